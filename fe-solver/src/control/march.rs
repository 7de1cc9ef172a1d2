//! How far a run has come, and how long its next step is.

use super::StepControl;
use super::accept::Done;
use crate::error::SolverError;
use crate::recorder::IterationRecord;

/// How far a run has come.
#[derive(Debug)]
pub(super) struct March {
    /// Length aimed at.
    pub length: f64,
    progress: f64,
    /// Number of the step under way, and attempts at it so far.
    pub step: usize,
    pub attempts: usize,
    /// Steps in a row that missed the criterion.
    pub flagged: usize,
    /// Longest step that the recorder allows.
    at_most: f64,
    pub heard: Heard,
}

/// What recorders have been told since the last accepted step.
#[derive(Debug, Default)]
pub(super) struct Heard {
    pub iterations: Vec<IterationRecord>,
    pub notes: Vec<String>,
}

impl March {
    pub(super) fn new(control: &StepControl) -> Self {
        Self {
            length: control.initial.min(control.longest),
            progress: 0.0,
            step: 1,
            attempts: 0,
            flagged: 0,
            at_most: f64::INFINITY,
            heard: Heard::default(),
        }
    }

    /// Length of the next attempt; none at the end of the run.
    pub(super) fn next(&self, control: &StepControl) -> Option<f64> {
        let remaining = control.end - self.progress;
        if remaining <= 1e-9 * control.end {
            return None;
        }
        // A last sliver shorter than half a step is merged into this one, unless that has failed.
        let fits = remaining < 1.5 * self.length && remaining <= self.longest(control);
        let next = if self.attempts == 0 && fits {
            remaining
        } else {
            self.length.min(remaining)
        };
        Some(next.min(self.at_most.max(control.shortest)))
    }

    /// Longest step that the settings allow here.
    fn longest(&self, control: &StepControl) -> f64 {
        control.longest.max(control.longest_share * self.progress)
    }

    /// Length aimed at after an accepted step.
    fn length_after(&self, done: &Done, control: &StepControl) -> f64 {
        let Some(iterations) = done.iterations else {
            return self.length;
        };
        let wanted = control.desired as f64 / iterations.max(1) as f64;
        let growth = if done.converged { control.growth } else { 1.0 };
        // A snap takes its iterations however short the step that meets it.
        let shrinkage = if done.held { 1.0 } else { control.shrinkage };
        let factor = wanted.sqrt().clamp(shrinkage.min(growth), growth);
        let next = done.taken * factor;
        // A step that another limit made short says nothing about the next one.
        let next = if factor > 1.0 {
            next.max(self.length)
        } else {
            next.min(self.length)
        };
        next.min(self.longest(control)).max(control.shortest)
    }

    /// Goes on behind an accepted step; the reason, where the recorder wants no other.
    pub(super) fn pass(
        &mut self,
        control: &StepControl,
        done: Done,
    ) -> Result<Option<String>, SolverError> {
        self.flagged = done.flagged(self.flagged);
        self.length = self.length_after(&done, control);
        self.progress += done.taken;
        self.step += 1;
        self.attempts = 0;
        match done.verdict.longest_step() {
            Ok(longest) if longest.is_nan() => Err(SolverError::NoNumber {
                what: "longest step that a recorder allows".into(),
                value: longest,
            }),
            Ok(longest) => {
                self.at_most = longest;
                Ok(None)
            }
            Err(reason) => Ok(Some(reason)),
        }
    }
}
