//! Runs specimens.

use crate::exit::Exit;
use crate::options::RunOptions;
use crate::spec::Specimen;

/// What stops the program before or between runs.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[non_exhaustive]
pub enum RunError {
    /// The analysis is missing.
    #[error("the analysis is not built yet")]
    NotBuilt,
}

impl RunError {
    /// How the program ends because of it.
    pub fn exit(&self) -> Exit {
        match self {
            Self::NotBuilt => Exit::StoppedEarly,
        }
    }
}

/// Runs the specimens one after the other.
///
/// # Errors
///
/// [`RunError::NotBuilt`], always.
pub fn run_all(_specimens: &[Specimen], _options: &RunOptions) -> Result<Exit, RunError> {
    Err(RunError::NotBuilt)
}
