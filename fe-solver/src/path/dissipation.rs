//! Control of the energy that a step dissipates.

use super::linear::Linear;
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
pub struct Dissipation(Linear);

impl PathConstraint for Dissipation {
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        let mut forces = reference_forces(stage)?;
        self.0.slope = -0.5 * dot(&forces, &stage.restrict(stage.displacement()));
        for f in &mut forces {
            *f *= 0.5 * stage.lambda();
        }
        SolverError::setting(
            (
                "load factor where control of the dissipation begins",
                stage.lambda(),
            ),
            "not at rest, where nothing dissipates: begin with another constraint",
            self.0.slope != 0.0 || forces.iter().any(|f| *f != 0.0),
        )?;
        self.0.gradient = forces;
        self.0.length = length;
        Ok(())
    }

    fn extrapolate(&self, du: &[f64], dlambda: f64) -> Option<f64> {
        let dissipated = self.0.advance(du, dlambda);
        (dissipated > 0.0).then(|| self.0.length / dissipated)
    }

    fn linearise(&self, du: &[f64], dlambda: f64, gradient: &mut [f64]) -> Border {
        self.0.linearise(du, dlambda, gradient)
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
    /// `lambda`.
    ///
    /// # Errors
    ///
    /// [`SolverError::Setting`] if the load factor drives displacements, [`SolverError::Mismatch`] for a `u` of another model.
    pub fn to(stage: &Stage<'_>, u: &[f64], lambda: f64) -> Result<Self, SolverError> {
        SolverError::length("displacement", u.len(), stage.displacement().len())?;
        let start = stage.restrict(stage.displacement());
        let du = difference(&stage.restrict(u), &start);
        let from = (start.as_slice(), stage.lambda());
        Self::of(stage, from, (&du, lambda - stage.lambda()))
    }

    /// Energies of the increment that led to the accepted state; none before the first step and after a snap.
    ///
    /// # Errors
    ///
    /// [`SolverError::Setting`] if the load factor drives displacements.
    pub fn last(stage: &Stage<'_>) -> Result<Option<Self>, SolverError> {
        let Some((du, dlambda)) = stage.previous() else {
            return Ok(None);
        };
        let du = stage.restrict(du);
        let start = difference(&stage.restrict(stage.displacement()), &du);
        let from = (start.as_slice(), stage.lambda() - dlambda);
        Self::of(stage, from, (&du, dlambda)).map(Some)
    }

    fn of(
        stage: &Stage<'_>,
        (start, lambda): (&[f64], f64),
        (du, dlambda): (&[f64], f64),
    ) -> Result<Self, SolverError> {
        let forces = reference_forces(stage)?;
        let along = dot(&forces, du);
        Ok(Self {
            work: (lambda + 0.5 * dlambda) * along,
            dissipated: 0.5 * (lambda * along - dlambda * dot(&forces, start)),
        })
    }
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
