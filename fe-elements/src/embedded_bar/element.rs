//! The part of a bar inside one host, as an element on the host's nodes, and on its own where it slips.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::followers::Followers;
use fe_core::kinematics::Axial;
use fe_core::material::{Material, Operator, PointContext};
use fe_core::mesh::NodeId;
use fe_core::shape::{line3, quadrature};
use nalgebra::{Vector1, Vector3};

use super::cut::{Host, Piece};
use super::row::Row;
use super::{Bar, Dowel, gradients_at};
use crate::led::columns;
use crate::points;

/// One Gauss point of a bar.
#[derive(Debug, Clone)]
struct BarPoint {
    position: [f64; 3],
    arc_length: f64,
    weight: f64,
    /// Axial strain = `axial` . u.
    axial: Row,
    /// Transverse shear strain = `shear` . u.
    shear: Option<Row>,
}

/// The pieces of one bar inside one host.
#[derive(Debug)]
pub struct EmbeddedBar {
    bar: String,
    /// Whose displacements it shares; none if it slips.
    host: Option<[NodeId; 20]>,
    nodes: Vec<NodeId>,
    area: f64,
    dowel: Option<Dowel>,
    law: Arc<dyn Material<Axial>>,
    points: Vec<BarPoint>,
    /// Ends of each piece and the number of its points.
    pieces: Vec<([[f64; 3]; 2], usize)>,
}

impl EmbeddedBar {
    pub(super) fn new(bar: &Bar, host: &Host, pieces: &[Piece]) -> Result<Self, ElementError> {
        let rule = quadrature::gauss_legendre(if host.is_affine() { 2 } else { 4 });
        let mut element = Self::empty(bar, Some(host.nodes), host.nodes.into());
        for piece in pieces {
            element.add(bar, host, piece, &rule, |_, g| {
                axial_row(g, piece.direction)
            })?;
        }
        element.admitted()
    }

    /// The `piece` of a bar that slips, on the nodes `own`, its ends first, then its middle. The axial strain is
    /// e = sum dN_a/ds t . u_a over these; the dowel acts on the nodes of the host as with perfect bond.
    pub(super) fn slipping(
        bar: &Bar,
        host: &Host,
        piece: &Piece,
        own: [NodeId; 3],
    ) -> Result<Self, ElementError> {
        let nodes: Vec<NodeId> = match transverse(bar, piece.direction) {
            Some(_) => own.into_iter().chain(host.nodes).collect(),
            None => own.into(),
        };
        let count = 3 * nodes.len();
        let to_length = 2.0 / (piece.ends[1] - piece.ends[0]).norm();
        let mut element = Self::empty(bar, None, nodes);
        let rule = quadrature::gauss_legendre(2);
        element.add(bar, host, piece, &rule, |xi, _| {
            let mut row = vec![0.0; count];
            for (own, slope) in row.chunks_exact_mut(3).zip(line3::shape(xi).1) {
                own.copy_from_slice((to_length * slope * piece.direction).as_slice());
            }
            row
        })?;
        for point in &mut element.points {
            point.shear = point.shear.as_ref().map(|shear| shear.after(9));
        }
        element.admitted()
    }

    /// The element, unless its law refuses the length of the bar in it.
    fn admitted(self) -> Result<Self, ElementError> {
        self.law
            .admit(&PointContext::new(self.length()))
            .map_err(|source| ElementError::Material { point: 0, source })?;
        Ok(self)
    }

    /// A bar with no pieces yet.
    fn empty(bar: &Bar, host: Option<[NodeId; 20]>, nodes: Vec<NodeId>) -> Self {
        Self {
            bar: bar.name.clone(),
            host,
            nodes,
            area: bar.area_mm2,
            dowel: None,
            law: Arc::clone(&bar.law),
            points: Vec::new(),
            pieces: Vec::new(),
        }
    }

    /// Adds a piece with the points of `rule`. Their axial rows come from the natural coordinate along the piece and
    /// the gradients of the host's shape functions.
    fn add(
        &mut self,
        bar: &Bar,
        host: &Host,
        piece: &Piece,
        rule: &[(f64, f64)],
        axial: impl Fn(f64, &[[f64; 3]; 20]) -> Vec<f64>,
    ) -> Result<(), ElementError> {
        let [a, b] = piece.ends;
        let length = (b - a).norm();
        let transverse = transverse(bar, piece.direction);
        if transverse.is_some() {
            self.dowel = bar.dowel;
        }
        for &(xi, w) in rule {
            let share = 0.5 * (1.0 + xi);
            let position = a + share * (b - a);
            let Some(g) = gradients_at(host, position) else {
                return Err(ElementError::no_host(&bar.name, position));
            };
            self.points.push(BarPoint {
                position: position.into(),
                arc_length: piece.start + share * length,
                weight: 0.5 * w * length,
                axial: Row::new(&axial(xi, &g)),
                shear: transverse.map(|n| shear_row(&g, piece.direction, n)),
            });
        }
        self.pieces.push(([a.into(), b.into()], rule.len()));
        Ok(())
    }

    /// The same on the DOFs of the nodes that lead those of the host.
    #[must_use]
    pub fn led_by(mut self, followers: &Followers) -> Self {
        let (leaders, columns) = columns(&self.nodes, self.dofs(), followers);
        let led = |row: &Row| row.led(&columns, 3 * leaders.len());
        for point in &mut self.points {
            point.axial = led(&point.axial);
            point.shear = point.shear.as_ref().map(led);
        }
        self.nodes = leaders;
        self
    }

    /// Length of the histories of the points.
    fn axial_len(&self) -> usize {
        self.points.len() * self.law.state_len()
    }

    /// Whether the dowel can slide.
    fn slides(&self) -> bool {
        self.dowel.is_some_and(|d| d.is_bounded())
    }

    /// Name of the bar.
    pub fn bar(&self) -> &str {
        &self.bar
    }

    /// Length of the bar inside this host (mm).
    pub fn length(&self) -> f64 {
        self.points.iter().map(|p| p.weight).sum()
    }

    /// Axial strain and stress (MPa) at every point with its arc length along the bar (mm).
    ///
    /// # Errors
    ///
    /// [`ElementError::Material`].
    pub fn strains(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(f64, f64, f64),
    ) -> Result<(), ElementError> {
        let mut i = 0;
        self.sample(u, state, &mut |s| {
            visit(self.points[i].arc_length, s.strain[0], s.stress[0]);
            i += 1;
        })
    }
}

/// Direction in which a bar along t acts as a dowel, if it has one.
fn transverse(bar: &Bar, t: Vector3<f64>) -> Option<Vector3<f64>> {
    let normal = Vector3::from(bar.dowel?.plane_normal());
    normal.cross(&t).try_normalize(1e-6)
}

/// t . (grad u) t: entry (a, k) is (grad N_a . t) t_k.
fn axial_row(g: &[[f64; 3]; 20], t: Vector3<f64>) -> Vec<f64> {
    let mut row = vec![0.0; 60];
    for a in 0..20 {
        let along = Vector3::from(g[a]).dot(&t);
        for k in 0..3 {
            row[3 * a + k] = along * t[k];
        }
    }
    row
}

/// t . (grad u + grad u^T) n.
fn shear_row(g: &[[f64; 3]; 20], t: Vector3<f64>, n: Vector3<f64>) -> Row {
    let mut row = vec![0.0; 60];
    for a in 0..20 {
        let (along, across) = (Vector3::from(g[a]).dot(&t), Vector3::from(g[a]).dot(&n));
        for k in 0..3 {
            row[3 * a + k] = along * n[k] + across * t[k];
        }
    }
    Row::new(&row)
}

/// Axial strain of a point.
fn strain(point: &BarPoint, u: &[f64]) -> Vector1<f64> {
    Vector1::new(point.axial.dot(u))
}

impl Element for EmbeddedBar {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn dofs(&self) -> &'static [Dof] {
        &Dof::DISPLACEMENTS
    }

    /// The histories of the points, then the slid strains of bounded dowels.
    fn state_len(&self) -> usize {
        let slid = if self.slides() { self.points.len() } else { 0 };
        self.axial_len() + slid
    }

    fn init_state(&self, state: &mut [f64]) {
        let (axial, slid) = state.split_at_mut(self.axial_len());
        points::init_state(self.law.as_ref(), axial);
        slid.fill(0.0);
    }

    fn unsymmetric(&self) -> bool {
        self.slides()
    }

    fn evaluate(
        &self,
        u: &[f64],
        committed: &[f64],
        trial: &mut [f64],
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        let law = self.law.as_ref();
        let point_ctx = points::context(self.length(), ctx);
        let full = self.slides() && ctx.operator == Operator::Tangent;
        let (trial, slid) = trial.split_at_mut(self.axial_len());
        slid.copy_from_slice(&committed[self.axial_len()..]);
        for (p, point) in self.points.iter().enumerate() {
            let states = (committed, &mut *trial);
            let response = points::answer(law, (p, &strain(point, u)), states, &point_ctx)?;
            let axial = self.area * point.weight * response.stress[0];
            point.axial.add(axial, out.force);
            let mut add = |c: f64, rows: &Row, columns: &Row| {
                rows.add_outer(c * point.weight, columns, (u.len(), full), out.stiffness);
            };
            let slope = response.tangent[(0, 0)];
            if ctx.operator != Operator::None {
                add(self.area * slope, &point.axial, &point.axial);
            }
            let (Some(dowel), Some(shear)) = (&self.dowel, &point.shear) else {
                continue;
            };
            let kept = slid.get(p).copied().unwrap_or_default();
            let across = dowel.at(shear.dot(u), kept, response.stress[0]);
            if let Some(slid) = slid.get_mut(p) {
                *slid = across.slid;
            }
            shear.add(across.force * point.weight, out.force);
            match ctx.operator {
                Operator::None => {}
                Operator::Tangent => {
                    add(across.stiffness, shear, shear);
                    if across.by_axial != 0.0 {
                        add(across.by_axial * slope, shear, &point.axial);
                    }
                }
                Operator::Secant => add(dowel.stiffness(), shear, shear),
            }
        }
        Ok(())
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        let axial = self.axial_len();
        points::latch(self.law.as_ref(), &trial[..axial], &mut base[..axial])
    }

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Result<Option<f64>, ElementError> {
        let bar = self
            .points
            .iter()
            .map(|p| (self.area * p.weight, strain(p, u)));
        let energy = points::free_energy(self.law.as_ref(), self.length(), state, bar)?;
        let slid = &state[self.axial_len()..];
        let dowel = self.points.iter().enumerate().filter_map(|(i, p)| {
            let slid = slid.get(i).copied();
            let shear = p.shear.as_ref()?.dot(u);
            let stored = self.dowel?.free_energy(shear, slid.unwrap_or_default());
            Some(stored * p.weight)
        });
        Ok(Some(energy + dowel.sum::<f64>()))
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        let places = self.points.iter();
        let points = places.map(|p| (p.position, self.area * p.weight, strain(p, u)));
        points::sample(self.law.as_ref(), self.length(), state, points, visit)
    }

    fn host(&self) -> Option<&[NodeId; 20]> {
        self.host.as_ref()
    }

    fn segments(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut([[f64; 3]; 2], f64),
    ) -> Result<(), ElementError> {
        let mut stresses = Vec::with_capacity(self.points.len());
        self.sample(u, state, &mut |s| stresses.push(s.stress[0]))?;
        let mut rest = stresses.as_slice();
        for (ends, count) in &self.pieces {
            let (own, tail) = rest.split_at(*count);
            visit(*ends, own.iter().sum::<f64>() / *count as f64);
            rest = tail;
        }
        Ok(())
    }
}
