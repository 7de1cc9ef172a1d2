//! A law whose tangent is a constant: what is left is the cost of elements and assembly.

use fe_core::kinematics::Solid;
use fe_core::material::{Material, MaterialError, PointContext, Response, StateVar};
use fe_core::voigt::isotropic;
use nalgebra::{Matrix6, Vector6};

/// sigma = D e, with as many state variables as a concrete law has.
#[derive(Debug)]
pub struct Linear {
    tangent: Matrix6<f64>,
    unsymmetric: bool,
}

impl Linear {
    /// Concrete; with a skew entry in D if `unsymmetric`.
    pub fn new(unsymmetric: bool) -> Self {
        let mut tangent = isotropic(30_000.0, 0.2);
        if unsymmetric {
            tangent[(0, 3)] += 500.0;
        }
        Self {
            tangent,
            unsymmetric,
        }
    }
}

const STATE: [StateVar; 1] = [StateVar::vector("history", "-", 18)];

impl Material<Solid> for Linear {
    fn name(&self) -> &'static str {
        "linear"
    }

    fn state_vars(&self) -> &[StateVar] {
        &STATE
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        committed: &[f64],
        trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        trial.copy_from_slice(committed);
        Ok(Response {
            stress: self.tangent * strain,
            tangent: self.tangent,
        })
    }

    fn unsymmetric_tangent(&self) -> bool {
        self.unsymmetric
    }
}
