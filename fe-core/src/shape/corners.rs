//! Cells and faces that are turned over at a corner: integration points may not see it.

use nalgebra::Vector3;

use super::quad8;
use crate::element::ElementError;

/// Share of the Jacobian determinant in the middle by which that of a corner may be negative: exchanged nodes give -1 or
/// less, the patch of MacNeal and Harder (1985), which is distorted only, -0.05 (assumed).
const FLAT: f64 = 0.25;

/// Refuses a face or cell whose determinants at the corners say that it is turned over at one, against that in its `middle`:
/// two of its nodes may be exchanged. A corner may be flat, as in a wedge.
///
/// # Errors
///
/// [`ElementError::Jacobian`], naming the corner.
pub fn corners_turn(corners: impl Iterator<Item = f64>, middle: f64) -> Result<(), ElementError> {
    let turned = |(_, determinant): &(usize, f64)| *determinant < -FLAT * middle.abs();
    match corners.enumerate().find(turned) {
        Some((point, determinant)) => Err(ElementError::Jacobian { point, determinant }),
        None => Ok(()),
    }
}

/// Area vector dx/dxi x dx/deta (mm2) in the middle of an 8-node face through `coords` (mm), unless it is turned over at a
/// corner.
///
/// # Errors
///
/// [`ElementError::Jacobian`], naming the corner.
pub fn middle_of_face(coords: &[[f64; 3]; 8]) -> Result<Vector3<f64>, ElementError> {
    let area = |xi| {
        let [along, across] = quad8::base(coords, &quad8::shape(xi).1);
        along.cross(&across)
    };
    let middle = area([0.0; 2]);
    let corner = |xi: &[f64; 2]| area(*xi).dot(&middle) / middle.norm();
    corners_turn(quad8::NODES[..4].iter().map(corner), middle.norm())?;
    Ok(middle)
}
