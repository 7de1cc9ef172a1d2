//! The same beam once more, modelled or stepped otherwise: what the peak would be with perfect bond, with
//! steps half as long, or with a finer mesh.

use std::io;

use fe_solver::capacity::Capacity;
use fe_solver::recorder::IterationRecord;

use super::RunError;
use super::case::Case;
use crate::analysis::Observer;
use crate::build::ModelSettings;
use crate::options::Bond;
use crate::results::interrupt::Interrupt;
use crate::results::mode::strengthened::BOND_GOVERNS;
use crate::results::numerical_error::{NumericalError, REFINEMENT};

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
struct Peak {
    /// Load (kN).
    kn: f64,
    /// Whether it is a peak; otherwise the path ended before, and it is a lower bound.
    reached: bool,
}

/// How far the peak (kN) moves with half the steps, and with half as many elements again along and up; none when the run was
/// interrupted or the path of a variation ended before its peak.
pub(super) fn numerical_error(
    case: &Case<'_>,
    peak_kn: f64,
) -> Result<Option<NumericalError>, RunError> {
    let halved = peak_of(&Case {
        stepping: case.stepping.halved(),
        ..*case
    })?;
    let mesh = case.settings.mesh.finer(REFINEMENT);
    let finer = peak_of(&Case {
        settings: ModelSettings {
            mesh,
            ..case.settings
        },
        ..*case
    })?;
    let peaks = halved.zip(finer).filter(|(a, b)| a.reached && b.reached);
    Ok(peaks.map(|(halved, finer)| {
        NumericalError::new(peak_kn, halved.kn, (finer.kn, mesh.to_string()))
    }))
}

/// Peak with perfect bond over that of the beam (kN); none when the run was interrupted, or when its path ended before the
/// peak: a lower bound proves that bond governs, never that it does not.
pub(super) fn perfect_bond(case: &Case<'_>, peak_kn: f64) -> Result<Option<f64>, RunError> {
    let peak = peak_of(&Case {
        settings: ModelSettings {
            bond: Bond::Perfect,
            ..case.settings
        },
        ..*case
    })?;
    let ratio = peak.map(|peak| (peak.kn / peak_kn, peak.reached));
    let told = ratio.filter(|(ratio, reached)| *reached || *ratio >= BOND_GOVERNS);
    Ok(told.map(|(ratio, _)| ratio))
}

/// Peak of a case; none when the run was interrupted.
fn peak_of(case: &Case<'_>) -> Result<Option<Peak>, RunError> {
    let interrupt = case.interrupt;
    let mut driver = case.driver()?;
    let outcome = match case.follow(&case.beam()?, driver.as_mut(), &mut Silent(interrupt)) {
        Ok(outcome) => outcome,
        Err(_) if interrupt.is_set() => return Ok(None),
        Err(error) => return Err(case.failure(error)),
    };
    let capacity = Capacity::of(&outcome.path).filter(|_| !interrupt.is_set());
    Ok(capacity.and_then(|c| {
        Some(Peak {
            kn: outcome.path.get(c.peak)?.load,
            reached: c.is_reached(),
        })
    }))
}
