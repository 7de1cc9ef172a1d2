//! Paths under forces: load over the displacement it works on, for scenes whose closed forms are known.

use fe_core::dof::Dof;
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_solver::control::StepControl;
use fe_solver::critical::Critical;
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::recorder::{Continue, Recorder, StepView};
use fe_solver::stage::{Counters, Stage};

use crate::strip::Strip;

/// Length of the strip of [`pulled_strip`] (mm).
const LENGTH: f64 = 400.0;
/// Steps after which a path is given up.
const BUDGET: usize = 3000;

/// Force (N) over the displacement it works on (mm).
#[derive(Debug)]
pub struct Path {
    /// Reference forces of all DOFs (N), and the size of their sum.
    forces: (Vec<f64>, f64),
    arrived: fn(&Self) -> bool,
    /// Force and displacement of every step.
    pub points: Vec<[f64; 2]>,
    /// What the driver said.
    pub notes: Vec<String>,
    /// Critical points passed, with the force (N) of the step before.
    pub critical: Vec<(Critical, f64)>,
    /// Why it did not arrive.
    pub stopped: Option<String>,
    /// Steps that are [`marked`].
    pub marked: usize,
    /// Work done.
    pub counters: Counters,
    /// Relative residual that a step is to meet.
    criterion: f64,
}

/// Whether a step jumped, or missed the criterion.
pub fn marked(view: &StepView<'_>, criterion: f64) -> bool {
    view.flagged || view.held || view.residual > criterion
}

impl Recorder for Path {
    fn note(&mut self, step: usize, text: &str) -> std::io::Result<()> {
        self.notes.push(format!("step {step}: {text}"));
        Ok(())
    }

    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue> {
        if let Some(critical) = view.critical {
            let before = self.points.last().map_or(0.0, |p| p[0]);
            self.critical.push((critical, before));
        }
        self.marked += usize::from(marked(view, self.criterion));
        let u = view.stage.displacement();
        let along: f64 = self.forces.0.iter().zip(u).map(|(f, u)| f * u).sum();
        let force = view.lambda * self.forces.1;
        self.points.push([force, along / self.forces.1]);
        self.counters = *view.stage.counters();
        Ok(if (self.arrived)(self) {
            Continue::Stop("arrived".into())
        } else if self.points.len() >= BUDGET {
            self.stopped = Some(format!("not there after {BUDGET} steps"));
            Continue::Stop("budget".into())
        } else {
            Continue::Yes
        })
    }
}

impl Path {
    /// Largest force (N).
    pub fn peak(&self) -> f64 {
        self.points.iter().map(|p| p[0]).fold(0.0, f64::max)
    }

    /// Largest displacement (mm).
    pub fn turn(&self) -> f64 {
        self.points.iter().map(|p| p[1]).fold(0.0, f64::max)
    }

    /// Dissipated energy (N mm): work less what is stored at the end, 1/2 P u.
    pub fn dissipated(&self) -> f64 {
        let mut work = 0.0;
        let mut last = [0.0; 2];
        for p in &self.points {
            work += 0.5 * (p[0] + last[0]) * (p[1] - last[1]);
            last = *p;
        }
        work - 0.5 * last[0] * last[1]
    }
}

/// Follows a path from the virgin state by one driver after the other, each with its step control, until it has
/// `arrived`.
///
/// # Errors
///
/// [`SolverError`] where there is no path at all; later ones are kept.
pub fn follow(
    (model, conditions): (&Model, Conditions),
    legs: Vec<(StepControl, Box<dyn Driver>)>,
    arrived: fn(&Path) -> bool,
) -> Result<Path, SolverError> {
    let forces = conditions.reference().to_vec();
    let sum = forces.iter().sum::<f64>().abs();
    let mut path = Path {
        forces: (forces, sum),
        arrived,
        points: Vec::new(),
        notes: Vec::new(),
        critical: Vec::new(),
        stopped: None,
        marked: 0,
        counters: Counters::default(),
        criterion: f64::INFINITY,
    };
    let mut state = StateStore::new(model.elements());
    let virgin = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(model, conditions, &mut state, virgin)?;
    for (control, mut driver) in legs {
        path.criterion = control.criterion;
        if let Err(error) = control.run(&mut stage, driver.as_mut(), &mut path) {
            path.stopped = Some(error.to_string());
        }
    }
    Ok(path)
}

/// Steps of one length, which may shorten to 1/1024, without an end of their own.
pub fn steps(length: f64, criterion: f64) -> StepControl {
    StepControl {
        criterion,
        shortest: length / 1024.0,
        ..StepControl::new(length, 1e6)
    }
}

/// Whether the force is down to 2 % of its peak.
pub fn gone(path: &Path) -> bool {
    path.points
        .last()
        .is_some_and(|p| p[0] < 0.02 * path.peak())
}

/// The strip of STR-01, 400 mm in elements of 5 mm, under a force on its end.
///
/// # Panics
///
/// Never for these numbers.
pub fn pulled_strip() -> (Model, Conditions) {
    let strip = Strip::uniform(LENGTH, 5.0);
    let mut conditions = strip.held().expect("supports");
    for (node, share) in strip.line(LENGTH) {
        conditions
            .add_reference(&strip.model, node, Dof::Ux, share)
            .expect("a force");
    }
    (strip.model, conditions)
}
