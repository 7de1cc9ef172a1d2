//! Path control chosen by the state of the path.

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;

use crate::anderson::dot;
use crate::critical::Signs;
use crate::driver::{Attempt, Driver, IterationLog, Request};
use crate::error::SolverError;
use crate::newton::{NewtonRaphson, NewtonSettings};
use crate::path::{Dissipation, Energies, LoadedDisplacement, Mode};
use crate::secant::SecantAnderson;
use crate::stage::{Residual, Stage};

/// A step that dissipates more than this share of the work done on it calls for dissipation control.
const DISSIPATIVE: f64 = 0.05;
/// A step whose load falls and that dissipates less than this share of its work unloads elastically.
const ELASTIC: f64 = 1e-3;
/// Share of its length that a step takes under control of a mode, so that the peak is not stepped over.
const ONSET: f64 = 1.0 / 16.0;
/// Bounds of the factor by which the dissipation of a step changes from one to the next.
const PACE: (f64, f64) = (0.7, 1.3);

/// Largest load that the growth of histories may take away within a step under imposed displacements, over the largest
/// load so far: more would hide a peak between two steps.
const EVENT: f64 = 0.02;

/// Share of its load that a step loses, and its reach over that of the step before, if it has left the path: a body that
/// unloads, and dissipates a little on the way back to the origin, meets dissipation control as well.
const LOST: f64 = 0.2;
/// See [`LOST`].
const ASTRAY: f64 = 8.0;

/// What is controlled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Control {
    Displacement,
    Dissipation,
    Mode,
}

/// Newton-Raphson under forces, for paths through limit points and snaps back that nobody has to announce.
///
/// Dissipation is told from the force and the displacements, as of bodies that unload along the secant: elastic bodies that
/// soften by their geometry, such as shallow arches that snap through, seem to dissipate, and are followed by
/// [arc length](crate::path::ArcLength) under Newton-Raphson instead.
///
/// While a path is elastic the [loaded displacement](LoadedDisplacement) grows by the length of the step (mm). Once
/// a step has dissipated more than a twentieth of its work, steps are made to [dissipate](Dissipation) as much again
/// (switching on the energy: Verhoosel, Remmers and Gutierrez 2009, section 4); how much is adapted until the largest
/// displacement of a step is its length. Where a step fails before anything has been dissipated (an elastic body
/// cracks and snaps back) the difference between the failed iterate and the extrapolated path is the
/// [mode](Mode) that wants to grow, and its amplitude is controlled. Where one control fails the others are tried before the
/// step is cut.
///
/// A step that unloads elastically, or that loses a fifth of the load and reaches eight times as far as the one before, was not asked
/// for and is refused, however well it converged. Every change is
/// noted with its reason.
///
/// Where displacements are imposed and no force grows, steps are solved by [`SecantAnderson`], which passes snaps at held
/// displacements. A step in which the growth of histories takes away more than 2 % of the largest load, measured by the
/// [work-conjugate load](Stage::work_conjugate_load) against that with histories held, is shortened as far as allowed:
/// so no peak is stepped over. So is a step from a stable equilibrium to one that is not: where several places are about
/// to fail, a short step lets the weakest fail first.
#[derive(Debug)]
pub struct Automatic {
    settings: NewtonSettings,
    displacement: NewtonRaphson,
    dissipation: NewtonRaphson,
    mode: Option<NewtonRaphson>,
    imposed: SecantAnderson,
    /// Largest load (N) under imposed displacements.
    largest: f64,
    control: Control,
    /// Length (mm) of the last attempt that converged.
    length: f64,
    /// Energy that a step dissipates per mm of its length (N); 0 before the first that does.
    rate: f64,
    /// Accepted steps of the stage when it was looked at last.
    seen: usize,
    /// What the last attempt has replaced, until it is accepted.
    replaced: Option<Replaced>,
    notes: Vec<String>,
}

/// Control and mode before another control served.
#[derive(Debug)]
struct Replaced {
    control: Control,
    /// Whether the mode has been replaced too.
    by_mode: bool,
    mode: Option<NewtonRaphson>,
}

impl Automatic {
    /// A driver with the given settings of Newton-Raphson.
    pub fn new(settings: NewtonSettings) -> Self {
        let with = |constraint| NewtonRaphson::with_constraint(settings, constraint);
        Self {
            settings,
            displacement: with(Box::<LoadedDisplacement>::default()),
            dissipation: with(Box::<Dissipation>::default()),
            mode: None,
            imposed: SecantAnderson::default(),
            largest: 0.0,
            control: Control::Displacement,
            length: 0.0,
            rate: 0.0,
            seen: 0,
            replaced: None,
            notes: Vec::new(),
        }
    }

    fn switch(&mut self, to: Control, reason: &str) {
        if self.control != to {
            self.control = to;
            let name = match to {
                Control::Displacement => "displacement control",
                Control::Dissipation => "dissipation control",
                Control::Mode => "control of the failing mode",
            };
            self.notes.push(format!("{name}: {reason}"));
        }
    }

    /// Looks at the last accepted step, once.
    fn look_back(&mut self, stage: &Stage<'_>) -> Result<(), SolverError> {
        let steps = stage.counters().steps;
        if std::mem::replace(&mut self.seen, steps) == steps {
            return Ok(());
        }
        let (Some(last), Some((du, _))) = (Energies::last(stage)?, stage.previous()) else {
            return Ok(());
        };
        let largest = largest(du.iter().copied());
        if largest == 0.0 {
            return Ok(());
        }
        // Steps accepted by another driver, or recalled, have no length here.
        let length = if self.length > 0.0 {
            self.length
        } else {
            largest
        };
        if self.control == Control::Dissipation {
            self.rate *= (length / largest).clamp(PACE.0, PACE.1);
            return Ok(());
        }
        let share = last.dissipated / last.work.abs();
        if share > DISSIPATIVE {
            self.rate = last.dissipated / length;
            let reason = format!(
                "the last step dissipated {:.0} % of its work",
                100.0 * share
            );
            self.switch(Control::Dissipation, &reason);
        }
        Ok(())
    }

    fn run(
        &mut self,
        stage: &mut Stage<'_>,
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        let (driver, scale) = match (self.control, &mut self.mode) {
            (Control::Dissipation, _) => (&mut self.dissipation, self.rate),
            (Control::Mode, Some(mode)) => (mode, ONSET),
            _ => (&mut self.displacement, 1.0),
        };
        let scaled = Request {
            length: scale * request.length,
            ..request
        };
        let mut attempt = match driver.attempt(stage, scaled, log) {
            Ok(attempt) => attempt,
            // More was asked for than there is left: what has failed is loose.
            Err(SolverError::Singular { .. }) if !request.last_resort => Attempt {
                displacement: stage.displacement().to_vec(),
                lambda: stage.lambda(),
                converged: false,
                residual: Residual::ENDLESS,
                iterations: 0,
                held: false,
                means: None,
                lag: None,
            },
            Err(e) => return Err(e),
        };
        let energies = Energies::to(stage, &attempt.displacement, attempt.lambda)?;
        let falls = attempt.lambda.abs() < stage.lambda().abs();
        attempt.converged &= !(falls && energies.dissipated < ELASTIC * energies.work.abs());
        if attempt.converged && Self::is_astray(stage, &attempt, request.length) {
            attempt.converged = false;
            self.notes
                .push("a step that led back towards the origin was refused".into());
        }
        Ok(attempt)
    }

    /// Whether another control may do where one has failed so: also where what it controls does not respond.
    fn may_go_on(error: &SolverError) -> bool {
        error.is_recoverable() || matches!(error, SolverError::Setting { .. })
    }

    /// Whether an attempt has left the path, see [`LOST`].
    fn is_astray(stage: &Stage<'_>, attempt: &Attempt, length: f64) -> bool {
        let lost = stage.lambda().abs() - attempt.lambda.abs() > LOST * stage.lambda().abs();
        let du = attempt.displacement.iter().zip(stage.displacement());
        let reach = largest(du.map(|(a, b)| a - b));
        let before = stage.previous();
        let before = before.map_or(0.0, |(du, _)| largest(du.iter().copied()));
        lost && reach > ASTRAY * before.max(length)
    }

    /// A step under imposed displacements.
    fn impose(
        &mut self,
        stage: &mut Stage<'_>,
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        let mut attempt = self.imposed.attempt(stage, request, log)?;
        // Snaps are passed in the shortest steps only.
        attempt.converged &= request.last_resort || !attempt.held;
        if !attempt.converged || request.last_resort {
            return Ok(attempt);
        }
        let (u, lambda) = (&attempt.displacement, attempt.lambda);
        let load = stage.work_conjugate_load(u, lambda);
        stage.residual(u, lambda, &EvaluationContext::frozen())?;
        let held = stage.work_conjugate_load(u, lambda);
        self.largest = self.largest.max(stage.accepted_load().abs());
        attempt.converged = held - load <= EVENT * self.largest.max(load.abs());
        if attempt.converged && stage.signs() == Signs::STABLE {
            attempt.converged = stage.stability(u, lambda, 1.0)? == Signs::STABLE;
        }
        Ok(attempt)
    }

    /// The mode in which an attempt failed: what its iterate has beyond the last increment, scaled to the same
    /// displacement under the forces.
    fn failing_mode(stage: &Stage<'_>, failed: &Attempt) -> Option<Vec<f64>> {
        let (last, _) = stage.previous()?;
        let forces = stage.conditions().reference();
        let du = failed.displacement.iter().zip(stage.displacement());
        let du: Vec<f64> = du.map(|(a, b)| a - b).collect();
        let share = dot(forces, &du) / dot(forces, last);
        let mode: Vec<f64> = du.iter().zip(last).map(|(d, l)| d - share * l).collect();
        Some(stage.restrict(&mode))
    }

    /// Other controls to try after one has failed. Which way the mode grows is not known: a snap-back is met from
    /// behind. The wrong way unloads, and is refused.
    fn others(
        &self,
        stage: &Stage<'_>,
        failed: Option<&Attempt>,
    ) -> Vec<(Control, Option<NewtonRaphson>)> {
        let mut others = Vec::new();
        if self.rate > 0.0 {
            others.push((Control::Dissipation, None));
        }
        others.push((Control::Displacement, None));
        others.retain(|(c, _)| *c != self.control);
        if let Some(mode) = failed.and_then(|f| Self::failing_mode(stage, f)) {
            for sign in [1.0, -1.0] {
                let mode = Mode::new(mode.iter().map(|m| sign * m).collect());
                let driver = |m| NewtonRaphson::with_constraint(self.settings, Box::new(m));
                others.extend(mode.map(|m| (Control::Mode, Some(driver(m)))));
            }
        }
        others
    }
}

/// Largest size of a component.
fn largest(du: impl Iterator<Item = f64>) -> f64 {
    du.fold(0.0, |a, d| a.max(d.abs()))
}

impl Driver for Automatic {
    fn name(&self) -> &'static str {
        "automatic path control"
    }

    /// The largest load is that of all stages.
    fn begin(&mut self) {
        *self = Self {
            largest: self.largest,
            ..Self::new(self.settings)
        };
    }

    fn attempt(
        &mut self,
        stage: &mut Stage<'_>,
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        if stage.conditions().reference().iter().all(|f| *f == 0.0) {
            return self.impose(stage, request, log);
        }
        if let Some(before) = self.replaced.take() {
            self.switch(before.control, "the step that had changed it was refused");
            if before.by_mode {
                self.mode = before.mode;
            }
        }
        self.look_back(stage)?;
        let usual = self.control;
        let mut result = self.run(stage, request, log);
        let mut serves = result.as_ref().is_ok_and(|a| a.converged);
        let recoverable = match &result {
            Ok(_) => true,
            Err(e) => Self::may_go_on(e),
        };
        if !serves && recoverable {
            for (other, mode) in self.others(stage, result.as_ref().ok()) {
                stage.roll_back();
                self.control = other;
                let kept = mode.map(|mode| self.mode.replace(mode));
                let again = self.run(stage, request, log);
                self.control = usual;
                match again {
                    Ok(attempt) if attempt.converged => {
                        self.switch(other, "a step of the same length failed under the other");
                        self.replaced = Some(Replaced {
                            control: usual,
                            by_mode: kept.is_some(),
                            mode: kept.flatten(),
                        });
                        (result, serves) = (Ok(attempt), true);
                        break;
                    }
                    Err(error) if !Self::may_go_on(&error) => return Err(error),
                    Ok(_) | Err(_) => {}
                }
                if let Some(before) = kept {
                    self.mode = before;
                }
            }
        }
        if serves {
            self.length = request.length;
        } else if let Ok(attempt) = &mut result {
            // The trial state is to be that of the iterate that is returned, not of the last control that was tried.
            stage.roll_back();
            let (u, lambda) = (&attempt.displacement, attempt.lambda);
            let r = stage.residual(u, lambda, &EvaluationContext::new(Operator::None))?;
            attempt.residual = stage.measure(&r);
        }
        result
    }

    fn accepted(&mut self) {
        self.replaced = None;
    }

    /// What steps under imposed displacements depend on. Control under forces is not kept.
    fn memory(&self) -> Vec<f64> {
        vec![self.largest]
    }

    fn recall(&mut self, memory: &[f64]) {
        if let [largest] = *memory {
            self.largest = largest;
        }
    }

    fn notes(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notes)
    }
}
