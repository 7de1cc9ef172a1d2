//! Why a run ends, and what is said of it.

use fe_solver::error::SolverError;

use crate::analysis::{AnalysisError, Outcome};
use crate::exit::Exit;
use crate::results::folder::Folder;
use crate::results::interrupt::Interrupt;

/// The end of a run.
#[derive(Debug)]
pub(super) struct End {
    pub reason: String,
    pub exit: Exit,
}

impl End {
    /// Why the path ended, and what that means for the exit code.
    pub(super) fn of(outcome: &Outcome, interrupt: &Interrupt) -> Self {
        let (reason, exit) = match &outcome.stop {
            Ok(reason) => (reason.clone(), Exit::Done),
            Err(_) if interrupt.is_set() => return Self::by_user("stopped by the user"),
            Err(error @ AnalysisError::Solver(SolverError::Output(_))) => {
                (error.to_string(), Exit::File)
            }
            Err(error) => (error.to_string(), Exit::StoppedEarly),
        };
        Self { reason, exit }
    }

    /// Stopped by the user.
    pub(super) fn by_user(reason: &str) -> Self {
        Self {
            reason: reason.into(),
            exit: Exit::Interrupted,
        }
    }

    /// Whether there is nothing left to go on with: only a run that was stopped from outside can.
    pub(super) const fn is_final(&self) -> bool {
        matches!(self.exit, Exit::Done | Exit::StoppedEarly)
    }

    /// What is said of a run that does not reach its end.
    pub(super) fn told(&self, folder: &Folder) -> String {
        let (stopped, remedy) = match self.exit {
            Exit::Interrupted => ("", "; --resume goes on from there"),
            Exit::File => (
                "stopped: ",
                "; make room there, and --resume goes on from there",
            ),
            _ => ("stopped: ", ""),
        };
        let (reason, path) = (&self.reason, folder.path().display());
        format!("{stopped}{reason}; the results up to the last accepted step are in {path}{remedy}")
    }
}
