//! What stops an analysis.

use fe_core::dof::Dof;
use fe_core::mesh::NodeId;
use fe_core::model::ModelError;

use crate::linear::LinearError;

/// Why an analysis could not go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolverError {
    /// The model could not be evaluated.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The linear solver failed for a reason that is not the model's.
    #[error("linear solver: {0}")]
    Linear(LinearError),
    /// The model can move without resistance.
    #[error(
        "the stiffness is singular at {dof} of node {node} at {position:?} mm (pivot ratio {ratio:.1e}): \
         the model, or a part of it, is not held there; add a support or connect the part, or, if it has just come \
         loose, end before"
    )]
    Singular {
        /// Node.
        node: NodeId,
        /// DOF.
        dof: Dof,
        /// Position of the node (mm).
        position: [f64; 3],
        /// Pivot over the diagonal entry it came from.
        ratio: f64,
    },
    /// An entry of the stiffness is NaN or infinite.
    #[error(
        "the stiffness is not finite at {at}: an element there, or its law, gives no number; fe_core::testing checks both"
    )]
    NotFinite {
        /// Node and DOF.
        at: String,
    },
    /// No stiffness has been evaluated that could be factorised, or no forces that could be weighed.
    #[error(
        "no stiffness has been evaluated yet, or the evaluation failed: ask Stage::residual for an operator, tangent or \
         secant, first; for energies, for forces"
    )]
    NotEvaluated,
    /// A driver gives no number, or an iteration has left the range of numbers.
    #[error(
        "{what} = {value}; allowed: finite numbers; try shorter steps, and check the driver if it is your own"
    )]
    NoNumber {
        /// Quantity, and where.
        what: String,
        /// Value.
        value: f64,
    },
    /// No step could be completed, not even the shortest.
    #[error(
        "no convergence at load factor {lambda:.6} with the shortest step {step:.3e}: relative residual \
         {residual:.2e} after {iterations} iterations (allowed {tolerance:.1e}); worst at {worst}; try \
         shorter steps, another mesh or another driver"
    )]
    NoConvergence {
        /// Load factor of the last accepted step.
        lambda: f64,
        /// Step tried last.
        step: f64,
        /// Relative residual reached.
        residual: f64,
        /// Tolerance.
        tolerance: f64,
        /// Iterations spent in the last attempt.
        iterations: usize,
        /// Node and DOF of the largest residual.
        worst: String,
    },
    /// A step, even the shortest, creates energy.
    #[error(
        "the shortest step {step:.3e} from load factor {lambda:.6} creates energy: it dissipates {dissipated:.3e} N mm \
         while {work:.3e} N mm of work are done on the model; try shorter steps or another driver, and let laws and elements that do not unload to \
         the origin along the secant state their free energy"
    )]
    CreatesEnergy {
        /// Load factor of the last accepted step.
        lambda: f64,
        /// Step tried last.
        step: f64,
        /// Dissipation of the step (N mm), negative.
        dissipated: f64,
        /// Work of the internal forces (N mm).
        work: f64,
    },
    /// A recorder could not write.
    #[error("cannot write results: {0}")]
    Output(#[from] std::io::Error),
    /// A journal does not belong to this model, these settings or this machine.
    #[error(
        "step {step} of the earlier run does not lead where it led then ({what}): it belongs to another model, \
         version or machine; run it again from the start"
    )]
    Journal {
        /// Step, counted from 1.
        step: usize,
        /// What differs.
        what: String,
    },
    /// A setting is impossible.
    #[error("{what} = {value}; allowed: {allowed}")]
    Setting {
        /// Setting.
        what: &'static str,
        /// Value.
        value: f64,
        /// Allowed range.
        allowed: &'static str,
    },
    /// What is given belongs to another model.
    #[error(
        "{what} of length {found} for a model that asks for {expected}: build it from the same model"
    )]
    Mismatch {
        /// What is given.
        what: &'static str,
        /// Its length.
        found: usize,
        /// Length that fits the model.
        expected: usize,
    },
}

impl SolverError {
    /// Refuses a setting that does not fit.
    pub(crate) const fn setting(
        (what, value): (&'static str, f64),
        allowed: &'static str,
        fits: bool,
    ) -> Result<(), Self> {
        if fits {
            return Ok(());
        }
        Err(Self::Setting {
            what,
            value,
            allowed,
        })
    }

    /// Refuses what is no number.
    pub(crate) fn number(what: &str, value: f64) -> Result<(), Self> {
        if value.is_finite() {
            return Ok(());
        }
        let what = what.into();
        Err(Self::NoNumber { what, value })
    }

    /// Refuses a setting that is no positive number.
    pub(crate) fn positive(what: &'static str, value: f64) -> Result<(), Self> {
        Self::setting((what, value), "(0, inf)", value.is_finite() && value > 0.0)
    }

    /// Refuses what is not of the length that the model asks for.
    pub(crate) const fn length(
        what: &'static str,
        found: usize,
        expected: usize,
    ) -> Result<(), Self> {
        if found == expected {
            return Ok(());
        }
        Err(Self::Mismatch {
            what,
            found,
            expected,
        })
    }

    /// Whether a shorter step may cure it: a part that has just come loose leaves the stiffness singular, too.
    pub fn is_recoverable(&self) -> bool {
        match self {
            Self::Model(e) => e.is_recoverable(),
            Self::Singular { .. } | Self::NotFinite { .. } | Self::NoNumber { .. } => true,
            _ => false,
        }
    }
}
