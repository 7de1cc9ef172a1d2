//! The 8-node membrane in space.

use std::sync::Arc;

use fe_core::element::ElementError;
use fe_core::kinematics::PlaneStress;
use fe_core::material::Material;
use fe_core::mesh::NodeId;

use crate::quad8::QuadRule;
use crate::sheet::{Point, Sheet, admit_thickness};
use crate::surface;

/// Flat or curved sheet of constant thickness without bending stiffness: three displacements per node.
///
/// With the unit normal n of the surface and the material axes e_1, e_2 in its tangent plane, the small strain
/// of a point is
///
/// eps_ab = (e_a . du/ds_b + e_b . du/ds_a)/2, gamma_12 = 2 eps_12, a, b = 1, 2,
///
/// s_a being the length along e_a; K = sum t w B^T D B as for [`Quad8`](crate::Quad8).
///
/// Axis 1 is a given direction projected on the surface at every integration point, axis 2 is n x e_1, and n
/// follows from the order of the nodes (counter-clockwise seen from its tip). The law works in these axes: the
/// fibres of a ply at an angle lie at that angle from axis 1 towards axis 2.
///
/// A flat membrane has no stiffness normal to itself: what it is tied to must hold it.
///
/// Source: K.-J. Bathe, "Finite Element Procedures" (1996), section 5.3.1 (isoparametric elements in plane
/// stress, here in the tangent plane of the point).
pub type Membrane8 = Sheet<24>;

impl Membrane8 {
    /// An element at `coords` (mm) with `thickness` (mm) and the direction `axis` (global, of any length) whose
    /// projection is axis 1 of the law.
    ///
    /// # Errors
    ///
    /// [`ElementError::Jacobian`] for a folded or too distorted cell; [`ElementError::Input`] for a thickness
    /// that is not positive or an axis within a degree of the normal; [`ElementError::Material`] when the law
    /// refuses the crack-band width, which is the square root of the area.
    pub fn new(
        nodes: [NodeId; 8],
        coords: &[[f64; 3]; 8],
        thickness: f64,
        rule: QuadRule,
        axis: [f64; 3],
        law: Arc<dyn Material<PlaneStress>>,
    ) -> Result<Self, ElementError> {
        admit_thickness(thickness)?;
        let mut points = Vec::new();
        for place in surface::places(coords, rule, axis)? {
            points.push(Point {
                position: place.position,
                volume: thickness * place.area,
                b: place.strain(),
            });
        }
        Self::of_points(nodes, points, thickness, law)
    }
}
