//! Triangular solutions with the panel of one front, compiled for the vector unit found at run time.

use pulp::{Arch, Simd, WithSimd};

/// Columns treated together.
const BLOCK: usize = 4;

/// The panel of a front, whose diagonal is taken as 1 if it is `unit`, and the rows of a right-hand side that it sees: as many as
/// its own.
struct System<'a> {
    panel: &'a [f64],
    unit: bool,
    x: &'a mut [f64],
}

/// Solves L y = x for the own rows of a front and leaves -L y on the rows below.
pub(super) fn forward(panel: &[f64], unit: bool, x: &mut [f64]) {
    Arch::new().dispatch(Forward(System { panel, unit, x }));
}

/// Solves L^T y = x, minus what the rows below contribute, for the own rows of a front.
pub(super) fn backward(panel: &[f64], unit: bool, x: &mut [f64]) {
    Arch::new().dispatch(Backward(System { panel, unit, x }));
}

struct Forward<'a>(System<'a>);

struct Backward<'a>(System<'a>);

impl WithSimd for Forward<'_> {
    type Output = ();

    // Inlining is what compiles the body for the vector unit of the caller.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let System { panel, unit, x } = self.0;
        let height = x.len();
        let mut first = 0;
        for columns in panel.chunks(BLOCK * height) {
            let n = columns.len() / height;
            let mut y = [0.0; BLOCK];
            for j in 0..n {
                let column = &columns[j * height..(j + 1) * height];
                if !unit {
                    x[first + j] /= column[first + j];
                }
                y[j] = x[first + j];
                for i in first + j + 1..first + n {
                    x[i] -= column[i] * y[j];
                }
            }
            let below = &mut x[first + n..];
            if n == BLOCK {
                let part =
                    |j: usize| S::as_simd_f64s(&columns[j * height + first + n..(j + 1) * height]);
                let ((a, ra), (b, rb), (c, rc), (d, rd)) = (part(0), part(1), part(2), part(3));
                let (to, rest) = S::as_mut_simd_f64s(below);
                let [ya, yb, yc, yd] = y.map(|v| simd.splat_f64s(-v));
                for ((((t, a), b), c), d) in to.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                    let sum = simd.mul_add_f64s(*a, ya, *t);
                    let sum = simd.mul_add_f64s(*b, yb, sum);
                    let sum = simd.mul_add_f64s(*c, yc, sum);
                    *t = simd.mul_add_f64s(*d, yd, sum);
                }
                for ((((t, a), b), c), d) in rest.iter_mut().zip(ra).zip(rb).zip(rc).zip(rd) {
                    *t -= a * y[0] + b * y[1] + c * y[2] + d * y[3];
                }
            } else {
                for j in 0..n {
                    let column = &columns[j * height + first + n..(j + 1) * height];
                    for (t, a) in below.iter_mut().zip(column) {
                        *t -= a * y[j];
                    }
                }
            }
            first += n;
        }
    }
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let System { panel, unit, x } = self.0;
        let height = x.len();
        let mut end = panel.len() / height;
        for columns in panel.chunks(BLOCK * height).rev() {
            let n = columns.len() / height;
            let first = end - n;
            let (own, below) = x.split_at_mut(end);
            let mut sums = [0.0; BLOCK];
            if n == BLOCK {
                let part = |j: usize| S::as_simd_f64s(&columns[j * height + end..(j + 1) * height]);
                let ((a, ra), (b, rb), (c, rc), (d, rd)) = (part(0), part(1), part(2), part(3));
                let (from, rest) = S::as_simd_f64s(below);
                let mut s = [simd.splat_f64s(0.0); BLOCK];
                for ((((v, a), b), c), d) in from.iter().zip(a).zip(b).zip(c).zip(d) {
                    s[0] = simd.mul_add_f64s(*a, *v, s[0]);
                    s[1] = simd.mul_add_f64s(*b, *v, s[1]);
                    s[2] = simd.mul_add_f64s(*c, *v, s[2]);
                    s[3] = simd.mul_add_f64s(*d, *v, s[3]);
                }
                sums = s.map(|s| simd.reduce_sum_f64s(s));
                for ((((v, a), b), c), d) in rest.iter().zip(ra).zip(rb).zip(rc).zip(rd) {
                    sums[0] += a * v;
                    sums[1] += b * v;
                    sums[2] += c * v;
                    sums[3] += d * v;
                }
            } else {
                for j in 0..n {
                    let column = &columns[j * height + end..(j + 1) * height];
                    sums[j] = column.iter().zip(&*below).map(|(a, v)| a * v).sum();
                }
            }
            for j in (0..n).rev() {
                let column = &columns[j * height..(j + 1) * height];
                let mut value = own[first + j] - sums[j];
                for i in first + j + 1..end {
                    value -= column[i] * own[i];
                }
                own[first + j] = if unit {
                    value
                } else {
                    value / column[first + j]
                };
            }
            end = first;
        }
    }
}
