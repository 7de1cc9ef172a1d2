//! The stages of a run, one after the other.

use fe_core::energy::Ledger;
use fe_core::state::StateStore;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::recorder::Continue;
use fe_solver::secant::SecantAnderson;
use fe_solver::stage::{Counters, PhaseTimes, Stage};

use super::recorder::{LoadRecorder, Origin, WeightRecorder};
use super::{AnalysisError, Observer, Outcome, Snapshot, Staging, Stepping};
use crate::build::Beam;
use crate::spec::HoldOrUnload;

/// Displacements and states on the way from stage to stage.
struct March<'a> {
    observer: &'a mut dyn Observer,
    driver: &'a mut dyn Driver,
    stepping: &'a Stepping,
    origin: Origin,
    steps: usize,
    work: Vec<(Counters, PhaseTimes)>,
    ledger: Ledger,
}

/// Runs self weight, then the load stage; with `staging`, loads the bare beam first.
///
/// # Errors
///
/// [`AnalysisError`] when the beam cannot carry its own weight or the model is singular, or a model cannot be built; later
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
        ledger: Ledger::default(),
    };
    let Some(staging) = staging else {
        let mut state = StateStore::new(beam.model.elements());
        let start = march
            .weight(beam, &mut state)
            .map_err(AnalysisError::under_its_own_weight)?;
        let (mut outcome, _) = march.load(beam, &mut state, start, stepping, Until::Failure)?;
        outcome.work = march.work;
        return Ok(outcome);
    };
    let bare = Beam::bare(staging.specimen, staging.settings)?;
    let mut state = StateStore::new(bare.model.elements());
    let start = march
        .weight(&bare, &mut state)
        .map_err(AnalysisError::under_its_own_weight)?;
    let wanted_kn = staging.staged.load_kn.get();
    let until = Until::Load(wanted_kn);
    let (mut first, mut imposed) = march.load(&bare, &mut state, start, stepping, until)?;
    if first
        .path
        .last()
        .is_none_or(|p| until.reached(p.load, 0.0).is_none())
    {
        if first.stop.is_ok() {
            let carried_kn = first.path.iter().map(|p| p.load).fold(0.0, f64::max);
            first.stop = Err(AnalysisError::NotReached {
                carried_kn,
                wanted_kn,
            });
        }
        first.work = march.work;
        first.ended_on = Some(bare);
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
            first.ended_on = Some(bare);
            return Ok(first);
        }
    }
    let at = (first.last.displacement.as_slice(), &state);
    let (beam, start, mut state) = bare.strengthened(staging.specimen, staging.settings, at)?;
    march.observer.bonded(&beam).map_err(SolverError::Output)?;
    let rest = Stepping {
        until_mm: stepping.until_mm - imposed,
        ..*stepping
    };
    let (outcome, _) = march.load(&beam, &mut state, start, &rest, Until::Failure)?;
    Ok(Outcome {
        before: first.path,
        ended_on: Some(beam),
        work: march.work,
        ..outcome
    })
}

/// Where a load stage ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Until {
    /// Past the peak.
    Failure,
    /// At a load (kN), or past a peak below it.
    Load(f64),
    /// When the load is taken off; the loads move up.
    Unloaded,
}

/// Share of a load within which it counts as reached.
const LANDED: f64 = 1e-3;

impl Until {
    /// Why the stage ends at a load (kN), if it does; it began with `first`.
    pub(super) fn reached(self, load: f64, first: f64) -> Option<String> {
        match self {
            Self::Failure => None,
            Self::Load(wanted) => (load >= (1.0 - LANDED) * wanted)
                .then(|| format!("the load reached {load:.2} kN, {wanted} were asked for")),
            Self::Unloaded => {
                (load <= LANDED * first.abs()).then(|| "the load was taken off".to_owned())
            }
        }
    }

    /// The step from a load (kN) that grows at a `rate` (kN/mm): no longer than to the load at which the stage ends.
    pub(super) fn ahead(self, load: f64, rate: f64) -> Continue {
        let left = match self {
            Self::Failure => return Continue::Yes,
            Self::Load(wanted) => wanted - load,
            Self::Unloaded => -load,
        };
        let way = left / rate;
        if way.is_finite() && way > 0.0 {
            Continue::AtMost(way)
        } else {
            Continue::Yes
        }
    }
}

impl March<'_> {
    /// Self weight. Returns the displacements.
    fn weight(&mut self, beam: &Beam, state: &mut StateStore) -> Result<Vec<f64>, SolverError> {
        let zero = vec![0.0; beam.model.dofs().len()];
        let mut stage = Stage::new(&beam.model, beam.weight.clone(), state, zero)?
            .with_ledger(std::mem::take(&mut self.ledger));
        let mut recorder = WeightRecorder {
            beam,
            observer: &mut *self.observer,
            origin: &mut self.origin,
        };
        let control = StepControl {
            criterion: self.stepping.criterion,
            ..StepControl::new(1.0, 1.0)
        };
        // Whatever follows starts from an equilibrium.
        control.run(&mut stage, &mut SecantAnderson::default(), &mut recorder)?;
        self.work.push((*stage.counters(), *stage.times()));
        let reached = stage.displacement().to_vec();
        self.ledger = stage.into_ledger();
        Ok(reached)
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
        let mut stage = Stage::new(&beam.model, conditions.clone(), state, start)?
            .with_ledger(std::mem::take(&mut self.ledger));
        let observer = &mut *self.observer;
        let mut recorder = LoadRecorder::new(beam, observer, &self.origin);
        recorder.steps_before = self.steps;
        recorder.to_the_end = stepping.to_the_end;
        recorder.until = until;
        let mut control = stepping.control();
        if until != Until::Failure {
            // How stiff the beam is, and how far it is to the load, is known after the first step.
            control.initial = control.shortest;
        }
        let stop = control.run(&mut stage, self.driver, &mut recorder);
        let whole = (stage.lambda() - stepping.until_mm).abs() <= 1e-9 * stepping.until_mm;
        let stop = stop.map(|reason| match until {
            Until::Failure | Until::Load(_) if whole => {
                format!(
                    "the loads reached their deflection of {} mm",
                    self.stepping.until_mm
                )
            }
            _ => reason,
        });
        self.work.push((*stage.counters(), *stage.times()));
        let LoadRecorder {
            path, peak, fallen, ..
        } = recorder;
        self.steps += path.len();
        let last = path.last().map_or(0.0, |p| p.deflection);
        let outcome = Outcome {
            before: Vec::new(),
            ended_on: None,
            path,
            peak,
            fallen,
            last: Snapshot::of(&stage, last),
            self_weight_kn: 2.0 * self.origin.reactions.iter().sum::<f64>() / 1e3,
            work: Vec::new(),
            stop: stop.map_err(AnalysisError::from),
        };
        let moved = stage.lambda();
        self.ledger = stage.into_ledger();
        Ok((outcome, moved))
    }
}
