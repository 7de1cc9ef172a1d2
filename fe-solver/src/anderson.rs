//! Anderson acceleration of a fixed-point iteration.

use std::collections::VecDeque;

use nalgebra::{DMatrix, DVector};

/// Anderson acceleration, type II (Anderson 1965; Walker and Ni 2011, eq. 2.2).
///
/// For the fixed point u <- u + g(u) it keeps the last differences du_j of the iterates and dg_j of
/// the corrections, finds gamma = argmin |g - sum gamma_j dg_j|^2 (normal equations, regularised by
/// 1e-10 of their trace) and proposes the increment g - sum gamma_j (du_j + dg_j).
#[derive(Debug, Clone)]
pub struct Anderson {
    depth: usize,
    history: VecDeque<(Vec<f64>, Vec<f64>)>,
    last: Option<(Vec<f64>, Vec<f64>)>,
}

impl Anderson {
    /// Keeps at most `depth` differences; 0 is the plain iteration.
    pub const fn new(depth: usize) -> Self {
        Self {
            depth,
            history: VecDeque::new(),
            last: None,
        }
    }

    /// Forgets everything.
    pub fn reset(&mut self) {
        self.history.clear();
        self.last = None;
    }

    /// Increment of the iterate `u` whose plain correction is `g`.
    pub fn increment(&mut self, u: &[f64], g: &[f64]) -> Vec<f64> {
        if let Some((u0, g0)) = self.last.take() {
            let recycled = if self.history.len() >= self.depth {
                self.history.pop_front()
            } else {
                None
            };
            let (mut du, mut dg) = recycled.unwrap_or_default();
            difference(&mut du, u, &u0);
            difference(&mut dg, g, &g0);
            if self.depth > 0 {
                self.history.push_back((du, dg));
            }
        }
        self.last = Some((u.to_vec(), g.to_vec()));
        let mut step = g.to_vec();
        let m = self.history.len();
        if m == 0 {
            return step;
        }
        let mut normal = DMatrix::from_fn(m, m, |i, j| {
            if j <= i {
                dot(&self.history[i].1, &self.history[j].1)
            } else {
                0.0
            }
        });
        normal.fill_upper_triangle_with_lower_triangle();
        let trace = normal.trace();
        for i in 0..m {
            normal[(i, i)] += 1e-10 * trace;
        }
        let rhs = DVector::from_fn(m, |i, _| dot(&self.history[i].1, g));
        let Some(factor) = normal.cholesky() else {
            self.history.clear();
            return step;
        };
        let gamma = factor.solve(&rhs);
        for ((du, dg), c) in self.history.iter().zip(gamma.iter()) {
            for ((s, a), b) in step.iter_mut().zip(du).zip(dg) {
                *s -= c * (a + b);
            }
        }
        step
    }
}

fn difference(out: &mut Vec<f64>, a: &[f64], b: &[f64]) {
    out.clear();
    out.extend(a.iter().zip(b).map(|(x, y)| x - y));
}

/// Dot product, summed in order.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    // Eight partial sums let the compiler vectorise; their order is fixed, so the result is too.
    let mut sums = [0.0; 8];
    let (mut left, mut right) = (a.chunks_exact(8), b.chunks_exact(8));
    for (x, y) in (&mut left).zip(&mut right) {
        for k in 0..8 {
            sums[k] += x[k] * y[k];
        }
    }
    let tail: f64 = left
        .remainder()
        .iter()
        .zip(right.remainder())
        .map(|(x, y)| x * y)
        .sum();
    sums.iter().sum::<f64>() + tail
}

#[cfg(test)]
mod tests {
    //! Protects the acceleration: a linear fixed point of dimension n is solved in n + 1 steps.
    use super::*;

    #[test]
    fn solves_a_linear_problem_in_as_many_steps_as_unknowns() {
        let a = [[0.5, 0.2, -0.1], [0.1, 0.9, 0.05], [0.0, -0.3, 0.7]];
        let b = [1.0, -2.0, 0.5];
        let correction = |u: &[f64]| -> Vec<f64> {
            (0..3)
                .map(|i| b[i] - (0..3).map(|j| a[i][j] * u[j]).sum::<f64>())
                .collect()
        };
        let mut u = vec![0.0; 3];
        let mut accelerated = Anderson::new(5);
        for _ in 0..5 {
            let g = correction(&u);
            let step = accelerated.increment(&u, &g);
            for (x, s) in u.iter_mut().zip(step) {
                *x += s;
            }
        }
        let rest = correction(&u);
        assert!(dot(&rest, &rest).sqrt() < 1e-6, "{rest:?}");
    }
}
