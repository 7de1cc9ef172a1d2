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
//! what it meets; there alpha is shortened until r' . du >= -0.3 r . du, before the history is kept.
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
    /// Iterations with one factor.
    pub rebuild_after: usize,
    /// Largest overshoot: -r' . du over r . du.
    pub overshoot: f64,
    /// Smallest step factor.
    pub least_factor: f64,
}

impl Default for DescentSettings {
    fn default() -> Self {
        Self {
            max_iterations: 3000,
            rebuild_after: 10,
            overshoot: 0.3,
            least_factor: 0.05,
        }
    }
}

/// A descent under way.
#[derive(Debug)]
pub(crate) struct Descent {
    settings: DescentSettings,
    /// Free displacements (mm).
    pub free: Vec<f64>,
    lambda: f64,
    residual: Vec<f64>,
    /// Iterations with the present factor.
    age: usize,
    /// Evaluations so far.
    pub iterations: usize,
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
            age: 0,
            iterations: 0,
        };
        descent.renew(stage)?;
        Ok(descent)
    }

    /// Evaluates and factorises at the present iterate.
    fn renew(&mut self, stage: &mut Stage<'_>) -> Result<(), SolverError> {
        let u = stage.compose(&self.free, self.lambda);
        let operator = EvaluationContext::new(Operator::Secant);
        self.residual = stage.residual(&u, self.lambda, &operator)?;
        self.iterations += 1;
        self.age = 0;
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
        let mut size = stage.measure(&self.residual);
        for _ in 0..steps {
            if size.relative <= target || !size.relative.is_finite() {
                break;
            }
            let alpha = self.step(stage)?;
            size = stage.measure(&self.residual);
            log(&size, alpha)?;
            stage.advance();
            if alpha < 1.0 || self.age >= self.settings.rebuild_after {
                self.renew(stage)?;
            }
        }
        Ok(size)
    }

    /// One step; returns its factor.
    fn step(&mut self, stage: &mut Stage<'_>) -> Result<f64, SolverError> {
        let mut du = self.residual.clone();
        stage.precondition(&mut du)?;
        self.age += 1;
        let slope = dot(&self.residual, &du);
        let force = EvaluationContext::new(Operator::None);
        let mut alpha = 1.0;
        loop {
            let trial: Vec<f64> = self
                .free
                .iter()
                .zip(&du)
                .map(|(u, d)| u + alpha * d)
                .collect();
            let u = stage.compose(&trial, self.lambda);
            let residual = stage.residual(&u, self.lambda, &force)?;
            self.iterations += 1;
            let there = dot(&residual, &du);
            if there >= -self.settings.overshoot * slope || alpha <= self.settings.least_factor {
                (self.free, self.residual) = (trial, residual);
                return Ok(alpha);
            }
            alpha *= (slope / (slope - there)).clamp(0.1, 0.7);
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
