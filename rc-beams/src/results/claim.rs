//! One run at a time in a folder.

use std::fs::{File, OpenOptions, TryLockError};
use std::io;
use std::path::Path;

/// File whose lock says that a run is going on; it goes with the checkpoint.
pub(super) const CLAIM: &str = ".lock";

/// A folder that no other run may write into while this lives; the system ends it with the process.
#[derive(Debug)]
pub(super) struct Claim {
    _locked: File,
}

impl Claim {
    /// Claims a folder.
    ///
    /// # Errors
    ///
    /// If another run has claimed it, or the file cannot be written. A file system without locks is no obstacle.
    pub(super) fn on(folder: &Path) -> io::Result<Self> {
        let mut options = OpenOptions::new();
        options.write(true).create(true).truncate(false);
        let file = options.open(folder.join(CLAIM))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => {
                Err(io::Error::other("another run is writing into this folder"))
            }
            Ok(()) | Err(TryLockError::Error(_)) => Ok(Self { _locked: file }),
        }
    }
}
