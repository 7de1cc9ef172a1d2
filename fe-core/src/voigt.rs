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

/// Eigenvalues in descending order and their unit eigenvectors (columns, right-handed) of a
/// symmetric tensor: by closed form where the eigenvalues lie well apart, else by cyclic Jacobi rotations, which
/// are accurate for close ones. Deterministic.
pub fn principal(t: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    closed_form(t).unwrap_or_else(|| jacobi(t))
}

/// Least distance of two eigenvalues, relative to the deviator, for the closed form.
const APART: f64 = 1e-2;

/// Eigenvalues m + 2 r cos(theta - 2 pi k/3), cos 3 theta = det(B)/(2 r^3), with the deviator B, its mean m and
/// r^2 = |B|^2/6 (Smith 1961), improved by one Newton step of the characteristic polynomial; eigenvectors from the
/// cross products of the rows of T - lambda I. `None` where two eigenvalues are close.
fn closed_form(t: &Matrix3<f64>) -> Option<(Vector3<f64>, Matrix3<f64>)> {
    let mean = t.trace() / 3.0;
    let b = t - Matrix3::from_diagonal_element(mean);
    let radius = (b.norm_squared() / 6.0).sqrt();
    if radius < 1e-100 || radius < 1e-8 * mean.abs() {
        return None;
    }
    let b = b / radius;
    let theta = (0.5 * b.determinant()).clamp(-1.0, 1.0).acos() / 3.0;
    let (sin, cos) = theta.sin_cos();
    let root = 3.0_f64.sqrt() * sin;
    // Descending, since theta lies between 0 and pi/3; in units of the radius they solve x^3 - 3 x = det(B).
    let mut values = [2.0 * cos, root - cos, -root - cos];
    if values[0] - values[1] < APART || values[1] - values[2] < APART {
        return None;
    }
    let cubic = b.determinant();
    for x in &mut values {
        *x -= (*x * (*x * *x - 3.0) - cubic) / (3.0 * (*x * *x - 1.0));
    }
    let first = eigenvector(&b, values[0])?;
    let last = eigenvector(&b, values[2])?;
    let last = (last - first * first.dot(&last)).normalize();
    let middle = last.cross(&first);
    let axes = Matrix3::from_columns(&[first, middle, last]);
    Some((Vector3::from(values).map(|x| mean + radius * x), axes))
}

/// Unit eigenvector of a simple eigenvalue: the longest cross product of two rows of B - lambda I.
fn eigenvector(b: &Matrix3<f64>, lambda: f64) -> Option<Vector3<f64>> {
    let c = b - Matrix3::from_diagonal_element(lambda);
    let [r0, r1, r2] = [0, 1, 2].map(|i| Vector3::new(c[(i, 0)], c[(i, 1)], c[(i, 2)]));
    let products = [r0.cross(&r1), r1.cross(&r2), r2.cross(&r0)];
    let squares = products.map(|p| p.norm_squared());
    let longest = if squares[0] >= squares[1] && squares[0] >= squares[2] {
        0
    } else if squares[1] >= squares[2] {
        1
    } else {
        2
    };
    (squares[longest] > 1e-12).then(|| products[longest] / squares[longest].sqrt())
}

/// Cyclic Jacobi rotations.
fn jacobi(t: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
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

    /// The closed form agrees with Jacobi rotations wherever it answers. Target: rounding, 1e-12 of the deviator.
    #[test]
    fn closed_form_agrees_with_rotations() {
        let mut answered = 0;
        for k in 0..2000 {
            let x = |i: u32| f64::from((k * 7919 + i * 104_729) % 20_011) / 1e4 - 1.0;
            let tensor = stress_tensor(&Vector6::new(x(1), x(2), x(3), x(4), x(5), x(6)));
            let Some((w, v)) = closed_form(&tensor) else {
                continue;
            };
            answered += 1;
            let (expected, axes) = jacobi(&tensor);
            assert!((w - expected).amax() < 1e-12, "{w} {expected}");
            assert!((v.transpose() * v - Matrix3::identity()).amax() < 1e-12);
            assert!((v.determinant() - 1.0).abs() < 1e-12);
            for i in 0..3 {
                assert!((v.column(i).dot(&axes.column(i)).abs() - 1.0).abs() < 1e-12);
            }
        }
        assert!(answered > 1900, "{answered}");
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
        assert!((strain_into(&n, &e) - e_local).norm() < 1e-13);
        assert!((stress_out_of(&n, &s_local) - s).norm() < 1e-13);
        let (values, axes) = principal(&stress_tensor(&s));
        assert!((stress_along(&axes, &values) - s).norm() < 1e-13);
    }
}
