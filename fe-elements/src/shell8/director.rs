//! Directors of a shell: the lines that stay straight.

use fe_core::element::ElementError;
use fe_core::shape::quad8;
use nalgebra::Vector3;

use super::DOFS_PER_ELEMENT as N;

/// Unit normals of the surface at the nodes.
pub(super) fn directors(coords: &[[f64; 3]; 8]) -> Result<[Vector3<f64>; 8], ElementError> {
    let mut directors = [Vector3::zeros(); 8];
    for (point, xi) in quad8::NODES.into_iter().enumerate() {
        let [along, across] = quad8::base(coords, &quad8::shape(xi).1);
        let normal = along.cross(&across);
        let determinant = normal.norm();
        if determinant.is_nan() || determinant <= 0.0 {
            return Err(ElementError::Jacobian { point, determinant });
        }
        directors[point] = normal / determinant;
    }
    Ok(directors)
}

/// Strain rows on displacements and rotations, from those on the displacements u + z theta x d of a level.
pub(super) fn with_rotations(
    rows: &[[f64; 24]; 3],
    z: f64,
    directors: &[Vector3<f64>; 8],
) -> [[f64; N]; 3] {
    rows.map(|row| {
        let mut out = [0.0; N];
        for (a, b) in row.chunks_exact(3).enumerate() {
            let turn = z * directors[a].cross(&Vector3::from_column_slice(b));
            out[6 * a..6 * a + 3].copy_from_slice(b);
            out[6 * a + 3..6 * a + 6].copy_from_slice(turn.as_slice());
        }
        out
    })
}
