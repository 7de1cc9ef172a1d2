//! The contract of a driver: how one step is brought to equilibrium.

use std::fmt::Debug;

use serde::{Deserialize, Serialize};

use crate::error::SolverError;
use crate::stage::{Residual, Stage};

/// What a driver reports of each iteration: residual and line-search factor.
pub type IterationLog<'a> = dyn FnMut(&Residual, f64) -> Result<(), SolverError> + 'a;

/// What is asked of an attempt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Length of the step along the path: the increment of the load factor, unless a path constraint says otherwise.
    pub length: f64,
    /// Relative residual to reach.
    pub criterion: f64,
    /// Whether the step will not be shortened any more.
    pub last_resort: bool,
}

/// What a driver that follows a motion, not equilibria, reports of a step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Means {
    /// Internal force (N) on all DOFs, mean over the step.
    pub internal: Vec<f64>,
    /// Largest kinetic energy of the step over the work done so far.
    pub kinetic: f64,
}

/// What a driver whose laws lag behind reports of a step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Lag {
    /// Share of the growth of histories that was admitted, see
    /// [`EvaluationContext::relaxation`](fe_core::element::EvaluationContext::relaxation).
    pub relaxation: f64,
    /// Work of the viscous excess of stress over the work done, both of the run up to here.
    pub viscous: f64,
}

/// Result of one attempt at a step. The trial state of the stage is that of `displacement`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Attempt {
    /// Displacement of all DOFs (mm); the best iterate if the attempt did not converge.
    pub displacement: Vec<f64>,
    /// Load factor.
    pub lambda: f64,
    /// Whether the criterion was met.
    pub converged: bool,
    /// Residual of the law; where histories lag behind, of the law without viscosity.
    pub residual: Residual,
    /// Iterations spent, what was taken back on the way included: what the step control goes by.
    pub iterations: usize,
    /// Whether the step passed a snap at a held load factor.
    pub held: bool,
    /// Of a motion; none where the step ends in equilibrium.
    pub means: Option<Means>,
    /// Of laws that lag behind.
    pub lag: Option<Lag>,
}

impl Attempt {
    /// Refuses one of another model, and a converged one with what is no number.
    pub(crate) fn check(&self, stage: &Stage<'_>) -> Result<(), SolverError> {
        let u = &self.displacement;
        let dofs = stage.displacement().len();
        SolverError::length("displacement of an attempt", u.len(), dofs)?;
        if !self.converged {
            return Ok(());
        }
        SolverError::number("load factor of an attempt", self.lambda)?;
        let Residual {
            relative, worst, ..
        } = self.residual;
        if !relative.is_finite() {
            let what = format!("relative residual, worst at {}", stage.describe(worst));
            return SolverError::number(&what, relative);
        }
        u.iter().enumerate().try_for_each(|(dof, &u)| {
            if u.is_finite() {
                return Ok(());
            }
            SolverError::number(&format!("{} (mm)", stage.describe(dof)), u)
        })
    }
}

/// Brings one step to equilibrium, starting from the accepted state of a stage.
pub trait Driver: Debug + Send {
    /// Name, for output.
    fn name(&self) -> &'static str;

    /// Whether its steps end in equilibrium of the laws as they are. Elsewhere the work of the internal forces is not that of
    /// the loads, and the energies of a step say nothing.
    fn balances(&self) -> bool {
        true
    }

    /// A [run](crate::control::StepControl::run) begins, perhaps of another stage: what was found in an earlier one is to
    /// be forgotten.
    fn begin(&mut self) {}

    /// Tries a step.
    ///
    /// # Errors
    ///
    /// [`SolverError`]; a recoverable one asks for a shorter step.
    fn attempt(
        &mut self,
        stage: &mut Stage<'_>,
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError>;

    /// The last attempt is accepted; one that is not so told before the next has not happened.
    fn accepted(&mut self) {}

    /// What the driver keeps of the accepted steps beside the state of the stage, for [`Self::recall`].
    fn memory(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Takes back what [`Self::memory`] gave after the same step of an earlier run.
    fn recall(&mut self, _memory: &[f64]) {}

    /// What the driver has decided since it was last asked, with the reasons.
    fn notes(&mut self) -> Vec<String> {
        Vec::new()
    }
}
