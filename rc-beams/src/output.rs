//! Files and folders of the results.

use std::path::{Path, PathBuf};
use std::{fs, io};

use miette::Diagnostic;

/// A file or folder that cannot be written.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("cannot write {}", path.display())]
#[diagnostic(code(rc_beams::output), help("{}", remedy(source)))]
pub struct OutputError {
    /// The file or folder.
    pub path: PathBuf,
    /// Why.
    pub source: io::Error,
}

fn remedy(source: &io::Error) -> &'static str {
    match source.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "make room, and go on with --resume where a run had begun, or choose another place with --output"
        }
        _ => "choose another place with --output",
    }
}

/// Makes the folder if it is missing and makes sure that files can be written into it.
///
/// # Errors
///
/// [`OutputError`] if not.
pub fn prepare(path: &Path) -> Result<(), OutputError> {
    // Without the dots that name no folder.
    let path: PathBuf = path.components().collect();
    fs::create_dir_all(&path)
        .and_then(|()| tempfile::tempfile_in(&path))
        .map(|_| ())
        .map_err(|source| OutputError {
            path: path.clone(),
            source,
        })
}

/// Writes a file, anew if it exists.
///
/// # Errors
///
/// [`OutputError`] if it cannot be written.
pub fn write(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    fs::write(path, content).map_err(|source| OutputError {
        path: path.into(),
        source,
    })
}
