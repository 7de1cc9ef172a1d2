//! The folder of the results.

use std::path::{Path, PathBuf};
use std::{fs, io};

use miette::Diagnostic;

/// A folder that cannot hold results.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("cannot write into the folder {}", path.display())]
#[diagnostic(code(rc_beams::output), help("choose another folder with --output"))]
pub struct OutputError {
    /// The folder.
    pub path: PathBuf,
    /// Why.
    pub source: io::Error,
}

/// Makes the folder if it is missing and makes sure that files can be written into it.
///
/// # Errors
///
/// [`OutputError`] if not.
pub fn prepare(path: &Path) -> Result<(), OutputError> {
    fs::create_dir_all(path)
        .and_then(|()| tempfile::tempfile_in(path))
        .map(|_| ())
        .map_err(|source| OutputError {
            path: path.into(),
            source,
        })
}
