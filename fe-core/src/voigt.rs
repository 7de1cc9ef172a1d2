//! Voigt algebra: order xx, yy, zz, xy, yz, xz; engineering shear strain, tensor shear stress.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// Index pairs of the Voigt components.
pub const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];

/// Symmetric tensor of a Voigt stress.
pub fn stress_tensor(s: &Vector6<f64>) -> Matrix3<f64> {
    Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2])
}

/// Symmetric tensor of a Voigt strain (shear components halved).
pub fn strain_tensor(e: &Vector6<f64>) -> Matrix3<f64> {
    stress_tensor(&Vector6::new(
        e[0],
        e[1],
        e[2],
        0.5 * e[3],
        0.5 * e[4],
        0.5 * e[5],
    ))
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

/// Eigenvalues in descending order and their unit eigenvectors (columns, right-handed) of a
/// symmetric tensor, by cyclic Jacobi rotations: accurate for close eigenvalues, deterministic.
pub fn principal(t: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let mut a = *t;
    let mut v = Matrix3::identity();
    let scale = a.norm();
    // Below, squares of the entries would underflow.
    if scale < 1e-140 {
        return (Vector3::zeros(), v);
    }
    for _ in 0..12 {
        let off = a[(0, 1)].abs() + a[(0, 2)].abs() + a[(1, 2)].abs();
        if off <= 1e-15 * scale {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let apq = a[(p, q)];
            if apq.abs() <= 1e-17 * scale {
                continue;
            }
            let (gap, twice) = (a[(q, q)] - a[(p, p)], 2.0 * apq);
            let sign = if gap >= 0.0 { 1.0 } else { -1.0 };
            let tan = sign * twice / (gap.abs() + (gap * gap + twice * twice).sqrt());
            let c = 1.0 / (tan * tan + 1.0).sqrt();
            let s = tan * c;
            let r = 3 - p - q;
            let (arp, arq) = (a[(r, p)], a[(r, q)]);
            a[(p, p)] -= tan * apq;
            a[(q, q)] += tan * apq;
            a[(p, q)] = 0.0;
            a[(q, p)] = 0.0;
            a[(r, p)] = c * arp - s * arq;
            a[(p, r)] = a[(r, p)];
            a[(r, q)] = s * arp + c * arq;
            a[(q, r)] = a[(r, q)];
            for k in 0..3 {
                let (vp, vq) = (v[(k, p)], v[(k, q)]);
                v[(k, p)] = c * vp - s * vq;
                v[(k, q)] = s * vp + c * vq;
            }
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| a[(j, j)].total_cmp(&a[(i, i)]));
    let values = Vector3::from_fn(|i, _| a[(order[i], order[i])]);
    let mut axes = Matrix3::from_fn(|k, i| v[(k, order[i])]);
    if axes.determinant() < 0.0 {
        axes.set_column(2, &(-axes.column(2)));
    }
    (values, axes)
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
    fn principal_values_and_axes_rebuild_the_tensor() {
        for t in [
            sample(),
            Matrix3::identity(),
            Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.0)),
        ] {
            let (w, v) = principal(&t);
            assert!(w[0] >= w[1] && w[1] >= w[2]);
            let back = v * Matrix3::from_diagonal(&w) * v.transpose();
            assert!((back - t).norm() < 1e-14 * t.norm());
            assert!((v.determinant() - 1.0).abs() < 1e-14);
        }
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
    }
}
