//! Zero-thickness interface between two 8-node faces.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::kinematics::Interface;
use fe_core::material::{Material, Operator, PointContext};
use fe_core::mesh::NodeId;
use fe_core::points;
use fe_core::shape::corners::middle_of_face;
use fe_core::shape::{quad8, quadrature};
use nalgebra::{Matrix3, Vector3};

/// Integration rule of an [`Interface16`].
///
/// Gauss points resolve the gradient of slip best. Where K h^2 is large against the membrane stiffness of
/// what is bonded, their traction oscillates within an element, and Lobatto points, which lie on the nodes,
/// do not (Schellekens and de Borst 1993).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InterfaceRule {
    /// 3 x 3 Gauss points.
    #[default]
    Gauss3,
    /// 2 x 2 Gauss points.
    Gauss2,
    /// 3 x 3 Gauss-Lobatto points: the 8 nodes and the centre.
    Lobatto3,
}

impl InterfaceRule {
    /// Natural coordinates and weights.
    fn points(self) -> Vec<([f64; 2], f64)> {
        match self {
            Self::Gauss3 => quadrature::square(3),
            Self::Gauss2 => quadrature::square(2),
            Self::Lobatto3 => quadrature::lobatto_square(),
        }
    }
}

/// One integration point.
#[derive(Debug, Clone)]
struct Point {
    position: [f64; 3],
    /// Shape functions of the 8 nodes of a face.
    values: [f64; 8],
    /// Rows: the axes t1, t2, n.
    axes: Matrix3<f64>,
    /// Area the point stands for (mm2).
    area: f64,
}

impl Point {
    /// Jump (mm) along t1, t2, n, from those of the nodes.
    fn jump(&self, nodes: &Jumps) -> Vector3<f64> {
        let mut jump = Vector3::zeros();
        for (n, node) in self.values.iter().zip(nodes) {
            for k in 0..3 {
                jump[k] += n * node[k];
            }
        }
        self.axes * jump
    }
}

/// u_(a+8) - u_a (mm) of the 8 pairs of nodes.
type Jumps = [[f64; 3]; 8];

fn jumps(u: &[f64]) -> Jumps {
    let (lower, upper) = u.split_at(N / 2);
    std::array::from_fn(|a| std::array::from_fn(|k| upper[3 * a + k] - lower[3 * a + k]))
}

/// Interface of zero thickness between two faces of 8 nodes each.
///
/// ```text
///        t2        upper face: nodes 8..16, node 8+a opposite to node a
///        |  3----6----2
///        |  |         |     n out of the page, from the lower to the upper face
///        |  7         5
///        |  |         |     lower face: nodes 0..8, order of the VTK quadrilateral
///        |  0----4----1
///        +------- t1
/// ```
///
/// Jump d = sum N_a (u_(a+8) - u_a), seen in the axes t1, t2, n at the point: n is the unit normal of
/// the lower face by its node order (outward for the faces of a hexahedron, to which a sheet is then the
/// upper face), t1 a given direction projected onto the face, t2 = n x t1. Opening is positive.
///
/// $$ f = \sum w J B^T t(d), \qquad K = \sum w J B^T D B $$
///
/// Traction t (MPa) and D (MPa/mm) come from a law over [`Interface`]. The geometry is that of the lower face;
/// the upper one may coincide with it or lie at a distance, which must then be small against the size of
/// the element, since its lever arm is not seen.
///
/// A [sample](Element::sample) of a point has the jump (mm) as strain and the area (mm2) as volume, so that
/// volume times energy density is an energy here too. The crack-band width handed to the law is the square
/// root of the area.
#[derive(Debug)]
pub struct Interface16 {
    nodes: [NodeId; 16],
    points: Vec<Point>,
    size: f64,
    law: Arc<dyn Material<Interface>>,
}

const DOFS: [Dof; 3] = Dof::DISPLACEMENTS;

/// Displacements of the element.
const N: usize = 48;

impl Interface16 {
    /// An element whose lower face lies at `coords` (mm); `direction` shows where t1 goes and need not be a
    /// unit vector.
    ///
    /// # Errors
    ///
    /// [`ElementError::Jacobian`] for a face without area or that folds over, also at a corner, [`ElementError::Input`] for a direction that is
    /// normal to it, or [`ElementError::Material`] when the law refuses the point.
    pub fn new(
        nodes: [NodeId; 16],
        coords: &[[f64; 3]; 8],
        direction: [f64; 3],
        rule: InterfaceRule,
        law: Arc<dyn Material<Interface>>,
    ) -> Result<Self, ElementError> {
        let middle = middle_of_face(coords)?;
        let mut points = Vec::new();
        for (point, (xi, w)) in rule.points().into_iter().enumerate() {
            let (values, slopes) = quad8::shape(xi);
            let mut position = Vector3::zeros();
            for (n, x) in values.iter().zip(coords) {
                position += *n * Vector3::from(*x);
            }
            let [along, across] = quad8::base(coords, &slopes);
            let normal = along.cross(&across);
            let determinant = normal.norm();
            let scale = along.norm() * across.norm();
            if determinant.is_nan() || determinant <= 1e-9 * scale || normal.dot(&middle) <= 0.0 {
                let determinant = determinant.copysign(normal.dot(&middle));
                return Err(ElementError::Jacobian { point, determinant });
            }
            points.push(Point {
                position: position.into(),
                values,
                axes: axes(&(normal / determinant), direction)?,
                area: determinant * w,
            });
        }
        let size = points.iter().map(|p| p.area).sum::<f64>().sqrt();
        law.admit(&PointContext::new(size))
            .map_err(|source| ElementError::Material { point: 0, source })?;
        Ok(Self {
            nodes,
            points,
            size,
            law,
        })
    }

    /// The law.
    pub fn law(&self) -> &Arc<dyn Material<Interface>> {
        &self.law
    }
}

/// Adds the blocks of the stiffness: minus between the faces, plus within each.
fn spread(sums: &[[[[f64; 3]; 3]; 8]; 8], stiffness: &mut [f64]) {
    for (row, out) in stiffness.chunks_exact_mut(N).enumerate() {
        let (a, i) = (row / 3, row % 3);
        for (b, out) in out.chunks_exact_mut(3).enumerate() {
            let block = &sums[a % 8][b % 8][i];
            for (out, k) in out.iter_mut().zip(block) {
                *out += if (a < 8) == (b < 8) { *k } else { -*k };
            }
        }
    }
}

/// Rows t1, t2, n of a unit normal and a direction.
fn axes(normal: &Vector3<f64>, direction: [f64; 3]) -> Result<Matrix3<f64>, ElementError> {
    let given = Vector3::from(direction);
    let tangent = given - normal * normal.dot(&given);
    let share = tangent.norm() / given.norm();
    if share.is_nan() || share < 1e-6 {
        return Err(ElementError::Input {
            what: "part of the reference direction in the plane of the interface".into(),
            value: share,
            allowed: "[1e-6, 1]".into(),
            remedy: "give a direction along the interface".into(),
        });
    }
    let first = tangent.normalize();
    let second = normal.cross(&first);
    Ok(Matrix3::from_rows(&[
        first.transpose(),
        second.transpose(),
        normal.transpose(),
    ]))
}

impl Element for Interface16 {
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
        let nodes = jumps(u);
        // Of the upper face; the lower one has the opposite.
        let mut forces = [[0.0; 3]; 8];
        // Sums of w J N_a N_b D, of which the blocks of K are copies.
        let mut sums = (ctx.operator != Operator::None).then_some([[[[0.0; 3]; 3]; 8]; 8]);
        for (p, point) in self.points.iter().enumerate() {
            let states = (committed, &mut *trial);
            let response = points::answer(law, (p, &point.jump(&nodes)), states, &point_ctx)?;
            let traction = point.axes.tr_mul(&response.stress) * point.area;
            for (force, n) in forces.iter_mut().zip(point.values) {
                for k in 0..3 {
                    force[k] += n * traction[k];
                }
            }
            let Some(sums) = &mut sums else {
                continue;
            };
            let d = point.axes.tr_mul(&response.tangent) * point.axes * point.area;
            for a in 0..8 {
                for b in 0..8 {
                    let factor = point.values[a] * point.values[b];
                    for i in 0..3 {
                        for j in 0..3 {
                            sums[a][b][i][j] += factor * d[(i, j)];
                        }
                    }
                }
            }
        }
        let (lower, upper) = out.force.split_at_mut(N / 2);
        for (k, force) in forces.as_flattened().iter().enumerate() {
            lower[k] -= force;
            upper[k] += force;
        }
        if let Some(sums) = sums {
            spread(&sums, out.stiffness);
        }
        Ok(())
    }

    fn interface_face(&self) -> Option<[NodeId; 8]> {
        Some(std::array::from_fn(|a| self.nodes[a]))
    }

    fn unsymmetric(&self) -> bool {
        self.law.unsymmetric_tangent()
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        points::latch(self.law.as_ref(), trial, base)
    }

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Result<Option<f64>, ElementError> {
        let nodes = jumps(u);
        let points = self.points.iter().map(|p| (p.area, p.jump(&nodes)));
        points::free_energy(self.law.as_ref(), self.size, state, points).map(Some)
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        let nodes = jumps(u);
        let point = |p: &Point| (p.position, p.area, p.jump(&nodes));
        let points = self.points.iter().map(point);
        points::sample(self.law.as_ref(), self.size, state, points, visit)
    }
}
