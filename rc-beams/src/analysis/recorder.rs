//! What is read off accepted steps, and when a stage ends.

use std::io;

use fe_solver::capacity::{Capacity, DROP_FALL, PLATEAU_REACH, PathPoint};
use fe_solver::journal::Entry;
use fe_solver::recorder::{Continue, IterationRecord, Recorder, StepView};

use super::march::Until;
use super::{Observer, Reading, Snapshot};
use crate::build::Beam;

/// Reactions (N, half width) and deflection (mm) under self weight: the zero of all readings.
#[derive(Debug, Default)]
pub(super) struct Origin {
    pub reactions: Vec<f64>,
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
    let loads = beam.measures.loads.iter();
    let loads: Vec<f64> = loads.map(|l| l.force(|d| stage.reaction(d))).collect();
    let pulls = loads.iter().copied();
    let backward = pulls
        .chain(reactions.iter().map(|r| -r))
        .fold(0.0, f64::max);
    let all: f64 = loads.iter().map(|f| f.abs()).sum();
    Reading {
        backward: if all > 0.0 { backward / all } else { 0.0 },
        deflection_mm: origin.displacement - stage.displacement()[beam.measures.deflection],
        load_kn,
        work_conjugate_load_kn: load_kn * ratio,
        reactions_kn: reactions.iter().map(|r| 2.0 * r / 1e3).collect(),
        loads_kn: loads.iter().map(|up| -2.0 * up / 1e3).collect(),
    }
}

pub(super) struct WeightRecorder<'a> {
    pub beam: &'a Beam,
    pub observer: &'a mut dyn Observer,
    pub origin: &'a mut Origin,
}

impl Recorder for WeightRecorder<'_> {
    fn iteration(&mut self, _: &IterationRecord) -> io::Result<()> {
        self.observer.weighing()
    }

    fn recall(&mut self) -> io::Result<Option<Entry>> {
        self.observer.recall()
    }

    fn keep(&mut self, entry: &Entry) -> io::Result<()> {
        self.observer.keep(entry)
    }

    fn step(&mut self, view: &StepView<'_>) -> io::Result<Continue> {
        let stage = view.stage;
        *self.origin = Origin {
            reactions: self.beam.measures.reactions(|d| stage.reaction(d)),
            displacement: stage.displacement()[self.beam.measures.deflection],
        };
        let mut reading = read(self.beam, view, self.origin);
        // What is left there is residual: nothing holds the beam where it will be loaded.
        reading.loads_kn.fill(0.0);
        self.observer.weight(view, &reading)?;
        Ok(Continue::Yes)
    }
}

pub(super) struct LoadRecorder<'a> {
    beam: &'a Beam,
    observer: &'a mut dyn Observer,
    origin: &'a Origin,
    pub steps_before: usize,
    pub to_the_end: bool,
    pub until: Until,
    pub path: Vec<PathPoint>,
    pub peak: Option<Snapshot>,
    pub fallen: Option<Snapshot>,
}

impl<'a> LoadRecorder<'a> {
    /// For a stage that ends with the failure of the beam.
    pub(super) fn new(beam: &'a Beam, observer: &'a mut dyn Observer, origin: &'a Origin) -> Self {
        Self {
            beam,
            observer,
            origin,
            steps_before: 0,
            to_the_end: false,
            until: Until::Failure,
            path: Vec::new(),
            peak: None,
            fallen: None,
        }
    }
}

impl Recorder for LoadRecorder<'_> {
    fn recall(&mut self) -> io::Result<Option<Entry>> {
        self.observer.recall()
    }

    fn keep(&mut self, entry: &Entry) -> io::Result<()> {
        self.observer.keep(entry)
    }

    fn iteration(&mut self, record: &IterationRecord) -> io::Result<()> {
        self.observer.iteration(&IterationRecord {
            step: self.steps_before + record.step,
            ..*record
        })
    }

    fn note(&mut self, step: usize, text: &str) -> io::Result<()> {
        self.observer.note(self.steps_before + step, text)
    }

    fn step(&mut self, view: &StepView<'_>) -> io::Result<Continue> {
        let reading = read(self.beam, view, self.origin);
        self.path.push(PathPoint {
            deflection: reading.deflection_mm,
            load: reading.load_kn,
            work_conjugate_load: reading.work_conjugate_load_kn,
            residual: view.residual,
            flagged: view.flagged,
            held: view.held,
            unstable: view.negative_pivots != Some(0),
            kinetic: view.kinetic,
            viscous: view.viscous,
        });
        let Some(capacity) = Capacity::of(&self.path) else {
            return Ok(Continue::Yes);
        };
        let now = self.path[self.path.len() - 1];
        if capacity.peak == self.path.len() - 1 {
            self.peak = Some(Snapshot::of(view.stage, now.deflection));
        }
        if capacity.fell && self.fallen.is_none() {
            self.fallen = Some(Snapshot::of(view.stage, now.deflection));
        }
        let step = self.steps_before + view.step;
        if let Continue::Stop(reason) = self.observer.step(view, step, &reading)? {
            return Ok(Continue::Stop(reason));
        }
        let first = self.path[0].load;
        if let Some(reason) = self.until.reached(now.load, first) {
            return Ok(Continue::Stop(reason));
        }
        let before = match self.path[..] {
            [.., before, _] => before.load,
            _ => first,
        };
        let rate = (now.load - before) / view.increment;
        let go_on = self.until.ahead(now.load, rate);
        if self.to_the_end || self.until == Until::Unloaded {
            return Ok(go_on);
        }
        if capacity.fell {
            let fall = 100.0 * (1.0 - now.load / self.path[capacity.peak].load);
            return Ok(Continue::Stop(format!(
                "the load fell by {fall:.0} % from its peak"
            )));
        }
        if capacity.plateau {
            return Ok(Continue::Stop(format!(
                "the load stayed within {:.0} % of its peak up to {PLATEAU_REACH} times the deflection there",
                100.0 * DROP_FALL
            )));
        }
        Ok(go_on)
    }
}
