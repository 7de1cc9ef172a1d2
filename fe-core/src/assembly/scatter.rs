//! Where the entries of an element's matrix go in the arrays of values.

use crate::sparsity::Sparsity;

/// Equation number of a constrained DOF, and target of an entry that is dropped.
pub(super) const NONE: u32 = u32::MAX;

/// Set in a target whose entry (i, j) lies above the diagonal of the system; patterns of more than 2^31
/// entries (16 GiB of values) are beyond a direct solver.
const ABOVE: u32 = 1 << 31;

/// Targets of the upper triangle of an element's matrix, by rows.
#[derive(Debug)]
pub(super) struct Scatter {
    targets: Vec<u32>,
    /// Number of rows.
    n: usize,
}

impl Scatter {
    /// Looks up every entry once.
    pub(super) fn new(pattern: &Sparsity, equations: &[u32]) -> Self {
        let n = equations.len();
        let mut targets = Vec::with_capacity(n * (n + 1) / 2);
        for i in 0..n {
            for j in i..n {
                let (row, col) = (equations[i], equations[j]);
                let (low, high) = (row.min(col), row.max(col));
                let position = if high == NONE {
                    None
                } else {
                    pattern.position(high as usize, low as usize)
                };
                let above = if row < col { ABOVE } else { 0 };
                targets.push(position.map_or(NONE, |p| p as u32 | above));
            }
        }
        Self { targets, n }
    }

    /// Rows of the upper triangle: row number and targets of its entries from the diagonal on.
    fn rows(&self) -> impl Iterator<Item = (usize, &[u32])> {
        let mut rest = self.targets.as_slice();
        (0..self.n).map(move |i| {
            let (row, tail) = rest.split_at(self.n - i);
            rest = tail;
            (i, row)
        })
    }

    /// Adds a symmetric matrix, of which the upper triangle is read, to one triangle of the system.
    pub(super) fn add_symmetric(&self, matrix: &[f64], values: &mut [f64]) {
        for (i, targets) in self.rows() {
            let row = &matrix[i * self.n + i..(i + 1) * self.n];
            for (&target, value) in targets.iter().zip(row) {
                if target != NONE {
                    values[(target & !ABOVE) as usize] += value;
                }
            }
        }
    }

    /// Adds a full matrix to both triangles; the diagonal goes to both.
    pub(super) fn add_unsymmetric(&self, matrix: &[f64], lower: &mut [f64], upper: &mut [f64]) {
        let n = self.n;
        for (i, targets) in self.rows() {
            for (&target, j) in targets.iter().zip(i..) {
                if target == NONE {
                    continue;
                }
                let (ij, ji) = (matrix[i * n + j], matrix[j * n + i]);
                let (below, above) = if target & ABOVE == 0 {
                    (ij, ji)
                } else {
                    (ji, ij)
                };
                let position = (target & !ABOVE) as usize;
                lower[position] += below;
                upper[position] += above;
            }
        }
    }
}
