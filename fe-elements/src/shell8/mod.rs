//! The 8-node layered shell.

mod director;
mod section;
mod transverse;

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::kinematics::PlaneStress;
use fe_core::material::{Material, Operator, PointContext};
use fe_core::mesh::{CellKind, NodeId};
use nalgebra::Vector3;

use crate::points;
use crate::quad8::QuadRule;
use crate::sheet::Point;
use crate::surface;

use director::{directors, with_rotations};
pub use section::{Layer, ShellSection};
use transverse::{TiedShear, add_drilling};

const DOFS_PER_ELEMENT: usize = 48;

/// Flat or curved layered shell with transverse shear (Reissner-Mindlin), three displacements and three
/// rotations per node.
///
/// The material above node a moves as u_a + z theta_a x d_a, the director d_a being the normal of the surface at the
/// node: a level z of the thickness is a [`Membrane8`](crate::Membrane8) through the points x_a + z d_a, and its law,
/// in plane stress, is evaluated at every Gauss point of every level,
///
/// f = sum_levels sum w B(z)^T sigma + k sum_points w S^T A S u + drilling.
///
/// - Transverse shear S with A = sum t_k G_k is elastic and constant through the thickness. Its natural strains
///   are interpolated from points where thin plates can bend without them, so that the shell does not lock: two on
///   each of two opposite edges, and the mean of two in between.
/// - Drilling: the energy (1/2) c int (theta . n - omega_n)^2 dA, omega_n = (e_2 . u,_1 - e_1 . u,_2)/2 being
///   the rotation of the surface in its plane, holds the rotation about the normal. The stiffness c is
///   [`ShellSection::drilling`] times half the trace of A. Rigid-body motions and constant membrane strain do not
///   strain it.
///
/// With [`QuadRule::Reduced`] membrane strains do not lock either; a single free element then has one mechanism
/// beside its rigid-body modes (two if it is flat), which a neighbour prevents. With [`QuadRule::Full`] it has none,
/// but a thin curved shell is far too stiff on a coarse mesh. The director is taken as normal to the surface between
/// the nodes too, and the thickness is measured along the normal.
///
/// Sources: S. Ahmad, B. M. Irons, O. C. Zienkiewicz, "Analysis of thick and thin shell structures by curved finite
/// elements", Int. J. Numer. Meth. Eng. 2 (1970) 419-451 (kinematics); K.-J. Bathe, E. N. Dvorkin, "A formulation
/// of general shell elements: the use of mixed interpolation of tensorial components", Int. J. Numer. Meth. Eng. 22
/// (1986) 697-722 (transverse shear of the 8-node element); T. J. R. Hughes, F. Brezzi, "On drilling degrees of
/// freedom", Comput. Methods Appl. Mech. Eng. 72 (1989) 105-121 (drilling).
#[derive(Debug)]
pub struct Shell8 {
    nodes: [NodeId; 8],
    /// Points of one layer after the other.
    points: Vec<Point<DOFS_PER_ELEMENT>>,
    laws: Vec<Arc<dyn Material<PlaneStress>>>,
    /// Transverse shear and drilling, row-major.
    elastic: Vec<f64>,
    band_width: f64,
}

impl Shell8 {
    /// An element at `coords` (mm); axis 1 of the section is the projection of the direction `axis` on the
    /// surface, axis 2 = normal x axis 1.
    ///
    /// # Errors
    ///
    /// [`ElementError::Jacobian`] for a folded or too distorted cell or one too thick for its curvature;
    /// [`ElementError::Input`] for an impossible section or an axis within a degree of the normal;
    /// [`ElementError::Material`] when a law refuses the crack-band width, which is the square root of the area.
    pub fn new(
        nodes: [NodeId; 8],
        coords: &[[f64; 3]; 8],
        section: &ShellSection,
        rule: QuadRule,
        axis: [f64; 3],
    ) -> Result<Self, ElementError> {
        section.admit()?;
        let middle = surface::places(coords, rule, axis)?;
        let directors = directors(coords)?;
        let mut points = Vec::new();
        for level in section.levels() {
            let raised =
                std::array::from_fn(|a| (Vector3::from(coords[a]) + level.z * directors[a]).into());
            let angle = section.layers[level.layer].angle_deg.to_radians();
            let places = surface::places(&raised, rule, axis)?;
            for (place, below) in places.into_iter().zip(&middle) {
                if place.axes[2].dot(&below.axes[2]) <= 0.0 {
                    return Err(ElementError::Jacobian {
                        point: points.len(),
                        determinant: -place.area * level.thickness,
                    });
                }
                let place = place.turned(angle);
                points.push(Point {
                    position: place.position,
                    volume: level.thickness * place.area,
                    b: with_rotations(&place.strain(), level.z, &directors),
                });
            }
        }

        let mut elastic = vec![0.0; DOFS_PER_ELEMENT * DOFS_PER_ELEMENT];
        let shear = section.shear_stiffness();
        let tied = TiedShear::new(coords, &directors);
        for place in &middle {
            tied.add_stiffness(place, &(section.shear_correction * shear), &mut elastic);
        }
        // Eight rotations about the normal need nine points.
        for place in surface::places(coords, QuadRule::Full, axis)? {
            add_drilling(&place, 0.5 * section.drilling * shear.trace(), &mut elastic);
        }

        let area: f64 = middle.iter().map(|place| place.area).sum();
        let band_width = area.sqrt();
        let laws: Vec<_> = section.layers.iter().map(|l| Arc::clone(&l.law)).collect();
        let per_layer = points.len() / laws.len();
        for (k, law) in laws.iter().enumerate() {
            let point = k * per_layer;
            law.admit(&PointContext::new(band_width))
                .map_err(|source| ElementError::Material { point, source })?;
        }
        Ok(Self {
            nodes,
            points,
            laws,
            elastic,
            band_width,
        })
    }

    /// Each layer's law, number of its first point, points and place of its history.
    fn layers(&self) -> impl Iterator<Item = LayerPoints<'_>> {
        let per_layer = self.points.len() / self.laws.len();
        let mut start = 0;
        let layers = self.laws.iter().zip(self.points.chunks_exact(per_layer));
        layers.enumerate().map(move |(k, (law, points))| {
            let history = start..start + per_layer * law.state_len();
            start = history.end;
            LayerPoints {
                law: law.as_ref(),
                first: k * per_layer,
                points,
                history,
            }
        })
    }

    /// Transverse shear and drilling: row i of the stiffness times u.
    fn elastic_force(&self, i: usize, u: &[f64]) -> f64 {
        let row = &self.elastic[i * DOFS_PER_ELEMENT..(i + 1) * DOFS_PER_ELEMENT];
        row.iter().zip(u).map(|(k, u)| k * u).sum()
    }
}

/// The integration points of a layer.
struct LayerPoints<'a> {
    law: &'a dyn Material<PlaneStress>,
    /// Number of its first point in the element.
    first: usize,
    points: &'a [Point<DOFS_PER_ELEMENT>],
    /// Its part of the state of the element.
    history: std::ops::Range<usize>,
}

/// An error of a layer, its point counted in the element.
fn in_element(error: ElementError, first: usize) -> ElementError {
    match error {
        ElementError::Material { point, source } => ElementError::Material {
            point: first + point,
            source,
        },
        other => other,
    }
}

impl Element for Shell8 {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn dofs(&self) -> &'static [Dof] {
        &Dof::ALL
    }

    fn state_len(&self) -> usize {
        self.layers().last().map_or(0, |layer| layer.history.end)
    }

    fn init_state(&self, state: &mut [f64]) {
        for layer in self.layers() {
            points::init_state(layer.law, &mut state[layer.history]);
        }
    }

    fn evaluate(
        &self,
        u: &[f64],
        committed: &[f64],
        trial: &mut [f64],
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        let point_ctx = points::context(self.band_width, ctx);
        let unsymmetric = self.unsymmetric();
        for (i, force) in out.force.iter_mut().enumerate() {
            *force += self.elastic_force(i, u);
        }
        if ctx.operator != Operator::None {
            for (k, elastic) in out.stiffness.iter_mut().zip(&self.elastic) {
                *k += elastic;
            }
        }
        for layer in self.layers() {
            let n = layer.law.state_len();
            for (p, point) in layer.points.iter().enumerate() {
                let start = layer.history.start + p * n;
                let response = layer
                    .law
                    .update(
                        &point.strain(u),
                        &committed[start..start + n],
                        &mut trial[start..start + n],
                        &point_ctx,
                    )
                    .map_err(|source| ElementError::Material {
                        point: layer.first + p,
                        source,
                    })?;
                point.add(
                    &response,
                    ctx.operator,
                    unsymmetric,
                    out.force,
                    out.stiffness,
                );
            }
        }
        Ok(())
    }

    fn cell(&self) -> Option<(CellKind, &[NodeId])> {
        Some((CellKind::Quad8, self.nodes()))
    }

    fn unsymmetric(&self) -> bool {
        self.laws.iter().any(|law| law.unsymmetric_tangent())
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        self.layers().fold(false, |any, layer| {
            let history = layer.history;
            points::latch(layer.law, &trial[history.clone()], &mut base[history]) | any
        })
    }

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Result<Option<f64>, ElementError> {
        let elastic: f64 = u
            .iter()
            .enumerate()
            .map(|(i, u_i)| u_i * self.elastic_force(i, u))
            .sum();
        let mut sum = 0.5 * elastic;
        for layer in self.layers() {
            let points = layer.points.iter().map(|p| (p.volume, p.strain(u)));
            let state = &state[layer.history];
            sum += points::free_energy(layer.law, self.band_width, state, points)
                .map_err(|error| in_element(error, layer.first))?;
        }
        Ok(Some(sum))
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        for layer in self.layers() {
            let points = layer
                .points
                .iter()
                .map(|p| (p.position, p.volume, p.strain(u)));
            let state = &state[layer.history];
            points::sample(layer.law, self.band_width, state, points, visit)
                .map_err(|error| in_element(error, layer.first))?;
        }
        Ok(())
    }
}
