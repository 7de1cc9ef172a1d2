//! Whether an unsymmetric factor is that of a regular matrix.

use fe_core::sparsity::{MatrixValues, Sparsity};

use super::LinearError;

/// Growth of a probe solution beyond which the matrix counts as singular.
const SINGULAR_GROWTH: f64 = 1e13;

/// L U reports no singularity; the solution x of a probe b does. Both are measured in the scale of each equation,
///
/// b_i = w_i s_i,  growth = max_i |s_i x_i|,  s_i = |a_ii|^(1/2),
///
/// with irregular weights w between 0.5 and 1.5. The growth is the same for A and for c D A D with any number c and any
/// positive diagonal D: whatever the unit of the forces, and of each displacement with the force that works on it.
pub(super) fn regular(
    pattern: &Sparsity,
    values: &MatrixValues,
    solve: impl FnOnce(&mut [f64]),
) -> Result<(), LinearError> {
    let scales = scales(pattern, values);
    let mut x = load(&scales);
    solve(&mut x);
    let mut worst = (0, 0.0);
    for (i, (v, s)) in x.iter().zip(&scales).enumerate() {
        let grown = (v * s).abs();
        if !grown.is_finite() {
            return Err(LinearError::Singular {
                equation: i,
                pivot_ratio: 0.0,
            });
        }
        if grown > worst.1 {
            worst = (i, grown);
        }
    }
    if worst.1 > SINGULAR_GROWTH {
        return Err(LinearError::Singular {
            equation: worst.0,
            pivot_ratio: 1.0 / worst.1,
        });
    }
    Ok(())
}

/// The probe b.
pub(super) fn load(scales: &[f64]) -> Vec<f64> {
    // Multiples of the golden ratio: no rigid-body mode is orthogonal to them.
    let weight = |i: usize| 0.5 + (0.618_033_988_749_895 * i as f64).fract();
    (0..).zip(scales).map(|(i, s)| weight(i) * s).collect()
}

/// Scale of every equation: the root of its diagonal entry. Where that is zero, its largest coupling over the scale of what it
/// couples with, which a scaling changes alike, or, where that has none either, the root of the coupling; 0 without any.
pub(super) fn scales(pattern: &Sparsity, values: &MatrixValues) -> Vec<f64> {
    let diagonal = &pattern.col_ptr()[..pattern.len()];
    let roots: Vec<f64> = diagonal
        .iter()
        .map(|&k| values.lower[k].abs().sqrt())
        .collect();
    if roots.iter().all(|r| *r > 0.0) {
        return roots;
    }
    let upper = if values.is_symmetric() {
        &values.lower
    } else {
        &values.upper
    };
    let mut scales = roots.clone();
    let mut without = vec![0.0_f64; roots.len()];
    for j in 0..pattern.len() {
        for k in pattern.column(j).skip(1) {
            let i = pattern.row_idx()[k];
            let coupling = values.lower[k].abs().max(upper[k].abs());
            for (own, other) in [(i, j), (j, i)] {
                if roots[own] > 0.0 {
                    continue;
                }
                if roots[other] > 0.0 {
                    scales[own] = scales[own].max(coupling / roots[other]);
                }
                without[own] = without[own].max(coupling.sqrt());
            }
        }
    }
    for (scale, without) in scales.iter_mut().zip(without) {
        if *scale == 0.0 {
            *scale = without;
        }
    }
    scales
}
