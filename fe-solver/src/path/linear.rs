//! What constraints have in common that are linear in the increment.

use super::Border;
use crate::anderson::dot;
use crate::error::SolverError;
use crate::stage::Stage;

/// g = c . du + d dlambda - length.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Linear {
    /// c.
    pub gradient: Vec<f64>,
    /// d.
    pub slope: f64,
    /// What c . du + d dlambda is to reach.
    pub length: f64,
}

impl Linear {
    /// Begins a step of a `length` with the gradient at hand, that of `what`, unless it is one of another stage.
    pub(super) fn begin(
        &mut self,
        what: &'static str,
        stage: &Stage<'_>,
        length: f64,
    ) -> Result<(), SolverError> {
        let equations = stage.assembler().free().len();
        SolverError::length(what, self.gradient.len(), equations)?;
        self.length = length;
        Ok(())
    }

    /// c . du + d dlambda.
    pub(super) fn advance(&self, du: &[f64], dlambda: f64) -> f64 {
        dot(&self.gradient, du) + self.slope * dlambda
    }

    /// Value and derivatives, see [`PathConstraint::linearise`](super::PathConstraint::linearise).
    pub(super) fn linearise(&self, du: &[f64], dlambda: f64, gradient: &mut [f64]) -> Border {
        gradient.copy_from_slice(&self.gradient);
        Border {
            value: self.advance(du, dlambda) - self.length,
            slope: self.slope,
        }
    }
}
