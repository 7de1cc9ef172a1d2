//! Secant descent: from a state without equilibrium to the next one with it, at a held load factor.
//!
//! Every iterate is a state the structure passes through: its history is kept, nothing that has cracked heals.
//! With the residual r of the inviscid law and its secant operator K,
//!
//! K du = r,  u' = u + alpha du.
//!
//! The secant operator of a softening law is stiffer than the law itself, so that a full step, alpha = 1, goes
//! downhill in energy and falls short of the minimum rather than beyond it: r . du stays positive. Where the law is
//! stiffer than its secant (an open crack that closes) a full step would overshoot into compression and crush
//! what it meets. Such a step is taken back, and taken again with the operator where it led, in which the cracks have
//! closed; if that overshoots too, alpha is shortened until r' . du >= -0.3 r . du, before the history is kept.
//!
//! Where a step fell short, the next one under the same factor reaches as far as this one should have (Barzilai and
//! Borwein 1988, with K as the metric):
//!
//! alpha' = alpha r . du/(r . du - r' . du), between 1 and 2; 2 where r' . du >= r . du, on the way down.
//!
//! So a snap runs down to its end as far as equilibrium is missing and no further; an instability that only begins
//! grows by itself. The end is a state of equilibrium; the states between are not, and are not reported.

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;

use crate::driver::IterationLog;
use crate::error::SolverError;
use crate::stage::{Residual, Stage};

/// Settings of the descent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DescentSettings {
    /// Iterations after which it is given up.
    pub max_iterations: usize,
    /// Iterations in which the residual has to halve, else it is given up.
    pub patience: usize,
    /// Iterations with one factor.
    pub rebuild_after: usize,
    /// Largest overshoot: -r' . du over r . du.
    pub overshoot: f64,
    /// Smallest step factor.
    pub least_factor: f64,
    /// Largest step factor to begin a step with; 1 never goes beyond the secant step.
    pub largest_factor: f64,
}

impl Default for DescentSettings {
    fn default() -> Self {
        Self {
            max_iterations: 4000,
            patience: 1000,
            rebuild_after: 10,
            overshoot: 0.3,
            least_factor: 0.05,
            largest_factor: 2.0,
        }
    }
}

impl DescentSettings {
    /// # Errors
    ///
    /// [`SolverError::Setting`] where no descent is possible.
    pub(crate) fn check(&self) -> Result<(), SolverError> {
        let (over, least, most) = (self.overshoot, self.least_factor, self.largest_factor);
        let setting = SolverError::setting;
        SolverError::positive("iterations of the descent", self.max_iterations as f64)?;
        SolverError::positive("patience of the descent", self.patience as f64)?;
        let served = self.rebuild_after as f64;
        SolverError::positive("iterations of the descent with one factor", served)?;
        let fits = over.is_finite() && over >= 0.0;
        setting(("overshoot of the descent", over), "[0, inf)", fits)?;
        let fits = least > 0.0 && least <= 1.0;
        setting(("least step factor of the descent", least), "(0, 1]", fits)?;
        let fits = most.is_finite() && most >= 1.0;
        setting(
            ("largest step factor of the descent", most),
            "[1, inf)",
            fits,
        )
    }
}

/// Step factor below which the secant operator has been left behind and is rebuilt.
const STALE: f64 = 0.5;
/// Iterations a factor serves before that can happen.
const SERVED: usize = 2;

/// A descent under way.
#[derive(Debug)]
pub(crate) struct Descent {
    settings: DescentSettings,
    /// Free displacements (mm).
    pub free: Vec<f64>,
    lambda: f64,
    /// Residual there (N).
    pub residual: Vec<f64>,
    /// Its size, against the forces there.
    size: Residual,
    /// Iterations with the present factor.
    age: usize,
    /// Whether the last step was so short that another operator is needed.
    stale: bool,
    /// Step factor to begin the next step with.
    reach: f64,
    /// Evaluations so far.
    pub iterations: usize,
    /// Largest relative residual from which a step was taken so far.
    pub largest: f64,
}

impl Descent {
    /// Starts from `free`.
    pub(crate) fn start(
        stage: &mut Stage<'_>,
        settings: DescentSettings,
        free: Vec<f64>,
        lambda: f64,
    ) -> Result<Self, SolverError> {
        let mut descent = Self {
            settings,
            free,
            lambda,
            residual: Vec::new(),
            size: Residual::ENDLESS,
            age: 0,
            stale: false,
            reach: 1.0,
            iterations: 0,
            largest: 0.0,
        };
        descent.renew(stage)?;
        Ok(descent)
    }

    /// Goes on from where it was, after others have iterated from there, and perhaps left another operator.
    pub(crate) const fn resume(&mut self, another_operator: bool) {
        self.reach = 1.0;
        if another_operator {
            self.age = 0;
            self.stale = true;
        }
    }

    /// Residual at `free` with the given operator.
    fn evaluate(
        &mut self,
        stage: &mut Stage<'_>,
        free: &[f64],
        operator: Operator,
    ) -> Result<Vec<f64>, SolverError> {
        self.iterations += 1;
        let u = stage.compose(free, self.lambda);
        stage.residual(&u, self.lambda, &EvaluationContext::new(operator))
    }

    /// Evaluates and factorises at the present iterate.
    fn renew(&mut self, stage: &mut Stage<'_>) -> Result<(), SolverError> {
        let free = std::mem::take(&mut self.free);
        self.residual = self.evaluate(stage, &free, Operator::Secant)?;
        self.size = stage.measure(&self.residual);
        self.free = free;
        self.factorise(stage)
    }

    /// Factorises the operator of the last evaluation.
    fn factorise(&mut self, stage: &mut Stage<'_>) -> Result<(), SolverError> {
        self.stale = false;
        self.age = 0;
        self.reach = 1.0;
        stage.factorise()
    }

    /// Goes down until the residual is below `target`, for `steps` iterations at most. At the end the trial
    /// state is that of the last iterate.
    pub(crate) fn run(
        &mut self,
        stage: &mut Stage<'_>,
        target: f64,
        steps: usize,
        log: &mut IterationLog<'_>,
    ) -> Result<Residual, SolverError> {
        for _ in 0..steps {
            self.largest = self.largest.max(self.size.relative);
            if self.size.relative <= target || !self.size.relative.is_finite() {
                break;
            }
            if self.is_due() {
                self.factorise(stage)?;
            } else if self.stale {
                self.renew(stage)?;
            }
            let alpha = self.step(stage)?;
            log(&self.size, alpha)?;
            stage.advance();
            self.stale = alpha < STALE && self.age >= SERVED;
        }
        Ok(self.size)
    }

    /// Whether the present factor has served its time: the last step with it evaluates the next operator.
    const fn is_due(&self) -> bool {
        self.age >= self.settings.rebuild_after
    }

    /// Factor to begin the next step with, after one by `alpha` along which the residual fell from `slope` to `there`.
    fn reach_after(&self, alpha: f64, slope: f64, there: f64) -> f64 {
        let largest = self.settings.largest_factor;
        if there < slope {
            (alpha * slope / (slope - there)).clamp(1.0, largest)
        } else {
            largest
        }
    }

    /// Direction du of the present factor, and r . du.
    fn direction(&mut self, stage: &mut Stage<'_>) -> Result<(Vec<f64>, f64), SolverError> {
        let mut du = self.residual.clone();
        stage.precondition(&mut du)?;
        self.age += 1;
        let slope = dot(&self.residual, &du);
        Ok((du, slope))
    }

    /// One step; returns its factor.
    fn step(&mut self, stage: &mut Stage<'_>) -> Result<f64, SolverError> {
        let (mut du, mut slope) = self.direction(stage)?;
        let operator = if self.is_due() {
            Operator::Secant
        } else {
            Operator::None
        };
        let mut alpha = self.reach;
        let mut renewed = false;
        loop {
            let trial: Vec<f64> = self
                .free
                .iter()
                .zip(&du)
                .map(|(u, d)| u + alpha * d)
                .collect();
            let residual = self.evaluate(stage, &trial, operator)?;
            let there = dot(&residual, &du);
            if there >= -self.settings.overshoot * slope || alpha <= self.settings.least_factor {
                self.size = stage.measure(&residual);
                (self.free, self.residual) = (trial, residual);
                self.reach = self.reach_after(alpha, slope, there);
                return Ok(alpha);
            }
            if alpha <= 1.0 && !renewed {
                renewed = true;
                self.evaluate(stage, &trial, Operator::Secant)?;
                self.factorise(stage)?;
                (du, slope) = self.direction(stage)?;
                alpha = 1.0;
                continue;
            }
            let fits = slope / (slope - there);
            // Shortened most where the residual is no number.
            alpha *= if fits.is_nan() {
                0.1
            } else {
                fits.clamp(0.1, 0.7)
            };
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    //! Protects a descent that is resumed from what others have evaluated in between.
    use std::sync::Arc;

    use fe_core::dof::Dof;
    use fe_core::grid::GridBuilder;
    use fe_core::model::{Conditions, Model};
    use fe_core::state::StateStore;
    use fe_elements::{BandWidth, Hex20, HexRule};
    use fe_materials::Elastic;

    use super::*;

    /// The residual (N) is measured against the forces where the descent stands, not against those of the last evaluation, which
    /// may be a thousand times as large: an iterate far from equilibrium would pass for its end.
    #[test]
    fn the_residual_is_that_of_where_it_stands() {
        let mut grid = GridBuilder::new();
        grid.add_box("cube", &[0.0, 2.0], &[0.0, 2.0], &[0.0, 2.0]);
        let mesh = grid.finish().unwrap();
        let nodes: [usize; 20] = std::array::from_fn(|a| a);
        let coords = nodes.map(|n| mesh.nodes()[n]);
        let law = Arc::new(Elastic::new(30e3, 0.2).unwrap());
        let cube = Hex20::new(nodes, &coords, HexRule::Full, law, BandWidth::CubeRoot).unwrap();
        let model = Model::new(mesh, vec![Box::new(cube)]).unwrap();
        let mut conditions = Conditions::new(&model);
        for dof in Dof::DISPLACEMENTS {
            (0..8).for_each(|node| conditions.fix(&model, node, dof).unwrap());
        }
        let mut state = StateStore::new(model.elements());
        let rest = vec![0.0; model.dofs().len()];
        let mut stage = Stage::new(&model, conditions, &mut state, rest).unwrap();
        let free: Vec<f64> = (0..stage.assembler().free().len())
            .map(|i| 1e-4 * (i as f64).sin())
            .collect();
        let settings = DescentSettings::default();
        let mut descent = Descent::start(&mut stage, settings, free.clone(), 0.0).unwrap();
        let size = stage.measure(&descent.residual);
        let far = stage.compose(&free.iter().map(|u| 1e3 * u).collect::<Vec<_>>(), 0.0);
        let forces = EvaluationContext::new(Operator::None);
        stage.residual(&far, 0.0, &forces).unwrap();
        let mut log = |_: &Residual, _: f64| Ok(());
        let target = 0.1 * size.relative;
        let stands = descent.run(&mut stage, target, 0, &mut log).unwrap();
        assert_eq!(stands, size);
        let end = descent.run(&mut stage, target, 1, &mut log).unwrap();
        assert!(end.relative <= target, "{end:?}");
    }
}
