//! Zeros on the diagonal, as of multipliers. Pivots stay in their front, and such an equation may find none there.
//!
//! A pivot beside a zero tells nothing of its size, so that a probe must tell whether a factor is one of the matrix. Where it is
//! not, or there is none, zeros are filled with small entries, e_i = [`FILL`] s_i^2 in the scale s of the equations, and
//! solutions refined with the matrix itself (static pivoting: Li and Demmel 1998). What that cannot make up for is
//! singular: there is no solution that is the same with the entries and without.

use fe_core::sparsity::{MatrixValues, Sparsity};

/// Entry in place of a zero, in the scale of its equation: half of the digits are left to it, half to what it displaces.
const FILL: f64 = 1e-8;
/// Largest residual of a probe, in the scale of each equation: one refinement squares it.
const MISS: f64 = 1e-4;

/// The matrix with the zeros of its diagonal filled; none if there is no zero, or one in an equation without any entry.
pub(super) fn filled(
    pattern: &Sparsity,
    values: &MatrixValues,
    scales: &[f64],
) -> Option<MatrixValues> {
    let diagonal = pattern.col_ptr()[..pattern.len()].iter().zip(scales);
    let zeros = diagonal.filter(|&(&k, _)| values.lower[k] == 0.0);
    let mut filled = None;
    for (&k, scale) in zeros {
        let matrix = filled.get_or_insert_with(|| values.clone());
        let entry = FILL * scale.powi(2);
        if entry <= 0.0 {
            return None;
        }
        matrix.lower[k] = entry;
        if let Some(upper) = matrix.upper.get_mut(k) {
            *upper = entry;
        }
    }
    filled
}

/// Whether the factor at hand, by which `solve` solves, is that of the matrix, but for a refinement; if not, the equation that a
/// probe misses most.
pub(super) fn served(
    pattern: &Sparsity,
    values: &MatrixValues,
    scales: &[f64],
    solve: impl FnOnce(&mut [f64]),
) -> Result<(), usize> {
    let right = super::probe::load(scales);
    let mut x = right.clone();
    solve(&mut x);
    let mut product = vec![0.0; x.len()];
    values.multiply(pattern, &x, &mut product);
    let misses = product.iter().zip(&right).zip(scales);
    let misses = misses.map(|((p, b), s)| (p - b).abs() / s);
    // What is not a number is missed most.
    let worst = misses.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    match worst {
        Some((equation, miss)) if miss.is_nan() || miss > MISS => Err(equation),
        _ => Ok(()),
    }
}
