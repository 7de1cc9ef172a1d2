//! Integration points of a curved 8-node surface, with axes in its tangent plane.

use fe_core::element::ElementError;
use fe_core::shape::corners::middle_of_face;
use fe_core::shape::quad8;
use nalgebra::{Matrix2, Rotation2, Vector2, Vector3};

use crate::quad8::{QuadRule, gradients, invert};

/// Smallest angle between the direction of axis 1 and the normal (degrees).
const LEAST_ANGLE: f64 = 1.0;

/// One integration point.
#[derive(Debug)]
pub(crate) struct Place {
    /// Position (mm).
    pub(crate) position: [f64; 3],
    /// Natural coordinates.
    pub(crate) xi: [f64; 2],
    /// Shape functions.
    pub(crate) values: [f64; 8],
    /// Axis 1, axis 2 and the normal; orthonormal, right-handed.
    pub(crate) axes: [Vector3<f64>; 3],
    /// Derivatives of the natural coordinates: dxi_r/ds_c at (c, r) (1/mm).
    pub(crate) inverse: Matrix2<f64>,
    /// Derivatives of the shape functions along axes 1 and 2 (1/mm).
    pub(crate) gradients: [[f64; 2]; 8],
    /// Area the point stands for (mm2).
    pub(crate) area: f64,
}

impl Place {
    /// The point with axes 1 and 2 turned by an angle (radians) about the normal.
    pub(crate) fn turned(mut self, angle: f64) -> Self {
        let turn = Rotation2::new(angle);
        let [first, second, normal] = self.axes;
        let (s, c) = angle.sin_cos();
        self.axes = [c * first + s * second, c * second - s * first, normal];
        self.inverse = turn.matrix().transpose() * self.inverse;
        self.gradients = self
            .gradients
            .map(|g| (turn.inverse() * Vector2::from(g)).into());
        self
    }

    /// Strains 11, 22, 12 (engineering shear) per nodal displacement, node-major (1/mm).
    pub(crate) fn strain(&self) -> [[f64; 24]; 3] {
        let mut b = [[0.0; 24]; 3];
        for (a, [g1, g2]) in self.gradients.into_iter().enumerate() {
            for k in 0..3 {
                let (e1, e2) = (self.axes[0][k], self.axes[1][k]);
                b[0][3 * a + k] = g1 * e1;
                b[1][3 * a + k] = g2 * e2;
                b[2][3 * a + k] = g2 * e1 + g1 * e2;
            }
        }
        b
    }
}

/// The integration points of a rule; axis 1 is the projection of the direction `axis`.
///
/// # Errors
///
/// [`ElementError::Jacobian`] where the surface degenerates or is folded against its normal in the middle, also at a corner,
/// [`ElementError::Input`] for an axis that is no direction or (almost) normal to the surface.
pub(crate) fn places(
    coords: &[[f64; 3]; 8],
    rule: QuadRule,
    axis: [f64; 3],
) -> Result<Vec<Place>, ElementError> {
    let middle = middle_of_face(coords)?;
    let place = |(point, (xi, weight)): (usize, ([f64; 2], f64))| {
        let (values, slopes) = quad8::shape(xi);
        let tangents = quad8::base(coords, &slopes);
        let area_vector = tangents[0].cross(&tangents[1]);
        let area = area_vector.norm();
        let sense = area_vector.dot(&middle);
        if sense.is_nan() || sense <= 0.0 {
            let determinant = -area;
            return Err(ElementError::Jacobian { point, determinant });
        }
        let normal = area_vector / area;
        let axes = material_axes(point, normal, axis)?;
        let jacobian = Matrix2::from_fn(|r, c| tangents[r].dot(&axes[c]));
        let (inverse, determinant) = invert(jacobian)
            .map_err(|determinant| ElementError::Jacobian { point, determinant })?;
        let position: Vector3<f64> = values
            .iter()
            .zip(coords)
            .map(|(n, x)| *n * Vector3::from(*x))
            .sum();
        Ok(Place {
            position: position.into(),
            xi,
            values,
            axes,
            inverse,
            gradients: gradients(&slopes, &inverse),
            area: weight * determinant,
        })
    };
    rule.points().into_iter().enumerate().map(place).collect()
}

/// Axis 1 (the projection of `axis`), axis 2 and the normal.
fn material_axes(
    point: usize,
    normal: Vector3<f64>,
    axis: [f64; 3],
) -> Result<[Vector3<f64>; 3], ElementError> {
    let axis = Vector3::from(axis);
    let unit = axis / axis.norm();
    let projected = unit - unit.dot(&normal) * normal;
    let sine = projected.norm();
    if sine.is_nan() || sine < LEAST_ANGLE.to_radians().sin() {
        return Err(ElementError::Input {
            what: format!(
                "angle between axis 1 and the normal (degrees) at integration point {point}"
            ),
            value: sine.asin().to_degrees(),
            allowed: format!("[{LEAST_ANGLE}, 90]"),
            remedy: "give a direction, not zero, that lies more in the surface".into(),
        });
    }
    let first = projected / sine;
    Ok([first, normal.cross(&first), normal])
}
