//! Control of the load factor.

use super::{Border, PathConstraint};
use crate::error::SolverError;
use crate::stage::Stage;

/// The load factor itself grows by the length of the step: displacement control where the factor
/// drives prescribed displacements, load control where it drives forces. g = dlambda - length.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LoadFactor {
    length: f64,
}

impl PathConstraint for LoadFactor {
    fn begin(&mut self, _stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        self.length = length;
        Ok(())
    }

    fn linearise(&self, _du: &[f64], dlambda: f64, _gradient: &mut [f64]) -> Border {
        Border {
            value: dlambda - self.length,
            slope: 1.0,
        }
    }
}
