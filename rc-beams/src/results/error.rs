//! What keeps results from being written.

use std::io;
use std::path::PathBuf;

/// Why a result could not be written.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[non_exhaustive]
pub enum OutputError {
    /// The folder of the results cannot be used.
    #[error("cannot write into the folder {}: {source}", path.display())]
    #[diagnostic(help("choose another one with -o DIR, or allow writing there; nothing was run"))]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A picture cannot be drawn.
    #[error("cannot draw the picture: {0}")]
    Drawing(String),
    /// The signal handler cannot be installed.
    #[error("cannot watch for Ctrl-C: {0}")]
    Signal(#[from] ctrlc::Error),
}

impl From<OutputError> for io::Error {
    fn from(error: OutputError) -> Self {
        Self::other(error)
    }
}
