//! Integration points of a curved 8-node surface, with axes in its tangent plane.

use fe_core::element::ElementError;
use fe_core::shape::quad8;
use nalgebra::{Matrix2, Vector3};

use crate::quad8::{QuadRule, gradients};

/// Smallest angle between the direction of axis 1 and the normal (degrees).
const LEAST_ANGLE: f64 = 1.0;

/// One integration point.
#[derive(Debug)]
pub(crate) struct Place {
    /// Position (mm).
    pub(crate) position: [f64; 3],
    /// Axis 1, axis 2 and the normal; orthonormal, right-handed.
    pub(crate) axes: [Vector3<f64>; 3],
    /// Derivatives of the shape functions along axes 1 and 2 (1/mm).
    pub(crate) gradients: [[f64; 2]; 8],
    /// Area the point stands for (mm2).
    pub(crate) area: f64,
}

/// Base vectors dx/dxi and dx/deta (mm) of the surface.
fn base(coords: &[[f64; 3]; 8], slopes: &[[f64; 2]; 8]) -> [Vector3<f64>; 2] {
    std::array::from_fn(|k| {
        let terms = slopes.iter().zip(coords);
        terms.map(|(s, x)| s[k] * Vector3::from(*x)).sum()
    })
}

/// The integration points of a rule; axis 1 is the projection of the direction `axis`.
///
/// # Errors
///
/// [`ElementError::Jacobian`] where the surface degenerates or is folded against its normal in the middle,
/// [`ElementError::Input`] for an axis that is no direction or (almost) normal to the surface.
pub(crate) fn places(
    coords: &[[f64; 3]; 8],
    rule: QuadRule,
    axis: [f64; 3],
) -> Result<Vec<Place>, ElementError> {
    let [along, across] = base(coords, &quad8::shape([0.0; 2]).1);
    let middle = along.cross(&across);
    let place = |(point, (xi, weight)): (usize, ([f64; 2], f64))| {
        let (values, slopes) = quad8::shape(xi);
        let tangents = base(coords, &slopes);
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
        let (gradients, determinant) = gradients(&slopes, jacobian)
            .map_err(|determinant| ElementError::Jacobian { point, determinant })?;
        let position: Vector3<f64> = values
            .iter()
            .zip(coords)
            .map(|(n, x)| *n * Vector3::from(*x))
            .sum();
        Ok(Place {
            position: position.into(),
            axes,
            gradients,
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
