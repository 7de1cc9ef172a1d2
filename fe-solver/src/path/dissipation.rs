//! Control of the energy that a step dissipates.

use super::linear::Linear;
use super::{Border, PathConstraint, reference_forces};
use crate::anderson::dot;
use crate::error::SolverError;
use crate::stage::Stage;

/// A step dissipates the energy `length` (N mm): g = 1/2 (f_d + lambda_0 f) . du - 1/2 dlambda f . u_0 - length, with the dead
/// loads f_d, the reference forces f and the accepted state u_0, lambda_0 (Gutierrez 2004, eq. 9; Verhoosel, Remmers and
/// Gutierrez 2009; there without dead loads).
///
/// Valid where laws unload along the secant, so that the stored energy is 1/2 (f_d + lambda f) . u, in a model that was at rest
/// without forces and whose held DOFs are where they were then: else [`DissipatedEnergy`](super::DissipatedEnergy) serves. An elastic path dissipates nothing and cannot be followed: start with another constraint.
/// Through limit points and snaps back it needs no choice of sign, and it cannot unload elastically.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Dissipation {
    plane: Linear,
    /// Largest of the terms of which the dissipation of the last step is the difference (N mm).
    terms: f64,
}

/// Share of the terms of which a dissipation is the difference, below which it is rounding.
const NOISE: f64 = 1e-9;

impl PathConstraint for Dissipation {
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        let (dead, reference) = applied(stage)?;
        let at = stage.restrict(stage.displacement());
        let slope = -0.5 * dot(&reference, &at);
        let present = dead.iter().zip(&reference);
        let half: Vec<f64> = present
            .map(|(d, f)| 0.5 * (d + stage.lambda() * f))
            .collect();
        self.terms = stage.previous().map_or(0.0, |(du, dlambda)| {
            let along = dot(&half, &stage.restrict(du));
            along.abs().max((slope * dlambda).abs())
        });
        SolverError::setting(
            (
                "load factor where control of the dissipation begins",
                stage.lambda(),
            ),
            "not at rest, where nothing dissipates: begin with another constraint",
            slope != 0.0 || half.iter().any(|f| *f != 0.0),
        )?;
        self.plane = Linear {
            gradient: half,
            slope,
            length,
        };
        Ok(())
    }

    fn extrapolate(&self, du: &[f64], dlambda: f64) -> Option<f64> {
        let dissipated = self.plane.advance(du, dlambda);
        (dissipated > NOISE * self.terms).then(|| self.plane.length / dissipated)
    }

    fn linearise(&self, du: &[f64], dlambda: f64, gradient: &mut [f64]) -> Border {
        self.plane.linearise(du, dlambda, gradient)
    }
}

/// Energies (N mm) of an increment under dead loads f_d and reference forces f, for laws that unload along the secant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energies {
    /// Work of the forces: (f_d + (lambda_0 + 1/2 dlambda) f) . du.
    pub work: f64,
    /// What of it is dissipated: 1/2 (f_d + lambda_0 f) . du - 1/2 dlambda f . u_0, see [`Dissipation`].
    pub dissipated: f64,
}

impl Energies {
    /// Energies of the increment from the accepted state of a stage to `u` (all DOFs, mm) at the load factor
    /// `lambda`.
    ///
    /// # Errors
    ///
    /// [`SolverError::Setting`] if the load factor drives displacements, or held DOFs are displaced, [`SolverError::Mismatch`] for a `u` of another model.
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
    /// [`SolverError::Setting`] if the load factor drives displacements, or held DOFs are displaced.
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
        let (dead, reference) = applied(stage)?;
        let (steady, along) = (dot(&dead, du), dot(&reference, du));
        Ok(Self {
            work: steady + (lambda + 0.5 * dlambda) * along,
            dissipated: 0.5 * (steady + lambda * along - dlambda * dot(&reference, start)),
        })
    }
}

/// Dead loads and reference forces (N) on the free equations, of a stage that stores what they tell.
fn applied(stage: &Stage<'_>) -> Result<(Vec<f64>, Vec<f64>), SolverError> {
    let reference = reference_forces(stage)?;
    let held = stage.conditions().prescribed().keys();
    let displaced = held.map(|&d| stage.displacement()[d].abs());
    let largest = displaced.fold(0.0, f64::max);
    SolverError::setting(
        (
            "largest displacement (mm) of a held DOF, under control of the dissipation",
            largest,
        ),
        "0: forces alone do not tell the energy then, control the dissipated energy of the elements",
        largest == 0.0,
    )?;
    Ok((stage.restrict(stage.conditions().dead()), reference))
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
