//! Linear solutions of a stage: which matrix the factor at hand is of, and what goes wrong, by node and DOF.

use std::time::{Duration, Instant};

use fe_core::sparsity::MatrixValues;

use super::Stage;
use crate::error::SolverError;
use crate::linear::{DirectSolver, Inertia, LinearError, LinearSolver};

impl Stage<'_> {
    /// Whether the present factor is that of the consistent tangent (its symmetric part) at the accepted
    /// state, found positive definite by [`Self::stability`].
    pub const fn holds_stable_tangent(&self) -> bool {
        self.stable_tangent
    }

    /// The state whose stability was found is not accepted: the factor is that of no accepted state.
    pub(crate) const fn forget_tangent(&mut self) {
        self.stable_tangent = false;
    }

    /// Factorises the matrix of the last evaluation that asked for an operator.
    ///
    /// # Errors
    ///
    /// [`SolverError::NotEvaluated`] before such an evaluation, [`SolverError::Singular`] or [`SolverError::NotFinite`]
    /// naming node and DOF, or [`SolverError::Linear`].
    pub fn factorise(&mut self) -> Result<(), SolverError> {
        self.factorised(|linear, matrix| linear.factorize(matrix).map(Some))
    }

    /// Whether an operator has been evaluated, and the last one without failure.
    pub(crate) fn has_operator(&self) -> bool {
        self.assembled.matrix.lower.len() == self.assembler.pattern().nnz()
    }

    /// Hands the matrix over, and takes the signs of its pivots if it was factorised.
    fn factorised(
        &mut self,
        hand_over: impl FnOnce(&mut DirectSolver, &MatrixValues) -> Result<Option<Inertia>, LinearError>,
    ) -> Result<(), SolverError> {
        if !self.has_operator() {
            return Err(SolverError::NotEvaluated);
        }
        self.stable_tangent = false;
        let (result, time) = self.counted(hand_over);
        self.times.factorise += time;
        if let Some(inertia) = result.map_err(|e| self.place(e))? {
            self.counters.negative_pivots = inertia.negative;
        }
        Ok(())
    }

    /// What the linear solver does with the matrix, and how long it takes; counts what it factorises.
    fn counted<T>(
        &mut self,
        work: impl FnOnce(&mut DirectSolver, &MatrixValues) -> T,
    ) -> (T, Duration) {
        let (begin, before) = (Instant::now(), self.linear.stats().factorised);
        let result = work(&mut self.linear, &self.assembled.matrix);
        self.counters.factorisations += self.linear.stats().factorised - before;
        (result, begin.elapsed())
    }

    /// Factorises as [`Self::factorise`] does, unless the factor at hand is that of this matrix.
    pub(super) fn inertia(&mut self) -> Result<(), SolverError> {
        self.factorised(|linear, matrix| linear.inertia(matrix).map(Some))
    }

    /// Makes the matrix of the last evaluation that asked for an operator that of the next solutions; factorises it only
    /// if that is cheaper, see [`LinearSolver::renew`].
    ///
    /// # Errors
    ///
    /// Those of [`Self::factorise`].
    pub fn renew(&mut self) -> Result<(), SolverError> {
        self.factorised(LinearSolver::renew)
    }

    /// Solves with the last factor, in place.
    ///
    /// # Errors
    ///
    /// [`SolverError::Singular`], [`SolverError::NoNumber`] for a force that is none, or [`SolverError::Linear`].
    pub fn solve(&mut self, rhs: &mut [f64]) -> Result<(), SolverError> {
        let put_off = self.linear.is_put_off();
        let (result, time) = self.counted(|linear, _| linear.solve_in_place(rhs));
        self.times.solve += time;
        // What had been put off may have been factorised after all.
        if let Some(signs) = self.linear.signs().filter(|_| put_off) {
            self.counters.negative_pivots = signs.negative;
        }
        result.map_err(|e| self.place(e))
    }

    /// Applies the inverse of the last factor once, in place and unchecked, see [`LinearSolver::precondition`].
    ///
    /// # Errors
    ///
    /// [`SolverError::Linear`].
    pub fn precondition(&mut self, rhs: &mut [f64]) -> Result<(), SolverError> {
        let begin = Instant::now();
        let result = self.linear.precondition(rhs);
        self.times.solve += begin.elapsed();
        result.map_err(|e| self.place(e))
    }

    fn place(&self, error: LinearError) -> SolverError {
        match error {
            LinearError::Singular {
                equation,
                pivot_ratio,
            } => {
                let dof_index = self.assembler.free()[equation] as usize;
                let (node, dof) = self.model.dofs().owner(dof_index);
                let position = self.model.mesh().nodes()[node];
                SolverError::Singular {
                    node,
                    dof,
                    position,
                    ratio: pivot_ratio,
                }
            }
            LinearError::NotFinite { position } => {
                let rows = self.assembler.pattern().row_idx();
                let dof = self.assembler.free()[rows[position % rows.len()]];
                SolverError::NotFinite {
                    at: self.describe(dof as usize),
                }
            }
            LinearError::RightNotFinite { equation, value } => {
                let dof = self.assembler.free()[equation] as usize;
                let what = format!("force (N) on {}", self.describe(dof));
                SolverError::NoNumber { what, value }
            }
            other => SolverError::Linear(other),
        }
    }
}
