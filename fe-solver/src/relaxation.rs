//! Dynamic relaxation: a damped motion from a state without equilibrium to the next one with it.
//!
//! Explicit motion of fictitious masses at a held load factor, by central differences with time step 1:
//!
//! v' = ((1 - c/2) v + r/m)/(1 + c/2),  u' = u + v',
//!
//! r being the residual of the inviscid law, whose history follows every step. The masses are m_i = f sum_j |K_ij|/4
//! of the elastic stiffness: by Gershgorin's theorem the highest frequency is then below the limit of stability,
//! 2, for f >= 1. The damping is critical for the mode that moves, c = 2 omega, with Rayleigh's quotient
//! omega^2 = v . dK v/(v . m v) taken from the residuals (adaptive dynamic relaxation, Underwood 1983).
//!
//! Nothing is factorised and nothing can diverge as long as the law does not create energy.

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;

use crate::error::SolverError;
use crate::stage::{Residual, Stage};

/// Settings of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxationSettings {
    /// Time steps before it is given up.
    pub max_steps: usize,
    /// Factor on the fictitious masses over those at the limit of stability.
    pub mass_factor: f64,
    /// Least damping ratio of a time step, 2 xi omega dt.
    pub least_damping: f64,
}

impl Default for RelaxationSettings {
    fn default() -> Self {
        Self {
            max_steps: 12_000,
            mass_factor: 1.3,
            least_damping: 2e-3,
        }
    }
}

/// The motion, see the [module documentation](self).
#[derive(Debug)]
pub(crate) struct DynamicRelaxation {
    settings: RelaxationSettings,
    mass: Vec<f64>,
    velocity: Vec<f64>,
    residual: Vec<f64>,
}

impl DynamicRelaxation {
    /// At rest in the displacement `free`; the masses are those of the undamaged model.
    pub(crate) fn at_rest(
        stage: &mut Stage<'_>,
        settings: RelaxationSettings,
        free: &[f64],
        lambda: f64,
    ) -> Result<Self, SolverError> {
        let factor = 0.25 * settings.mass_factor;
        let sums = stage.elastic_row_sums()?;
        let mut relaxation = Self {
            mass: sums.iter().map(|s| factor * s).collect(),
            velocity: vec![0.0; free.len()],
            residual: Vec::new(),
            settings,
        };
        relaxation.residual = Self::evaluate(stage, free, lambda)?;
        Ok(relaxation)
    }

    fn evaluate(stage: &mut Stage<'_>, free: &[f64], lambda: f64) -> Result<Vec<f64>, SolverError> {
        let u = stage.compose(free, lambda);
        let r = stage.residual(&u, lambda, &EvaluationContext::new(Operator::None))?;
        stage.advance();
        Ok(r)
    }

    /// Moves on from `free` until the residual is below `target` or `steps` time steps are spent; returns the residual
    /// there and the steps made.
    pub(crate) fn run(
        &mut self,
        stage: &mut Stage<'_>,
        free: &mut [f64],
        lambda: f64,
        target: f64,
        steps: usize,
    ) -> Result<(Residual, usize), SolverError> {
        let mut damping = self.settings.least_damping;
        let mut size = stage.measure(&self.residual);
        for step in 0..steps {
            if size.relative <= target {
                return Ok((size, step));
            }
            let (keep, scale) = (1.0 - 0.5 * damping, 1.0 / (1.0 + 0.5 * damping));
            let mut inertia = 0.0;
            for i in 0..free.len() {
                let v = scale * (keep * self.velocity[i] + self.residual[i] / self.mass[i]);
                self.velocity[i] = v;
                free[i] += v;
                inertia += self.mass[i] * v * v;
            }
            let r = Self::evaluate(stage, free, lambda)?;
            let stiffness: f64 = (0..free.len())
                .map(|i| self.velocity[i] * (self.residual[i] - r[i]))
                .sum();
            self.residual = r;
            size = stage.measure(&self.residual);
            if inertia > 0.0 {
                let omega = (stiffness / inertia).max(0.0).sqrt();
                damping = (2.0 * omega).clamp(self.settings.least_damping, 1.0);
            }
        }
        Ok((size, steps))
    }
}
