//! What an analysis tells the outside while it runs.

use serde::{Deserialize, Serialize};

use crate::critical::Critical;
use crate::journal::Entry;
use crate::stage::Stage;

/// One iteration.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct IterationRecord {
    /// Step under way, counted from 1.
    pub step: usize,
    /// Attempt at this step, counted from 1.
    pub attempt: usize,
    /// Iteration within the attempt, counted from 0 (the predictor).
    pub iteration: usize,
    /// Load factor aimed at: the accepted one and the length of the step, whatever a path constraint measures it by.
    pub lambda: f64,
    /// Relative residual.
    pub residual: f64,
    /// Criterion it is held against.
    pub criterion: f64,
    /// Factor of the line search, 1 without one.
    pub line_search: f64,
}

/// One accepted step.
#[derive(Debug)]
pub struct StepView<'a> {
    /// The stage, with its accepted displacement and state.
    pub stage: &'a Stage<'a>,
    /// Step, counted from 1.
    pub step: usize,
    /// Load factor reached.
    pub lambda: f64,
    /// Length of the step in the load factor.
    pub increment: f64,
    /// Attempts it took.
    pub attempts: usize,
    /// Iterations of the successful attempt, as [`Recorder::iteration`] was told of them: that of the predictor included, none
    /// where the path is a motion.
    pub iterations: usize,
    /// Relative residual of the accepted state with the true, inviscid law.
    pub residual: f64,
    /// Whether the step passed a snap at a held load factor.
    pub held: bool,
    /// Load conjugate to the load factor where it moves prescribed displacements; 0 where forces alone grow.
    pub load: f64,
    /// Work-conjugate load of the step; of meaning as [`Self::load`] is.
    pub work_conjugate_load: f64,
    /// Whether the step was accepted without meeting the criterion.
    pub flagged: bool,
    /// Largest kinetic energy of the step over the work so far, for drivers that follow a motion.
    pub kinetic: Option<f64>,
    /// Viscous work over the work so far, for drivers whose laws lag behind.
    pub viscous: Option<f64>,
    /// Negative pivots of the symmetric part of the consistent tangent: 0 in a stable equilibrium; none where they were not
    /// counted, see [`StepControl::count_every`](crate::control::StepControl::count_every).
    pub negative_pivots: Option<usize>,
    /// What the path has passed since they were counted last.
    pub critical: Option<Critical>,
}

/// Whether to go on.
#[derive(Debug, Clone, PartialEq)]
pub enum Continue {
    /// Go on.
    Yes,
    /// Go on with a step no longer than this, in the unit of [`StepControl::initial`](crate::control::StepControl::initial), but for
    /// the shortest: to end at a load, for instance.
    AtMost(f64),
    /// Stop after this step, for the stated reason.
    Stop(String),
}

impl Continue {
    /// The longest step to go on with, or why to stop.
    pub(crate) fn longest_step(self) -> Result<f64, String> {
        match self {
            Self::Yes => Ok(f64::INFINITY),
            Self::AtMost(limit) => Ok(limit),
            Self::Stop(reason) => Err(reason),
        }
    }
}

/// Receives iterations and accepted steps.
pub trait Recorder {
    /// One iteration was evaluated.
    ///
    /// # Errors
    ///
    /// An output error ends the analysis.
    fn iteration(&mut self, _record: &IterationRecord) -> std::io::Result<()> {
        Ok(())
    }

    /// The driver has decided something about a step, which is given with the reason.
    ///
    /// # Errors
    ///
    /// An output error ends the analysis.
    fn note(&mut self, _step: usize, _text: &str) -> std::io::Result<()> {
        Ok(())
    }

    /// The next step of an earlier run, to be accepted again without solving it; none where that run ended, or without
    /// one.
    ///
    /// # Errors
    ///
    /// An error ends the analysis.
    fn recall(&mut self) -> std::io::Result<Option<Entry>> {
        Ok(None)
    }

    /// A step is about to be accepted for the first time; with this it can be [recalled](Self::recall).
    ///
    /// # Errors
    ///
    /// An output error ends the analysis.
    fn keep(&mut self, _entry: &Entry) -> std::io::Result<()> {
        Ok(())
    }

    /// One step was accepted.
    ///
    /// # Errors
    ///
    /// An output error ends the analysis.
    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue>;
}

/// Takes no notice of anything.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Silent;

impl Recorder for Silent {
    fn step(&mut self, _view: &StepView<'_>) -> std::io::Result<Continue> {
        Ok(Continue::Yes)
    }
}
