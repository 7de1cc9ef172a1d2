//! Modified secant iteration, extrapolated predictor, Anderson acceleration, snaps by secant descent.

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;

use crate::anderson::Anderson;
use crate::capacity::DROP_FALL;
use crate::descent::{Descent, DescentSettings};
use crate::driver::{Attempt, Driver, IterationLog, Request};
use crate::error::SolverError;
use crate::stage::{LEAST_FORCE, Residual, Stage};

/// Settings of [`SecantAnderson`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SecantSettings {
    /// Iterations of one solve.
    pub max_iterations: usize,
    /// Differences the acceleration keeps.
    pub depth: usize,
    /// Iterations after which the operator is rebuilt at the current iterate; 0 keeps the first.
    pub rebuild_after: usize,
    /// Iterations spent on a snap before the step is cut.
    pub small_snap: usize,
    /// Descent over snaps.
    pub descent: DescentSettings,
}

impl Default for SecantSettings {
    fn default() -> Self {
        Self {
            max_iterations: 30,
            depth: 10,
            rebuild_after: 20,
            small_snap: 150,
            descent: DescentSettings::default(),
        }
    }
}

impl SecantSettings {
    fn check(&self) -> Result<(), SolverError> {
        SolverError::positive(
            "iterations of the secant iteration",
            self.max_iterations as f64,
        )?;
        self.descent.check()
    }
}

/// Modified secant iteration with Anderson acceleration.
///
/// From the extrapolated displacement one factor serves the iterations of the step, one force evaluation and one
/// back-substitution each, no line search: that of the tangent at the accepted state, left by the count of its
/// negative pivots, where it is positive definite; elsewhere, and where that is slow, that of the positive-definite
/// secant operator of the laws. New cracks are latched until the step ends. After a snap, whose increment says nothing
/// about the next one, that tangent predicts.
///
/// Where no equilibrium lies near (a crack snaps, a sheet comes off), the load factor is held and a
/// [descent](crate::descent) leads to the next one: at once where the residual says that little moves and little load
/// is lost (no step is short enough to avoid the snap of a single point), else when steps cannot be cut any further. It
/// begins where the iteration came nearest, and gives over to it once the residual has fallen well below the largest on
/// the way.
#[derive(Debug, Clone, Default)]
pub struct SecantAnderson {
    settings: SecantSettings,
}

/// Result of one solve at a fixed load factor.
struct Solve {
    /// The last iterate, if it converged, otherwise the best one.
    free: Vec<f64>,
    /// Relative residual there.
    relative: f64,
    /// Residual of the last evaluation, if it was that of `free`: the solve converged.
    converged: Option<Residual>,
    iterations: usize,
}

/// The operator with which a solve starts.
#[derive(Debug, Clone, PartialEq)]
enum Start {
    /// Another one, evaluated with the first residual.
    Evaluated,
    /// That of the present factor.
    AtHand,
    /// The same, and this is the residual of the last evaluation, which was made there.
    Known(Vec<f64>),
}

/// End of a snap.
struct Snap {
    free: Vec<f64>,
    residual: Residual,
    iterations: usize,
    /// Whether it has lost the load, see [`COLLAPSE`].
    collapsed: bool,
}

/// Share of the accepted load after whose loss a structure has collapsed.
const COLLAPSE: f64 = 0.9;
/// Iterations from then on in which it has to come to rest: there may be no equilibrium left.
const TO_REST: usize = 250;
/// Relative residual below which a snap counts as small, and a descent gives over to the accelerated iteration.
const NEAR: f64 = 1e-2;
/// Iterations of a descent from one look at that to the next.
const LEG: usize = 5;
/// Share of the largest residual of a snap below which it is coming to its end.
const FALLEN: f64 = 0.3;
/// Share of the residual from which the accelerated iteration failed last, below which it is tried again.
const AGAIN: f64 = 0.5;
/// Iterations without halving the residual after which a solve this near has stalled: a snap is ahead.
const STALL: usize = 5;

impl SecantAnderson {
    /// A driver with the given settings.
    pub const fn new(settings: SecantSettings) -> Self {
        Self { settings }
    }

    /// Iterates from `free` at load factor `lambda`.
    fn solve(
        &self,
        stage: &mut Stage<'_>,
        mut free: Vec<f64>,
        start: Start,
        lambda: f64,
        criterion: f64,
        log: &mut IterationLog<'_>,
    ) -> Result<Solve, SolverError> {
        let operator = EvaluationContext::new(Operator::Secant);
        let force = EvaluationContext::new(Operator::None);
        let mut anderson = Anderson::new(self.settings.depth);
        let mut best: Option<(f64, Vec<f64>)> = None;
        let mut iterations = 0_usize;
        let mut halved = (f64::INFINITY, 0_usize);
        let begin_anew = start == Start::Evaluated;
        let mut known = match start {
            Start::Known(r) => Some(r),
            Start::Evaluated | Start::AtHand => None,
        };
        loop {
            let rebuild = match iterations {
                0 => begin_anew,
                n => n.is_multiple_of(self.settings.rebuild_after),
            };
            let (mut r, size) = if let Some(r) = known.take() {
                let size = stage.measure(&r);
                (r, size)
            } else {
                let u = stage.compose(&free, lambda);
                let r = stage.residual(&u, lambda, if rebuild { &operator } else { &force })?;
                stage.latch();
                let size = stage.measure(&r);
                log(&size, 1.0)?;
                (r, size)
            };
            if size.relative <= criterion {
                return Ok(Solve {
                    free,
                    relative: size.relative,
                    converged: Some(size),
                    iterations,
                });
            }
            if best.as_ref().is_none_or(|(b, _)| size.relative < *b) {
                best = Some((size.relative, free.clone()));
            }
            if size.relative < 0.5 * halved.0 {
                halved = (size.relative, iterations);
            }
            let near = best.as_ref().is_some_and(|(b, _)| *b < NEAR);
            let stalled = near && iterations >= halved.1 + STALL;
            if stalled || iterations >= self.settings.max_iterations || !size.relative.is_finite() {
                if rebuild {
                    // The operator is no longer that of the factor.
                    stage.forget_tangent();
                }
                let (relative, free) = best.unwrap_or((size.relative, free));
                return Ok(Solve {
                    free,
                    relative,
                    converged: None,
                    iterations,
                });
            }
            if rebuild {
                stage.factorise()?;
                anderson.reset();
            }
            stage.precondition(&mut r)?;
            let increment = anderson.increment(&free, &r);
            free.iter_mut().zip(&increment).for_each(|(u, d)| *u += d);
            iterations += 1;
        }
    }

    /// First iterate, and the operator to go on with: the accepted displacement extrapolated along its last increment, or,
    /// without one, a linear solve from it. The operator is the tangent there if the stage holds it and it is positive
    /// definite, else the secant operator: that of the linear solve, or another one.
    fn start(stage: &mut Stage<'_>, step: f64) -> Result<(Vec<f64>, Start), SolverError> {
        let extrapolates = Self::last(stage).is_some();
        let at_hand = stage.holds_stable_tangent() || !extrapolates;
        let first = Self::predict(stage, step)?;
        let start = if at_hand {
            Start::AtHand
        } else {
            Start::Evaluated
        };
        Ok((first, start))
    }

    /// The last increment, if the load factor has changed in it: what it is extrapolated by.
    fn last<'a>(stage: &'a Stage<'_>) -> Option<(&'a [f64], f64)> {
        stage.previous().filter(|(_, dl)| *dl != 0.0)
    }

    /// The first iterate of [`Self::start`].
    pub(crate) fn predict(stage: &mut Stage<'_>, step: f64) -> Result<Vec<f64>, SolverError> {
        let accepted = stage.displacement();
        if let Some((du, dl)) = Self::last(stage) {
            let ratio = step / dl;
            let at: Vec<f64> = accepted
                .iter()
                .zip(du)
                .map(|(u, d)| u + ratio * d)
                .collect();
            return Ok(stage.restrict(&at));
        }
        let accepted = accepted.to_vec();
        if !(stage.holds_stable_tangent() && stage.has_operator()) {
            let operator = EvaluationContext::new(Operator::Secant);
            stage.residual(&accepted, stage.lambda() + step, &operator)?;
            stage.factorise()?;
        }
        let mut increment = stage.reference_load();
        for q in &mut increment {
            *q *= step;
        }
        stage.solve(&mut increment)?;
        let mut free = stage.restrict(&accepted);
        free.iter_mut().zip(&increment).for_each(|(u, d)| *u += d);
        Ok(free)
    }

    /// To the next equilibrium at a held load factor, from the iterate that came `nearest`, whose history is kept, or without
    /// one from the accepted displacement: a descent that the accelerated iteration ends. Given up after the iterations of a
    /// small snap, or once it has lost load, unless it is the last resort.
    fn pass_snap(
        &self,
        stage: &mut Stage<'_>,
        nearest: Option<Vec<f64>>,
        lambda: f64,
        criterion: f64,
        last_resort: bool,
        log: &mut IterationLog<'_>,
    ) -> Result<Snap, SolverError> {
        let settings = self.settings.descent;
        let mut limit = if last_resort {
            settings.max_iterations
        } else {
            settings.max_iterations.min(self.settings.small_snap)
        };
        let passed = nearest.is_some();
        let free = nearest.unwrap_or_else(|| stage.restrict(stage.displacement()));
        let mut descent = Descent::start(stage, settings, free, lambda)?;
        if passed {
            stage.advance();
        }
        let mut spent = 0;
        let mut near = NEAR;
        let mut halved = (0.0_f64, 0);
        loop {
            let residual = descent.run(stage, criterion, LEG, log)?;
            let iterations = spent + descent.iterations;
            let loss = Self::loss(stage);
            let collapsed = loss >= COLLAPSE;
            if collapsed {
                limit = limit.min(iterations + TO_REST);
            }
            if residual.relative < 0.5 * halved.0 {
                halved = (residual.relative, iterations);
            }
            halved.0 = halved.0.max(residual.relative);
            let stalled = iterations >= halved.1 + settings.patience;
            let over = stalled || iterations >= limit || !residual.relative.is_finite();
            // A snap that loses load is to be placed by shorter steps first: no use to follow it down.
            let lost = !last_resort && loss >= DROP_FALL;
            if residual.relative <= criterion || over || lost {
                return Ok(Snap {
                    free: descent.free,
                    residual,
                    iterations,
                    collapsed,
                });
            }
            if residual.relative > near.min(FALLEN * descent.largest) {
                continue;
            }
            near = AGAIN * residual.relative;
            let free = descent.free.clone();
            let start = Start::Known(descent.residual.clone());
            let passed = stage.state().base_changes();
            let solve = self.solve(stage, free, start, lambda, criterion, log)?;
            spent += solve.iterations;
            if let Some(residual) = solve.converged {
                return Ok(Snap {
                    free: solve.free,
                    residual,
                    iterations: iterations + solve.iterations,
                    collapsed: false,
                });
            }
            // Cracks that opened on the way of a rejected solve have not opened.
            stage.set_base(&passed);
            descent.resume(self.rebuilds(solve.iterations));
        }
    }

    /// Whether a solve of so many iterations, begun with the factor at hand, has replaced it.
    const fn rebuilds(&self, iterations: usize) -> bool {
        let after = self.settings.rebuild_after;
        after > 0 && iterations >= after
    }

    /// Share of the accepted load lost in the last evaluation, nothing where there was none but rounding; not a number where
    /// the load factor drives forces only.
    fn loss(stage: &Stage<'_>) -> f64 {
        let (load, accepted) = (stage.load(), stage.accepted_load());
        if accepted.abs() <= LEAST_FORCE && load != 0.0 {
            return 0.0;
        }
        1.0 - load / accepted
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
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        let Request {
            length,
            criterion,
            last_resort,
        } = request;
        self.settings.check()?;
        let lambda = stage.lambda() + length;
        let (first, start) = Self::start(stage, length)?;
        let mut solve = self.solve(stage, first, start, lambda, criterion, log)?;
        let mut iterations = solve.iterations;
        let held = solve.converged.is_none() && (last_resort || solve.relative < NEAR);
        let before = held.then(|| stage.state().base_changes());
        let snap = if held {
            let nearest = (solve.relative < NEAR).then(|| solve.free.clone());
            Some(self.pass_snap(stage, nearest, lambda, criterion, last_resort, log)?)
        } else {
            None
        };
        iterations += snap.as_ref().map_or(0, |snap| snap.iterations);
        let residual = match (snap, solve.converged) {
            // A snap that was not passed may end farther from equilibrium than the regular solve did, unless nothing is
            // left to go back to.
            (Some(s), _) if s.collapsed || s.residual.relative <= criterion.max(solve.relative) => {
                solve.free = s.free;
                s.residual
            }
            (None, Some(residual)) => residual,
            _ => {
                // What a rejected snap went through has not happened.
                if let Some(before) = before {
                    stage.set_base(&before);
                }
                Self::check(stage, &solve.free, lambda)?
            }
        };
        // A snap that loses load is placed by shorter steps before it is passed.
        let placed = !held || last_resort || Self::loss(stage) < DROP_FALL;
        Ok(Attempt {
            displacement: stage.compose(&solve.free, lambda),
            lambda,
            converged: residual.relative <= criterion && placed,
            residual,
            iterations,
            held,
            means: None,
            lag: None,
        })
    }
}
