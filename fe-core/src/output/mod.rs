//! Files that ParaView and other readers of VTK formats open.
//!
//! A [`FieldSeries`] writes the fields of a model step by step: one `.vtu` of cells, one of bars, one of
//! interfaces, and a `.pvd` collection that ties them to a time. Every file is written beside its final place and then
//! renamed, so that a run killed at any moment leaves complete files and a readable collection.

mod background;
mod bars;
mod cells;
mod error;
mod interfaces;
mod pvd;
mod series;
mod vtu;

pub use bars::bar_grid;
pub use cells::cell_grid;
pub use error::OutputError;
pub use interfaces::interface_grid;
pub use pvd::Pvd;
pub use series::FieldSeries;
pub use vtu::{DataArray, UnstructuredGrid};

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes a file under a temporary name in the same folder, then renames it.
fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    let mut temporary = path.as_os_str().to_owned();
    temporary.push(".part");
    let result = File::create(&temporary)
        .and_then(|file| {
            let mut out = BufWriter::new(file);
            write(&mut out)?;
            out.flush()
        })
        .and_then(|()| fs::rename(&temporary, path));
    result.map_err(|source| {
        // What is left of a failed attempt is of no use; the first error is the one to report.
        let _ = fs::remove_file(&temporary);
        OutputError::Io {
            path: path.into(),
            source,
        }
    })
}
