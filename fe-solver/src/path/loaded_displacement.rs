//! Displacement control of forces.

use super::{Border, PathConstraint, reference_forces};
use crate::anderson::dot;
use crate::error::SolverError;
use crate::stage::Stage;

/// The displacement that the reference forces f work on grows by the length of the step (mm).
/// g = f . du/sum |f| - length: displacement control of a load that is spread over nodes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LoadedDisplacement {
    weights: Vec<f64>,
    length: f64,
}

impl PathConstraint for LoadedDisplacement {
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        self.weights = reference_forces(stage)?;
        let sum: f64 = self.weights.iter().map(|f| f.abs()).sum();
        for f in &mut self.weights {
            *f /= sum;
        }
        self.length = length;
        Ok(())
    }

    fn linearise(&self, du: &[f64], _dlambda: f64, gradient: &mut [f64]) -> Border {
        gradient.copy_from_slice(&self.weights);
        Border {
            value: dot(&self.weights, du) - self.length,
            slope: 0.0,
        }
    }
}
