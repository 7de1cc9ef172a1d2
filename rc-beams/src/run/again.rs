//! The same beam once more, modelled or stepped otherwise: what the peak would be with perfect bond, or with steps half as long.

use std::io;

use fe_solver::capacity::Capacity;
use fe_solver::recorder::{Continue, IterationRecord, StepView};

use super::plan::driver;
use super::{RunError, build};
use crate::analysis::{Observer, Reading, Staging, Stepping, analyse};
use crate::build::{Beam, ModelSettings};
use crate::options::RunOptions;
use crate::results::interrupt::Interrupt;
use crate::spec::Specimen;

/// Watches for interruptions only.
struct Silent<'a>(&'a Interrupt);

impl Observer for Silent<'_> {
    fn weight(&mut self, _: &StepView<'_>, _: &Reading) -> io::Result<()> {
        self.0.check()
    }

    fn iteration(&mut self, _: &IterationRecord) -> io::Result<()> {
        self.0.check()
    }

    fn step(&mut self, _: &StepView<'_>, _: usize, _: &Reading) -> io::Result<Continue> {
        Ok(Continue::Yes)
    }

    fn bonded(&mut self, _: &Beam) -> io::Result<()> {
        Ok(())
    }
}

/// Peak load (kN) with the given settings and steps; none when the run was interrupted.
pub(super) fn peak_kn(
    specimen: &Specimen,
    settings: &ModelSettings,
    stepping: &Stepping,
    options: &RunOptions,
    interrupt: &Interrupt,
) -> Result<Option<f64>, RunError> {
    let beam = build(specimen, settings)?;
    let staging = specimen.staged.as_ref().map(|staged| Staging {
        specimen,
        settings,
        staged,
    });
    let mut driver = driver(specimen, options)?;
    let mut silent = Silent(interrupt);
    let done = analyse(
        &beam,
        staging.as_ref(),
        stepping,
        driver.as_mut(),
        &mut silent,
    );
    let outcome = match done {
        Ok(outcome) => outcome,
        Err(_) if interrupt.is_set() => return Ok(None),
        Err(error) => {
            return Err(RunError::Solver {
                specimen: specimen.name.clone(),
                reason: Box::new(error),
            });
        }
    };
    let capacity = Capacity::of(&outcome.path).filter(|_| !interrupt.is_set());
    Ok(capacity
        .and_then(|c| outcome.path.get(c.peak))
        .map(|p| p.load))
}
