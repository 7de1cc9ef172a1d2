//! What a linear solver can refuse.

/// Why a system could not be factorised or solved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinearError {
    /// The matrix is singular to working precision.
    #[error(
        "the matrix is singular at equation {equation}: pivot {pivot_ratio:.1e} of its diagonal"
    )]
    Singular {
        /// An equation that takes part in the zero-energy mode.
        equation: usize,
        /// Pivot relative to the diagonal entry it came from.
        pivot_ratio: f64,
    },
    /// A value is NaN or infinite.
    #[error("entry {position} of the matrix is not finite")]
    NotFinite {
        /// Position in the value array.
        position: usize,
    },
    /// A value on the right is NaN or infinite.
    #[error("value {equation} on the right is {value}; allowed: finite numbers")]
    RightNotFinite {
        /// Equation.
        equation: usize,
        /// Value given.
        value: f64,
    },
    /// Values or right-hand side of another pattern.
    #[error("{given} {what} for a pattern of {expected}")]
    Mismatch {
        /// Entries of the matrix or of the right-hand side.
        what: &'static str,
        /// How many there are.
        given: usize,
        /// How many the pattern has.
        expected: usize,
    },
    /// The factor cannot be held in memory.
    #[error("the factor does not fit in memory; use a coarser mesh")]
    OutOfMemory,
    /// `factorize` was called before `analyze`.
    #[error("no pattern has been analysed")]
    NotAnalysed,
    /// `solve_in_place` was called before `factorize`.
    #[error("no matrix has been factorised")]
    NotFactorized,
}
