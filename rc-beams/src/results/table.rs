//! A CSV file that grows.

use std::io;
use std::path::PathBuf;

use csv::Writer;

use crate::output::OutputError;
use crate::results::error::ResultsError;
use crate::results::folder::Folder;
use crate::results::growing::Growing;

/// A CSV file with its path.
#[derive(Debug)]
pub(super) struct Table {
    path: PathBuf,
    writer: Writer<Growing>,
}

impl Table {
    pub(super) fn create<'a>(
        folder: &Folder,
        name: &str,
        columns: impl IntoIterator<Item = &'a str>,
    ) -> Result<Self, ResultsError> {
        let mut table = Self {
            path: folder.path().join(name),
            writer: Writer::from_writer(folder.start(name)?),
        };
        table.row(columns)?;
        table.flush()?;
        Ok(table)
    }

    pub(super) fn row<C: AsRef<[u8]>>(
        &mut self,
        cells: impl IntoIterator<Item = C>,
    ) -> Result<(), ResultsError> {
        let written = self.writer.write_record(cells);
        written.map_err(|e| self.error(e.into()))
    }

    pub(super) fn flush(&mut self) -> Result<(), ResultsError> {
        let flushed = self.writer.flush();
        flushed.map_err(|e| self.error(e))
    }

    /// Ends what an earlier run left, see [`Growing::settle`].
    pub(super) fn settle(&mut self) -> Result<(), ResultsError> {
        self.flush()?;
        let settled = self.writer.get_ref().settle();
        settled.map_err(|e| self.error(e))
    }

    fn error(&self, source: io::Error) -> ResultsError {
        let path = self.path.clone();
        OutputError { path, source }.into()
    }
}

/// The shortest text that reads back as `value`; empty if it is not finite.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 {
        "0".to_owned()
    } else if !value.is_finite() {
        String::new()
    } else if (1e-4..1e7).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    //! Protects numbers on their way into a file.
    use super::*;

    #[test]
    fn numbers_read_back_unchanged() {
        for value in [0.1 + 0.2, 1.0 / 3.0, -2.5e-17, 6.02e23, 149.0] {
            assert_eq!(number(value).parse::<f64>().unwrap(), value);
        }
        assert_eq!(number(f64::NAN), "");
        assert_eq!(number(-0.0), "0");
    }
}
