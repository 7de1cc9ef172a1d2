//! One beam from self weight to the end of its path.

use fe_core::state::StateStore;
use fe_solver::capacity::{CAPACITY_FALL, PathPoint};
use fe_solver::control::{OnFailure, StepControl};
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::recorder::{Continue, IterationRecord, Recorder, StepView};
use fe_solver::stage::{Counters, PhaseTimes, Stage};
use std::io;

use crate::build::Beam;

/// A path is followed to this multiple of the deflection at its largest load.
pub const FOLLOW: f64 = 1.5;

/// How the load stage is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepping {
    /// First step (mm).
    pub initial_mm: f64,
    /// Imposed deflection at which the path ends at the latest (mm).
    pub until_mm: f64,
    /// Whether the path is followed to `until_mm` whatever happens to the load.
    pub to_the_end: bool,
    /// Relative residual a step must meet.
    pub criterion: f64,
}

/// Longest step over the first one.
const LONGEST: f64 = 2.0;
/// Share of the deflection reached that a step may take where this is longer.
const LONGEST_SHARE: f64 = 0.01;
/// First step over the shortest one.
const SHORTEST: f64 = 16.0;
/// Steps with fewer iterations are followed by longer ones.
const EASY: usize = 20;
/// How much longer.
const GROWTH: f64 = 1.5;

impl Stepping {
    fn control(&self) -> StepControl {
        StepControl {
            longest: (LONGEST * self.initial_mm).min(self.until_mm),
            longest_share: LONGEST_SHARE,
            shortest: self.initial_mm / SHORTEST,
            criterion: self.criterion,
            easy: EASY,
            growth: GROWTH,
            on_failure: OnFailure::Flag,
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

/// Watches a run.
pub trait Observer {
    /// The beam carries its own weight.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn weight(&mut self, view: &StepView<'_>, reading: &Reading) -> io::Result<()>;

    /// An iteration of the load stage was evaluated.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn iteration(&mut self, record: &IterationRecord) -> io::Result<()>;

    /// A step of the load stage was accepted. The answer tells whether to go on.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn step(&mut self, view: &StepView<'_>, reading: &Reading) -> io::Result<Continue>;
}

/// What a run leaves behind.
#[derive(Debug)]
pub struct Outcome {
    /// Load path, one point per accepted step.
    pub path: Vec<PathPoint>,
    /// State at the largest load up to the fall; `None` without a step.
    pub peak: Option<Snapshot>,
    /// State at the last accepted step.
    pub last: Snapshot,
    /// Sum of the support reactions under self weight, whole width (kN).
    pub self_weight_kn: f64,
    /// Work done and wall time by phase, stage by stage.
    pub work: Vec<(Counters, PhaseTimes)>,
    /// Why the path ended.
    pub stop: Result<String, SolverError>,
}

/// Runs self weight, then the load stage.
///
/// # Errors
///
/// [`SolverError`] when the beam cannot carry its own weight or the model is singular; later failures end the
/// path and are kept in [`Outcome::stop`].
pub fn analyse(
    beam: &Beam,
    stepping: &Stepping,
    driver: &mut dyn Driver,
    observer: &mut dyn Observer,
) -> Result<Outcome, SolverError> {
    let mut state = StateStore::new(beam.model.elements());
    let zero = vec![0.0; beam.model.dofs().len()];
    let mut origin = Origin::default();
    let mut work = Vec::new();
    let start = {
        let mut stage = Stage::new(&beam.model, beam.weight.clone(), &mut state, zero)?;
        let mut recorder = WeightRecorder {
            beam,
            observer: &mut *observer,
            origin: &mut origin,
        };
        let control = StepControl {
            criterion: stepping.criterion,
            ..StepControl::new(1.0, 1.0)
        };
        control.run(&mut stage, driver, &mut recorder)?;
        work.push((*stage.counters(), *stage.times()));
        stage.displacement().to_vec()
    };
    let mut stage = Stage::new(&beam.model, beam.loading.clone(), &mut state, start)?;
    let mut recorder = LoadRecorder {
        beam,
        observer,
        origin: &origin,
        to_the_end: stepping.to_the_end,
        path: Vec::new(),
        best: 0,
        fell: false,
        peak: None,
    };
    let stop = stepping.control().run(&mut stage, driver, &mut recorder);
    work.push((*stage.counters(), *stage.times()));
    let LoadRecorder { path, peak, .. } = recorder;
    let last = path.last().map_or(0.0, |p| p.deflection);
    Ok(Outcome {
        path,
        peak,
        last: Snapshot::of(&stage, last),
        self_weight_kn: 2.0 * origin.reactions.iter().sum::<f64>() / 1e3,
        work,
        stop,
    })
}

/// Reactions (N, half width) and deflection (mm) under self weight: the zero of all readings.
#[derive(Debug, Default)]
struct Origin {
    reactions: Vec<f64>,
    displacement: f64,
}

fn read(beam: &Beam, view: &StepView<'_>, origin: &Origin) -> Reading {
    let stage = view.stage;
    let reactions = beam.measures.reactions(|d| stage.reaction(d));
    let net: Vec<f64> = reactions
        .iter()
        .zip(&origin.reactions)
        .map(|(r, w)| r - w)
        .collect();
    let load_kn = beam.measures.load_kn(&net);
    // The load conjugate to the imposed deflection is the sum of all loads; its error is shared by the
    // reported load in proportion.
    let ratio = if view.load == 0.0 {
        1.0
    } else {
        view.work_conjugate_load / view.load
    };
    Reading {
        deflection_mm: origin.displacement - stage.displacement()[beam.measures.deflection],
        load_kn,
        work_conjugate_load_kn: load_kn * ratio,
        reactions_kn: reactions.iter().map(|r| 2.0 * r / 1e3).collect(),
    }
}

struct WeightRecorder<'a> {
    beam: &'a Beam,
    observer: &'a mut dyn Observer,
    origin: &'a mut Origin,
}

impl Recorder for WeightRecorder<'_> {
    fn step(&mut self, view: &StepView<'_>) -> io::Result<Continue> {
        let stage = view.stage;
        *self.origin = Origin {
            reactions: self.beam.measures.reactions(|d| stage.reaction(d)),
            displacement: stage.displacement()[self.beam.measures.deflection],
        };
        let reading = read(self.beam, view, self.origin);
        self.observer.weight(view, &reading)?;
        Ok(Continue::Yes)
    }
}

struct LoadRecorder<'a> {
    beam: &'a Beam,
    observer: &'a mut dyn Observer,
    origin: &'a Origin,
    to_the_end: bool,
    path: Vec<PathPoint>,
    /// Index of the largest load so far, until the load has fallen from it.
    best: usize,
    fell: bool,
    peak: Option<Snapshot>,
}

impl Recorder for LoadRecorder<'_> {
    fn iteration(&mut self, record: &IterationRecord) -> io::Result<()> {
        self.observer.iteration(record)
    }

    fn step(&mut self, view: &StepView<'_>) -> io::Result<Continue> {
        let reading = read(self.beam, view, self.origin);
        self.path.push(PathPoint {
            deflection: reading.deflection_mm,
            load: reading.load_kn,
            work_conjugate_load: reading.work_conjugate_load_kn,
            residual: view.residual,
            flagged: view.flagged,
            held: view.held > 0,
            unstable: view.negative_pivots > 0,
        });
        let (best, now) = (self.path[self.best], self.path[self.path.len() - 1]);
        if !self.fell && (self.path.len() == 1 || now.load > best.load) {
            self.best = self.path.len() - 1;
            self.peak = Some(Snapshot::of(view.stage, now.deflection));
        }
        self.fell |= now.load < (1.0 - CAPACITY_FALL) * best.load;
        if let Continue::Stop(reason) = self.observer.step(view, &reading)? {
            return Ok(Continue::Stop(reason));
        }
        if self.to_the_end {
            return Ok(Continue::Yes);
        }
        if self.fell {
            let fall = 100.0 * (1.0 - now.load / best.load);
            return Ok(Continue::Stop(format!(
                "the load fell by {fall:.0} % from its peak"
            )));
        }
        if now.deflection > FOLLOW * best.deflection && now.load < best.load {
            return Ok(Continue::Stop(format!(
                "the deflection reached {FOLLOW} times that at the peak"
            )));
        }
        Ok(Continue::Yes)
    }
}
