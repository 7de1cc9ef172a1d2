//! Conjugate gradients with the factor of a nearby matrix as preconditioner.

use fe_core::sparsity::{MatrixValues, Sparsity};

use crate::anderson::dot;

/// Operations of one iteration per stored entry of factor and matrix: both triangles, a product and a sum each.
const PER_ENTRY: f64 = 4.0;
/// Rate of a factorisation over that of an iteration, which waits for memory: measured, 38 to 3.5 Gflop/s on a mesh of
/// 176 x 12 x 4 hexahedra.
const RATES: f64 = 10.0;
/// Iterations that must pay before a factorisation is put off: on small meshes it costs less than a few.
const LEAST: usize = 8;

/// Iterations that together cost as much as a factorisation of `flops` operations; none where that is not worth putting off.
pub(super) fn budget(flops: f64, entries: usize) -> Option<usize> {
    let iterations = (flops / (RATES * PER_ENTRY * entries as f64)) as usize;
    (iterations >= LEAST).then_some(iterations)
}

/// A linear system and the factor at hand.
pub(super) struct Nearby<'a, P> {
    pub(super) pattern: &'a Sparsity,
    pub(super) values: &'a MatrixValues,
    pub(super) precondition: P,
}

impl<P: FnMut(&mut [f64])> Nearby<'_, P> {
    /// Solves for `right` to a relative residual of `tolerance` within `limit` iterations. Returns the solution and the
    /// iterations; none if they do not suffice or the matrix proves not to be positive definite (Hestenes and Stiefel 1952).
    pub(super) fn solve(
        mut self,
        right: &[f64],
        tolerance: f64,
        limit: usize,
    ) -> Option<(Vec<f64>, usize)> {
        let mut x = vec![0.0; right.len()];
        let mut r = right.to_vec();
        let target = tolerance * dot(right, right).sqrt();
        let mut z = r.clone();
        (self.precondition)(&mut z);
        let mut p = z.clone();
        let mut product = vec![0.0; right.len()];
        let mut slope = dot(&r, &z);
        for iteration in 0..=limit {
            if dot(&r, &r).sqrt() <= target {
                return Some((x, iteration));
            }
            self.values.multiply(self.pattern, &p, &mut product);
            let curvature = dot(&p, &product);
            if !(curvature > 0.0 && slope > 0.0) {
                return None;
            }
            let length = slope / curvature;
            for (((x, r), p), q) in x.iter_mut().zip(&mut r).zip(&p).zip(&product) {
                *x += length * p;
                *r -= length * q;
            }
            z.copy_from_slice(&r);
            (self.precondition)(&mut z);
            let next = dot(&r, &z);
            for (p, z) in p.iter_mut().zip(&z) {
                *p = z + next / slope * *p;
            }
            slope = next;
        }
        None
    }
}
