//! Displacement control of forces.

use super::linear::Linear;
use super::{Border, PathConstraint, reference_forces};
use crate::error::SolverError;
use crate::stage::Stage;

/// The displacement that the reference forces f work on grows by the length of the step (mm).
/// g = f . du/sum |f| - length: displacement control of a load that is spread over nodes.
///
/// Where nodal forces differ in sign, as those of an even pressure on a face of a `Hex20` at its corners do, sum |f| exceeds the
/// load, and its points move further than the length by that ratio (5/3 for that pressure).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LoadedDisplacement(Linear);

impl PathConstraint for LoadedDisplacement {
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        let mut weights = reference_forces(stage)?;
        let sum: f64 = weights.iter().map(|f| f.abs()).sum();
        for f in &mut weights {
            *f /= sum;
        }
        self.0.gradient = weights;
        self.0.length = length;
        Ok(())
    }

    fn linearise(&self, du: &[f64], dlambda: f64, gradient: &mut [f64]) -> Border {
        self.0.linearise(du, dlambda, gradient)
    }
}
