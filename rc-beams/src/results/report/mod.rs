//! `rc-beams report`: the stored results of all beams of a folder, side by side.
//!
//! Reads `summary.json`, `history.csv`, `events.csv`, `sheets.csv` and `sheet_map.csv` of every folder in
//! the given one that holds one of the first two; solves nothing. Writes `report.md`, `report.csv` and one picture of
//! curves per group of beams, `report-GROUP.svg`; beams whose names differ by the last number are a group.
//! Pictures of sheets that are missing are drawn anew from `sheet_map.csv`.
//!
//! A beam without a readable summary is left out; of the others all that can be read is used. What is
//! wrong is told once per beam.

mod figures;
mod markdown;
mod stored;
mod table;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};
use std::{fs, io};

use self::stored::Stored;
use super::error::ResultsError;
use super::folder::Folder;

/// Why there is no report.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[non_exhaustive]
pub enum ReportError {
    /// The folder cannot be read.
    #[error("cannot read the folder {}", path.display())]
    #[diagnostic(
        code(rc_beams::report),
        help("give the folder of the results of `rc-beams run`")
    )]
    Folder {
        /// The folder.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// No beam has results there.
    #[error("there are no results in {}", path.display())]
    #[diagnostic(
        code(rc_beams::report),
        help(
            "give the folder in which those of the beams lie, or run beams first, for instance `rc-beams run all \
             --output {}`",
            path.display()
        )
    )]
    Nothing {
        /// The folder.
        path: PathBuf,
    },
    /// The folder is that of one beam.
    #[error("{} holds the results of one beam", path.display())]
    #[diagnostic(
        code(rc_beams::report),
        help("give the folder in which it lies: `rc-beams report {}`", above(path).display())
    )]
    OneBeam {
        /// The folder.
        path: PathBuf,
    },
    /// The report cannot be written.
    #[error("cannot write {}", path.display())]
    #[diagnostic(
        code(rc_beams::report),
        help("the report goes into the folder of the results; make it writable")
    )]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A picture cannot be drawn.
    #[error(transparent)]
    Picture(ResultsError),
}

impl From<ResultsError> for ReportError {
    fn from(error: ResultsError) -> Self {
        match error {
            ResultsError::Output(e) => Self::Write {
                path: e.path,
                source: e.source,
            },
            other => Self::Picture(other),
        }
    }
}

/// What was reported.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// `report.md`.
    pub path: PathBuf,
    /// Beams in the tables.
    pub beams: usize,
    /// Accuracy; none without a beam that was tested.
    pub accuracy: Option<Accuracy>,
    /// What is wrong with the stored results, one line per beam concerned.
    pub problems: Vec<String>,
}

/// How the peaks compare with the tests.
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// Beams with a test.
    pub beams: usize,
    /// Mean of |peak over test - 1|.
    pub mean_error: f64,
    /// Largest of them.
    pub worst_error: f64,
    /// Its beam.
    pub worst_beam: String,
}

impl Accuracy {
    fn of(beams: &[Stored]) -> Option<Self> {
        let errors: Vec<(f64, &str)> = beams
            .iter()
            .filter_map(|b| Some(((b.summary.ratio()? - 1.0).abs(), b.name.as_str())))
            .collect();
        let worst = errors.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Self {
            beams: errors.len(),
            mean_error: errors.iter().map(|e| e.0).sum::<f64>() / errors.len() as f64,
            worst_error: worst.0,
            worst_beam: worst.1.to_owned(),
        })
    }
}

impl std::fmt::Display for Accuracy {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "mean |error| {:.1} % over {} with a test, largest {:.1} % ({})",
            100.0 * self.mean_error,
            counted(self.beams),
            100.0 * self.worst_error,
            self.worst_beam
        )
    }
}

impl Report {
    /// The report in one line.
    pub fn line(&self) -> String {
        let accuracy = self.accuracy.as_ref().map_or_else(
            || "none with a peak and a test".to_owned(),
            Accuracy::to_string,
        );
        let (path, beams) = (self.path.display(), counted(self.beams));
        format!("{path}: {beams}, {accuracy}")
    }
}

/// A number of beams, in words.
fn counted(beams: usize) -> String {
    format!("{beams} beam{}", if beams == 1 { "" } else { "s" })
}

/// Writes the report on the results in `root`.
///
/// # Errors
///
/// [`ReportError`]; damaged results are no error but told by [`Report::problems`].
pub fn write(root: &Path) -> Result<Report, ReportError> {
    let mut beams = Vec::new();
    let mut problems = Vec::new();
    let folders = stored::folders(root).map_err(|source| ReportError::Folder {
        path: root.into(),
        source,
    })?;
    if folders.is_empty() {
        let path = root.into();
        return Err(if stored::holds_results(root) {
            ReportError::OneBeam { path }
        } else {
            ReportError::Nothing { path }
        });
    }
    for path in folders {
        let (beam, wrong) = stored::read(&path);
        if !wrong.is_empty() {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            problems.push(format!("{name}: {}", wrong.join("; ")));
        }
        beams.extend(beam);
    }
    let folder = Folder::open(root)?;
    let groups = figures::groups(&folder, &beams)?;
    for beam in &beams {
        figures::sheets(&root.join(&beam.name), beam)?;
    }
    let report = Report {
        path: root.join("report.md"),
        beams: beams.len(),
        accuracy: Accuracy::of(&beams),
        problems,
    };
    let text = markdown::report(&beams, &groups, &report);
    folder.replace("report.md", |out| out.write_all(text.as_bytes()))?;
    folder.replace("report.csv", |out| table::write(out, &beams))?;
    Ok(report)
}

/// The folder that a folder lies in.
fn above(folder: &Path) -> PathBuf {
    match (folder.file_name(), folder.parent()) {
        (Some(_), Some(parent)) if parent.as_os_str().is_empty() => ".".into(),
        (Some(_), Some(parent)) => parent.into(),
        _ => folder.join(".."),
    }
}

/// Whether a file is there.
fn exists(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|m| m.is_file())
}
