//! Isotropic tensor functions in principal axes.

use nalgebra::{Matrix3, Matrix6, Vector3};

use fe_core::voigt::{SHEAR_PAIRS, strain_transform};

/// Gap of two principal values, relative to the largest, below which they count as equal.
const EQUAL: f64 = 1e-7;

/// Difference quotient (y_i - y_j)/(x_i - x_j) of an isotropic function y(x) for each shear pair; for equal
/// x its limit dy_i/dx_i - dy_i/dx_j, from the Jacobian `slopes`.
pub(crate) fn spin_quotients(
    x: &Vector3<f64>,
    y: &Vector3<f64>,
    slopes: &Matrix3<f64>,
) -> [f64; 3] {
    let scale = x.amax();
    SHEAR_PAIRS.map(|(i, j)| {
        let gap = x[i] - x[j];
        if gap.abs() > EQUAL * scale {
            (y[i] - y[j]) / gap
        } else {
            let first = slopes[(i, i)] - slopes[(i, j)];
            first.midpoint(slopes[(j, j)] - slopes[(j, i)])
        }
    })
}

/// The tangent with the given normal block and shear moduli in axes (columns), turned into Voigt axes.
pub(crate) fn from_principal(
    axes: &Matrix3<f64>,
    normal: &Matrix3<f64>,
    shear: [f64; 3],
) -> Matrix6<f64> {
    let t = strain_transform(axes);
    let mut local = Matrix6::zeros();
    local.fixed_view_mut::<3, 3>(0, 0).copy_from(normal);
    for k in 0..3 {
        local[(3 + k, 3 + k)] = shear[k];
    }
    t.tr_mul(&(local * t))
}
