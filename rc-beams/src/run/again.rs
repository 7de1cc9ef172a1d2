//! The same beam once more, modelled or stepped otherwise: what the peak would be with perfect bond, with
//! steps half as long, or with a finer mesh.

use std::io;

use fe_solver::capacity::Capacity;
use fe_solver::recorder::IterationRecord;

use super::plan::driver;
use super::{RunError, build};
use crate::analysis::{Observer, Staging, Stepping, analyse};
use crate::build::ModelSettings;
use crate::options::RunOptions;
use crate::results::interrupt::Interrupt;
use crate::results::numerical_error::{NumericalError, REFINEMENT};
use crate::spec::Specimen;

/// Watches for interruptions only.
struct Silent<'a>(&'a Interrupt);

impl Observer for Silent<'_> {
    fn weighing(&mut self) -> io::Result<()> {
        self.0.check()
    }

    fn iteration(&mut self, _: &IterationRecord) -> io::Result<()> {
        self.0.check()
    }
}

/// The largest load of a run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Peak {
    /// Load (kN).
    pub kn: f64,
    /// Whether it is a peak; otherwise the path ended before, and it is a lower bound.
    pub reached: bool,
}

/// How far the peak (kN) moves with half the steps, and with half as many elements again along and up; none when the run was
/// interrupted or the path of a variation ended before its peak.
pub(super) fn numerical_error(
    peak_kn: f64,
    (specimen, settings, stepping): (&Specimen, &ModelSettings, &Stepping),
    options: &RunOptions,
    interrupt: &Interrupt,
) -> Result<Option<NumericalError>, RunError> {
    let halved = peak_of(specimen, settings, &stepping.halved(), options, interrupt)?;
    let finer = ModelSettings {
        mesh: settings.mesh.finer(REFINEMENT),
        ..*settings
    };
    let peak = peak_of(specimen, &finer, stepping, options, interrupt)?;
    let peaks = halved.zip(peak).filter(|(a, b)| a.reached && b.reached);
    Ok(peaks.map(|(halved, peak)| {
        NumericalError::new(peak_kn, halved.kn, (peak.kn, finer.mesh.to_string()))
    }))
}

/// Peak with the given settings and steps; none when the run was interrupted.
pub(super) fn peak_of(
    specimen: &Specimen,
    settings: &ModelSettings,
    stepping: &Stepping,
    options: &RunOptions,
    interrupt: &Interrupt,
) -> Result<Option<Peak>, RunError> {
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
    Ok(capacity.and_then(|c| {
        Some(Peak {
            kn: outcome.path.get(c.peak)?.load,
            reached: c.is_reached(),
        })
    }))
}
