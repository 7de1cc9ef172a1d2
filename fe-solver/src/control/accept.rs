//! What is measured of a step, and how it is accepted, for the first time or again.

use fe_core::energy::Change;

use super::StepControl;
use crate::critical::Signs;
use crate::driver::Attempt;
use crate::error::SolverError;
use crate::journal::Entry;
use crate::recorder::{Continue, Recorder, StepView};
use crate::stage::Stage;

/// An accepted step, as far as the next one depends on it.
pub(super) struct Done {
    pub(super) verdict: Continue,
    pub(super) taken: f64,
    pub(super) converged: bool,
    /// Whether a snap was passed.
    pub(super) held: bool,
    /// None where the path is a motion, whose steps need none.
    pub(super) iterations: Option<usize>,
}

impl Done {
    /// Steps in a row that missed the criterion, this one included.
    pub(super) const fn flagged(&self, before: usize) -> usize {
        if self.converged { 0 } else { before + 1 }
    }
}

impl StepControl {
    /// Signs of the tangent where an attempt ends, if they are due, and the energies of the step.
    pub(super) fn measure(
        &self,
        stage: &mut Stage<'_>,
        attempt: &Attempt,
    ) -> Result<(Option<Signs>, Change), SolverError> {
        let (u, lambda) = (&attempt.displacement, attempt.lambda);
        let relaxation = attempt.lag.map_or(1.0, |lag| lag.relaxation);
        let known = stage.signs().negative > 0 && !attempt.held;
        let signs = if known && stage.uncounted() + 1 < self.count_every {
            stage.settle(u, lambda, relaxation)?;
            None
        } else {
            Some(stage.stability(u, lambda, relaxation)?)
        };
        // The factor may be that of the state that was not weighed.
        let change = stage.weigh(u, lambda);
        Ok((signs, change.inspect_err(|_| stage.forget_tangent())?))
    }

    /// Commits a measured state and records it; keeps it, unless it is recalled and leads where it led.
    pub(super) fn accept(
        stage: &mut Stage<'_>,
        recorder: &mut dyn Recorder,
        step: usize,
        (mut entry, signs): (Entry, Option<Signs>),
    ) -> Result<Done, SolverError> {
        let lambda = entry.attempt.lambda;
        let critical = signs.and_then(|signs| stage.signs().until(signs));
        if let Some(means) = &entry.attempt.means {
            stage.read_off(&means.internal)?;
        }
        let load = stage.load();
        // Where forces alone grow the load is none.
        let check = [load, stage.unbalance()];
        match entry.check {
            None => {
                entry.check = Some(check);
                recorder.keep(&entry)?;
            }
            Some(was) => {
                let pairs = ["load", "residual"]
                    .into_iter()
                    .zip(check.into_iter().zip(was));
                let differs = |(_, (now, was)): &(_, (f64, f64))| now.to_bits() != was.to_bits();
                if let Some((what, (now, was))) = pairs.into_iter().find(differs) {
                    return Err(SolverError::Journal {
                        step,
                        what: format!("{what} {now} for {was}"),
                    });
                }
            }
        }
        let Entry {
            taken,
            attempts,
            attempt,
            iterations: heard,
            ..
        } = entry;
        let of_this_attempt = heard.iter().filter(|record| record.attempt == attempts);
        let increment = lambda - stage.lambda();
        let work_conjugate_load = stage.work_conjugate_load(&attempt.displacement, lambda);
        stage.commit(attempt.displacement, lambda, attempt.held, signs)?;
        let view = StepView {
            step,
            lambda,
            increment,
            attempts,
            iterations: of_this_attempt.count(),
            residual: attempt.residual.relative,
            held: attempt.held,
            load,
            work_conjugate_load,
            flagged: !attempt.converged,
            negative_pivots: signs.map(|signs| signs.negative),
            critical,
            kinetic: attempt.means.as_ref().map(|m| m.kinetic),
            viscous: attempt.lag.map(|lag| lag.viscous),
            stage,
        };
        Ok(Done {
            verdict: recorder.step(&view)?,
            taken,
            converged: attempt.converged,
            held: attempt.held,
            iterations: attempt.means.is_none().then_some(attempt.iterations),
        })
    }

    /// Accepts a step of an earlier run again.
    pub(super) fn replay(
        &self,
        stage: &mut Stage<'_>,
        recorder: &mut dyn Recorder,
        step: usize,
        entry: Entry,
    ) -> Result<Done, SolverError> {
        let same = entry.attempt.displacement.len() == stage.displacement().len();
        if !(same && stage.set_base(&entry.base)) {
            return Err(SolverError::Journal {
                step,
                what: "number of unknowns".into(),
            });
        }
        if !(entry.length > 0.0 && entry.taken > 0.0) {
            return Err(SolverError::Journal {
                step,
                what: format!("length {} for {} aimed at", entry.taken, entry.length),
            });
        }
        for record in &entry.iterations {
            recorder.iteration(record)?;
        }
        for note in &entry.notes {
            recorder.note(step, note)?;
        }
        let (signs, _) = self.measure(stage, &entry.attempt)?;
        *stage.counters_mut() = entry.counters;
        Self::accept(stage, recorder, step, (entry, signs))
    }
}
