//! Laws made for a test, and short ways to the usual ones.

use std::sync::Arc;

use fe_core::kinematics::Solid;
use fe_core::material::{Material, MaterialError};
use fe_materials::Elastic;

/// Isotropic elasticity as elements take it.
///
/// # Errors
///
/// [`MaterialError::Parameter`].
pub fn elastic(young_mpa: f64, poisson: f64) -> Result<Arc<dyn Material<Solid>>, MaterialError> {
    Ok(Arc::new(Elastic::new(young_mpa, poisson)?))
}
