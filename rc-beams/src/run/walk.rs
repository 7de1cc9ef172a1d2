//! From the model to the end of its load path.

use super::case::Case;
use super::caveats::read_elsewhere;
use super::end::End;
use super::recording::Recording;
use super::{RunError, evidence, pull_out};
use crate::analysis::{AnalysisError, Outcome};
use crate::build::Beam;
use crate::results::checkpoint::{Checkpoint, CheckpointError};
use crate::results::evidence::Layout;
use crate::results::folder::Folder;
use crate::results::summary::BondError;

use fe_solver::error::SolverError;

/// A load path that has been followed.
pub(super) struct Walk<'a> {
    pub outcome: Outcome,
    pub recording: Recording<'a>,
    pub layout: Layout,
    /// What the size of the elements costs in bond.
    pub bond_error: Option<BondError>,
    /// Name of the driver.
    pub driver: &'static str,
}

/// Follows the load path of a beam and records it; none, and the user is told, where an interruption left nothing of its own.
pub(super) fn walk<'a>(
    case: &Case<'a>,
    beam: &'a Beam,
    (folder, checkpoint): (&Folder, Checkpoint),
) -> Result<Option<Walk<'a>>, RunError> {
    let specimen = case.specimen;
    let bond_error = match &beam.sheets {
        Some(sheets) => pull_out::error(&beam.model, sheets)?,
        None => None,
    };
    let mut driver = case.driver()?;
    let layout = evidence::layout(specimen, beam);
    let mut recording = Recording::start(
        (case.board, &specimen.name),
        (beam, &layout),
        (folder, checkpoint),
        case.options.fields,
        (case.stepping.until_mm, case.stepping.criterion),
        case.interrupt,
    )?;
    if let Some(error) = &bond_error {
        recording.note(&error.to_string());
    }
    if let Some(text) = read_elsewhere(specimen, beam.measures.deflection_at) {
        recording.note(&text);
    }
    let done = case.follow(beam, driver.as_mut(), &mut recording);
    let outcome = followed(case, done, recording.is_resuming(), folder)?;
    Ok(outcome.map(|outcome| Walk {
        outcome,
        recording,
        layout,
        bond_error,
        driver: driver.name(),
    }))
}

/// What was followed; none where the user stopped it before it had anything of its own.
fn followed(
    case: &Case<'_>,
    done: Result<Outcome, AnalysisError>,
    resuming: bool,
    folder: &Folder,
) -> Result<Option<Outcome>, RunError> {
    let failure = match &done {
        Ok(outcome) => outcome.stop.as_ref().err(),
        Err(error) => Some(error),
    };
    let interrupted = case.interrupt.is_set();
    // Steps of the earlier run that could not be accepted again.
    let unfinished = resuming && failure.is_some();
    if let Some(error) = failure.filter(|_| unfinished && !interrupted) {
        let reason = match error {
            AnalysisError::Solver(SolverError::Output(table)) => table.to_string(),
            other => other.to_string(),
        };
        return Err(CheckpointError::of(folder, reason).into());
    }
    match done {
        _ if interrupted && (unfinished || done.is_err()) => {
            case.tell(&End::by_user("stopped by the user").told(folder));
            Ok(None)
        }
        Ok(outcome) => Ok(Some(outcome)),
        Err(error) => {
            // Nothing to go on with.
            Checkpoint::remove(folder)?;
            Err(case.failure(error))
        }
    }
}
