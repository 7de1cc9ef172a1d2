//! Symmetric factors: L L^T and L B L^T on one supernodal analysis.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, IntranodeLbltRef, LltRef, SymbolicCholesky, SymbolicCholeskyRaw,
    SymmetricOrdering, factorize_symbolic_cholesky,
    supernodal::{SupernodalIntranodeLbltRef, SupernodalLltRef},
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use fe_core::sparsity::{MatrixValues, Sparsity};

use super::LinearError;

/// A pivot smaller than this share of its diagonal entry means that the equation can move freely. Measured:
/// rigid-body modes leave 1e-15 to 2e-12 (beams of 176 x 4 x 1 and 300 x 2 x 2 cells), a cantilever 300 times
/// longer than deep 3e-8.
const SINGULAR_PIVOT: f64 = 1e-11;

/// Analysis and buffers, allocated once.
pub(super) struct SymmetricFactor {
    col_ptr: Vec<usize>,
    row_idx: Vec<usize>,
    diagonal: Vec<usize>,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    subdiagonal: Vec<f64>,
    forward: Vec<usize>,
    inverse: Vec<usize>,
    memory: MemBuffer,
    definite: bool,
}

impl std::fmt::Debug for SymmetricFactor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SymmetricFactor")
            .field("nnz", &self.factor.len())
            .finish_non_exhaustive()
    }
}

impl SymmetricFactor {
    pub(super) fn analyze(pattern: &Sparsity) -> Result<Self, LinearError> {
        let n = pattern.len();
        let (col_ptr, row_idx) = (pattern.col_ptr().to_vec(), pattern.row_idx().to_vec());
        let identity: Vec<usize> = (0..n).collect();
        let structure = SymbolicSparseColMatRef::new_checked(n, n, &col_ptr, None, &row_idx);
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..CholeskySymbolicParams::default()
        };
        let ordering = SymmetricOrdering::Custom(PermRef::new_checked(&identity, &identity, n));
        let symbolic = factorize_symbolic_cholesky(structure, Side::Lower, ordering, params)
            .map_err(|_| LinearError::OutOfMemory)?;
        let request = StackReq::any_of(&[
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, faer::Spec::default()),
            symbolic
                .factorize_numeric_intranode_lblt_scratch::<f64>(Par::Seq, faer::Spec::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        ]);
        let memory = MemBuffer::try_new(request).map_err(|_| LinearError::OutOfMemory)?;
        let mut factor = Vec::new();
        factor
            .try_reserve_exact(symbolic.len_val())
            .map_err(|_| LinearError::OutOfMemory)?;
        factor.resize(symbolic.len_val(), 0.0);
        Ok(Self {
            diagonal: col_ptr[..n].to_vec(),
            factor,
            subdiagonal: vec![0.0; n],
            forward: identity.clone(),
            inverse: identity,
            col_ptr,
            row_idx,
            symbolic,
            memory,
            definite: false,
        })
    }

    pub(super) fn nnz(&self) -> usize {
        self.factor.len()
    }

    /// Multiplications and additions of L L^T: sum over the columns of the square of their stored entries.
    pub(super) fn flops(&self) -> f64 {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else {
            return 0.0;
        };
        let columns = symbolic.supernode_begin().iter();
        let below = symbolic.col_ptr_for_row_idx().windows(2);
        let nodes = columns.zip(symbolic.supernode_end()).zip(below);
        nodes
            .map(|((&begin, &end), rows)| {
                let below = rows[1] - rows[0];
                let entries = 1 + below..=end - begin + below;
                entries.map(|m| (m * m) as f64).sum::<f64>()
            })
            .sum()
    }

    /// L L^T; `Ok(false)` when a pivot is not positive.
    pub(super) fn cholesky(&mut self, values: &MatrixValues) -> Result<bool, LinearError> {
        let n = self.diagonal.len();
        let structure =
            SymbolicSparseColMatRef::new_checked(n, n, &self.col_ptr, None, &self.row_idx);
        let matrix = SparseColMatRef::new(structure, &values.lower[..]);
        let done = self.symbolic.factorize_numeric_llt(
            &mut self.factor,
            matrix,
            Side::Lower,
            faer::linalg::cholesky::llt::factor::LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            faer::Spec::default(),
        );
        if done.is_err() {
            return Ok(false);
        }
        self.definite = true;
        if let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() {
            let factor = SupernodalLltRef::new(symbolic, &self.factor);
            for s in 0..symbolic.n_supernodes() {
                let node = factor.supernode(s);
                for j in 0..node.val().ncols() {
                    let pivot = node.val()[(j, j)].powi(2);
                    check_pivot(pivot, node.start() + j, &self.diagonal, values)?;
                }
            }
        }
        Ok(true)
    }

    /// L B L^T; returns the number of negative pivots, those of 2 x 2 blocks included.
    pub(super) fn bunch_kaufman(&mut self, values: &MatrixValues) -> Result<usize, LinearError> {
        let n = self.diagonal.len();
        let structure =
            SymbolicSparseColMatRef::new_checked(n, n, &self.col_ptr, None, &self.row_idx);
        let matrix = SparseColMatRef::new(structure, &values.lower[..]);
        self.symbolic.factorize_numeric_intranode_lblt(
            &mut self.factor,
            &mut self.subdiagonal,
            &mut self.forward,
            &mut self.inverse,
            matrix,
            Side::Lower,
            Par::Seq,
            MemStack::new(&mut self.memory),
            faer::Spec::default(),
        );
        self.definite = false;
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else {
            return Ok(0);
        };
        let perm = PermRef::new_checked(&self.forward, &self.inverse, n);
        let factor =
            SupernodalIntranodeLbltRef::new(symbolic, &self.factor, &self.subdiagonal, perm);
        let mut negative = 0;
        for s in 0..symbolic.n_supernodes() {
            let node = factor.supernode(s);
            let (start, columns) = (node.start(), node.val().ncols());
            let mut j = 0;
            while j < columns {
                let d = node.val()[(j, j)];
                let off = self.subdiagonal[start + j];
                if off == 0.0 || j + 1 == columns {
                    check_pivot(d, self.forward[start + j], &self.diagonal, values)?;
                    negative += usize::from(d < 0.0);
                    j += 1;
                } else {
                    // Eigenvalues of the block: their product is the determinant, their sum the trace.
                    let e = node.val()[(j + 1, j + 1)];
                    let determinant = d * e - off * off;
                    let scale = off.abs();
                    check_pivot(
                        determinant / scale,
                        self.forward[start + j],
                        &self.diagonal,
                        values,
                    )?;
                    negative += if determinant < 0.0 {
                        1
                    } else {
                        2 * usize::from(d + e < 0.0)
                    };
                    j += 2;
                }
            }
        }
        Ok(negative)
    }

    pub(super) fn solve(&mut self, rhs: &mut [f64]) {
        let n = rhs.len();
        let right = MatMut::from_column_major_slice_mut(rhs, n, 1);
        let stack = MemStack::new(&mut self.memory);
        if self.definite {
            let factor = LltRef::new(&self.symbolic, &self.factor);
            factor.solve_in_place_with_conj(Conj::No, right, Par::Seq, stack);
        } else {
            let perm = PermRef::new_checked(&self.forward, &self.inverse, n);
            let factor =
                IntranodeLbltRef::new(&self.symbolic, &self.factor, &self.subdiagonal, perm);
            factor.solve_in_place_with_conj(Conj::No, right, Par::Seq, stack);
        }
    }
}

/// Refuses a pivot that is nothing beside the diagonal entry it came from.
fn check_pivot(
    pivot: f64,
    equation: usize,
    diagonal: &[usize],
    values: &MatrixValues,
) -> Result<(), LinearError> {
    let original = values.lower[diagonal[equation]].abs();
    let pivot_ratio = if original > 0.0 {
        pivot.abs() / original
    } else {
        pivot.abs()
    };
    // A NaN pivot must not pass either.
    if pivot_ratio > SINGULAR_PIVOT || (original == 0.0 && pivot_ratio > 0.0) {
        Ok(())
    } else {
        Err(LinearError::Singular {
            equation,
            pivot_ratio,
        })
    }
}
