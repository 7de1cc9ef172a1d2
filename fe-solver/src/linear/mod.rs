//! Sparse direct solvers on one reused analysis.
//!
//! Policy: L L^T while the matrix is positive definite; L B L^T (Bunch and Kaufman 1977, pivoting inside a
//! supernode) when it is not, which also counts the negative pivots; L U for unsymmetric values. Equations
//! are taken in the order they are numbered, along the longest axis of the mesh: as little fill as a
//! fill-reducing ordering on slender meshes. One thread, so results are bit-identical.

mod error;
mod general;
mod symmetric;

pub use error::LinearError;

use fe_core::sparsity::{MatrixValues, Sparsity};

use general::GeneralFactor;
use symmetric::SymmetricFactor;

/// Relative residual above which a solution is refined once.
const REFINE_ABOVE: f64 = 1e-10;

/// Signs of the pivots; by Sylvester's law those of the eigenvalues.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Inertia {
    /// Negative pivots; 0 for an unsymmetric matrix, which has no inertia.
    pub negative: usize,
}

/// What a solver has done.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LinearStats {
    /// Equations.
    pub equations: usize,
    /// Stored entries of the lower triangle.
    pub nnz_matrix: usize,
    /// Stored entries of the symmetric factor.
    pub nnz_factor: usize,
    /// Multiplications and additions of a factorisation L L^T.
    pub factor_flops: f64,
    /// Factorisations L L^T.
    pub cholesky: usize,
    /// Factorisations L B L^T.
    pub indefinite: usize,
    /// Factorisations L U.
    pub general: usize,
    /// Applications of a factor, refinements included.
    pub solves: usize,
    /// Solutions that were refined.
    pub refinements: usize,
    /// Relative residual |b - A x|/|b| of the last solution.
    pub last_residual: f64,
}

/// A direct solver: symbolic once, numeric often.
pub trait LinearSolver {
    /// Analyses a pattern; drops any factor.
    ///
    /// # Errors
    ///
    /// [`LinearError::OutOfMemory`] when the factor cannot be held.
    fn analyze(&mut self, pattern: &Sparsity) -> Result<(), LinearError>;

    /// Factorises values on the analysed pattern.
    ///
    /// # Errors
    ///
    /// [`LinearError::Singular`] naming an equation that takes part in a zero-energy mode.
    fn factorize(&mut self, values: &MatrixValues) -> Result<Inertia, LinearError>;

    /// Solves with the last factor, in place: one residual check, one refinement if it exceeds 1e-10.
    ///
    /// # Errors
    ///
    /// [`LinearError::NotFactorized`] before a factorisation.
    fn solve_in_place(&mut self, rhs: &mut [f64]) -> Result<(), LinearError>;

    /// Applies the inverse of the last factor once, in place, unchecked: for iterations whose operator is only near
    /// the tangent, and which measure their residual anyway.
    ///
    /// # Errors
    ///
    /// [`LinearError::NotFactorized`] before a factorisation.
    fn precondition(&mut self, rhs: &mut [f64]) -> Result<(), LinearError>;

    /// What has been done.
    fn stats(&self) -> &LinearStats;
}

/// Which factor is current.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Current {
    #[default]
    None,
    Symmetric,
    General,
}

/// [`LinearSolver`] on faer's supernodal kernels.
#[derive(Debug, Default)]
pub struct DirectSolver {
    pattern: Option<Sparsity>,
    symmetric: Option<SymmetricFactor>,
    general: Option<GeneralFactor>,
    values: MatrixValues,
    current: Current,
    /// The last symmetric matrix was indefinite: start with L B L^T.
    indefinite: bool,
    stats: LinearStats,
    scratch: [Vec<f64>; 2],
}

impl DirectSolver {
    /// Tells what the next symmetric matrix is likely to be: an indefinite one is not tried by Cholesky first.
    pub const fn expect(&mut self, indefinite: bool) {
        self.indefinite = indefinite;
    }
}

impl LinearSolver for DirectSolver {
    fn analyze(&mut self, pattern: &Sparsity) -> Result<(), LinearError> {
        let symmetric = SymmetricFactor::analyze(pattern)?;
        self.stats = LinearStats {
            equations: pattern.len(),
            nnz_matrix: pattern.nnz(),
            nnz_factor: symmetric.nnz(),
            factor_flops: symmetric.flops(),
            ..LinearStats::default()
        };
        self.symmetric = Some(symmetric);
        self.general = None;
        self.current = Current::None;
        self.pattern = Some(pattern.clone());
        Ok(())
    }

    fn factorize(&mut self, values: &MatrixValues) -> Result<Inertia, LinearError> {
        self.current = Current::None;
        let (Some(pattern), Some(symmetric)) = (&self.pattern, &mut self.symmetric) else {
            return Err(LinearError::NotAnalysed);
        };
        if let Some(k) = values
            .lower
            .iter()
            .chain(&values.upper)
            .position(|v| !v.is_finite())
        {
            return Err(LinearError::NotFinite { position: k });
        }
        self.values.clone_from(values);
        if !values.is_symmetric() {
            let general = match &mut self.general {
                Some(general) => general,
                none => none.insert(GeneralFactor::analyze(pattern)?),
            };
            general.factorize(values)?;
            self.stats.general += 1;
            self.current = Current::General;
            return Ok(Inertia::default());
        }
        if !self.indefinite {
            self.stats.cholesky += 1;
            if symmetric.cholesky(values)? {
                self.current = Current::Symmetric;
                return Ok(Inertia::default());
            }
        }
        self.stats.indefinite += 1;
        let negative = symmetric.bunch_kaufman(values)?;
        self.indefinite = negative > 0;
        self.current = Current::Symmetric;
        Ok(Inertia { negative })
    }

    fn solve_in_place(&mut self, rhs: &mut [f64]) -> Result<(), LinearError> {
        let [mut right, mut residual] = std::mem::take(&mut self.scratch);
        right.clear();
        right.extend_from_slice(rhs);
        residual.resize(rhs.len(), 0.0);
        self.precondition(rhs)?;
        let Some(pattern) = &self.pattern else {
            return Err(LinearError::NotAnalysed);
        };
        self.values.multiply(pattern, rhs, &mut residual);
        for (r, b) in residual.iter_mut().zip(right.iter()) {
            *r = b - *r;
        }
        self.stats.last_residual = norm(&residual) / norm(&right).max(f64::MIN_POSITIVE);
        if self.stats.last_residual > REFINE_ABOVE {
            self.precondition(&mut residual)?;
            for (x, d) in rhs.iter_mut().zip(residual.iter()) {
                *x += d;
            }
            self.stats.refinements += 1;
        }
        self.scratch = [right, residual];
        Ok(())
    }

    fn precondition(&mut self, rhs: &mut [f64]) -> Result<(), LinearError> {
        match (self.current, &mut self.symmetric, &mut self.general) {
            (Current::Symmetric, Some(factor), _) => factor.solve(rhs),
            (Current::General, _, Some(factor)) => factor.solve(rhs),
            (_, None, _) => return Err(LinearError::NotAnalysed),
            _ => return Err(LinearError::NotFactorized),
        }
        self.stats.solves += 1;
        Ok(())
    }

    fn stats(&self) -> &LinearStats {
        &self.stats
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests;
