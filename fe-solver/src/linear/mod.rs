//! Sparse direct solvers on one reused analysis.
//!
//! Policy: L L^T while the matrix is positive definite; L B L^T (Bunch and Kaufman 1977, pivoting inside a front) when
//! it is not, which also counts the negative pivots; L U, pivoting inside a front, for unsymmetric values. Multifrontal
//! (Duff and Reid 1983) on dense kernels; independent subtrees in parallel, with the same bits for any number of threads.
//!
//! Pivots stay in their front. That serves stiffnesses, whose diagonal is positive, also where they have become indefinite.
//! A zero on the diagonal, as of a multiplier, that leaves no pivot in its front is filled, and solutions are refined; a part
//! that nothing but multipliers holds may still be refused as singular. Prescribed displacements and followers need none.
//!
//! A matrix near the one whose L L^T is at hand may be solved by conjugate gradients with that factor instead, where
//! counted operations say that it is cheaper, see [`LinearSolver::renew`].
//!
//! ```
//! use fe_solver::linear::{DirectSolver, LinearSolver, MatrixValues, Sparsity};
//!
//! // The lower triangle, column by column, of 4 1 0; 1 3 -1; 0 -1 2.
//! let pattern = Sparsity::from_groups(3, [[0, 1], [1, 2]].iter().map(|pair| &pair[..]));
//! let values = MatrixValues {
//!     lower: vec![4.0, 1.0, 3.0, -1.0, 2.0],
//!     upper: Vec::new(),
//! };
//! let mut solver = DirectSolver::default();
//! solver.analyze(&pattern)?;
//! assert_eq!(solver.factorize(&values)?.negative, 0);
//! let mut x = [5.0, 3.0, 1.0];
//! solver.solve_in_place(&mut x)?;
//! assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15));
//! # Ok::<(), fe_solver::linear::LinearError>(())
//! ```

mod blocks;
mod conjugate;
mod dense;
mod elimination;
mod error;
mod extend;
mod factor;
mod fronts;
mod graph;
mod order;
mod probe;
mod tree;
mod triangular;
mod zeros;

pub use error::LinearError;
pub use fe_core::sparsity::{MatrixValues, Sparsity};
pub use order::Ordering;

use conjugate::Nearby;
use elimination::Kind;
use factor::Factor;
use fronts::Fronts;
use graph::Graph;

/// Relative residual of a solution by conjugate gradients.
const ITERATE_TO: f64 = 1e-8;
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
    /// Order of elimination.
    pub ordering: Ordering,
    /// Stored entries of the symmetric factor, zeros included.
    pub nnz_factor: usize,
    /// Multiplications and additions of a factorisation L L^T that stores no zeros.
    pub factor_flops: f64,
    /// Matrices that were factorised, whichever ways were tried.
    pub factorised: usize,
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
    /// Iterations of conjugate gradients.
    pub iterations: usize,
    /// Relative residual |b - A x|/|b| of the last solution by a factor, before its refinement.
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
    /// [`LinearError::Singular`] naming an equation that takes part in a zero-energy mode, [`LinearError::NotFinite`],
    /// [`LinearError::NotAnalysed`], [`LinearError::Mismatch`] for values of another pattern, and [`LinearError::OutOfMemory`] when
    /// the upper factor of an unsymmetric matrix, or what its kernels work on, cannot be held.
    fn factorize(&mut self, values: &MatrixValues) -> Result<Inertia, LinearError>;

    /// Makes `values` the matrix of the next solutions and factorises them only if that is cheaper: not if the present factor
    /// is theirs; if it is L L^T of another matrix, solutions are found by conjugate gradients with that factor, to a relative residual of
    /// 1e-8, as long as all their iterations together cost less than a factorisation, by counted operations. Where
    /// they do not suffice, or the matrix proves not to be positive definite, it is factorised then. Meshes on which less than
    /// eight iterations would pay are factorised at once. Returns the signs of the pivots, if it was factorised.
    ///
    /// # Errors
    ///
    /// Those of [`Self::factorize`].
    fn renew(&mut self, values: &MatrixValues) -> Result<Option<Inertia>, LinearError>;

    /// Solves with the last factor, in place: one residual check, one refinement if it exceeds 1e-10.
    ///
    /// # Errors
    ///
    /// [`LinearError::NotFactorized`] before a factorisation, [`LinearError::Mismatch`] for another number of equations,
    /// [`LinearError::RightNotFinite`], and those of [`Self::factorize`] where one was put off.
    fn solve_in_place(&mut self, rhs: &mut [f64]) -> Result<(), LinearError>;

    /// Applies the inverse of the last factor once, in place, unchecked: for iterations whose operator is only near
    /// the tangent, and which measure their residual anyway.
    ///
    /// # Errors
    ///
    /// [`LinearError::NotAnalysed`] before an analysis, [`LinearError::NotFactorized`] before a factorisation,
    /// [`LinearError::Mismatch`] for another number of equations.
    fn precondition(&mut self, rhs: &mut [f64]) -> Result<(), LinearError>;

    /// What has been done.
    fn stats(&self) -> &LinearStats;
}

/// What is known of a pattern.
#[derive(Debug)]
struct Analysis {
    pattern: Sparsity,
    fronts: Fronts,
}

/// [`LinearSolver`] by fronts.
#[derive(Debug, Default)]
pub struct DirectSolver {
    analysis: Option<Analysis>,
    factor: Option<Factor>,
    values: MatrixValues,
    /// The signs of the factor, if there is one: that of `values`, or of an earlier matrix while that of `values` is put off.
    current: Option<Inertia>,
    /// Iterations that still pay while the factorisation of `values` is put off.
    put_off: Option<usize>,
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

    /// Whether the factorisation of the last [renewed](LinearSolver::renew) matrix is put off.
    pub const fn is_put_off(&self) -> bool {
        self.put_off.is_some()
    }

    /// The signs of the matrix of the next solutions, if it is factorised.
    pub fn signs(&self) -> Option<Inertia> {
        self.current.filter(|_| !self.is_put_off())
    }

    /// The signs of the factor at hand, if it is that of `values`.
    fn known(&self, values: &MatrixValues) -> Option<Inertia> {
        let factorised = self.put_off.is_none() && self.values == *values;
        self.current.filter(|_| factorised)
    }

    /// The signs of the pivots of `values`, factorised unless the factor at hand is theirs.
    ///
    /// # Errors
    ///
    /// Those of [`LinearSolver::factorize`].
    pub fn inertia(&mut self, values: &MatrixValues) -> Result<Inertia, LinearError> {
        self.known(values)
            .map_or_else(|| self.factorize(values), Ok)
    }

    /// Solves by conjugate gradients within the iterations that still pay. Returns whether they sufficed.
    fn iterate(&mut self, rhs: &mut [f64], limit: usize) -> Result<bool, LinearError> {
        let (Some(analysis), Some(factor)) = (&self.analysis, &mut self.factor) else {
            return Err(LinearError::NotAnalysed);
        };
        fits("values on the right", rhs.len(), analysis.pattern.len())?;
        let system = Nearby {
            pattern: &analysis.pattern,
            values: &self.values,
            precondition: |r: &mut [f64]| factor.solve(&analysis.fronts, r),
        };
        let Some((x, iterations)) = system.solve(rhs, ITERATE_TO, limit) else {
            return Ok(false);
        };
        rhs.copy_from_slice(&x);
        self.put_off = Some(limit - iterations);
        self.stats.iterations += iterations;
        self.stats.solves += iterations + 1;
        Ok(true)
    }
}

/// Refuses what has another length than the pattern that was analysed.
fn fits(what: &'static str, given: usize, expected: usize) -> Result<(), LinearError> {
    if given == expected {
        return Ok(());
    }
    Err(LinearError::Mismatch {
        what,
        given,
        expected,
    })
}

impl LinearSolver for DirectSolver {
    fn analyze(&mut self, pattern: &Sparsity) -> Result<(), LinearError> {
        (self.analysis, self.factor, self.current) = (None, None, None);
        self.put_off = None;
        let graph = Graph::new(pattern);
        let (ordering, tree) = order::choose(&graph)?;
        let fronts = Fronts::new(pattern, &graph, &tree).ok_or(LinearError::OutOfMemory)?;
        self.stats = LinearStats {
            equations: pattern.len(),
            nnz_matrix: pattern.nnz(),
            ordering,
            nnz_factor: fronts.entries_of_factor(),
            factor_flops: tree.flops(&graph),
            ..LinearStats::default()
        };
        self.factor = Some(Factor::new(&fronts)?);
        self.analysis = Some(Analysis {
            pattern: pattern.clone(),
            fronts,
        });
        Ok(())
    }

    fn factorize(&mut self, values: &MatrixValues) -> Result<Inertia, LinearError> {
        let (Some(analysis), Some(factor)) = (&self.analysis, &mut self.factor) else {
            return Err(LinearError::NotAnalysed);
        };
        let Analysis { pattern, fronts } = analysis;
        fits("entries", values.lower.len(), pattern.nnz())?;
        if !values.is_symmetric() {
            fits("upper entries", values.upper.len(), pattern.nnz())?;
        }
        (self.current, self.put_off) = (None, None);
        self.values.clone_from(values);
        self.stats.factorised += 1;
        let diagonal = &pattern.col_ptr()[..pattern.len()];
        let result = if values.is_symmetric() {
            let indefinite = self.indefinite;
            decompose_symmetric(
                factor,
                (fronts, values, diagonal),
                indefinite,
                &mut self.stats,
            )
        } else {
            self.stats.general += 1;
            factor
                .factorize(fronts, values, diagonal, Kind::General)
                .and_then(|_| probe::regular(pattern, values, |x| factor.solve(fronts, x)))
                .map(|()| 0)
        };
        let result = if diagonal.iter().any(|&k| values.lower[k] == 0.0) {
            beside_zeros(result, factor, (fronts, pattern, values), &mut self.stats)
        } else {
            result
        };
        // A value that is not finite makes a pivot so.
        let negative = result.map_err(|error| match not_finite(values) {
            Some(position) => LinearError::NotFinite { position },
            None => error,
        })?;
        if values.is_symmetric() {
            self.indefinite = negative > 0;
        }
        let inertia = Inertia { negative };
        self.current = Some(inertia);
        Ok(inertia)
    }

    fn renew(&mut self, values: &MatrixValues) -> Result<Option<Inertia>, LinearError> {
        if let Some(inertia) = self.known(values) {
            return Ok(Some(inertia));
        }
        let definite = self.factor.as_ref().is_some_and(Factor::is_definite);
        if self.current.is_some() && definite && values.is_symmetric() {
            let LinearStats {
                factor_flops,
                nnz_factor,
                nnz_matrix,
                ..
            } = self.stats;
            fits("entries", values.lower.len(), nnz_matrix)?;
            self.put_off = conjugate::budget(factor_flops, nnz_factor + nnz_matrix);
            if self.is_put_off() {
                self.values.clone_from(values);
                return Ok(None);
            }
        }
        self.factorize(values).map(Some)
    }

    fn solve_in_place(&mut self, rhs: &mut [f64]) -> Result<(), LinearError> {
        if let Some(equation) = rhs.iter().position(|b| !b.is_finite()) {
            let value = rhs[equation];
            return Err(LinearError::RightNotFinite { equation, value });
        }
        if let Some(limit) = self.put_off {
            if self.iterate(rhs, limit)? {
                return Ok(());
            }
            let values = std::mem::take(&mut self.values);
            self.factorize(&values)?;
        }
        let [mut right, mut residual] = std::mem::take(&mut self.scratch);
        right.clear();
        right.extend_from_slice(rhs);
        residual.resize(rhs.len(), 0.0);
        self.precondition(rhs)?;
        let Some(analysis) = &self.analysis else {
            return Err(LinearError::NotAnalysed);
        };
        self.values.multiply(&analysis.pattern, rhs, &mut residual);
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
        match (&self.analysis, &mut self.factor) {
            (Some(_), Some(_)) if self.current.is_none() => return Err(LinearError::NotFactorized),
            (Some(analysis), Some(factor)) => {
                fits("values on the right", rhs.len(), analysis.pattern.len())?;
                factor.solve(&analysis.fronts, rhs);
            }
            _ => return Err(LinearError::NotAnalysed),
        }
        self.stats.solves += 1;
        Ok(())
    }

    fn stats(&self) -> &LinearStats {
        &self.stats
    }
}

/// L L^T, or L B L^T if the matrix is or is expected to be `indefinite`; returns the number of negative pivots.
fn decompose_symmetric(
    factor: &mut Factor,
    (fronts, values, diagonal): (&Fronts, &MatrixValues, &[usize]),
    indefinite: bool,
    stats: &mut LinearStats,
) -> Result<usize, LinearError> {
    if !indefinite {
        stats.cholesky += 1;
        if factor.factorize(fronts, values, diagonal, Kind::Definite)? {
            return Ok(0);
        }
    }
    stats.indefinite += 1;
    factor.factorize(fronts, values, diagonal, Kind::Indefinite)?;
    Ok(factor.negative(fronts))
}

/// What has come of a matrix with zeros on its diagonal: its `result`, if that holds, or that of L B L^T or L U with the zeros
/// filled, see [`zeros`].
fn beside_zeros(
    result: Result<usize, LinearError>,
    factor: &mut Factor,
    (fronts, pattern, values): (&Fronts, &Sparsity, &MatrixValues),
    stats: &mut LinearStats,
) -> Result<usize, LinearError> {
    let scales = probe::scales(pattern, values);
    let served =
        |factor: &mut Factor| zeros::served(pattern, values, &scales, |x| factor.solve(fronts, x));
    let refused = match result {
        Ok(negative) => match served(factor) {
            Ok(()) => return Ok(negative),
            Err(equation) => LinearError::Singular {
                equation,
                pivot_ratio: 0.0,
            },
        },
        Err(error @ LinearError::Singular { .. }) => error,
        Err(error) => return Err(error),
    };
    let Some(filled) = zeros::filled(pattern, values, &scales) else {
        return Err(refused);
    };
    let kind = if values.is_symmetric() {
        stats.indefinite += 1;
        Kind::Indefinite
    } else {
        stats.general += 1;
        Kind::General
    };
    let diagonal = &pattern.col_ptr()[..pattern.len()];
    match factor.factorize(fronts, &filled, diagonal, kind) {
        Ok(_) if served(factor).is_ok() => Ok(match kind {
            Kind::General => 0,
            Kind::Definite | Kind::Indefinite => factor.negative(fronts),
        }),
        Ok(_) | Err(_) => Err(refused),
    }
}

/// Position of a value that is not finite.
fn not_finite(values: &MatrixValues) -> Option<usize> {
    let all = values.lower.iter().chain(&values.upper);
    all.copied().position(|v| !v.is_finite())
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests;
