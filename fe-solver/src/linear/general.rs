//! L U for unsymmetric values on the structurally symmetric pattern.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::lu::{
    LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par};
use fe_core::sparsity::{MatrixValues, Sparsity};

use super::LinearError;

/// Growth of a probe solution beyond which the matrix counts as singular.
const SINGULAR_GROWTH: f64 = 1e13;

/// Analysis and buffers, allocated once.
pub(super) struct GeneralFactor {
    col_ptr: Vec<usize>,
    row_idx: Vec<usize>,
    /// Where each entry of the full matrix comes from: position and whether from `upper`.
    source: Vec<(usize, bool)>,
    full: Vec<f64>,
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
    memory: MemBuffer,
}

impl std::fmt::Debug for GeneralFactor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("GeneralFactor")
            .field("nnz", &self.full.len())
            .finish_non_exhaustive()
    }
}

impl GeneralFactor {
    pub(super) fn analyze(pattern: &Sparsity) -> Result<Self, LinearError> {
        let n = pattern.len();
        let mut columns: Vec<Vec<(usize, usize, bool)>> = vec![Vec::new(); n];
        for j in 0..n {
            for k in pattern.col_ptr()[j]..pattern.col_ptr()[j + 1] {
                let i = pattern.row_idx()[k];
                columns[j].push((i, k, false));
                if i != j {
                    columns[i].push((j, k, true));
                }
            }
        }
        let mut col_ptr = vec![0];
        let (mut row_idx, mut source) = (Vec::new(), Vec::new());
        for column in &mut columns {
            column.sort_unstable();
            row_idx.extend(column.iter().map(|c| c.0));
            source.extend(column.iter().map(|c| (c.1, c.2)));
            col_ptr.push(row_idx.len());
        }
        let structure = SymbolicSparseColMatRef::new_checked(n, n, &col_ptr, None, &row_idx);
        let params = LuSymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..LuSymbolicParams::default()
        };
        let symbolic =
            factorize_symbolic_lu(structure, params).map_err(|_| LinearError::OutOfMemory)?;
        let request = StackReq::any_of(&[
            symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, faer::Spec::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        ]);
        let memory = MemBuffer::try_new(request).map_err(|_| LinearError::OutOfMemory)?;
        let full = vec![0.0; row_idx.len()];
        Ok(Self {
            col_ptr,
            row_idx,
            source,
            full,
            symbolic,
            numeric: NumericLu::new(),
            memory,
        })
    }

    pub(super) fn factorize(&mut self, values: &MatrixValues) -> Result<(), LinearError> {
        let n = self.col_ptr.len() - 1;
        for (v, &(k, upper)) in self.full.iter_mut().zip(&self.source) {
            *v = if upper {
                values.upper[k]
            } else {
                values.lower[k]
            };
        }
        let structure =
            SymbolicSparseColMatRef::new_checked(n, n, &self.col_ptr, None, &self.row_idx);
        let matrix = SparseColMatRef::new(structure, &self.full[..]);
        self.symbolic
            .factorize_numeric_lu(
                &mut self.numeric,
                matrix,
                Par::Seq,
                MemStack::new(&mut self.memory),
                faer::Spec::default(),
            )
            .map_err(|_| LinearError::Singular {
                equation: 0,
                pivot_ratio: 0.0,
            })?;
        self.probe(values)
    }

    /// The factorisation reports no singularity; the solution of a load scaled by rows does.
    fn probe(&mut self, values: &MatrixValues) -> Result<(), LinearError> {
        let n = self.col_ptr.len() - 1;
        let mut diagonal = vec![0.0; n];
        for j in 0..n {
            for k in self.col_ptr[j]..self.col_ptr[j + 1] {
                if self.row_idx[k] == j {
                    diagonal[j] = values.lower[self.source[k].0].abs();
                }
            }
        }
        // Irregular shares (multiples of the golden ratio): no rigid-body mode is orthogonal to them.
        let share = |i: usize| 0.5 + (0.618_033_988_749_895 * i as f64).fract();
        let mut x: Vec<f64> = (0..n).map(|i| share(i) * diagonal[i]).collect();
        self.solve(&mut x);
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

    pub(super) fn solve(&mut self, rhs: &mut [f64]) {
        let n = rhs.len();
        let factor = LuRef::new_unchecked(&self.symbolic, &self.numeric);
        factor.solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(rhs, n, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }
}
