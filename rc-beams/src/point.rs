//! Drives a material point through the program of a case file.

use std::error::Error;
use std::path::Path;

use fe_core::point::PointError;
use fe_materials::case::{CaseError, PointCase, PointRun};

use crate::input::{InputError, read_file};
use crate::ronfile::RonFile;

/// Reads a case file and drives its point.
///
/// # Errors
///
/// [`InputError`] if the file cannot be read or the case is not valid; a program that cannot be finished
/// is told by [`PointRun::result`].
pub fn run(path: &Path) -> Result<PointRun, InputError> {
    let file = RonFile::new(&path.display().to_string(), &read_file(path)?);
    let case: PointCase = file.parse()?;
    let refused = |field: String, error: &dyn Error| {
        InputError::from(file.error(&field, error.to_string(), None))
    };
    let run = case.run().map_err(|error| refused(field(&error), &error))?;
    match run.result {
        Err(
            ref error @ (PointError::Steps { segment, .. } | PointError::NotFinite { segment, .. }),
        ) => Err(refused(program(segment), error)),
        _ => Ok(run),
    }
}

/// The field that an error is about.
fn field(error: &CaseError) -> String {
    match error {
        CaseError::Component { segment, field, .. } => format!("{}.{field}", program(*segment)),
        CaseError::Overdetermined { segment, .. } => program(*segment),
        CaseError::NoSegments => "program".into(),
        _ => "law".into(),
    }
}

/// Field of a segment, counted from 1.
fn program(segment: usize) -> String {
    format!("program[{}]", segment.saturating_sub(1))
}
