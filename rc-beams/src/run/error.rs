//! What stops the program.

use fe_core::model::ModelError;

use crate::analysis::AnalysisError;
use crate::build::BuildError;
use crate::exit::Exit;
use crate::results::checkpoint::CheckpointError;
use crate::results::error::ResultsError;

/// What stops the program before or between runs.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[non_exhaustive]
pub enum RunError {
    /// Options do not fit together.
    #[error("{0}")]
    Options(String),
    /// A model cannot be built.
    #[error("{specimen}: {reason}")]
    Build {
        /// Specimen.
        specimen: String,
        /// Why.
        reason: Box<BuildError>,
        /// Whether it can with the default options.
        by_options: bool,
    },
    /// Results cannot be written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Output(#[from] ResultsError),
    /// A run cannot be continued.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Resume(#[from] CheckpointError),
    /// The threads cannot be started.
    #[error("cannot start the threads")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A beam cannot carry its own weight, or its model is singular.
    #[error("{specimen}: {reason}")]
    Solver {
        /// Specimen.
        specimen: String,
        /// Why.
        reason: Box<AnalysisError>,
    },
    /// A state cannot be read.
    #[error(transparent)]
    Model(#[from] ModelError),
}

impl RunError {
    /// How the program ends because of it.
    pub fn exit(&self) -> Exit {
        match self {
            Self::Options(_)
            | Self::Build {
                by_options: true, ..
            } => Exit::Usage,
            Self::Build { .. } => Exit::BadInput,
            Self::Output(_) | Self::Resume(_) => Exit::File,
            Self::Solver { reason, .. } if reason.is_output() => Exit::File,
            Self::Threads(_) | Self::Solver { .. } | Self::Model(_) => Exit::StoppedEarly,
        }
    }
}
