//! The fields of a model over time.

use std::path::{Path, PathBuf};

use super::background::Background;
use super::error::OutputError;
use super::pvd::Pvd;
use super::vtu::UnstructuredGrid;
use super::{bar_grid, cell_grid, interface_grid, write_atomically};
use crate::model::Model;
use crate::state::StateStore;

/// Writes `NAME.pvd`, and for each recorded step `NAME_0001.vtu` (cells) and, where there are some,
/// `NAME_bars_0001.vtu` (bars) and `NAME_interfaces_0001.vtu` (interfaces) into one folder: parts 0, 1, 2 of the
/// collection in that order.
///
/// The fields are taken from the model at once; a thread of the series compresses and writes them. Dropped, it waits
/// for the rest to be written; [`Self::flush`] tells the errors too.
#[derive(Debug)]
pub struct FieldSeries {
    background: Background<Step>,
}

/// The grids of one step: cells, bars, interfaces.
#[derive(Debug)]
struct Step {
    time: f64,
    grids: [UnstructuredGrid; 3],
}

/// What the names of the files of a step have after that of the series.
const KINDS: [&str; 3] = ["", "_bars", "_interfaces"];

impl FieldSeries {
    /// Starts a series in an existing folder.
    ///
    /// # Errors
    ///
    /// [`OutputError::Io`].
    pub fn create(folder: &Path, name: &str) -> Result<Self, OutputError> {
        let path = folder.join(format!("{name}.pvd"));
        let mut files = Files {
            folder: folder.into(),
            name: name.into(),
            recorded: 0,
            collection: Pvd::create(&path)?,
        };
        let background = Background::start(move |step| files.write(&step));
        Ok(Self {
            background: background.map_err(|source| OutputError::Io { path, source })?,
        })
    }

    /// Takes the fields of the committed `state` at displacement `u`, to be written and added at `time`.
    ///
    /// # Errors
    ///
    /// [`OutputError`], naming the file or the element; also that of a file of an earlier step.
    pub fn record(
        &mut self,
        time: f64,
        model: &Model,
        u: &[f64],
        state: &StateStore,
    ) -> Result<(), OutputError> {
        let grids = [
            cell_grid(model, u, state)?,
            bar_grid(model, u, state)?,
            interface_grid(model, u, state)?,
        ];
        self.background.write(Step { time, grids })
    }

    /// Waits until all that was recorded is on disk.
    ///
    /// # Errors
    ///
    /// [`OutputError::Io`] of the first file that could not be written; none after it is.
    /// [`OutputError::Ended`] once that was told.
    pub fn flush(&mut self) -> Result<(), OutputError> {
        self.background.flush()
    }
}

/// The files of a series.
#[derive(Debug)]
struct Files {
    folder: PathBuf,
    name: String,
    recorded: usize,
    collection: Pvd,
}

impl Files {
    fn write(&mut self, step: &Step) -> Result<(), OutputError> {
        self.recorded += 1;
        let mut files = Vec::new();
        for (kind, grid) in KINDS.into_iter().zip(&step.grids) {
            if kind.is_empty() || grid.cells() > 0 {
                let file = format!("{}{kind}_{:04}.vtu", self.name, self.recorded);
                write_atomically(&self.folder.join(&file), |out| grid.write(out))?;
                files.push(file);
            }
        }
        self.collection.add(step.time, &files)
    }
}
