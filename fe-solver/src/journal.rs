//! Accepted steps as a journal from which a run can be continued.
//!
//! What a step leaves behind (history variables, reactions, tangent and its factor) follows from the displacement it
//! accepts and from the history variables its last evaluation started from. An [`Entry`] holds these, what the
//! step control goes on with, and what recorders were told. Entries accepted again in order, without iterations,
//! bring a stage to the same state to the last bit; only then does the driver take over.
//!
//! The format in which entries are kept must give back every bit of a number, and infinity, which a residual may be: postcard
//! does, JSON does not (infinity becomes null, which is no number when it is read).
//!
//! Drivers keep nothing of their own from step to step, or give it as their [memory](crate::driver::Driver::memory).
//! [`Automatic`](crate::automatic::Automatic) gives it under imposed displacements; under forces it goes on from control
//! begun anew, and the path may be another one. Where the negative pivots are not counted after every step, a driver with a
//! symmetric tangent may find another factor at hand than in the run itself: the path then is the same to the criterion, not
//! to the last bit.

use serde::{Deserialize, Serialize};

use crate::driver::Attempt;
use crate::recorder::IterationRecord;
use crate::stage::Counters;

/// One accepted step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Length that the step control aimed at, in units of the load factor.
    pub length: f64,
    /// Length of the step.
    pub taken: f64,
    /// Attempts, the successful one included.
    pub attempts: usize,
    /// The successful one.
    pub attempt: Attempt,
    /// History variables of the last evaluation where they differ from those of the step before.
    pub base: Vec<(u32, f64)>,
    /// Work done before the step was accepted.
    pub counters: Counters,
    /// Load and relative residual of the accepted state, as a check; none before it is accepted.
    pub check: Option<[f64; 2]>,
    /// Iterations of all attempts.
    pub iterations: Vec<IterationRecord>,
    /// What the driver keeps beside the state of the stage.
    pub memory: Vec<f64>,
    /// What the driver said, attempt by attempt.
    pub notes: Vec<String>,
}
