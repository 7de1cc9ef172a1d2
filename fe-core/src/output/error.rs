//! What can go wrong when results are written.

use std::io;
use std::path::PathBuf;

use crate::model::ModelError;

/// Why results could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The file system refused.
    #[error("cannot write {}: {source}; check that the folder exists, is writable and has room", path.display())]
    Io {
        /// File that was to be written.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The writing ended before, with an error that has been told.
    #[error("not written: a file before it could not be")]
    Ended,
    /// An element could not be evaluated.
    #[error("cannot sample the results: {0}")]
    Model(#[from] ModelError),
}
