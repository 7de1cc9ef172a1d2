//! One beam from self weight to the end of its path.

use fe_core::state::StateStore;
use fe_solver::capacity::{CAPACITY_FALL, PathPoint};
use fe_solver::control::{OnFailure, StepControl};
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::recorder::{Continue, IterationRecord, Recorder, StepView};
use fe_solver::stage::{Counters, PhaseTimes, Stage};
use std::io;

use crate::build::{Beam, BuildError, ModelSettings};
use crate::spec::{HoldOrUnload, Specimen, Staged};

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

    /// A step under load was accepted, counted through all stages. The answer tells whether to go on.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn step(&mut self, view: &StepView<'_>, step: usize, reading: &Reading)
    -> io::Result<Continue>;

    /// Sheets have been bonded to the loaded beam: from now on it is this one, with `u` the displacements of
    /// all its DOFs.
    ///
    /// # Errors
    ///
    /// An output error ends the run.
    fn bonded(&mut self, beam: &Beam, u: &[f64]) -> io::Result<()>;
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
    /// The bare beam fails before the sheets are bonded.
    #[error(
        "the bare beam carries {carried_kn:.1} kN, but its sheets are to be bonded at {wanted_kn:.1} kN; give a \
         lower load in staged.load_kn"
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

/// What a run leaves behind.
#[derive(Debug)]
pub struct Outcome {
    /// Load path before the sheets were bonded; empty unless the strengthening is staged.
    pub before: Vec<PathPoint>,
    /// The beam that was strengthened under load.
    pub strengthened: Option<Beam>,
    /// Load path, one point per accepted step.
    pub path: Vec<PathPoint>,
    /// State at the largest load up to the fall; `None` without a step.
    pub peak: Option<Snapshot>,
    /// State when the load had first fallen by [`CAPACITY_FALL`] from there, if it did.
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

/// Displacements and states on the way from stage to stage.
struct March<'a> {
    observer: &'a mut dyn Observer,
    driver: &'a mut dyn Driver,
    stepping: &'a Stepping,
    origin: Origin,
    steps: usize,
    work: Vec<(Counters, PhaseTimes)>,
}

/// Runs self weight, then the load stage; with `staging`, loads the bare beam first.
///
/// # Errors
///
/// [`SolverError`] when the beam cannot carry its own weight or the model is singular, [`BuildError`]; later
/// failures end the path and are kept in [`Outcome::stop`].
pub fn analyse(
    beam: &Beam,
    staging: Option<&Staging<'_>>,
    stepping: &Stepping,
    driver: &mut dyn Driver,
    observer: &mut dyn Observer,
) -> Result<Outcome, AnalysisError> {
    let mut march = March {
        observer,
        driver,
        stepping,
        origin: Origin::default(),
        steps: 0,
        work: Vec::new(),
    };
    let Some(staging) = staging else {
        let mut state = StateStore::new(beam.model.elements());
        let start = march.weight(beam, &mut state)?;
        let (mut outcome, _) = march.load(beam, &mut state, start, stepping, Until::Failure)?;
        outcome.work = march.work;
        return Ok(outcome);
    };
    let bare = Beam::bare(staging.specimen, staging.settings)?;
    let mut state = StateStore::new(bare.model.elements());
    let start = march.weight(&bare, &mut state)?;
    let wanted_kn = staging.staged.load_kn.get();
    let until = Until::Load(wanted_kn);
    let (mut first, mut imposed) = march.load(&bare, &mut state, start, stepping, until)?;
    if first.path.last().is_none_or(|p| p.load < wanted_kn) {
        if first.stop.is_ok() {
            let carried_kn = first.path.iter().map(|p| p.load).fold(0.0, f64::max);
            first.stop = Err(AnalysisError::NotReached {
                carried_kn,
                wanted_kn,
            });
        }
        first.work = march.work;
        return Ok(first);
    }
    if staging.staged.hold == HoldOrUnload::Unload {
        let start = first.last.displacement.clone();
        let back = Stepping {
            until_mm: imposed,
            ..*stepping
        };
        let until = Until::Unloaded;
        let (unloading, way) = march.load(&bare, &mut state, start, &back, until)?;
        imposed -= way;
        first.path.extend(unloading.path);
        first.last = unloading.last;
        if let stop @ Err(_) = unloading.stop {
            first.stop = stop;
            first.work = march.work;
            return Ok(first);
        }
    }
    let at = (first.last.displacement.as_slice(), &state);
    let (beam, start, mut state) = bare.strengthened(staging.specimen, staging.settings, at)?;
    march
        .observer
        .bonded(&beam, &start)
        .map_err(SolverError::Output)?;
    let rest = Stepping {
        until_mm: stepping.until_mm - imposed,
        ..*stepping
    };
    let (outcome, _) = march.load(&beam, &mut state, start, &rest, Until::Failure)?;
    Ok(Outcome {
        before: first.path,
        strengthened: Some(beam),
        work: march.work,
        ..outcome
    })
}

/// Where a load stage ends.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Until {
    /// Past the peak.
    Failure,
    /// At a load (kN), or past a peak below it.
    Load(f64),
    /// When the load is taken off; the loads move up.
    Unloaded,
}

impl March<'_> {
    /// Self weight. Returns the displacements.
    fn weight(&mut self, beam: &Beam, state: &mut StateStore) -> Result<Vec<f64>, SolverError> {
        let zero = vec![0.0; beam.model.dofs().len()];
        let mut stage = Stage::new(&beam.model, beam.weight.clone(), state, zero)?;
        let mut recorder = WeightRecorder {
            beam,
            observer: &mut *self.observer,
            origin: &mut self.origin,
        };
        let control = StepControl {
            criterion: self.stepping.criterion,
            ..StepControl::new(1.0, 1.0)
        };
        control.run(&mut stage, self.driver, &mut recorder)?;
        self.work.push((*stage.counters(), *stage.times()));
        Ok(stage.displacement().to_vec())
    }

    /// One stage of imposed deflection. Returns what it leaves behind and how far the loads moved (mm).
    fn load(
        &mut self,
        beam: &Beam,
        state: &mut StateStore,
        start: Vec<f64>,
        stepping: &Stepping,
        until: Until,
    ) -> Result<(Outcome, f64), SolverError> {
        let conditions = match until {
            Until::Unloaded => &beam.unloading,
            Until::Failure | Until::Load(_) => &beam.loading,
        };
        let mut stage = Stage::new(&beam.model, conditions.clone(), state, start)?;
        let mut recorder = LoadRecorder {
            beam,
            observer: &mut *self.observer,
            origin: &self.origin,
            steps_before: self.steps,
            to_the_end: stepping.to_the_end,
            until,
            path: Vec::new(),
            best: 0,
            fell: false,
            peak: None,
            fallen: None,
        };
        let stop = stepping
            .control()
            .run(&mut stage, self.driver, &mut recorder);
        self.work.push((*stage.counters(), *stage.times()));
        let LoadRecorder {
            path, peak, fallen, ..
        } = recorder;
        self.steps += path.len();
        let last = path.last().map_or(0.0, |p| p.deflection);
        let outcome = Outcome {
            before: Vec::new(),
            strengthened: None,
            path,
            peak,
            fallen,
            last: Snapshot::of(&stage, last),
            self_weight_kn: 2.0 * self.origin.reactions.iter().sum::<f64>() / 1e3,
            work: Vec::new(),
            stop: stop.map_err(AnalysisError::from),
        };
        Ok((outcome, stage.lambda()))
    }
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
    steps_before: usize,
    to_the_end: bool,
    until: Until,
    path: Vec<PathPoint>,
    /// Index of the largest load so far, until the load has fallen from it.
    best: usize,
    fell: bool,
    peak: Option<Snapshot>,
    fallen: Option<Snapshot>,
}

impl Recorder for LoadRecorder<'_> {
    fn iteration(&mut self, record: &IterationRecord) -> io::Result<()> {
        self.observer.iteration(&IterationRecord {
            step: self.steps_before + record.step,
            ..*record
        })
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
        if !self.fell && now.load <= (1.0 - CAPACITY_FALL) * best.load {
            self.fell = true;
            self.fallen = Some(Snapshot::of(view.stage, now.deflection));
        }
        let step = self.steps_before + view.step;
        if let Continue::Stop(reason) = self.observer.step(view, step, &reading)? {
            return Ok(Continue::Stop(reason));
        }
        match self.until {
            Until::Load(load) if now.load >= load => {
                let reason = format!("the load reached {load} kN");
                return Ok(Continue::Stop(reason));
            }
            Until::Unloaded if now.load <= 0.0 => {
                return Ok(Continue::Stop("the load was taken off".into()));
            }
            Until::Unloaded => return Ok(Continue::Yes),
            Until::Failure | Until::Load(_) => {}
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
