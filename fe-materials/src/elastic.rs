//! Isotropic linear elasticity.

use fe_core::kinematics::{Axial, PlaneStress, Solid};
use fe_core::material::{Material, MaterialError, PointContext, Response, StateVar};
use nalgebra::{Matrix1, Matrix3, Vector1, Vector3, Vector6};

use crate::elasticity::Elasticity;
use crate::limits::finite;

const LAW: &str = "isotropic elasticity";

/// Isotropic linear elasticity, for a solid, for plane stress and for a bar.
///
/// $$ \sigma = D \varepsilon, \qquad D_{solid} = \lambda \mathbf{1} \otimes \mathbf{1} + 2G I, \qquad
/// D_{plane} = \frac{E}{1-\nu^2} \begin{pmatrix} 1 & \nu & 0 \cr \nu & 1 & 0 \cr
/// 0 & 0 & (1-\nu)/2 \end{pmatrix}, \qquad D_{bar} = E. $$
///
/// No internal variables; tangent and secant operator are D; the free energy is (1/2) eps . D eps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    elastic: Elasticity,
}

impl Elastic {
    /// A material of Young's modulus E (MPa) and Poisson's ratio nu (-).
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] unless E > 0 and 0 <= nu < 0.5.
    pub fn new(young_mpa: f64, poisson: f64) -> Result<Self, MaterialError> {
        Ok(Self {
            elastic: Elasticity::new(LAW, young_mpa, poisson)?,
        })
    }

    /// Plane-stress stiffness (MPa): the solid one with sigma_33 = 0 condensed.
    fn plane_stiffness(&self) -> Matrix3<f64> {
        let (young, shear) = (self.elastic.young, self.elastic.shear);
        let poisson = 0.5 * young / shear - 1.0;
        let direct = young / (1.0 - poisson * poisson);
        let cross = poisson * direct;
        Matrix3::new(direct, cross, 0.0, cross, direct, 0.0, 0.0, 0.0, shear)
    }
}

impl Material<Solid> for Elastic {
    fn name(&self) -> &'static str {
        LAW
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        _committed: &[f64],
        _trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        finite(LAW, strain)?;
        Ok(Response {
            stress: self.elastic.stress(strain),
            tangent: self.elastic.stiffness,
        })
    }

    fn free_energy(&self, strain: &Vector6<f64>, _: &[f64], _: &PointContext) -> Option<f64> {
        Some(self.elastic.energy(strain))
    }
}

impl Material<PlaneStress> for Elastic {
    fn name(&self) -> &'static str {
        LAW
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        strain: &Vector3<f64>,
        _committed: &[f64],
        _trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<PlaneStress>, MaterialError> {
        finite(LAW, strain)?;
        let tangent = self.plane_stiffness();
        Ok(Response {
            stress: tangent * strain,
            tangent,
        })
    }

    fn free_energy(&self, strain: &Vector3<f64>, _: &[f64], _: &PointContext) -> Option<f64> {
        Some(0.5 * strain.dot(&(self.plane_stiffness() * strain)))
    }
}

impl Material<Axial> for Elastic {
    fn name(&self) -> &'static str {
        LAW
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        strain: &Vector1<f64>,
        _committed: &[f64],
        _trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<Axial>, MaterialError> {
        finite(LAW, strain)?;
        Ok(Response {
            stress: self.elastic.young * strain,
            tangent: Matrix1::new(self.elastic.young),
        })
    }

    fn free_energy(&self, strain: &Vector1<f64>, _: &[f64], _: &PointContext) -> Option<f64> {
        Some(0.5 * self.elastic.young * strain[0] * strain[0])
    }
}

#[cfg(test)]
mod tests {
    //! Protects the elastic stiffness of the three kinematics.
    use fe_core::testing::{MaterialCheck, check_isotropy, check_material};

    use super::*;

    fn stress<K: fe_core::kinematics::Kinematics>(
        law: &dyn Material<K>,
        strain: &[f64],
    ) -> Vec<f64> {
        let response = law
            .update(&K::vector(strain), &[], &mut [], &PointContext::new(1.0))
            .unwrap();
        K::components(&response.stress).to_vec()
    }

    /// Contract of a law, and isotropy under rotation.
    #[test]
    fn conforms() {
        let law = Elastic::new(200e3, 0.3).unwrap();
        let check = MaterialCheck::new(1e-3);
        check_material::<Solid>(&law, &check).unwrap();
        check_material::<PlaneStress>(&law, &check).unwrap();
        check_material::<Axial>(&law, &check).unwrap();
        check_isotropy(&law, &check).unwrap();
    }

    /// Source: Hooke's law. A bar under uniaxial stress sigma = E eps contracts by nu eps: the three
    /// kinematics must agree on it. Target: rounding.
    #[test]
    fn the_three_kinematics_agree_on_uniaxial_stress() {
        let law = Elastic::new(30e3, 0.2).unwrap();
        let e = 1e-3;
        assert_eq!(stress::<Axial>(&law, &[e]), [30.0]);
        let plane = stress::<PlaneStress>(&law, &[e, -0.2 * e, 0.0]);
        let solid = stress::<Solid>(&law, &[e, -0.2 * e, -0.2 * e, 0.0, 0.0, e]);
        assert!((plane[0] - 30.0).abs() < 1e-12 && plane[1].abs() < 1e-12);
        assert!((solid[0] - 30.0).abs() < 1e-12 && solid[1].abs() < 1e-12);
        assert!((solid[5] - 12.5).abs() < 1e-12, "tau = G gamma");
    }

    #[test]
    fn impossible_parameters_and_strains_are_refused() {
        for (young, poisson) in [(0.0, 0.2), (f64::NAN, 0.2), (30e3, 0.5), (30e3, f64::NAN)] {
            assert!(Elastic::new(young, poisson).is_err(), "{young} {poisson}");
        }
        let law = Elastic::new(30e3, 0.2).unwrap();
        let strain = Vector1::new(f64::INFINITY);
        let ctx = PointContext::new(1.0);
        let error = Material::<Axial>::update(&law, &strain, &[], &mut [], &ctx);
        assert!(matches!(error, Err(MaterialError::NotFinite { .. })));
    }
}
