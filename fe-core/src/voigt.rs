//! Voigt algebra: order xx, yy, zz, xy, yz, xz; engineering shear strain, tensor shear stress.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

pub use crate::principal::principal;

/// Index pairs of the Voigt components.
pub const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];

/// Index pairs of the shear components.
pub const SHEAR_PAIRS: [(usize, usize); 3] = [PAIRS[3], PAIRS[4], PAIRS[5]];

/// Symmetric tensor of a Voigt stress.
pub fn stress_tensor(s: &Vector6<f64>) -> Matrix3<f64> {
    Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2])
}

/// Tensor components of a Voigt strain (shear components halved), in the same order.
pub fn strain_components(e: &Vector6<f64>) -> Vector6<f64> {
    Vector6::new(e[0], e[1], e[2], 0.5 * e[3], 0.5 * e[4], 0.5 * e[5])
}

/// Symmetric tensor of a Voigt strain.
pub fn strain_tensor(e: &Vector6<f64>) -> Matrix3<f64> {
    stress_tensor(&strain_components(e))
}

/// Voigt stress of a symmetric tensor.
pub fn stress_voigt(t: &Matrix3<f64>) -> Vector6<f64> {
    Vector6::from_fn(|i, _| t[PAIRS[i]])
}

/// Voigt strain of a symmetric tensor (shear components doubled).
pub fn strain_voigt(t: &Matrix3<f64>) -> Vector6<f64> {
    Vector6::from_fn(|i, _| {
        if i < 3 {
            t[PAIRS[i]]
        } else {
            2.0 * t[PAIRS[i]]
        }
    })
}

/// Strain transformation T (6 x 6) into axes `n` (columns are the unit axes): e_local = T e,
/// and, by work conjugacy, sigma = T^T sigma_local and D = T^T D_local T.
pub fn strain_transform(n: &Matrix3<f64>) -> Matrix6<f64> {
    let mut t = Matrix6::zeros();
    for (row, &(a, b)) in PAIRS.iter().enumerate() {
        let factor = if row < 3 { 1.0 } else { 2.0 };
        for (col, &(k, l)) in PAIRS.iter().enumerate() {
            // Engineering shear gamma_kl stands for two tensor components of gamma/2 each.
            t[(row, col)] = if col < 3 {
                factor * n[(k, a)] * n[(k, b)]
            } else {
                0.5 * factor * (n[(k, a)] * n[(l, b)] + n[(l, a)] * n[(k, b)])
            };
        }
    }
    t
}

/// Strain in axes `n` (columns are the unit axes), N^T e N: [`strain_transform`] times the strain, for less.
pub fn strain_into(n: &Matrix3<f64>, strain: &Vector6<f64>) -> Vector6<f64> {
    let moved = strain_tensor(strain) * n;
    Vector6::from_fn(|i, _| {
        let (a, b) = PAIRS[i];
        let factor = if i < 3 { 1.0 } else { 2.0 };
        factor * n.column(a).dot(&moved.column(b))
    })
}

/// Stress of which `local` are the components in axes `n`, N s N^T: the transpose of [`strain_transform`] times the local
/// stress, for less.
pub fn stress_out_of(n: &Matrix3<f64>, local: &Vector6<f64>) -> Vector6<f64> {
    let moved = stress_tensor(local) * n.transpose();
    Vector6::from_fn(|i, _| {
        let (a, b) = PAIRS[i];
        n.row(a).transpose().dot(&moved.column(b))
    })
}

/// Stress of which `values` are the principal values along axes `n`, sum s_i n_i n_i^T.
pub fn stress_along(n: &Matrix3<f64>, values: &Vector3<f64>) -> Vector6<f64> {
    let scaled = Matrix3::from_fn(|k, i| n[(k, i)] * values[i]);
    Vector6::from_fn(|i, _| {
        let (a, b) = PAIRS[i];
        (0..3).map(|k| scaled[(a, k)] * n[(b, k)]).sum()
    })
}

/// Stress transformation (6 x 6) into axes `n`: s_local = T s.
pub fn stress_transform(n: &Matrix3<f64>) -> Matrix6<f64> {
    let mut t = Matrix6::zeros();
    for (row, &(a, b)) in PAIRS.iter().enumerate() {
        for (col, &(k, l)) in PAIRS.iter().enumerate() {
            t[(row, col)] =
                n[(k, a)] * n[(l, b)] + if col < 3 { 0.0 } else { n[(l, a)] * n[(k, b)] };
        }
    }
    t
}

/// Isotropic elasticity matrix (MPa) for engineering shear strain.
pub fn isotropic(young: f64, poisson: f64) -> Matrix6<f64> {
    let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let shear = young / (2.0 * (1.0 + poisson));
    let mut d = Matrix6::zeros();
    for i in 0..3 {
        for j in 0..3 {
            d[(i, j)] = lambda;
        }
        d[(i, i)] += 2.0 * shear;
        d[(i + 3, i + 3)] = shear;
    }
    d
}

#[cfg(test)]
mod tests {
    //! Protects the conventions every law and element relies on.
    use super::*;

    fn sample() -> Matrix3<f64> {
        Matrix3::new(3.0, -1.0, 0.5, -1.0, 2.0, 0.7, 0.5, 0.7, -4.0)
    }

    #[test]
    fn transforms_agree_with_tensor_rotation_and_conserve_work() {
        let (_, n) = principal(&sample());
        let e = Vector6::new(1.0, -2.0, 0.3, 0.9, -0.4, 0.2);
        let s = Vector6::new(5.0, 1.0, -2.0, 0.6, 1.1, -0.7);
        let e_local = strain_voigt(&(n.transpose() * strain_tensor(&e) * n));
        let s_local = stress_voigt(&(n.transpose() * stress_tensor(&s) * n));
        assert!((strain_transform(&n) * e - e_local).norm() < 1e-13);
        assert!((stress_transform(&n) * s - s_local).norm() < 1e-13);
        assert!((strain_transform(&n).transpose() * s_local - s).norm() < 1e-13);
        assert!((e.dot(&s) - e_local.dot(&s_local)).abs() < 1e-13);
        assert!((strain_into(&n, &e) - e_local).norm() < 1e-13);
        assert!((stress_out_of(&n, &s_local) - s).norm() < 1e-13);
        let (values, axes) = principal(&stress_tensor(&s));
        assert!((stress_along(&axes, &values) - s).norm() < 1e-13);
    }
}
