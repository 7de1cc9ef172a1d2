//! The fields of a model over time.

use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::pvd::Pvd;
use super::{bar_grid, cell_grid, interface_grid, write_atomically};
use crate::model::Model;
use crate::state::StateStore;

/// Writes `NAME.pvd`, and for each recorded step `NAME_0001.vtu` (cells) and, where there are some,
/// `NAME_bars_0001.vtu` (bars) and `NAME_interfaces_0001.vtu` (interfaces) into one folder: parts 0, 1, 2 of the
/// collection in that order.
#[derive(Debug)]
pub struct FieldSeries {
    folder: PathBuf,
    name: String,
    recorded: usize,
    collection: Pvd,
}

impl FieldSeries {
    /// Starts a series in an existing folder.
    ///
    /// # Errors
    ///
    /// [`OutputError::Io`].
    pub fn create(folder: &Path, name: &str) -> Result<Self, OutputError> {
        Ok(Self {
            folder: folder.into(),
            name: name.into(),
            recorded: 0,
            collection: Pvd::create(&folder.join(format!("{name}.pvd")))?,
        })
    }

    /// Writes the fields of the committed `state` at displacement `u` and adds them at `time`.
    ///
    /// # Errors
    ///
    /// [`OutputError`], naming the file or the element.
    pub fn record(
        &mut self,
        time: f64,
        model: &Model,
        u: &[f64],
        state: &StateStore,
    ) -> Result<(), OutputError> {
        self.recorded += 1;
        let (name, number) = (&self.name, self.recorded);
        let mut files = vec![format!("{name}_{number:04}.vtu")];
        let mut grids = vec![cell_grid(model, u, state)?];
        for (kind, grid) in [
            ("bars", bar_grid(model, u, state)?),
            ("interfaces", interface_grid(model, u, state)?),
        ] {
            if grid.cells() > 0 {
                files.push(format!("{name}_{kind}_{number:04}.vtu"));
                grids.push(grid);
            }
        }
        for (file, grid) in files.iter().zip(&grids) {
            write_atomically(&self.folder.join(file), |out| grid.write(out))?;
        }
        self.collection.add(time, &files)
    }
}
