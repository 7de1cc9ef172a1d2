//! Path constraints: the equation that borders the system and fixes the load factor.

mod arc_length;
mod dissipated_energy;
mod dissipation;
mod free_displacement;
mod linear;
mod load_factor;
mod loaded_displacement;
mod mode;
mod opening;

use std::fmt::Debug;

use fe_core::dof::Dof;
use fe_core::mesh::NodeId;

use crate::error::SolverError;
use crate::stage::Stage;

pub use arc_length::ArcLength;
pub use dissipated_energy::DissipatedEnergy;
pub use dissipation::{Dissipation, Energies};
pub use free_displacement::FreeDisplacement;
pub use load_factor::LoadFactor;
pub use loaded_displacement::LoadedDisplacement;
pub use mode::Mode;
pub use opening::Opening;

/// Linearisation of a path constraint g(du, dlambda) = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Border {
    /// Value of g.
    pub value: f64,
    /// Derivative of g with respect to the load factor.
    pub slope: f64,
}

/// One scalar equation g(du, dlambda) = 0 on the increment of a step, with du the free part (mm).
///
/// With K du_r = r and K du_q = q, the correction of the bordered system is
/// d lambda = -(g + c . du_r)/(d + c . du_q), du = du_r + d lambda du_q, where c and d are the
/// derivatives of g (Batoz and Dhatt 1979).
pub trait PathConstraint: Debug + Send {
    /// Starts a step of the given length from the accepted state of a stage.
    ///
    /// # Errors
    ///
    /// [`SolverError::Setting`] where the constraint means nothing to the stage.
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError>;

    /// Share of the last increment of the stage, `du` (free part, mm) and `dlambda`, at which the iteration starts; none
    /// where it starts from the accepted state, whose tangent is that of unloading in some laws.
    fn extrapolate(&self, _du: &[f64], _dlambda: f64) -> Option<f64> {
        None
    }

    /// Looks at the increment so far, for constraints that must evaluate the model to know themselves. Correction du_r and
    /// response du_q are the `directions` in which their gradient will be asked for.
    ///
    /// # Errors
    ///
    /// [`SolverError`] when the model cannot be evaluated there.
    fn observe(
        &mut self,
        _stage: &mut Stage<'_>,
        _increment: (&[f64], f64),
        _directions: [&[f64]; 2],
    ) -> Result<(), SolverError> {
        Ok(())
    }

    /// Value and derivatives at the increment so far; writes dg/du into `gradient`, zeroed before. At a zero
    /// increment it is the predictor that is asked for.
    fn linearise(&self, du: &[f64], dlambda: f64, gradient: &mut [f64]) -> Border;
}

/// Free equation of a DOF of a node.
///
/// # Errors
///
/// [`SolverError::Model`] for a node or DOF that is not there, [`SolverError::Setting`] for one that is prescribed.
fn free_equation(stage: &Stage<'_>, node: NodeId, dof: Dof) -> Result<usize, SolverError> {
    let index = stage.model().dof(node, dof)?;
    let equation = stage.assembler().equation(index);
    equation.ok_or(SolverError::Setting {
        what: "node whose displacement is controlled",
        value: node as f64,
        allowed: "nodes whose displacement is free in that direction",
    })
}

/// Reference forces f (N) of a stage on its free equations.
///
/// # Errors
///
/// [`SolverError::Setting`] if the load factor drives displacements, or nothing.
fn reference_forces(stage: &Stage<'_>) -> Result<Vec<f64>, SolverError> {
    let driven = stage.conditions().prescribed().values();
    let driven = driven.filter(|rate| **rate != 0.0).count();
    if driven > 0 {
        return Err(SolverError::Setting {
            what: "number of displacements that the load factor drives, under a constraint on forces",
            value: driven as f64,
            allowed: "0",
        });
    }
    let forces = stage.restrict(stage.conditions().reference());
    if forces.iter().all(|f| *f == 0.0) {
        return Err(SolverError::Setting {
            what: "largest reference force (N) on a free equation",
            value: 0.0,
            allowed: "(0, inf)",
        });
    }
    Ok(forces)
}
