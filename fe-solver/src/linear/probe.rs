//! Whether an unsymmetric factor is that of a regular matrix.

use fe_core::sparsity::MatrixValues;

use super::LinearError;

/// Growth of a probe solution beyond which the matrix counts as singular.
const SINGULAR_GROWTH: f64 = 1e13;

/// L U reports no singularity; the solution of a load scaled by the diagonal does.
pub(super) fn regular(
    values: &MatrixValues,
    diagonal: &[usize],
    solve: impl FnOnce(&mut [f64]),
) -> Result<(), LinearError> {
    // Irregular shares (multiples of the golden ratio): no rigid-body mode is orthogonal to them.
    let share = |i: usize| 0.5 + (0.618_033_988_749_895 * i as f64).fract();
    let entries = diagonal.iter().enumerate();
    let mut x: Vec<f64> = entries
        .map(|(i, &k)| share(i) * values.lower[k].abs())
        .collect();
    solve(&mut x);
    let mut worst = (0, 0.0);
    for (i, v) in x.iter().enumerate() {
        if !v.is_finite() {
            return Err(LinearError::Singular {
                equation: i,
                pivot_ratio: 0.0,
            });
        }
        if v.abs() > worst.1 {
            worst = (i, v.abs());
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
