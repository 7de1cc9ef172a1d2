//! Control of the distance that two nodes move apart.

use fe_core::dof::Dof;
use fe_core::mesh::NodeId;

use super::linear::Linear;
use super::{Border, PathConstraint, free_equation};
use crate::error::SolverError;
use crate::stage::Stage;

/// The difference of two free displacements grows by the length of the step (mm) while the load factor drives forces:
/// g = du_b - du_a - length, as the opening or the slip of a crack between the nodes a and b (de Borst 1987).
#[derive(Debug, Clone, PartialEq)]
pub struct Opening(Linear);

impl Opening {
    /// Controls how far the second of two nodes moves from the first, each along its DOF.
    ///
    /// # Errors
    ///
    /// [`SolverError::Model`] for a node or DOF that is not there, [`SolverError::Setting`] for one that is prescribed, or the
    /// same twice.
    pub fn between(stage: &Stage<'_>, [from, to]: [(NodeId, Dof); 2]) -> Result<Self, SolverError> {
        let from = free_equation(stage, from.0, from.1)?;
        let to = free_equation(stage, to.0, to.1)?;
        SolverError::setting(
            ("equation of both displacements of an opening", to as f64),
            "two different ones",
            from != to,
        )?;
        let mut gradient = vec![0.0; stage.assembler().free().len()];
        (gradient[from], gradient[to]) = (-1.0, 1.0);
        Ok(Self(Linear {
            gradient,
            ..Linear::default()
        }))
    }
}

impl PathConstraint for Opening {
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        self.0.begin("opening", stage, length)
    }

    fn linearise(&self, du: &[f64], dlambda: f64, gradient: &mut [f64]) -> Border {
        self.0.linearise(du, dlambda, gradient)
    }
}
