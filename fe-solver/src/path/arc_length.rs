//! Arc length.

use super::{Border, PathConstraint, reference_forces};
use crate::anderson::dot;
use crate::error::SolverError;
use crate::stage::Stage;

/// The increment has the length of the step: g = sqrt(du . du + (psi dlambda)^2) - length, cylindrical with
/// psi = 0 (Crisfield 1981), else spherical (Riks 1979), psi in mm per unit of the load factor.
///
/// g is linearised consistently (Ramm 1981), so that there is no quadratic equation and no root to choose. The iteration
/// starts from the last increment at the length of this one, in the first step from the direction of the forces.
///
/// The constraint does not tell loading from unloading: through a sharp turn it may lead back along the
/// elastic path, every step converged. See [`Dissipation`](super::Dissipation) for one that cannot.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ArcLength {
    psi: f64,
    length: f64,
    /// Unit direction of the forces.
    direction: Vec<f64>,
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
        self.direction = reference_forces(stage)?;
        let norm = dot(&self.direction, &self.direction).sqrt();
        for f in &mut self.direction {
            *f /= norm;
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
            gradient.copy_from_slice(&self.direction);
            return Border {
                value: -self.length,
                slope: 0.0,
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
