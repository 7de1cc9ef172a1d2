//! Step control: adaptive length, shortening on failure, acceptance, recording.
//!
//! A step that ends in equilibrium but [creates energy](Change::creates_energy) is refused like one without convergence.

mod accept;
mod march;
#[cfg(test)]
mod tests;

use fe_core::energy::Change;

use crate::critical::Signs;
use crate::driver::{Attempt, Driver, Request};
use crate::error::SolverError;
use crate::journal::Entry;
use crate::recorder::{IterationRecord, Recorder};
use crate::stage::Stage;

use march::{Heard, March};

/// What to do when even the shortest step does not meet the criterion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OnFailure {
    /// Stop with [`SolverError::NoConvergence`].
    Stop,
    /// Accept the best iterate, unless it has diverged, or one that creates energy, and flag the step; stop with [`SolverError::NoConvergence`] after
    /// [`MAX_FLAGGED`] such steps in a row.
    Flag,
}

/// Steps in a row that may miss the criterion; a path that loses equilibrium for longer is not followed.
pub const MAX_FLAGGED: usize = 10;

/// Relative residual beyond which an iterate is no state of the model at all, and no step is made of it: in a collapse, where
/// reactions vanish, it may come to some hundreds.
const UNBALANCED: f64 = 1e3;

/// Share of the end below which no step is allowed: their sum is near rounding, and as many would be no run.
const LEAST_SHARE: f64 = 1e-13;

/// Settings of the step control; lengths in units of the load factor, or of what the path constraint of the driver measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepControl {
    /// First step.
    pub initial: f64,
    /// Longest step at the start.
    pub longest: f64,
    /// Share of the load factor reached that a step may take where this is more than `longest`; 0 keeps
    /// `longest` throughout.
    pub longest_share: f64,
    /// Shortest step, 1e-13 of the end at least.
    pub shortest: f64,
    /// Load factor to be added by this run; under a path constraint the length of its path.
    pub end: f64,
    /// Relative residual a step must meet.
    pub criterion: f64,
    /// Iterations a step should take: the next one is longer or shorter by the square root of their ratio to those taken
    /// (Ramm 1981), within the two bounds that follow.
    pub desired: usize,
    /// Largest growth from one step to the next.
    pub growth: f64,
    /// Smallest, at most 1, where no step has to be shorter than one that succeeded; after a snap, 1 in any case.
    pub shrinkage: f64,
    /// Share of a step that failed at which it is tried again.
    pub cut: f64,
    /// What to do when the shortest step fails.
    pub on_failure: OnFailure,
    /// Steps from one count of negative pivots to the next while there are some and no snap is passed; 1 counts at every
    /// step. A stable path is looked at after every step.
    pub count_every: usize,
}

/// One attempt at a step.
#[derive(Debug, Clone, Copy)]
struct Plan {
    step: usize,
    attempt: usize,
    length: f64,
    last_resort: bool,
}

impl StepControl {
    /// From 0 to `end` in steps of `initial`, which may shorten to 1/64.
    pub const fn new(initial: f64, end: f64) -> Self {
        Self {
            initial,
            longest: initial,
            longest_share: 0.0,
            shortest: initial / 64.0,
            end,
            criterion: 1e-3,
            desired: 8,
            growth: 1.3,
            shrinkage: 1.0,
            cut: 0.5,
            on_failure: OnFailure::Stop,
            count_every: 1,
        }
    }

    fn check(&self) -> Result<(), SolverError> {
        let fits = self.cut > 0.0 && self.cut < 1.0;
        SolverError::setting(("cut of a failed step", self.cut), "(0, 1)", fits)?;
        let share = self.longest_share;
        let fits = share.is_finite() && share >= 0.0;
        SolverError::setting(
            ("longest step over the load factor", share),
            "[0, inf)",
            fits,
        )?;
        for (what, value) in [
            ("first step", self.initial),
            ("longest step", self.longest),
            ("shortest step", self.shortest),
            ("end", self.end),
            ("criterion", self.criterion),
            ("growth of a step", self.growth),
            ("shrinkage of a step", self.shrinkage),
        ] {
            SolverError::positive(what, value)?;
        }
        let fits = self.shortest <= self.longest.min(self.initial);
        SolverError::setting(
            ("shortest step", self.shortest),
            "(0, first and longest step]",
            fits,
        )?;
        SolverError::setting(
            ("shortest step over the end", self.shortest / self.end),
            "[1e-13, inf)",
            self.shortest >= LEAST_SHARE * self.end,
        )
    }

    /// Runs a stage to its end, or until the recorder stops it. Returns the reason.
    ///
    /// # Errors
    ///
    /// [`SolverError`]; everything accepted before has been recorded, and the stage is left at the last accepted state.
    pub fn run(
        &self,
        stage: &mut Stage<'_>,
        driver: &mut dyn Driver,
        recorder: &mut dyn Recorder,
    ) -> Result<String, SolverError> {
        self.check()?;
        driver.begin();
        let end = self.march(stage, driver, recorder);
        if end.is_err() {
            stage.roll_back();
            stage.forget_tangent();
        }
        end
    }

    /// The steps of a run; an error leaves the stage where it arose.
    fn march(
        &self,
        stage: &mut Stage<'_>,
        driver: &mut dyn Driver,
        recorder: &mut dyn Recorder,
    ) -> Result<String, SolverError> {
        let mut march = March::new(self);
        while let Some(length) = march.next(self) {
            let done = if let Some(entry) = recorder.recall()? {
                march.length = entry.length;
                driver.recall(&entry.memory);
                self.replay(stage, recorder, march.step, entry)?
            } else {
                let found = self.find(stage, driver, recorder, (&mut march, length))?;
                let Some((attempt, signs)) = found else {
                    stage.roll_back();
                    stage.counters_mut().cutbacks += 1;
                    march.length = (self.cut * length).max(self.shortest);
                    continue;
                };
                driver.accepted();
                let heard = std::mem::take(&mut march.heard);
                let entry = Entry {
                    length: march.length,
                    taken: length,
                    attempts: march.attempts,
                    attempt,
                    base: stage.state().base_changes(),
                    counters: *stage.counters(),
                    check: None,
                    iterations: heard.iterations,
                    memory: driver.memory(),
                    notes: heard.notes,
                };
                Self::accept(stage, recorder, march.step, (entry, signs))?
            };
            if let Some(reason) = march.pass(self, done)? {
                return Ok(reason);
            }
        }
        Ok(format!("reached the end of the stage at {}", self.end))
    }

    /// Attempts a step of this length; none where it is to be given up for a shorter one.
    fn find(
        &self,
        stage: &mut Stage<'_>,
        driver: &mut dyn Driver,
        recorder: &mut dyn Recorder,
        (march, length): (&mut March, f64),
    ) -> Result<Option<(Attempt, Option<Signs>)>, SolverError> {
        march.attempts += 1;
        let can_shorten = 0.5 * length >= self.shortest;
        let may_flag =
            !can_shorten && self.on_failure == OnFailure::Flag && march.flagged < MAX_FLAGGED;
        let plan = Plan {
            step: march.step,
            attempt: march.attempts,
            length,
            last_resort: !can_shorten,
        };
        let shorter = |error: SolverError, stage: &Stage<'_>| {
            if can_shorten && Self::may_recover(&error, stage) {
                Ok(None)
            } else {
                Err(error)
            }
        };
        let mut attempt = match self.attempt(stage, driver, (recorder, &mut march.heard), plan) {
            Ok(attempt) if attempt.converged || may_flag && is_a_state(stage, &attempt) => attempt,
            Ok(_) if can_shorten => return Ok(None),
            Ok(attempt) => {
                return Err(SolverError::NoConvergence {
                    lambda: stage.lambda(),
                    step: length,
                    residual: attempt.residual.relative,
                    tolerance: self.criterion,
                    iterations: attempt.iterations,
                    worst: stage.describe(attempt.residual.worst),
                });
            }
            Err(error) => return shorter(error, stage),
        };
        let (signs, change) = match self.measure(stage, &attempt) {
            Ok(measured) => measured,
            Err(error) => return shorter(error, stage),
        };
        if driver.balances() && change.creates_energy() {
            if can_shorten {
                recorder.note(march.step, &creation(&change))?;
                march.heard.notes.push(creation(&change));
                stage.forget_tangent();
                return Ok(None);
            }
            if !may_flag {
                return Err(SolverError::CreatesEnergy {
                    lambda: stage.lambda(),
                    step: length,
                    dissipated: change.dissipated(),
                    work: change.work,
                });
            }
            attempt.converged = false;
        }
        Ok(Some((attempt, signs)))
    }

    /// Whether a shorter step may help. A model whose stiffness is singular before the first step never was held.
    fn may_recover(error: &SolverError, stage: &Stage<'_>) -> bool {
        let never_held =
            matches!(error, SolverError::Singular { .. }) && stage.counters().steps == 0;
        error.is_recoverable() && !never_held
    }

    fn attempt(
        &self,
        stage: &mut Stage<'_>,
        driver: &mut dyn Driver,
        (recorder, heard): (&mut dyn Recorder, &mut Heard),
        plan: Plan,
    ) -> Result<Attempt, SolverError> {
        let mut iteration = 0;
        let lambda = stage.lambda() + plan.length;
        let result = driver.attempt(
            stage,
            Request {
                length: plan.length,
                criterion: self.criterion,
                last_resort: plan.last_resort,
            },
            &mut |residual, line_search| {
                let record = IterationRecord {
                    step: plan.step,
                    attempt: plan.attempt,
                    iteration,
                    lambda,
                    residual: residual.relative,
                    criterion: self.criterion,
                    line_search,
                };
                recorder.iteration(&record)?;
                heard.iterations.push(record);
                iteration += 1;
                Ok(())
            },
        );
        stage.counters_mut().iterations += iteration;
        for note in driver.notes() {
            recorder.note(plan.step, &note)?;
            heard.notes.push(note);
        }
        let attempt = result?;
        attempt.check(stage)?;
        Ok(attempt)
    }
}

/// Whether an attempt that misses the criterion ends in a state of the model, and has not diverged: what breaks off may go
/// far, but not by more than the size of the model, if it has one, in which displacements are small.
fn is_a_state(stage: &Stage<'_>, attempt: &Attempt) -> bool {
    let mut ways = attempt.displacement.iter().zip(stage.displacement());
    let extent = stage.model().mesh().extent();
    attempt.lambda.is_finite()
        && attempt.residual.relative <= UNBALANCED
        && (extent == 0.0 || ways.all(|(to, from)| (to - from).abs() <= extent))
}

/// What is said of a step that creates energy.
fn creation(change: &Change) -> String {
    format!(
        "the step is repeated shorter: it would dissipate {:.3e} N mm while {:.3e} N mm of work are done",
        change.dissipated(),
        change.work
    )
}
