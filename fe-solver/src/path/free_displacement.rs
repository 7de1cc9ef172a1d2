//! Control of one free displacement.

use super::{Border, PathConstraint};
use crate::error::SolverError;
use crate::stage::Stage;

/// A free displacement grows by the length of the step (mm) while the load factor drives forces.
/// g = du_k - length (Batoz and Dhatt 1979; with a crack opening or a slip: de Borst 1987).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeDisplacement {
    equation: usize,
    length: f64,
}

impl FreeDisplacement {
    /// Controls the free equation `equation`.
    pub const fn new(equation: usize) -> Self {
        Self {
            equation,
            length: 0.0,
        }
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
        gradient[self.equation] = 1.0;
        Border {
            value: du[self.equation] - self.length,
            slope: 0.0,
        }
    }
}
