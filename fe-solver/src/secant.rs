//! Secant operator, extrapolated predictor, Anderson acceleration, viscous passage of snaps.

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;

use crate::anderson::Anderson;
use crate::driver::{Attempt, Driver, IterationLog};
use crate::error::SolverError;
use crate::stage::{Residual, Stage};

/// Settings of [`SecantAnderson`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SecantSettings {
    /// Iterations of one solve.
    pub max_iterations: usize,
    /// Differences the acceleration keeps.
    pub depth: usize,
    /// Viscosity tau of the history within the iteration, in units of the load factor:
    /// a = d lambda/(tau + d lambda).
    pub viscosity: f64,
    /// Iterations after which the operator is rebuilt at the current iterate; 0 keeps the first.
    pub rebuild_after: usize,
    /// Viscous solves at a fixed load factor before a snap is given up.
    pub max_holds: usize,
    /// Smallest relaxation a of such a solve before a snap is given up.
    pub min_relaxation: f64,
    /// Relative residual of such a solve over that of the inviscid law before it, where this is looser than the
    /// criterion.
    pub transit: f64,
}

impl Default for SecantSettings {
    fn default() -> Self {
        Self {
            max_iterations: 60,
            depth: 10,
            viscosity: 0.0,
            rebuild_after: 30,
            max_holds: 150,
            min_relaxation: 1e-4,
            transit: 0.1,
        }
    }
}

/// Modified secant iteration with Anderson acceleration.
///
/// The positive-definite secant operator of the laws at an extrapolated displacement gives a
/// predictor, is rebuilt there once, and serves the iterations of the step: one force evaluation and
/// one back-substitution each, no tangent, no line search. New cracks are latched until the step ends.
///
/// Where no equilibrium lies near (a crack snaps), the load factor is held and the history is let grow
/// viscously, solve by solve, until the inviscid law is in equilibrium again.
#[derive(Debug, Clone, Default)]
pub struct SecantAnderson {
    settings: SecantSettings,
}

/// Result of one solve at a fixed load factor and relaxation.
struct Solve {
    free: Vec<f64>,
    /// Residual of the last evaluation, if it was that of `free`: the solve converged.
    converged: Option<Residual>,
    iterations: usize,
}

impl SecantAnderson {
    /// A driver with the given settings.
    pub const fn new(settings: SecantSettings) -> Self {
        Self { settings }
    }

    /// Iterates from `free` at load factor `lambda`; the operator is built at the first iterate.
    fn solve(
        &self,
        stage: &mut Stage<'_>,
        mut free: Vec<f64>,
        lambda: f64,
        relaxation: f64,
        criterion: f64,
        log: &mut IterationLog<'_>,
    ) -> Result<Solve, SolverError> {
        let operator = EvaluationContext {
            operator: Operator::Secant,
            relaxation,
        };
        let force = EvaluationContext {
            operator: Operator::None,
            relaxation,
        };
        let mut anderson = Anderson::new(self.settings.depth);
        let mut best: Option<(f64, Vec<f64>)> = None;
        let mut iterations = 0_usize;
        loop {
            let rebuild = iterations.is_multiple_of(self.settings.rebuild_after);
            let u = stage.compose(&free, lambda);
            let mut r = stage.residual(&u, lambda, if rebuild { &operator } else { &force })?;
            stage.latch();
            let size = stage.measure(&r);
            log(&size, 1.0)?;
            if size.relative <= criterion {
                return Ok(Solve {
                    free,
                    converged: Some(size),
                    iterations,
                });
            }
            if best.as_ref().is_none_or(|(b, _)| size.relative < *b) {
                best = Some((size.relative, free.clone()));
            }
            if iterations >= self.settings.max_iterations || !size.relative.is_finite() {
                let free = best.map_or(free, |(_, free)| free);
                return Ok(Solve {
                    free,
                    converged: None,
                    iterations,
                });
            }
            if rebuild {
                stage.factorise()?;
                anderson.reset();
            }
            stage.solve(&mut r)?;
            let increment = anderson.increment(&free, &r);
            free.iter_mut().zip(&increment).for_each(|(u, d)| *u += d);
            iterations += 1;
        }
    }

    /// First iterate: one linear solve with the secant operator at the extrapolated displacement.
    fn predict(stage: &mut Stage<'_>, step: f64, relaxation: f64) -> Result<Vec<f64>, SolverError> {
        let lambda = stage.lambda() + step;
        let operator = EvaluationContext {
            operator: Operator::Secant,
            relaxation,
        };
        let accepted = stage.displacement().to_vec();
        let at = match stage.previous() {
            Some((du, dl)) => accepted
                .iter()
                .zip(du)
                .map(|(u, d)| u + step / dl * d)
                .collect(),
            None => accepted.clone(),
        };
        stage.residual(&at, lambda, &operator)?;
        stage.factorise()?;
        let mut predictor = stage.reference_load();
        for q in &mut predictor {
            *q *= step;
        }
        for (q, r) in predictor.iter_mut().zip(stage.accepted_residual()) {
            *q += r;
        }
        stage.solve(&mut predictor)?;
        let mut free = stage.restrict(&accepted);
        free.iter_mut().zip(&predictor).for_each(|(u, d)| *u += d);
        Ok(free)
    }

    /// Residual of the inviscid law at `free`; the trial state becomes the inviscid one.
    fn check(stage: &mut Stage<'_>, free: &[f64], lambda: f64) -> Result<Residual, SolverError> {
        let u = stage.compose(free, lambda);
        let r = stage.residual(&u, lambda, &EvaluationContext::new(Operator::None))?;
        Ok(stage.measure(&r))
    }
}

impl Driver for SecantAnderson {
    fn name(&self) -> &'static str {
        "secant-Anderson"
    }

    fn attempt(
        &mut self,
        stage: &mut Stage<'_>,
        length: f64,
        criterion: f64,
        last_resort: bool,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        let lambda = stage.lambda() + length;
        let mut relaxation = length / (self.settings.viscosity + length);
        // The viscous iterate is solved a little tighter, so that the inviscid check can pass.
        let inner = if relaxation < 1.0 {
            0.8 * criterion
        } else {
            criterion
        };
        let first = Self::predict(stage, length, relaxation)?;
        let mut solve = self.solve(stage, first, lambda, relaxation, inner, log)?;
        let mut iterations = solve.iterations;
        let mut residual = match solve.converged {
            // Without viscosity the iterate has been evaluated with the true law already.
            Some(residual) if relaxation >= 1.0 => residual,
            _ => Self::check(stage, &solve.free, lambda)?,
        };
        let mut held = 0;
        if residual.relative > criterion && last_resort {
            relaxation = 0.5;
            let nearest = (residual.relative, solve.free.clone());
            let mut free = stage.restrict(stage.displacement());
            while held < self.settings.max_holds {
                held += 1;
                // States passed through on the way need no more than a fraction of what is still amiss.
                let inner = inner.max(self.settings.transit * residual.relative);
                solve = self.solve(stage, free.clone(), lambda, relaxation, inner, log)?;
                iterations += solve.iterations;
                if solve.converged.is_none() {
                    relaxation *= 0.3;
                    if relaxation < self.settings.min_relaxation {
                        break;
                    }
                    continue;
                }
                let u = stage.compose(&solve.free, lambda);
                let ctx = EvaluationContext {
                    operator: Operator::None,
                    relaxation,
                };
                stage.residual(&u, lambda, &ctx)?;
                stage.advance();
                free.clone_from(&solve.free);
                residual = Self::check(stage, &free, lambda)?;
                if residual.relative <= criterion {
                    break;
                }
                if solve.iterations < self.settings.max_iterations / 2 {
                    relaxation = (1.6 * relaxation).min(1.0 - 0.6 * (1.0 - relaxation));
                }
            }
            solve.free = free;
            if residual.relative > criterion {
                // The snap was not passed: the nearer of the two states, that where it was left and the best
                // iterate of the regular solve.
                residual = Self::check(stage, &solve.free, lambda)?;
                if nearest.0 < residual.relative {
                    solve.free = nearest.1;
                    residual = Self::check(stage, &solve.free, lambda)?;
                }
            }
        }
        Ok(Attempt {
            displacement: stage.compose(&solve.free, lambda),
            lambda,
            converged: residual.relative <= criterion,
            residual,
            iterations,
            held,
        })
    }
}
