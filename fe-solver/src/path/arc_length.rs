//! Arc length.

use super::{Border, PathConstraint, reference_forces};
use crate::anderson::dot;
use crate::error::SolverError;
use crate::stage::Stage;

/// The increment has the length of the step: g = sqrt(du . du + (psi dlambda)^2) - length, cylindrical with
/// psi = 0 (Crisfield 1981), else spherical (Riks 1979), psi in mm per unit of the load factor.
///
/// g is linearised consistently (Ramm 1981), so that there is no quadratic equation and no root to choose. The iteration
/// starts from the last increment at the length of this one, in the first step from the response to the forces, in their
/// direction.
///
/// The constraint does not tell loading from unloading: through a sharp turn it may lead back along the
/// elastic path, every step converged. See [`Dissipation`](super::Dissipation) for one that cannot.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ArcLength {
    psi: f64,
    length: f64,
    /// The reference forces.
    forces: Vec<f64>,
    /// Gradient and slope at a zero increment: the direction of the response.
    first: (Vec<f64>, f64),
}

impl ArcLength {
    /// On a cylinder.
    pub fn cylindrical() -> Self {
        Self::default()
    }

    /// On a sphere, with the weight of the load factor (mm per unit of it).
    pub fn spherical(psi: f64) -> Self {
        Self {
            psi,
            ..Self::default()
        }
    }

    /// Length of an increment (mm).
    fn size(&self, du: &[f64], dlambda: f64) -> f64 {
        (dot(du, du) + (self.psi * dlambda).powi(2)).sqrt()
    }
}

impl PathConstraint for ArcLength {
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        let fits = self.psi.is_finite() && self.psi >= 0.0;
        SolverError::setting(("psi of the arc length", self.psi), "[0, inf)", fits)?;
        self.length = length;
        self.forces = reference_forces(stage)?;
        Ok(())
    }

    fn observe(
        &mut self,
        _: &mut Stage<'_>,
        (du, dlambda): (&[f64], f64),
        [_, response]: [&[f64]; 2],
    ) -> Result<(), SolverError> {
        if self.size(du, dlambda) == 0.0 {
            let along = dot(&self.forces, response);
            let sign = if along == 0.0 { 0.0 } else { along.signum() };
            let scale = sign / self.size(response, 1.0);
            let gradient = response.iter().map(|q| scale * q).collect();
            self.first = (gradient, scale * self.psi * self.psi);
        }
        Ok(())
    }

    fn extrapolate(&self, du: &[f64], dlambda: f64) -> Option<f64> {
        let size = self.size(du, dlambda);
        (size > 0.0).then(|| self.length / size)
    }

    fn linearise(&self, du: &[f64], dlambda: f64, gradient: &mut [f64]) -> Border {
        let size = self.size(du, dlambda);
        if size == 0.0 {
            gradient.copy_from_slice(&self.first.0);
            return Border {
                value: -self.length,
                slope: self.first.1,
            };
        }
        for (g, d) in gradient.iter_mut().zip(du) {
            *g = d / size;
        }
        Border {
            value: size - self.length,
            slope: self.psi * self.psi * dlambda / size,
        }
    }
}
