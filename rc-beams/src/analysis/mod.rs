//! One beam from self weight to the end of its path.

mod march;
mod recorder;

use std::io;

use fe_core::state::StateStore;
use fe_solver::capacity::PathPoint;
use fe_solver::control::{OnFailure, StepControl};
use fe_solver::error::SolverError;
use fe_solver::journal::Entry;
use fe_solver::recorder::{Continue, IterationRecord, StepView};
use fe_solver::stage::{Counters, PhaseTimes, Stage};

pub use march::analyse;

use crate::build::{Beam, BuildError, ModelSettings};
use crate::spec::{Specimen, Staged};

/// How the load stage is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepping {
    /// First step (mm).
    pub initial_mm: f64,
    /// Share of the deflection reached that a step may take where this is longer than twice the first step.
    pub longest_share: f64,
    /// Imposed deflection at which the path ends at the latest (mm).
    pub until_mm: f64,
    /// Whether the path is followed to `until_mm` whatever happens to the load.
    pub to_the_end: bool,
    /// Relative residual a step must meet.
    pub criterion: f64,
}

/// Longest step over the first one.
const LONGEST: f64 = 2.0;
/// First step over the shortest one, from where on shorter ones place snaps no better.
const SHORTEST: f64 = 16.0;
/// Iterations a step should take.
const DESIRED: usize = 8;
/// Bounds of the change from one step to the next.
const GROWTH: f64 = 1.25;
const SHRINKAGE: f64 = 0.35;
/// Steps from one count of negative pivots to the next while there are some: each takes a factorisation.
const COUNT_EVERY: usize = 2;
/// Share of a failed step at which it is tried again.
const CUT: f64 = 0.25;

impl Stepping {
    /// The same path in steps half as long.
    #[must_use]
    pub fn halved(&self) -> Self {
        Self {
            initial_mm: 0.5 * self.initial_mm,
            longest_share: 0.5 * self.longest_share,
            ..*self
        }
    }

    fn control(&self) -> StepControl {
        StepControl {
            longest: (LONGEST * self.initial_mm).min(self.until_mm),
            longest_share: self.longest_share,
            shortest: (self.initial_mm / SHORTEST).min(self.until_mm),
            criterion: self.criterion,
            desired: DESIRED,
            growth: GROWTH,
            shrinkage: SHRINKAGE,
            cut: CUT,
            on_failure: OnFailure::Flag,
            count_every: COUNT_EVERY,
            ..StepControl::new(self.initial_mm, self.until_mm)
        }
    }
}

/// What is read off the model at an accepted step, net of self weight.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Deflection at the gauge (mm).
    pub deflection_mm: f64,
    /// Reported load (kN).
    pub load_kn: f64,
    /// The same from the work of the true stresses on the step (kN).
    pub work_conjugate_load_kn: f64,
    /// Support reactions of the whole width, self weight included (kN).
    pub reactions_kn: Vec<f64>,
    /// Force of each load of the whole width, down positive (kN); none act under self weight.
    pub loads_kn: Vec<f64>,
    /// Largest force by which a support holds the beam down or a load pulls it up, over all loads.
    pub backward: f64,
}

/// Displacements and states of an accepted step.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Deflection (mm).
    pub deflection_mm: f64,
    /// Displacements of all DOFs (mm).
    pub displacement: Vec<f64>,
    /// States of all elements.
    pub state: StateStore,
}

impl Snapshot {
    /// The accepted state of a stage.
    pub fn of(stage: &Stage<'_>, deflection_mm: f64) -> Self {
        Self {
            deflection_mm,
            displacement: stage.displacement().to_vec(),
            state: stage.state().clone(),
        }
    }
}

/// Watches a run; what is not looked at goes on.
pub trait Observer {
    /// The beam carries its own weight.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn weight(&mut self, _view: &StepView<'_>, _reading: &Reading) -> io::Result<()> {
        Ok(())
    }

    /// An iteration under self weight was evaluated.
    ///
    /// # Errors
    ///
    /// An error ends the run.
    fn weighing(&mut self) -> io::Result<()> {
        Ok(())
    }

    /// An iteration of the load stage was evaluated.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn iteration(&mut self, _record: &IterationRecord) -> io::Result<()> {
        Ok(())
    }

    /// The next step of an earlier run, see [`Recorder::recall`](fe_solver::recorder::Recorder::recall).
    ///
    /// # Errors
    ///
    /// An error ends the run.
    fn recall(&mut self) -> io::Result<Option<Entry>> {
        Ok(None)
    }

    /// A step of any stage is about to be accepted for the first time.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn keep(&mut self, _entry: &Entry) -> io::Result<()> {
        Ok(())
    }

    /// The driver or the step control has decided something about a step, with the reason.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn note(&mut self, _step: usize, _text: &str) -> io::Result<()> {
        Ok(())
    }

    /// A step under load was accepted, counted through all stages. The answer tells whether to go on.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn step(
        &mut self,
        _view: &StepView<'_>,
        _step: usize,
        _reading: &Reading,
    ) -> io::Result<Continue> {
        Ok(Continue::Yes)
    }

    /// Sheets have been bonded to the loaded beam: from now on it is this one.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn bonded(&mut self, _beam: &Beam) -> io::Result<()> {
        Ok(())
    }
}

/// A beam that is loaded before its sheets are bonded.
#[derive(Debug, Clone, Copy)]
pub struct Staging<'a> {
    /// The specimen.
    pub specimen: &'a Specimen,
    /// How it is modelled.
    pub settings: &'a ModelSettings,
    /// Load and what happens to it while the sheets are bonded.
    pub staged: &'a Staged,
}

/// Why a path ended before its time.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// The solver gave up.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// The beam does not stand.
    #[error("under its own weight, before any load, which it may be too weak to carry: {0}")]
    SelfWeight(SolverError),
    /// The bare beam fails before the sheets are bonded.
    #[error(
        "the bare beam carries {carried_kn:.1} kN up to the end of its path, but its sheets are to be bonded at \
         {wanted_kn:.1} kN; give a lower load in staged.load_kn or, where the path ends early, a greater deflection with --until"
    )]
    NotReached {
        /// Largest load of the bare beam (kN).
        carried_kn: f64,
        /// Load at which the sheets are to be bonded (kN).
        wanted_kn: f64,
    },
    /// The strengthened model cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
}

impl AnalysisError {
    /// What stops the stage of self weight: the beam, unless it is a table that cannot be written or a journal of another run.
    fn under_its_own_weight(error: SolverError) -> Self {
        match error {
            SolverError::Output(_) | SolverError::Journal { .. } => Self::Solver(error),
            other => Self::SelfWeight(other),
        }
    }

    /// Whether results could not be written.
    pub(crate) const fn is_output(&self) -> bool {
        matches!(self, Self::Solver(SolverError::Output(_)))
    }
}

/// What a run leaves behind.
#[derive(Debug)]
pub struct Outcome {
    /// Load path before the sheets were bonded; empty unless the strengthening is staged.
    pub before: Vec<PathPoint>,
    /// The beam of the last stage, unless it is the one that was given: without sheets or strengthened under load.
    pub ended_on: Option<Beam>,
    /// Load path, one point per accepted step.
    pub path: Vec<PathPoint>,
    /// State at the largest load up to the fall; `None` without a step.
    pub peak: Option<Snapshot>,
    /// State when the load had first fallen by [`CAPACITY_FALL`](fe_solver::capacity::CAPACITY_FALL) from there, if it did.
    pub fallen: Option<Snapshot>,
    /// State at the last accepted step.
    pub last: Snapshot,
    /// Sum of the support reactions under self weight, whole width (kN).
    pub self_weight_kn: f64,
    /// Work done and wall time by phase, stage by stage.
    pub work: Vec<(Counters, PhaseTimes)>,
    /// Why the path ended.
    pub stop: Result<String, AnalysisError>,
}
