//! Principal values and axes of symmetric tensors, one by one or many at once.

use nalgebra::{Matrix3, Vector3, Vector6};
use pulp::{Arch, Simd, WithSimd};

/// Tensors treated together.
const LANES: usize = 8;

/// Principal values, descending, and their unit vectors as columns, right-handed.
pub type Principal = (Vector3<f64>, Matrix3<f64>);

/// Eigenvalues in descending order and their unit eigenvectors (columns, right-handed) of a symmetric tensor.
/// Deterministic, and exact to rounding for equal eigenvalues too.
///
/// The eigenvalues are m + r x with the mean m and r^2 = |B|^2/6 of the deviator B. The root x of largest size of
/// x^3 - 3 x = det(B)/r^3 (Smith 1961) lies at least sqrt(3) from the others, so that its eigenvector, the longest cross
/// product of two rows of B/r - x I, is well defined; the plane across it leaves a symmetric 2 x 2 matrix, which one
/// rotation makes diagonal. Tensors without a deviator are left to Jacobi rotations.
pub fn principal(t: &Matrix3<f64>) -> Principal {
    let found = closed_form([t.m11, t.m22, t.m33, t.m12, t.m23, t.m13]);
    if found.deviatoric {
        (found.values.into(), Matrix3::from_column_slice(&found.axes))
    } else {
        jacobi(t)
    }
}

/// [`principal`] of many tensors with components in Voigt order, tensor shear; the same to the last bit.
///
/// # Panics
///
/// If `out` is shorter than `tensors`.
pub fn principal_of_many(tensors: &[Vector6<f64>], out: &mut [Principal]) {
    assert!(out.len() >= tensors.len(), "room for every tensor");
    Arch::new().dispatch(Many { tensors, out });
}

struct Many<'a> {
    tensors: &'a [Vector6<f64>],
    out: &'a mut [Principal],
}

impl WithSimd for Many<'_> {
    type Output = ();

    // Inlining is what compiles the loop over the lanes for the vector unit of the caller.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let chunks = self.tensors.chunks(LANES);
        for (tensors, out) in chunks.zip(self.out.chunks_mut(LANES)) {
            let mut t = [[0.0; LANES]; 6];
            for (l, tensor) in tensors.iter().enumerate() {
                for i in 0..6 {
                    t[i][l] = tensor[i];
                }
            }
            let mut values = [[0.0; LANES]; 3];
            let mut axes = [[0.0; LANES]; 9];
            let mut deviatoric = [0.0; LANES];
            for l in 0..LANES {
                let found = closed_form([t[0][l], t[1][l], t[2][l], t[3][l], t[4][l], t[5][l]]);
                for i in 0..3 {
                    values[i][l] = found.values[i];
                }
                for i in 0..9 {
                    axes[i][l] = found.axes[i];
                }
                deviatoric[l] = if found.deviatoric { 1.0 } else { 0.0 };
            }
            for (l, (out, t)) in out.iter_mut().zip(tensors).enumerate() {
                *out = if deviatoric[l] > 0.0 {
                    let values = Vector3::new(values[0][l], values[1][l], values[2][l]);
                    (values, Matrix3::from_fn(|r, c| axes[3 * c + r][l]))
                } else {
                    jacobi(&crate::voigt::stress_tensor(t))
                };
            }
        }
    }
}

/// What the closed form finds.
struct Found {
    values: [f64; 3],
    /// By columns.
    axes: [f64; 9],
    /// Whether there is a deviator; if not, the rest means nothing.
    deviatoric: bool,
}

/// See [`principal`]. Without branches, so that lanes can run side by side.
#[allow(clippy::inline_always)]
#[inline(always)]
fn closed_form([xx, yy, zz, xy, yz, xz]: [f64; 6]) -> Found {
    let mean = (xx + yy + zz) / 3.0;
    let (xx, yy, zz) = (xx - mean, yy - mean, zz - mean);
    let square = xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + yz * yz + xz * xz);
    let radius = (square / 6.0).sqrt();
    let deviatoric = (radius >= 1e-100) & (radius >= 1e-8 * mean.abs());
    let scale = 1.0 / if deviatoric { radius } else { 1.0 };
    let (xx, yy, zz) = (xx * scale, yy * scale, zz * scale);
    let (xy, yz, xz) = (xy * scale, yz * scale, xz * scale);
    let cubic = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    let size = cubic.abs();
    let size = if size > 2.0 { 2.0 } else { size };
    let root = largest_root(size).copysign(cubic);

    let [r0, r1, r2] = [
        [xx - root, xy, xz],
        [xy, yy - root, yz],
        [xz, yz, zz - root],
    ];
    let (p0, p1, p2) = (cross(r0, r1), cross(r1, r2), cross(r2, r0));
    let (s0, s1, s2) = (dot(p0, p0), dot(p1, p1), dot(p2, p2));
    let (p, s) = select(s0 >= s1, (p0, s0), (p1, s1));
    let (p, s) = select(s >= s2, (p, s), (p2, s2));
    let normal = times(p, 1.0 / s.sqrt());

    let wide = normal[0].abs() > normal[2].abs();
    let (u, _) = select(
        wide,
        ([-normal[1], normal[0], 0.0], 0.0),
        ([0.0, -normal[2], normal[1]], 0.0),
    );
    let u = times(u, 1.0 / dot(u, u).sqrt());
    let v = cross(normal, u);
    let by = |w: [f64; 3]| {
        [
            xx * w[0] + xy * w[1] + xz * w[2],
            xy * w[0] + yy * w[1] + yz * w[2],
            xz * w[0] + yz * w[1] + zz * w[2],
        ]
    };
    let (bu, bv) = (by(u), by(v));
    let (uu, uv, vv) = (dot(u, bu), dot(u, bv), dot(v, bv));
    // Tangent of the smaller angle that makes the plane diagonal (Golub and Van Loan 2013, 8.5.2).
    let (gap, twice) = (vv - uu, 2.0 * uv);
    let bottom = gap.abs() + (gap * gap + twice * twice).sqrt();
    let tan = twice.copysign(twice * gap) / if bottom > 0.0 { bottom } else { 1.0 };
    let cos = 1.0 / (1.0 + tan * tan).sqrt();
    let sin = tan * cos;
    let one = (minus(times(u, cos), times(v, sin)), uu - tan * uv);
    let two = (minus(times(v, cos), times(u, -sin)), vv + tan * uv);
    let first_larger = one.1 >= two.1;
    let upper = select(first_larger, one, two);
    let lower = select(first_larger, two, one);

    let apart = (normal, root);
    let tension = root >= 0.0;
    let first = select(tension, apart, upper);
    let middle = select(tension, upper, lower);
    let last = select(tension, lower, apart);
    let axis = cross(last.0, first.0);
    Found {
        values: [first.1, middle.1, last.1].map(|x| mean + radius * x),
        axes: [
            first.0[0], first.0[1], first.0[2], axis[0], axis[1], axis[2], last.0[0], last.0[1],
            last.0[2],
        ],
        deviatoric,
    }
}

/// Largest root 2 cos(acos(c/2)/3) of x^3 - 3 x = c for 0 <= c <= 2. It is nearly linear in c: from a cubic through four
/// of its values, 8e-5 off, Newton's iteration reaches rounding in two steps.
#[allow(clippy::inline_always)]
#[inline(always)]
fn largest_root(c: f64) -> f64 {
    let newton = |x: f64| x - (x * (x * x - 3.0) - c) / (3.0 * (x * x - 1.0));
    newton(newton(
        1.732_133 + c * (0.165_33 + c * (0.002_33 * c - 0.020_346)),
    ))
}

#[allow(clippy::inline_always)]
#[inline(always)]
fn select(first: bool, a: ([f64; 3], f64), b: ([f64; 3], f64)) -> ([f64; 3], f64) {
    let pick = |a: f64, b: f64| if first { a } else { b };
    (
        [
            pick(a.0[0], b.0[0]),
            pick(a.0[1], b.0[1]),
            pick(a.0[2], b.0[2]),
        ],
        pick(a.1, b.1),
    )
}

#[allow(clippy::inline_always)]
#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[allow(clippy::inline_always)]
#[inline(always)]
fn times(a: [f64; 3], s: f64) -> [f64; 3] {
    [a[0] * s, a[1] * s, a[2] * s]
}

#[allow(clippy::inline_always)]
#[inline(always)]
fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[allow(clippy::inline_always)]
#[inline(always)]
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
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

#[cfg(test)]
mod tests {
    //! Protects what every law of cracks and yield rests on.
    use super::*;
    use crate::voigt::stress_tensor;

    fn sample() -> Matrix3<f64> {
        Matrix3::new(3.0, -1.0, 0.5, -1.0, 2.0, 0.7, 0.5, 0.7, -4.0)
    }

    fn random(k: u32) -> Vector6<f64> {
        Vector6::from_fn(|i, _| {
            let i = i as u32 + 1;
            f64::from((k * 7919 + i * 104_729) % 20_011) / 1e4 - 1.0
        })
    }

    /// The closed form agrees with Jacobi rotations. Target: rounding, 1e-12 of the deviator.
    #[test]
    fn closed_form_agrees_with_rotations() {
        for k in 0..2000 {
            let tensor = stress_tensor(&random(k));
            let (w, v) = principal(&tensor);
            let (expected, axes) = jacobi(&tensor);
            assert!((w - expected).amax() < 1e-12, "{w} {expected}");
            assert!((v.transpose() * v - Matrix3::identity()).amax() < 1e-12);
            assert!((v.determinant() - 1.0).abs() < 1e-12);
            let gap = (w[0] - w[1]).min(w[1] - w[2]);
            for i in 0..3 {
                let along = v.column(i).dot(&axes.column(i)).abs();
                assert!((along - 1.0).abs() < 1e-12 / gap.min(1.0), "{k}");
            }
        }
    }

    /// Many at once are the same as one by one, to the last bit, hydrostatic and zero tensors among them.
    #[test]
    fn lanes_change_nothing() {
        let mut tensors: Vec<_> = (0..1003).map(random).collect();
        tensors[5] = Vector6::zeros();
        tensors[13] = Vector6::new(2.0, 2.0, 2.0, 0.0, 0.0, 0.0);
        tensors[20] = Vector6::new(2.0, 1.0, 1.0, 0.0, 0.0, 0.0);
        let mut many = vec![(Vector3::zeros(), Matrix3::zeros()); tensors.len()];
        principal_of_many(&tensors, &mut many);
        for (t, found) in tensors.iter().zip(&many) {
            assert_eq!(principal(&stress_tensor(t)), *found);
        }
    }

    #[test]
    fn the_root_without_cosines_is_the_cosine() {
        for i in 0..=2000 {
            let c = 1e-3 * f64::from(i);
            let expected = 2.0 * ((0.5 * c).clamp(-1.0, 1.0).acos() / 3.0).cos();
            assert!((largest_root(c) - expected).abs() < 2e-15, "{c}");
        }
    }

    #[test]
    fn principal_values_and_axes_rebuild_the_tensor() {
        for t in [
            sample(),
            Matrix3::zeros(),
            Matrix3::identity(),
            Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 2.0)),
            Matrix3::from_diagonal(&Vector3::new(2.0, 2.0, 1.0)),
            Matrix3::from_diagonal(&Vector3::new(1.0, 0.0, -1.0)),
            Matrix3::from_element(1.0) + Matrix3::identity() * 1e-3,
            Matrix3::identity() * 5.0 + sample() * 1e-6,
        ] {
            let (w, v) = principal(&t);
            assert!(w[0] >= w[1] && w[1] >= w[2]);
            let back = v * Matrix3::from_diagonal(&w) * v.transpose();
            assert!((back - t).norm() <= 1e-14 * t.norm());
            assert!((v.determinant() - 1.0).abs() < 1e-14);
        }
    }
}
