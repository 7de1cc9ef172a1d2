//! Newton-Raphson on the bordered system, full and modified, with a line search.

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;

use crate::anderson::dot;
use crate::driver::{Attempt, Driver, IterationLog, Request};
use crate::error::SolverError;
use crate::path::{LoadFactor, PathConstraint};
use crate::stage::Stage;

/// Share of the two parts of its response, that to the load factor and that to the displacements, below which what a path
/// constraint controls does not respond: they cancel, but for the rounding of a solution.
const UNRESPONSIVE: f64 = 1e-9;

/// When the tangent is rebuilt and factorised.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Refactor {
    /// In every iteration: full Newton-Raphson.
    Always,
    /// After the first iteration of a step, and when a later one has reduced the residual by less than this
    /// factor: modified Newton-Raphson.
    Below(f64),
}

/// Settings of [`NewtonRaphson`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NewtonSettings {
    /// Iterations of one attempt.
    pub max_iterations: usize,
    /// When the tangent is rebuilt.
    pub refactor: Refactor,
    /// Operator asked of the laws.
    pub operator: Operator,
    /// Halvings of the line search; 0 switches it off.
    pub halvings: usize,
}

impl Default for NewtonSettings {
    fn default() -> Self {
        Self {
            max_iterations: 25,
            refactor: Refactor::Always,
            operator: Operator::Tangent,
            halvings: 5,
        }
    }
}

/// Newton-Raphson with a path constraint.
///
/// The line search halves the correction until the residual norm falls. If no tried factor reduces it the
/// attempt ends: a worse residual is never accepted.
///
/// A step has converged when its forces balance. The equation of a constraint that is not linear, g = 0, holds then as far as
/// the last correction has brought it: the step is a point of the path, if not exactly as far along it as was asked.
///
/// Latching: after every correction that does not yet converge, laws latch what the trial state shows (the
/// axes of a new crack) and keep it for the rest of the attempt. The next tangent is evaluated with it; while
/// modified Newton-Raphson keeps its factor, so is the next residual only. A correction that converges latches
/// nothing: its cracks are fixed when the step is committed. Rolling back forgets what an attempt latched.
#[derive(Debug)]
pub struct NewtonRaphson {
    settings: NewtonSettings,
    relaxation: f64,
    constraint: Box<dyn PathConstraint>,
}

impl NewtonRaphson {
    /// Newton-Raphson under control of the load factor.
    pub fn new(settings: NewtonSettings) -> Self {
        Self::with_constraint(settings, Box::new(LoadFactor::default()))
    }

    /// Newton-Raphson under another path constraint.
    pub fn with_constraint(settings: NewtonSettings, constraint: Box<dyn PathConstraint>) -> Self {
        Self {
            settings,
            relaxation: 1.0,
            constraint,
        }
    }

    /// An attempt whose histories grow by the share `relaxation`.
    pub(crate) fn relaxed(
        &mut self,
        relaxation: f64,
        stage: &mut Stage<'_>,
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        self.relaxation = relaxation;
        self.attempt(stage, request, log)
    }
}

impl Driver for NewtonRaphson {
    fn name(&self) -> &'static str {
        match self.settings.refactor {
            Refactor::Always => "Newton-Raphson",
            Refactor::Below(_) => "modified Newton-Raphson",
        }
    }

    fn attempt(
        &mut self,
        stage: &mut Stage<'_>,
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        let s = self.settings;
        SolverError::setting(
            ("operator of Newton-Raphson (none: 0)", 0.0),
            "tangent or secant",
            s.operator != Operator::None,
        )?;
        SolverError::positive("iterations of Newton-Raphson", s.max_iterations as f64)?;
        if let Refactor::Below(reduction) = s.refactor {
            SolverError::positive("reduction that keeps the factor", reduction)?;
        }
        self.constraint.begin(stage, request.length)?;
        let [tangent, force] = [s.operator, Operator::None].map(|operator| EvaluationContext {
            relaxation: self.relaxation,
            ..EvaluationContext::new(operator)
        });
        let start = stage.restrict(stage.displacement());
        let mut du = vec![0.0; start.len()];
        let mut lambda = stage.lambda();
        let mut gradient = vec![0.0; start.len()];
        let mut u = stage.displacement().to_vec();
        if let Some((last, dlambda)) = stage.previous() {
            let last = stage.restrict(last);
            if let Some(share) = self.constraint.extrapolate(&last, dlambda) {
                du = last.iter().map(|d| share * d).collect();
                lambda += share * dlambda;
                let free: Vec<f64> = start.iter().zip(&du).map(|(u, d)| u + d).collect();
                u = stage.compose(&free, lambda);
            }
        }
        let mut residual = stage.residual(&u, lambda, &tangent)?;
        stage.renew()?;
        let mut reference = stage.reference_load();
        stage.solve(&mut reference)?;
        let mut iterations = 0;
        let mut best: Option<(f64, Vec<f64>, f64)> = None;
        loop {
            let mut correction = residual.clone();
            stage.solve(&mut correction)?;
            gradient.fill(0.0);
            let advance = lambda - stage.lambda();
            let directions = [correction.as_slice(), reference.as_slice()];
            self.constraint.observe(stage, (&du, advance), directions)?;
            let border = self.constraint.linearise(&du, advance, &mut gradient);
            let along = dot(&gradient, &reference);
            let response = border.slope + along;
            let least = UNRESPONSIVE * (border.slope.abs() + along.abs());
            if iterations == 0 && (response.abs() <= least || !response.is_finite()) {
                return Err(SolverError::Setting {
                    what: "change of what the path constraint controls under the load",
                    value: if response.is_finite() { 0.0 } else { response },
                    allowed: "other numbers than 0: control what responds to the load",
                });
            }
            let dlambda = -(border.value + dot(&gradient, &correction)) / response;
            for (c, q) in correction.iter_mut().zip(&reference) {
                *c += dlambda * q;
            }
            // The predictor carries the whole increment; corrections are searched along.
            let halvings = if iterations == 0 { 0 } else { s.halvings };
            let before = norm(&residual);
            let from: Vec<f64> = start.iter().zip(&du).map(|(u, d)| u + d).collect();
            let along = (correction.as_slice(), dlambda);
            let factor;
            (factor, u, residual) =
                search(stage, (&from, lambda), along, (before, halvings), &force)?;
            let after = norm(&residual);
            iterations += 1;
            let size = stage.measure(&residual);
            let worse = iterations > 1 && s.halvings > 0 && after >= before;
            log(&size, factor)?;
            lambda += factor * dlambda;
            for (d, c) in du.iter_mut().zip(&correction) {
                *d += factor * c;
            }
            let converged = size.relative <= request.criterion;
            let over = worse || iterations >= s.max_iterations || !size.relative.is_finite();
            let nearer =
                best.take_if(|(nearest, ..)| size.relative >= *nearest || size.relative.is_nan());
            if converged || over {
                let residual = match nearer {
                    Some((_, at, load)) if !converged => {
                        (u, lambda) = (at, load);
                        let r = stage.residual(&u, lambda, &force)?;
                        stage.measure(&r)
                    }
                    _ => size,
                };
                return Ok(Attempt {
                    displacement: u,
                    lambda,
                    converged,
                    residual,
                    iterations,
                    held: false,
                    means: None,
                    lag: None,
                });
            }
            best = nearer.or_else(|| Some((size.relative, u.clone(), lambda)));
            stage.latch();
            let slow = match s.refactor {
                Refactor::Always => true,
                Refactor::Below(reduction) => iterations == 1 || after * reduction > before,
            };
            if slow {
                residual = stage.residual(&u, lambda, &tangent)?;
                stage.renew()?;
                reference = stage.reference_load();
                stage.solve(&mut reference)?;
            }
        }
    }
}

/// Halves a correction until the residual is smaller than it was `before`, so many times at most: the factor reached, the
/// displacements there and their residual.
fn search(
    stage: &mut Stage<'_>,
    (from, lambda): (&[f64], f64),
    (correction, dlambda): (&[f64], f64),
    (before, halvings): (f64, usize),
    force: &EvaluationContext,
) -> Result<(f64, Vec<f64>, Vec<f64>), SolverError> {
    let (mut factor, mut tried) = (1.0, 0);
    loop {
        let moved = from.iter().zip(correction);
        let trial: Vec<f64> = moved.map(|(u, c)| u + factor * c).collect();
        let load = lambda + factor * dlambda;
        let u = stage.compose(&trial, load);
        let residual = stage.residual(&u, load, force)?;
        if norm(&residual) < before || tried >= halvings {
            return Ok((factor, u, residual));
        }
        tried += 1;
        factor *= 0.5;
    }
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
