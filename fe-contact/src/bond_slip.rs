//! Bond between a bar with nodes of its own and the hexahedron around it.

use std::f64::consts::PI;
use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::kinematics::Interface;
use fe_core::material::{Material, Operator, PointContext};
use fe_core::mesh::NodeId;
use fe_core::points;
use fe_core::shape::{hex20, line3, quadrature};
use nalgebra::{Matrix3, Vector3};

/// Nodes of the element: 3 of the bar, 20 of the host.
const NODES: usize = 23;
/// Displacements of the element.
const N: usize = 3 * NODES;

const DOFS: [Dof; 3] = Dof::DISPLACEMENTS;

/// What the bond of a bar is.
#[derive(Debug, Clone)]
pub struct BondSlipBar {
    /// Diameter of the bar (mm).
    pub diameter_mm: f64,
    /// Stiffness that holds the bar in its channel, across the axis (MPa/mm).
    pub transverse_mpa_per_mm: f64,
    /// Law of the slip along the axis.
    pub law: Arc<dyn Material<Interface>>,
}

/// One Gauss point along the bar.
#[derive(Debug, Clone)]
struct Point {
    position: [f64; 3],
    /// Rows: the axis of the bar and two directions across it.
    axes: Matrix3<f64>,
    /// Signed shape functions: bar minus host.
    signed: [f64; NODES],
    /// Surface of the bar that the point stands for (mm2).
    area: f64,
}

impl Point {
    /// Slip along the axis and displacements across it (mm).
    fn jump(&self, u: &[f64]) -> Vector3<f64> {
        let mut jump = Vector3::zeros();
        for (n, u) in self.signed.iter().zip(u.chunks_exact(3)) {
            for k in 0..3 {
                jump[k] += n * u[k];
            }
        }
        self.axes * jump
    }
}

/// Line interface between a quadratic bar and the 20-node hexahedron that contains it.
///
/// Nodes: the bar's ends and middle, then the host. With the displacement of the host at the place of the bar,
/// the jump is d = sum N_a u_a (bar) - sum N_b(x) u_b (host); along the axis t of the bar the law answers the slip
/// s = t . d, across it an elastic stiffness holds the bar:
///
/// $$ f = \int \pi \phi B^T (\tau(s) t + K_t (1 - t t^T) d) dl, $$
///
/// with 3 Gauss points. The law is driven with the jump (s, 0, 0): what it does along its normal plays no part.
/// The stiffness of the bar itself is that of a truss on the same three nodes. Cut the bar where it crosses from
/// one host to the next, and give it a node there.
///
/// A [sample](Element::sample) has the slip and the displacements across the axis as strain and the surface of the bar
/// (mm2) as volume.
#[derive(Debug)]
pub struct BondSlip {
    nodes: [NodeId; NODES],
    points: Vec<Point>,
    size: f64,
    transverse: f64,
    law: Arc<dyn Material<Interface>>,
}

impl BondSlip {
    /// Bond of the bar on `nodes[..3]` at `coords` (mm) to the host on `nodes[3..]` at `host` (mm).
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] for a diameter or stiffness that is not positive, [`ElementError::Jacobian`] for a bar
    /// without length or whose middle node lies nearer to an end than a quarter, [`ElementError::NoHost`] where a point of the bar lies outside the host,
    /// [`ElementError::Material`] when the law refuses the point.
    pub fn new(
        nodes: [NodeId; NODES],
        coords: &[[f64; 3]; 3],
        host: &[[f64; 3]; 20],
        bar: &BondSlipBar,
    ) -> Result<Self, ElementError> {
        for (what, value) in [
            ("diameter_mm", bar.diameter_mm),
            ("transverse_mpa_per_mm", bar.transverse_mpa_per_mm),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(ElementError::Input {
                    what: what.into(),
                    value,
                    allowed: "(0, inf)".into(),
                    remedy: "give a positive number".into(),
                });
            }
        }
        if let Some((point, determinant)) = line3::turns_back(coords) {
            return Err(ElementError::Jacobian { point, determinant });
        }
        let chord = Vector3::from(coords[1]) - Vector3::from(coords[0]);
        let mut points = Vec::new();
        for (point, (xi, w)) in quadrature::gauss_legendre(3).into_iter().enumerate() {
            let (position, along, values, _) = line3::map(coords, xi);
            let determinant = along.norm();
            if determinant.is_nan() || along.dot(&chord) <= 0.0 {
                let determinant = determinant.copysign(along.dot(&chord));
                return Err(ElementError::Jacobian { point, determinant });
            }
            let inside = |xi: &[f64; 3]| xi.iter().all(|c| c.abs() <= 1.0 + 1e-6);
            let natural = hex20::inverse_map(host, position.into()).filter(inside);
            let Some(natural) = natural else {
                return Err(ElementError::no_host("with slip", position));
            };
            let around = hex20::shape(natural).0;
            points.push(Point {
                position: position.into(),
                axes: axes(&(along / determinant)),
                signed: std::array::from_fn(|a| if a < 3 { values[a] } else { -around[a - 3] }),
                area: PI * bar.diameter_mm * w * determinant,
            });
        }
        let size = points.iter().map(|p| p.area).sum::<f64>() / (PI * bar.diameter_mm);
        bar.law
            .admit(&PointContext::new(size))
            .map_err(|source| ElementError::Material { point: 0, source })?;
        Ok(Self {
            nodes,
            points,
            size,
            transverse: bar.transverse_mpa_per_mm,
            law: Arc::clone(&bar.law),
        })
    }

    /// The law of the slip.
    pub fn law(&self) -> &Arc<dyn Material<Interface>> {
        &self.law
    }
}

/// Rows: a unit vector and two more that complete it.
fn axes(axis: &Vector3<f64>) -> Matrix3<f64> {
    // The global direction farthest from the axis.
    let mut other = Vector3::zeros();
    other[axis.iamin()] = 1.0;
    let second = axis.cross(&other).normalize();
    let third = axis.cross(&second);
    Matrix3::from_rows(&[axis.transpose(), second.transpose(), third.transpose()])
}

/// The slip along the axis alone.
fn slip(jump: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(jump[0], 0.0, 0.0)
}

impl Element for BondSlip {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn dofs(&self) -> &'static [Dof] {
        &DOFS
    }

    fn state_len(&self) -> usize {
        self.points.len() * self.law.state_len()
    }

    fn init_state(&self, state: &mut [f64]) {
        points::init_state(self.law.as_ref(), state);
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
        let point_ctx = points::context(self.size, ctx);
        for (p, point) in self.points.iter().enumerate() {
            let jump = point.jump(u);
            let states = (committed, &mut *trial);
            let response = points::answer(law, (p, &slip(&jump)), states, &point_ctx)?;
            let across = self.transverse * jump;
            let stress = Vector3::new(response.stress[0], across[1], across[2]);
            let traction = point.axes.tr_mul(&stress) * point.area;
            for (f, s) in out.force.chunks_exact_mut(3).zip(point.signed) {
                for k in 0..3 {
                    f[k] += s * traction[k];
                }
            }
            if ctx.operator == Operator::None {
                continue;
            }
            let (along, across) = (response.tangent[(0, 0)], self.transverse);
            let local = Matrix3::from_diagonal(&Vector3::new(along, across, across));
            let d = point.axes.tr_mul(&local) * point.axes * point.area;
            for a in 0..NODES {
                for b in a..NODES {
                    let factor = point.signed[a] * point.signed[b];
                    for i in 0..3 {
                        for j in 0..3 {
                            out.stiffness[(3 * a + i) * N + 3 * b + j] += factor * d[(i, j)];
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        points::latch(self.law.as_ref(), trial, base)
    }

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Result<Option<f64>, ElementError> {
        let along = self.points.iter().map(|p| (p.area, slip(&p.jump(u))));
        let along = points::free_energy(self.law.as_ref(), self.size, state, along)?;
        let across = self.points.iter().map(|p| {
            let jump = p.jump(u);
            0.5 * p.area * self.transverse * (jump[1].powi(2) + jump[2].powi(2))
        });
        Ok(Some(along + across.sum::<f64>()))
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        let mut jumps = self.points.iter().map(|p| p.jump(u));
        let slips = self
            .points
            .iter()
            .map(|p| (p.position, p.area, slip(&p.jump(u))));
        points::sample(self.law.as_ref(), self.size, state, slips, &mut |s| {
            let Some(jump) = jumps.next() else {
                return;
            };
            let across = self.transverse * jump;
            visit(PointSample {
                strain: jump.as_slice(),
                stress: &[s.stress[0], across[1], across[2]],
                ..s
            });
        })
    }
}
