//! Control of one free displacement.

use fe_core::dof::Dof;
use fe_core::mesh::NodeId;

use super::{Border, PathConstraint, free_equation};
use crate::error::SolverError;
use crate::stage::Stage;

/// A free displacement grows by the length of the step (mm) while the load factor drives forces.
/// g = s du_k - length with the sign s = 1, -1 where it is [reversed](Self::reversed) (Batoz and Dhatt 1979; with a slip:
/// de Borst 1987). For a crack, which opens between two nodes, see [`Opening`](super::Opening).
///
/// The load factor grows where the load moves the displacement that way; a load the other way asks for the reverse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeDisplacement {
    equation: usize,
    sign: f64,
    length: f64,
}

impl FreeDisplacement {
    /// Controls the free equation `equation`, see [`Assembler::equation`](fe_core::assembly::Assembler::equation).
    pub const fn new(equation: usize) -> Self {
        Self {
            equation,
            sign: 1.0,
            length: 0.0,
        }
    }

    /// Controls a DOF of a node.
    ///
    /// # Errors
    ///
    /// [`SolverError::Model`] for a node or DOF that is not there, [`SolverError::Setting`] for one that is prescribed.
    pub fn of(stage: &Stage<'_>, node: NodeId, dof: Dof) -> Result<Self, SolverError> {
        free_equation(stage, node, dof).map(Self::new)
    }

    /// The same with a displacement that falls instead of growing.
    #[must_use]
    pub const fn reversed(mut self) -> Self {
        self.sign = -self.sign;
        self
    }
}

impl PathConstraint for FreeDisplacement {
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        if self.equation >= stage.assembler().free().len() {
            return Err(SolverError::Setting {
                what: "equation of the controlled displacement",
                value: self.equation as f64,
                allowed: "the free equations of the stage",
            });
        }
        self.length = length;
        Ok(())
    }

    fn linearise(&self, du: &[f64], _dlambda: f64, gradient: &mut [f64]) -> Border {
        gradient[self.equation] = self.sign;
        Border {
            value: self.sign * du[self.equation] - self.length,
            slope: 0.0,
        }
    }
}
