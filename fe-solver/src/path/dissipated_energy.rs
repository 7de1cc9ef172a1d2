//! Control of the energy that a step dissipates, measured on the elements.

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;

use super::{Border, PathConstraint};
use crate::anderson::dot;
use crate::error::SolverError;
use crate::stage::Stage;

/// Share of the increment by which derivatives are taken.
const PROBE: f64 = 1e-5;
/// Share of all works done so far below which a difference of dissipations is rounding: no derivative is made of it.
const NOISE: f64 = 1e-13;

/// A step dissipates the energy `length` (N mm): g = D - length,
///
/// D = 1/2 (f_int,0 + f_int) . du - (psi - psi_0),
///
/// with the internal forces and the free energies psi of the elements at the start and at the end of the step: the energy
/// form of dissipation control (Verhoosel, Remmers and Gutierrez 2009, section 2.2), here with the change of the free energy
/// itself instead of its rate at the start. It holds for plasticity, damage, slip and what mixes them, under forces and
/// imposed displacements; [`Dissipation`](super::Dissipation) is cheaper and holds for damage under forces.
///
/// The gradient is taken by differences in the two directions that the bordered system asks for, three evaluations of the
/// model per iteration. A path that dissipates nothing cannot be followed, and is refused: start with another constraint.
#[derive(Debug, Clone, Default)]
pub struct DissipatedEnergy {
    length: f64,
    /// Dissipation of the last step; none before the first, after a snap, and where it is rounding.
    last: Option<f64>,
    value: f64,
    gradient: Vec<f64>,
}

impl PathConstraint for DissipatedEnergy {
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        self.length = length;
        let last = stage.last_change();
        let told = last.filter(|change| change.dissipated() > NOISE * change.turnover);
        self.last = told.map(|change| change.dissipated());
        Ok(())
    }

    fn extrapolate(&self, _du: &[f64], _dlambda: f64) -> Option<f64> {
        Some(self.length / self.last?)
    }

    fn observe(
        &mut self,
        stage: &mut Stage<'_>,
        (du, dlambda): (&[f64], f64),
        [correction, response]: [&[f64]; 2],
    ) -> Result<(), SolverError> {
        let start = stage.restrict(stage.displacement());
        let from = stage.lambda() + dlambda;
        let mut dissipated = |along: &[f64], share: f64, lambda: f64| {
            let moved = start.iter().zip(du).zip(along);
            let free: Vec<f64> = moved.map(|((u, d), a)| u + d + share * a).collect();
            let u = stage.compose(&free, lambda);
            stage.residual(&u, lambda, &EvaluationContext::new(Operator::None))?;
            let change = stage.weigh(&u, lambda)?;
            Ok::<_, SolverError>((change.dissipated(), NOISE * change.turnover))
        };
        let (here, _) = dissipated(correction, 0.0, from)?;
        let size = dot(du, du).sqrt();
        let mut slope = |along: &[f64], dlambda: f64| {
            let length = dot(along, along).sqrt();
            if length == 0.0 {
                return Ok::<_, SolverError>(0.0);
            }
            // Before anything has moved, the whole direction is as good a measure as any.
            let share = PROBE * if size > 0.0 { size / length } else { 1.0 };
            let (there, noise) = dissipated(along, share, from + share * dlambda)?;
            let change = there - here;
            Ok(if change.abs() <= noise {
                0.0
            } else {
                change / share
            })
        };
        let slopes = [slope(correction, 0.0)?, slope(response, 1.0)?];
        self.value = here - self.length;
        self.gradient = within_plane([correction, response], slopes);
        Ok(())
    }

    fn linearise(&self, _du: &[f64], _dlambda: f64, gradient: &mut [f64]) -> Border {
        gradient.copy_from_slice(&self.gradient);
        Border {
            value: self.value,
            slope: 0.0,
        }
    }
}

/// The vector of the plane of two directions that has the given products with them.
fn within_plane([a, b]: [&[f64]; 2], [along_a, along_b]: [f64; 2]) -> Vec<f64> {
    let bb = dot(b, b);
    if bb == 0.0 {
        return vec![0.0; b.len()];
    }
    let share = dot(a, b) / bb;
    // The part of a across b.
    let across: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - share * b).collect();
    let cc = dot(&across, &across);
    let parallel = cc <= 1e-24 * dot(a, a);
    let first = if parallel {
        0.0
    } else {
        (along_a - share * along_b) / cc
    };
    let second = along_b / bb;
    across
        .iter()
        .zip(b)
        .map(|(c, b)| first * c + second * b)
        .collect()
}
