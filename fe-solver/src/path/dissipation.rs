//! Control of the energy that a step dissipates.

use super::{Border, PathConstraint, reference_forces};
use crate::anderson::dot;
use crate::error::SolverError;
use crate::stage::Stage;

/// A step dissipates the energy `length` (N mm): g = 1/2 f . (lambda_0 du - dlambda u_0) - length, with the reference
/// forces f and the accepted state u_0, lambda_0 (Gutierrez 2004, eq. 9; Verhoosel, Remmers and Gutierrez 2009).
///
/// Valid where laws unload along the secant, so that the stored energy is 1/2 lambda f . u, under forces that grow from
/// an unloaded state. An elastic path dissipates nothing and cannot be followed: start with another constraint.
/// Through limit points and snaps back it needs no choice of sign, and it cannot unload elastically.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Dissipation {
    /// 1/2 lambda_0 f.
    gradient: Vec<f64>,
    /// -1/2 f . u_0.
    slope: f64,
    length: f64,
}

impl PathConstraint for Dissipation {
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        let mut forces = reference_forces(stage)?;
        self.slope = -0.5 * dot(&forces, &stage.restrict(stage.displacement()));
        for f in &mut forces {
            *f *= 0.5 * stage.lambda();
        }
        self.gradient = forces;
        self.length = length;
        Ok(())
    }

    fn extrapolate(&self, du: &[f64], dlambda: f64) -> Option<f64> {
        let dissipated = dot(&self.gradient, du) + self.slope * dlambda;
        (dissipated > 0.0).then(|| self.length / dissipated)
    }

    fn linearise(&self, du: &[f64], dlambda: f64, gradient: &mut [f64]) -> Border {
        gradient.copy_from_slice(&self.gradient);
        Border {
            value: dot(&self.gradient, du) + self.slope * dlambda - self.length,
            slope: self.slope,
        }
    }
}

/// Energies (N mm) of an increment under reference forces, for laws that unload along the secant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energies {
    /// Work of the forces: (lambda_0 + 1/2 dlambda) f . du.
    pub work: f64,
    /// What of it is dissipated: 1/2 f . (lambda_0 du - dlambda u_0).
    pub dissipated: f64,
}

impl Energies {
    /// Energies of the increment from the accepted state of a stage to `u` (all DOFs, mm) at the load factor
    /// `lambda`; to the accepted state from the one before, if there is one and `u` is `None`.
    ///
    /// # Errors
    ///
    /// [`SolverError::Setting`] if the load factor drives displacements.
    pub fn of(stage: &Stage<'_>, to: Option<(&[f64], f64)>) -> Result<Option<Self>, SolverError> {
        let forces = reference_forces(stage)?;
        let here = stage.restrict(stage.displacement());
        let (du, dl, start, lambda) = match (to, stage.previous()) {
            (Some((u, lambda)), _) => {
                let du: Vec<f64> = stage
                    .restrict(u)
                    .iter()
                    .zip(&here)
                    .map(|(a, b)| a - b)
                    .collect();
                (du, lambda - stage.lambda(), here, stage.lambda())
            }
            (None, Some((du, dl))) => {
                let du = stage.restrict(du);
                let start = here.iter().zip(&du).map(|(a, b)| a - b).collect();
                (du, dl, start, stage.lambda() - dl)
            }
            (None, None) => return Ok(None),
        };
        let along = dot(&forces, &du);
        Ok(Some(Self {
            work: (lambda + 0.5 * dl) * along,
            dissipated: 0.5 * (lambda * along - dl * dot(&forces, &start)),
        }))
    }
}
