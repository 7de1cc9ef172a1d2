//! The collection file that ties grids to a time.

use std::io::Write;
use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::write_atomically;

/// A `.pvd` collection: data files by time and part, rewritten as a whole after each addition.
#[derive(Debug, Clone)]
pub struct Pvd {
    path: PathBuf,
    entries: Vec<Entry>,
}

#[derive(Debug, Clone)]
struct Entry {
    time: f64,
    part: usize,
    file: String,
}

impl Pvd {
    /// Creates an empty collection; a file of that name is replaced.
    ///
    /// # Errors
    ///
    /// [`OutputError::Io`].
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        let pvd = Self {
            path: path.into(),
            entries: Vec::new(),
        };
        pvd.rewrite()?;
        Ok(pvd)
    }

    /// Adds the files of one time, given relative to the folder of the collection, as parts 0, 1, ...
    ///
    /// # Errors
    ///
    /// [`OutputError::Io`]; the file on disk is then the one before the addition.
    pub fn add(&mut self, time: f64, files: &[String]) -> Result<(), OutputError> {
        let before = self.entries.len();
        self.entries
            .extend(files.iter().enumerate().map(|(part, file)| Entry {
                time,
                part,
                file: escape(file),
            }));
        self.rewrite()
            .inspect_err(|_| self.entries.truncate(before))
    }

    fn rewrite(&self) -> Result<(), OutputError> {
        write_atomically(&self.path, |out| {
            writeln!(out, "<?xml version=\"1.0\"?>")?;
            writeln!(
                out,
                "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">"
            )?;
            writeln!(out, "<Collection>")?;
            for Entry { time, part, file } in &self.entries {
                writeln!(
                    out,
                    "<DataSet timestep=\"{time}\" part=\"{part}\" file=\"{file}\"/>"
                )?;
            }
            writeln!(out, "</Collection>\n</VTKFile>")
        })
    }
}

/// Escapes what XML does not admit in an attribute.
pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('"', "&quot;")
}
