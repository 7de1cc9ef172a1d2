//! Paths under imposed displacements.

use fe_core::energy::{Change, Ledger};
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::recorder::{Continue, IterationRecord, Recorder, StepView};
use fe_solver::stage::{Counters, Stage};

use crate::follow::marked;

/// One way of the imposed displacement: how far (mm), and in steps of what length (mm).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leg {
    /// Where it leads (mm), from the end of the leg before.
    pub to: f64,
    /// First and longest step (mm).
    pub step: f64,
}

/// Load (N) over imposed displacement (mm), and what it took.
#[derive(Debug, Default)]
pub struct Driven {
    /// Displacement and load of every step.
    pub points: Vec<[f64; 2]>,
    /// Iterations of every step: the first solution of an attempt counts, and so do attempts that were given up. The step
    /// that ended it, if one did, is the last.
    pub iterations: Vec<usize>,
    /// Steps that are [`marked`].
    pub marked: usize,
    /// Negative pivots at every step; none where they were not counted.
    pub negative: Vec<Option<usize>>,
    /// Energies of every step, by the trapezoidal rule.
    pub changes: Vec<Change>,
    /// Viscous work over the work, of drivers whose laws lag behind.
    pub viscous: Option<f64>,
    /// Why it did not arrive.
    pub stopped: Option<String>,
    /// Work done.
    pub counters: Counters,
    from: f64,
    sign: f64,
    criterion: f64,
    /// Iterations of the step under way.
    under_way: usize,
}

impl Recorder for Driven {
    fn iteration(&mut self, _record: &IterationRecord) -> std::io::Result<()> {
        self.under_way += 1;
        Ok(())
    }

    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue> {
        self.marked += usize::from(marked(view, self.criterion));
        self.negative.push(view.negative_pivots);
        self.changes.push(view.stage.ledger().last_change());
        self.viscous = view.viscous;
        self.iterations.push(std::mem::take(&mut self.under_way));
        let at = self.from + self.sign * view.lambda;
        self.points.push([at, self.sign * view.load]);
        Ok(Continue::Yes)
    }
}

impl Driven {
    /// Nothing yet, to be held against a relative residual.
    pub fn holding(criterion: f64) -> Self {
        Self {
            criterion,
            ..Self::default()
        }
    }

    /// Goes through a stage, and says whether it arrived.
    pub fn lead(
        &mut self,
        control: &StepControl,
        stage: &mut Stage<'_>,
        driver: &mut dyn Driver,
    ) -> bool {
        let end = control.run(stage, driver, self);
        let c = stage.counters();
        let sum = &mut self.counters;
        sum.steps += c.steps;
        sum.iterations += c.iterations;
        sum.cutbacks += c.cutbacks;
        sum.factorisations += c.factorisations;
        sum.force_evaluations += c.force_evaluations;
        if let Err(error) = end {
            self.stopped = Some(error.to_string());
            self.iterations.push(self.under_way);
        }
        self.stopped.is_none()
    }

    /// Largest load (N).
    pub fn peak(&self) -> f64 {
        self.points.iter().map(|p| p[1]).fold(0.0, f64::max)
    }

    /// Work up to a step (N mm).
    fn work(&self, until: usize) -> f64 {
        let mut last = [0.0; 2];
        let mut work = 0.0;
        for p in &self.points[..until] {
            work += 0.5 * (p[1] + last[1]) * (p[0] - last[0]);
            last = *p;
        }
        work
    }

    /// Dissipated energy at the end (N mm), where unloading is a secant: work less 1/2 P u.
    pub fn dissipated(&self) -> f64 {
        let stored = self.points.last().map_or(0.0, |p| 0.5 * p[0] * p[1]);
        self.work(self.points.len()) - stored
    }

    /// Largest energy (N mm) that a step created: fall of work less 1/2 P u.
    pub fn created(&self) -> f64 {
        let spent = |n: usize| {
            let stored = n
                .checked_sub(1)
                .map_or(0.0, |i| 0.5 * self.points[i][0] * self.points[i][1]);
            self.work(n) - stored
        };
        let falls = (0..self.points.len()).map(|n| spent(n) - spent(n + 1));
        falls.fold(0.0, f64::max)
    }

    /// Work (N mm) on all elements.
    pub fn worked(&self) -> f64 {
        self.changes.iter().map(|change| change.work).sum()
    }

    /// Energy (N mm) that all elements have dissipated at the end, whatever they unload along.
    pub fn spent(&self) -> f64 {
        self.changes.iter().map(Change::dissipated).sum()
    }

    /// Largest energy (N mm) that all elements created in one step.
    pub fn gained(&self) -> f64 {
        let gains = self.changes.iter().map(|change| -change.dissipated());
        gains.fold(0.0, f64::max)
    }

    /// Largest number of negative pivots, if they were counted at every step.
    pub fn most_negative(&self) -> Option<usize> {
        let counted: Option<Vec<usize>> = self.negative.iter().copied().collect();
        counted?.into_iter().max()
    }

    /// Iterations that `share` of all steps do not exceed.
    pub fn iterations_within(&self, share: f64) -> usize {
        let mut sorted = self.iterations.clone();
        sorted.sort_unstable();
        let last = (share * sorted.len() as f64).ceil() as usize;
        sorted
            .get(last.saturating_sub(1))
            .copied()
            .unwrap_or(usize::MAX)
    }
}

/// Moves a model from the virgin state along legs, the displacement growing by 1 mm per unit of the load factor of
/// `conditions`.
///
/// # Errors
///
/// [`SolverError`] where there is no path at all; later ones are kept.
pub fn drive(
    model: &Model,
    conditions: &Conditions,
    legs: &[Leg],
    criterion: f64,
    driver: &mut dyn Driver,
) -> Result<Driven, SolverError> {
    let mut state = StateStore::new(model.elements());
    let mut u = vec![0.0; model.dofs().len()];
    let mut ledger = Ledger::default();
    let mut driven = Driven::holding(criterion);
    for leg in legs {
        let way = leg.to - driven.from;
        driven.sign = way.signum();
        let mut turned = conditions.clone();
        for (dof, rate) in conditions.prescribed() {
            let (node, kind) = model.dofs().owner(*dof);
            turned.prescribe(model, node, kind, way.signum() * rate)?;
        }
        let control = StepControl {
            criterion,
            shortest: leg.step / 1024.0,
            ..StepControl::new(leg.step, way.abs())
        };
        let mut stage = Stage::new(model, turned, &mut state, u.clone())?.with_ledger(ledger);
        let arrived = driven.lead(&control, &mut stage, driver);
        u = stage.displacement().to_vec();
        ledger = stage.into_ledger();
        if !arrived {
            break;
        }
        driven.from = leg.to;
    }
    Ok(driven)
}

#[cfg(test)]
mod tests {
    //! Protects the count of iterations from leaving out attempts that were given up.
    use fe_solver::automatic::Automatic;
    use fe_solver::newton::NewtonSettings;

    use super::*;
    use crate::softening_bar::moved;

    #[test]
    fn iterations_of_attempts_given_up_count() {
        let (model, conditions) = moved(300.0, &[2.5, 2.2, 2.5]);
        let leg = Leg {
            to: 0.05,
            step: 0.01,
        };
        let mut driver = Automatic::new(NewtonSettings::default());
        let driven = drive(&model, &conditions, &[leg], 1e-4, &mut driver).unwrap();
        assert!(driven.counters.cutbacks > 0);
        assert_eq!(driven.iterations.len(), driven.points.len());
        assert_eq!(
            driven.iterations.iter().sum::<usize>(),
            driven.counters.iterations
        );
    }
}
