//! Drives a material point through the program of a case file.

use std::error::Error;
use std::path::Path;

use fe_contact::case::BondCase;
use fe_core::material::PointContext;
use fe_core::point::PointError;
use fe_materials::case::{CaseError, LawCase, PointCase, PointRun, SegmentCase, drive};
use serde::Deserialize;

use crate::input::{InputError, read_file};
use crate::ronfile::RonFile;

/// A case file: a law, or a bond between two faces, and what the point goes through.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PointFile {
    #[serde(default)]
    title: String,
    #[serde(default)]
    law: Option<LawCase>,
    #[serde(default)]
    bond: Option<BondCase>,
    program: Vec<SegmentCase>,
}

impl PointFile {
    /// Drives the point; an error names its field.
    fn run(self) -> Result<PointRun, (String, Box<dyn Error>)> {
        let program = self.program;
        let (field, run) = match (self.law, self.bond) {
            (Some(law), None) => {
                let title = self.title;
                let case = PointCase {
                    title,
                    law,
                    program,
                };
                ("law", case.run())
            }
            (None, Some(bond)) => {
                let law = bond.build().map_err(CaseError::from);
                let ctx = PointContext::new(0.0);
                (
                    "bond",
                    law.and_then(|law| drive(law.as_ref(), ctx, &program)),
                )
            }
            (law, _) => {
                let given = if law.is_some() { "both" } else { "none" };
                let what = format!("{given} of `law` and `bond` are given; give one of them");
                return Err((String::new(), what.into()));
            }
        };
        run.map_err(|error| (place(&error, field), error.into()))
    }
}

/// Reads a case file and drives its point.
///
/// # Errors
///
/// [`InputError`] if the file cannot be read or the case is not valid; a program that cannot be finished
/// is told by [`PointRun::result`].
pub fn run(path: &Path) -> Result<PointRun, InputError> {
    let file = RonFile::new(&path.display().to_string(), &read_file(path)?);
    let case: PointFile = file.parse()?;
    let refused = |field: String, error: &dyn Error| {
        InputError::from(file.error(&field, error.to_string(), None))
    };
    let run = case.run();
    let run = run.map_err(|(field, error)| refused(field, error.as_ref()))?;
    match run.result {
        Err(
            ref error @ (PointError::Steps { segment, .. } | PointError::NotFinite { segment, .. }),
        ) => Err(refused(program(segment), error)),
        _ => Ok(run),
    }
}

/// The field that an error is about, `law` if it is the law.
fn place(error: &CaseError, law: &str) -> String {
    match error {
        CaseError::Component { segment, field, .. } => format!("{}.{field}", program(*segment)),
        CaseError::Overdetermined { segment, .. } => program(*segment),
        CaseError::NoSegments => "program".into(),
        _ => law.into(),
    }
}

/// Field of a segment, counted from 1.
fn program(segment: usize) -> String {
    format!("program[{}]", segment.saturating_sub(1))
}
