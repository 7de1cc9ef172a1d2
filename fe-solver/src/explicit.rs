//! Explicit quasi-static integration with fictitious masses: a path without equilibrium iterations, to check others by.
//!
//! The free equations move as a damped system in a time of its own,
//!
//! M a + 2 xi omega_1 M v = f_ext - f_int,  m_i = sum_j |K_ij|,
//!
//! with K the elastic stiffness, that of the virgin model: what has cracked by the start may close again. By Gershgorin's theorem no frequency exceeds 1, so that central differences are stable up
//! to a time step of 2 (Belytschko, Liu and Moran 2000, section 6.2; fictitious masses: Underwood 1983). omega_1 is the
//! Rayleigh quotient of the elastic shape under the load. The load factor grows at a rate of so many periods of omega_1
//! per unit. History is kept after every time step: a snap runs its course while the load goes on, slowed by inertia.
//!
//! A step reports the mean internal forces over its time steps, the largest kinetic energy as a share of the work done so
//! far, and the true unbalanced force at its end; it is never taken for an equilibrium.

use std::f64::consts::TAU;

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;

use crate::driver::{Attempt, Driver, IterationLog, Means, Request};
use crate::error::SolverError;
use crate::stage::Stage;

/// Settings of [`Explicit`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExplicitSettings {
    /// Periods of the lowest frequency per unit of the load factor, 1e6 at most.
    pub periods: f64,
    /// Damping xi of the lowest frequency, of critical.
    pub damping: f64,
    /// Time step; stable below 2. Not below 1e-3, with which a run would hardly end.
    pub time_step: f64,
    /// Periods in which the speed of the load factor grows e-fold, from 1/20 of the full one: that is reached after ln 20,
    /// three, times as many.
    pub ramp: f64,
}

impl Default for ExplicitSettings {
    fn default() -> Self {
        Self {
            periods: 7.0,
            damping: 0.15,
            time_step: 1.8,
            ramp: 1.0,
        }
    }
}

/// Most periods per unit of the load factor: a motion of more would not end.
const MAX_PERIODS: f64 = 1e6;

/// Shortest time step.
const LEAST_TIME_STEP: f64 = 1e-3;

/// Share of its speed with which the load factor starts.
const FIRST_SPEED: f64 = 0.05;

/// Largest displacement (mm) at which the elastic shape is tried.
const TOUCH: f64 = 1e-6;

/// The moving system.
#[derive(Debug, Clone, Default)]
struct Motion {
    /// Fictitious masses of the free equations.
    mass: Vec<f64>,
    omega: f64,
    velocity: Vec<f64>,
    /// Work of the internal forces so far (N mm).
    work: f64,
    /// Load factor passed.
    passed: f64,
}

/// Explicit quasi-static integration.
#[derive(Debug, Clone, Default)]
pub struct Explicit {
    settings: ExplicitSettings,
    /// At the last step known to be accepted.
    motion: Motion,
    /// At the end of the last attempt, not yet known to be accepted.
    pending: Option<Motion>,
}

impl Explicit {
    /// A driver with the given settings.
    ///
    /// # Errors
    ///
    /// [`SolverError::Setting`] for periods outside (0, 1e6], a ramp that is no positive number, a damping outside [0, 1] or a
    /// time step outside [1e-3, 2).
    pub fn new(settings: ExplicitSettings) -> Result<Self, SolverError> {
        let ExplicitSettings {
            periods,
            damping,
            time_step,
            ramp,
        } = settings;
        let fits = periods > 0.0 && periods <= MAX_PERIODS;
        SolverError::setting(("periods", periods), "(0, 1e6]", fits)?;
        let fits = (0.0..=1.0).contains(&damping);
        SolverError::setting(("damping", damping), "[0, 1]", fits)?;
        let fits = (LEAST_TIME_STEP..2.0).contains(&time_step);
        SolverError::setting(("time_step", time_step), "[1e-3, 2)", fits)?;
        SolverError::positive("ramp", ramp)?;
        Ok(Self {
            settings,
            ..Self::default()
        })
    }

    /// Masses from the stiffness of the virgin model, or that at the accepted state where it is larger, and lowest frequency
    /// from the latter; at rest.
    fn start(stage: &mut Stage<'_>) -> Result<Motion, SolverError> {
        let u = stage.displacement().to_vec();
        let virgin = stage.virgin_row_sums()?;
        let operator = EvaluationContext::new(Operator::Secant);
        stage.residual(&u, stage.lambda(), &operator)?;
        let present = stage.absolute_row_sums();
        let mass: Vec<f64> = virgin.iter().zip(present).map(|(v, p)| v.max(p)).collect();
        stage.factorise()?;
        let mut shape = stage.reference_load();
        stage.solve(&mut shape)?;
        // Strain energy of the elastic shape, that at moving DOFs included: with these held the beam would look stiffer.
        let before = stage.internal().to_vec();
        let largest = shape.iter().map(|s| s.abs()).fold(1.0, f64::max);
        let small = TOUCH / largest;
        let mut free = stage.restrict(&u);
        free.iter_mut()
            .zip(&shape)
            .for_each(|(u, s)| *u += small * s);
        let touched = stage.compose(&free, stage.lambda() + small);
        stage.residual(
            &touched,
            stage.lambda() + small,
            &EvaluationContext::new(Operator::None),
        )?;
        let work = |d: usize| (stage.internal()[d] - before[d]) * (touched[d] - u[d]);
        let stiff = (0..u.len()).map(work).sum::<f64>() / small.powi(2);
        let heavy: f64 = shape.iter().zip(&mass).map(|(s, m)| m * s * s).sum();
        let omega = (stiff / heavy).sqrt();
        stage.roll_back();
        if !(omega.is_finite() && omega > 0.0) {
            return Err(SolverError::Setting {
                what: "lowest frequency under the load",
                value: omega,
                allowed: "(0, 1]: the load factor must load or move something",
            });
        }
        Ok(Motion {
            velocity: vec![0.0; mass.len()],
            mass,
            omega,
            work: 0.0,
            passed: 0.0,
        })
    }
}

impl Driver for Explicit {
    fn name(&self) -> &'static str {
        "explicit quasi-static"
    }

    fn balances(&self) -> bool {
        false
    }

    /// A motion begins at rest, also where another driver has led to.
    fn begin(&mut self) {
        (self.motion, self.pending) = (Motion::default(), None);
    }

    fn attempt(
        &mut self,
        stage: &mut Stage<'_>,
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        let s = self.settings;
        self.pending = None;
        let equations = stage.assembler().free().len();
        if self.motion.mass.is_empty() || self.motion.mass.len() != equations {
            self.motion = Self::start(stage)?;
        }
        let mut motion = self.motion.clone();
        let period = TAU / (motion.omega * s.time_step);
        let full = 1.0 / (s.periods * period);
        let drag = s.damping * motion.omega * s.time_step;
        let force = EvaluationContext::new(Operator::None);
        let mut u = stage.displacement().to_vec();
        let mut free = stage.restrict(&u);
        let (mut lambda, mut left) = (stage.lambda(), request.length);
        let mut sum = vec![0.0; u.len()];
        let (mut kinetic, mut count) = (0.0_f64, 0);
        while left > 0.0 {
            let residual = stage.residual(&u, lambda, &force)?;
            stage.advance();
            let mut energy = 0.0;
            for (i, r) in residual.iter().enumerate() {
                let pull = s.time_step * r / motion.mass[i];
                let v = ((1.0 - drag) * motion.velocity[i] + pull) / (1.0 + drag);
                energy += 0.5 * motion.mass[i] * v * v;
                motion.velocity[i] = v;
                free[i] += s.time_step * v;
            }
            let gathered = motion.passed * s.periods / s.ramp;
            let speed = (FIRST_SPEED + gathered).min(1.0);
            // The last time step ends where the step does.
            let advance = (speed * full).min(left);
            left -= advance;
            motion.passed += advance;
            lambda += advance;
            let next = stage.compose(&free, lambda);
            for (d, q) in stage.internal().iter().enumerate() {
                motion.work += q * (next[d] - u[d]);
                sum[d] += q;
            }
            u = next;
            kinetic = kinetic.max(energy);
            count += 1;
        }
        let residual = stage.residual(&u, lambda, &force)?;
        let residual = stage.measure(&residual);
        log(&residual, 1.0)?;
        let finite = residual.relative.is_finite();
        let share = kinetic / motion.work.abs().max(f64::MIN_POSITIVE);
        if finite {
            self.pending = Some(motion);
        }
        let mean = sum.iter().map(|q| q / f64::from(count)).collect();
        Ok(Attempt {
            displacement: u,
            lambda,
            converged: finite,
            residual,
            iterations: count as usize,
            held: false,
            means: Some(Means {
                internal: mean,
                kinetic: share,
            }),
            lag: None,
        })
    }

    fn accepted(&mut self) {
        if let Some(motion) = self.pending.take() {
            self.motion = motion;
        }
    }

    fn memory(&self) -> Vec<f64> {
        let Motion {
            mass,
            omega,
            velocity,
            work,
            passed,
        } = &self.motion;
        let scalars = [*omega, *work, *passed];
        scalars
            .iter()
            .chain(mass)
            .chain(velocity)
            .copied()
            .collect()
    }

    fn recall(&mut self, memory: &[f64]) {
        let Some(([omega, work, passed], rest)) = memory.split_first_chunk() else {
            return;
        };
        let (mass, velocity) = rest.split_at(rest.len() / 2);
        self.pending = None;
        self.motion = Motion {
            mass: mass.to_vec(),
            omega: *omega,
            velocity: velocity.to_vec(),
            work: *work,
            passed: *passed,
        };
    }
}
