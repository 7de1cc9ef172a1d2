//! What keeps results from being written.

use std::io;

use crate::output::OutputError;

/// Why a result could not be written.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[non_exhaustive]
pub enum ResultsError {
    /// A file or folder cannot be written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Output(#[from] OutputError),
    /// A picture cannot be drawn.
    #[error("cannot draw the picture: {0}")]
    Drawing(String),
    /// The signal handler cannot be installed.
    #[error("cannot watch for Ctrl-C")]
    Signal(#[source] io::Error),
}

/// For recorders, which answer in the terms of the system; the message names the file.
impl From<ResultsError> for io::Error {
    fn from(error: ResultsError) -> Self {
        match error {
            ResultsError::Output(e) => {
                let kind = e.source.kind();
                let text = match kind {
                    // What is there already is not what would be written.
                    io::ErrorKind::InvalidData => format!("{}: {}", e.path.display(), e.source),
                    _ => format!("{e}: {}", e.source),
                };
                Self::new(kind, text)
            }
            other => Self::other(other),
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the reason on its way through the solver.
    use super::*;

    #[test]
    fn a_table_that_differs_is_not_said_to_be_unwritable() {
        let error = ResultsError::from(OutputError {
            path: "history.csv".into(),
            source: io::Error::new(io::ErrorKind::InvalidData, "line 3 differs"),
        });
        assert_eq!(
            io::Error::from(error).to_string(),
            "history.csv: line 3 differs"
        );
    }

    #[test]
    fn an_error_of_the_system_keeps_its_kind_and_names_the_file() {
        let error = ResultsError::from(OutputError {
            path: "history.csv".into(),
            source: io::Error::new(io::ErrorKind::StorageFull, "disk full"),
        });
        let error = io::Error::from(error);
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
        assert_eq!(error.to_string(), "cannot write history.csv: disk full");
    }
}
