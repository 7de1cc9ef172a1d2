//! Laws made for a test, and short ways to the usual ones.

use std::sync::Arc;

use fe_core::kinematics::{Axial, Kinematics, Solid};
use fe_core::material::{Material, MaterialError, PointContext, Response, StateVar};
use fe_materials::Elastic;
use nalgebra::Vector1;

/// Isotropic elasticity as elements take it.
///
/// # Errors
///
/// [`MaterialError::Parameter`].
pub fn elastic(young_mpa: f64, poisson: f64) -> Result<Arc<dyn Material<Solid>>, MaterialError> {
    Ok(Arc::new(Elastic::new(young_mpa, poisson)?))
}

/// A tendon without stiffness: the same stress at every strain.
#[derive(Debug, Clone, Copy)]
pub struct Tendon {
    /// Stress [MPa].
    pub stress_mpa: f64,
}

impl Material<Axial> for Tendon {
    fn name(&self) -> &'static str {
        "tendon"
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        _strain: &Vector1<f64>,
        _committed: &[f64],
        _trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<Axial>, MaterialError> {
        Ok(Response {
            stress: Vector1::new(self.stress_mpa),
            tangent: Axial::zero_tangent(),
        })
    }
}
