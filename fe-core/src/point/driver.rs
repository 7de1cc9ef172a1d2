//! Newton-Raphson on the stress-controlled components of a point.

use nalgebra::{DMatrix, DVector};

use super::error::PointError;
use super::history::{PointHistory, PointRow};
use super::{Control, MAX_STEPS, Segment};
use crate::kinematics::Kinematics;
use crate::material::{Material, MaterialError, Operator, PointContext, Response};

/// Settings of the iteration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointSettings {
    /// Allowed residual stress, relative to the largest stress so far.
    pub tolerance: f64,
    /// Iterations of one attempt.
    pub max_iterations: usize,
    /// Halvings of a correction that does not reduce the residual.
    pub halvings: usize,
    /// How often a failed step is halved before the driver gives up.
    pub subdivisions: usize,
}

/// Halvings after which nothing is left of a double but its rounding.
const MOST_HALVINGS: usize = 52;

impl PointSettings {
    fn check(&self) -> Result<(), PointError> {
        let tolerance = self.tolerance;
        let fits = tolerance.is_finite() && tolerance > 0.0;
        setting("tolerance", tolerance, "(0, inf)", fits)?;
        for (what, count) in [
            ("halvings", self.halvings),
            ("subdivisions", self.subdivisions),
        ] {
            setting(what, count as f64, "[0, 52]", count <= MOST_HALVINGS)?;
        }
        Ok(())
    }
}

fn setting(
    what: &'static str,
    value: f64,
    allowed: &'static str,
    fits: bool,
) -> Result<(), PointError> {
    let wrong = PointError::Setting {
        what,
        value,
        allowed,
    };
    if fits { Ok(()) } else { Err(wrong) }
}

impl Default for PointSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-9,
            max_iterations: 30,
            halvings: 8,
            subdivisions: 8,
        }
    }
}

/// One integration point and the path it has gone.
///
/// With the prescribed strains set, the others follow from r_i = sigma_i(eps) - sigma_i* = 0 on the
/// stress-controlled components i by d_eps = -D^(-1) r, D being the consistent tangent restricted to
/// them. A correction is halved until |r| falls; a step that fails is halved too. As in the analysis of a
/// structure, what a step latches (the axes of a new crack) is held within the step.
#[derive(Debug)]
pub struct PointDriver<'a, K: Kinematics> {
    law: &'a dyn Material<K>,
    ctx: PointContext,
    settings: PointSettings,
    point: Point<K>,
    /// Largest stress so far (MPa).
    scale: f64,
    history: PointHistory,
}

/// Strain, stress and committed state.
#[derive(Debug, Clone)]
struct Point<K: Kinematics> {
    strain: K::Vector,
    stress: K::Vector,
    state: Vec<f64>,
}

/// Why an attempt failed.
#[derive(Debug)]
enum Failure {
    Material(MaterialError),
    Residual {
        component: usize,
        residual: f64,
        tolerance: f64,
        iterations: usize,
    },
}

impl Failure {
    const fn is_recoverable(&self) -> bool {
        match self {
            Self::Material(source) => source.is_recoverable(),
            Self::Residual { .. } => true,
        }
    }

    fn at<K: Kinematics>(self, segment: usize, step: usize) -> PointError {
        match self {
            Self::Material(source) => PointError::Material {
                segment,
                step,
                source,
            },
            Self::Residual {
                component,
                residual,
                tolerance,
                iterations,
            } => PointError::NoConvergence {
                segment,
                step,
                component: K::STRESS_LABELS[component],
                residual,
                tolerance,
                iterations,
            },
        }
    }
}

impl<'a, K: Kinematics> PointDriver<'a, K> {
    /// The virgin point at zero strain. The operator of `ctx` is of no account.
    ///
    /// # Errors
    ///
    /// [`PointError::Refused`] if the law does not admit the point.
    pub fn new(law: &'a dyn Material<K>, ctx: PointContext) -> Result<Self, PointError> {
        law.admit(&ctx).map_err(PointError::Refused)?;
        let strain = K::vector(&vec![0.0; K::LEN]);
        let mut state = vec![0.0; law.state_len()];
        law.init_state(&mut state);
        let mut trial = state.clone();
        let virgin = law
            .update(
                &strain,
                &state,
                &mut trial,
                &ctx.with_operator(Operator::None),
            )
            .map_err(PointError::Refused)?;
        let point = Point {
            strain,
            stress: virgin.stress,
            state,
        };
        let mut history = PointHistory::new(law);
        history.push(point.row());
        Ok(Self {
            law,
            ctx: ctx.with_operator(Operator::Tangent),
            settings: PointSettings::default(),
            point,
            scale: 0.0,
            history,
        })
    }

    /// The same point with other settings.
    #[must_use]
    pub fn with_settings(self, settings: PointSettings) -> Self {
        Self { settings, ..self }
    }

    /// Everything so far, also after an error.
    pub const fn history(&self) -> &PointHistory {
        &self.history
    }

    /// Goes through the segments, one after the other, from the present state.
    ///
    /// # Errors
    ///
    /// [`PointError`]; the history keeps all that was reached before, the last sub-step included.
    pub fn run(&mut self, segments: &[Segment]) -> Result<(), PointError> {
        self.settings.check()?;
        for (segment, ramp) in (1..).zip(segments) {
            check::<K>(segment, ramp)?;
        }
        for (segment, ramp) in (1..).zip(segments) {
            let start = self.targets_now(&ramp.controls);
            for step in 1..=ramp.steps {
                let share = |s: usize| s as f64 / ramp.steps as f64;
                let mut reached = share(step - 1);
                let result = self.advance(&ramp.controls, &start, &mut reached, share(step), 0);
                if result.is_ok() || reached > share(step - 1) {
                    self.history.push(self.point.row());
                }
                result.map_err(|failure| failure.at::<K>(segment, step))?;
            }
        }
        Ok(())
    }

    /// Present value of what each control prescribes.
    fn targets_now(&self, controls: &[Control]) -> Vec<f64> {
        let strain = K::components(&self.point.strain);
        let stress = K::components(&self.point.stress);
        (0..K::LEN)
            .map(|i| match controls[i] {
                Control::Strain(_) => strain[i],
                Control::Stress(_) => stress[i],
            })
            .collect()
    }

    /// Takes the ramp from the share `reached` of it to the share `end`, in halves where it must.
    fn advance(
        &mut self,
        controls: &[Control],
        start: &[f64],
        reached: &mut f64,
        end: f64,
        depth: usize,
    ) -> Result<(), Failure> {
        let targets: Vec<f64> = (0..K::LEN)
            .map(|i| start[i] + end * (controls[i].target() - start[i]))
            .collect();
        match self.attempt(controls, &targets) {
            Ok(point) => {
                self.point = point;
                *reached = end;
                Ok(())
            }
            Err(failure) if failure.is_recoverable() && depth < self.settings.subdivisions => {
                let middle = reached.midpoint(end);
                self.advance(controls, start, reached, middle, depth + 1)?;
                self.advance(controls, start, reached, end, depth + 1)
            }
            Err(failure) => Err(failure),
        }
    }

    /// One step to the targets, without accepting it.
    fn attempt(&mut self, controls: &[Control], targets: &[f64]) -> Result<Point<K>, Failure> {
        let unknown: Vec<usize> = (0..K::LEN)
            .filter(|&i| matches!(controls[i], Control::Stress(_)))
            .collect();
        let mut base = self.point.state.clone();
        let mut trial = base.clone();
        let mut strain = K::components(&self.point.strain).to_vec();
        for i in (0..K::LEN).filter(|i| !unknown.contains(i)) {
            strain[i] = targets[i];
        }
        let miss = |response: &Response<K>| {
            let stress = K::components(&response.stress);
            DVector::from_iterator(
                unknown.len(),
                unknown.iter().map(|&i| stress[i] - targets[i]),
            )
        };
        let mut response = self.update(&strain, &base, &mut trial)?;
        let mut residual = miss(&response);
        for iterations in 0.. {
            let stress = K::components(&response.stress);
            let largest = stress.iter().fold(self.scale, |m, s| m.max(s.abs()));
            let tolerance = self.settings.tolerance * largest;
            if let Some(component) = stress.iter().position(|s| !s.is_finite()) {
                return Err(Failure::Residual {
                    component,
                    residual: stress[component],
                    tolerance,
                    iterations,
                });
            }
            if residual.is_empty() || residual.amax() <= tolerance {
                self.scale = largest;
                break;
            }
            let worst = residual.icamax();
            let failure = Failure::Residual {
                component: unknown[worst],
                residual: residual[worst],
                tolerance,
                iterations,
            };
            if iterations == self.settings.max_iterations {
                return Err(failure);
            }
            self.law.latch(&trial, &mut base);
            let tangent = DMatrix::from_fn(unknown.len(), unknown.len(), |i, j| {
                K::entry(&response.tangent, unknown[i], unknown[j])
            });
            let Some(mut correction) = tangent.lu().solve(&-&residual) else {
                return Err(failure);
            };
            let before = strain.clone();
            for halvings in 0.. {
                for (k, &i) in unknown.iter().enumerate() {
                    strain[i] = before[i] + correction[k];
                }
                response = self.update(&strain, &base, &mut trial)?;
                let now = miss(&response);
                if now.norm() < residual.norm() {
                    residual = now;
                    break;
                }
                if halvings == self.settings.halvings {
                    return Err(failure);
                }
                correction *= 0.5;
            }
        }
        Ok(Point {
            strain: K::vector(&strain),
            stress: response.stress,
            state: trial,
        })
    }

    fn update(
        &self,
        strain: &[f64],
        base: &[f64],
        trial: &mut [f64],
    ) -> Result<Response<K>, Failure> {
        self.law
            .update(&K::vector(strain), base, trial, &self.ctx)
            .map_err(Failure::Material)
    }
}

impl<K: Kinematics> Point<K> {
    fn row(&self) -> PointRow {
        PointRow {
            strain: K::components(&self.strain).to_vec(),
            stress: K::components(&self.stress).to_vec(),
            state: self.state.clone(),
        }
    }
}

/// Refuses a segment that cannot be run.
fn check<K: Kinematics>(segment: usize, ramp: &Segment) -> Result<(), PointError> {
    if ramp.controls.len() != K::LEN {
        return Err(PointError::Components {
            segment,
            given: ramp.controls.len(),
            expected: K::LEN,
            labels: K::STRAIN_LABELS.join(", "),
        });
    }
    if !(1..=MAX_STEPS).contains(&ramp.steps) {
        return Err(PointError::Steps {
            segment,
            steps: ramp.steps,
        });
    }
    for (i, control) in ramp.controls.iter().enumerate() {
        let value = control.target();
        if !value.is_finite() {
            let labels = match control {
                Control::Strain(_) => K::STRAIN_LABELS,
                Control::Stress(_) => K::STRESS_LABELS,
            };
            return Err(PointError::NotFinite {
                segment,
                component: labels[i],
                value,
            });
        }
    }
    Ok(())
}
