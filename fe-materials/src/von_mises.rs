//! Von Mises plasticity with linear isotropic hardening.

use fe_core::kinematics::Solid;
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use nalgebra::{Matrix6, Vector6};

use crate::elasticity::Elasticity;
use crate::limits::{finite, out_of_range, positive};
use crate::plastic_state::{PLASTIC_VARS, PlasticState};

const LAW: &str = "von Mises plasticity";

/// Associated von Mises plasticity with linear isotropic hardening.
///
/// With the deviator s, q = sqrt(3 J2), and kappa the equivalent plastic strain:
///
/// $$ q \le \sigma_y + H\kappa, \qquad \dot\varepsilon_p = \dot\kappa \frac{3}{2}\frac{s}{q}. $$
///
/// Backward Euler is a radial return in closed form,
///
/// $$ \Delta\kappa = \frac{q_{tr} - \sigma_y - H\kappa_n}{3G + H}, \qquad s = \rho s_{tr}, \qquad
/// \rho = 1 - \frac{3G \Delta\kappa}{q_{tr}}, $$
///
/// with the consistent tangent, n = s_tr/|s_tr|,
///
/// $$ D_{ep} = K \mathbf{1} \otimes \mathbf{1} + 2G \rho P_{dev} - 2G\left(\frac{3G}{3G + H} - 1 + \rho\right)
/// n \otimes n. $$
///
/// The secant operator is the elastic stiffness. The free energy (1/2) eps_e . D eps_e + (1/2) H kappa^2
/// leaves a dissipation of sigma_y dkappa or more in every step.
///
/// Sources: J. C. Simo and R. L. Taylor, "Consistent tangent operators for rate-independent
/// elastoplasticity", Comput. Methods Appl. Mech. Eng. 48 (1985) 101-118; J. C. Simo and T. J. R. Hughes,
/// "Computational Inelasticity" (1998), boxes 3.1 and 3.2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VonMises {
    elastic: Elasticity,
    yield_stress: f64,
    hardening: f64,
}

impl VonMises {
    /// A material of Young's modulus E (MPa), Poisson's ratio nu (-), yield stress sigma_y (MPa) and
    /// plastic modulus H = dq/dkappa (MPa). A tangent ET of the uniaxial curve in total strain corresponds
    /// to H = E ET/(E - ET).
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] unless E > 0, 0 <= nu < 0.5, sigma_y > 0 and H >= 0.
    pub fn new(
        young_mpa: f64,
        poisson: f64,
        yield_mpa: f64,
        hardening_mpa: f64,
    ) -> Result<Self, MaterialError> {
        positive(LAW, "yield_mpa", yield_mpa, "MPa")?;
        if !(hardening_mpa.is_finite() && hardening_mpa >= 0.0) {
            return Err(out_of_range(
                LAW,
                "hardening_mpa",
                hardening_mpa,
                "MPa",
                "[0, inf)",
                "softening would depend on the mesh; use 0 for perfect plasticity",
            ));
        }
        Ok(Self {
            elastic: Elasticity::new(LAW, young_mpa, poisson)?,
            yield_stress: yield_mpa,
            hardening: hardening_mpa,
        })
    }

    /// Yield stress at an equivalent plastic strain (MPa).
    fn strength(&self, kappa: f64) -> f64 {
        self.yield_stress + self.hardening * kappa
    }

    /// Consistent tangent for a trial deviator that shrinks to `rho` of itself.
    fn tangent(&self, deviator: &Vector6<f64>, rho: f64) -> Matrix6<f64> {
        let (bulk, shear) = (self.elastic.bulk, self.elastic.shear);
        let mut d = Matrix6::zeros();
        for i in 0..3 {
            for j in 0..3 {
                d[(i, j)] = bulk - 2.0 / 3.0 * shear * rho;
            }
            d[(i, i)] += 2.0 * shear * rho;
            d[(i + 3, i + 3)] = shear * rho;
        }
        let radial = 3.0 * shear / (3.0 * shear + self.hardening) - 1.0 + rho;
        d - deviator * deviator.transpose() * (2.0 * shear * radial / squared_norm(deviator))
    }
}

/// s : s of a Voigt deviator.
fn squared_norm(s: &Vector6<f64>) -> f64 {
    s.norm_squared() + s.fixed_rows::<3>(3).norm_squared()
}

impl Material<Solid> for VonMises {
    fn name(&self) -> &'static str {
        LAW
    }

    fn state_vars(&self) -> &[StateVar] {
        &PLASTIC_VARS
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        finite(LAW, strain)?;
        let mut state = PlasticState::read(committed);
        let mut stress = self.elastic.stress(&(strain - state.strain));
        let mut tangent = self.elastic.stiffness;
        let mean = (stress[0] + stress[1] + stress[2]) / 3.0;
        let mut deviator = stress;
        for i in 0..3 {
            deviator[i] -= mean;
        }
        let q = (1.5 * squared_norm(&deviator)).sqrt();
        let excess = q - self.strength(state.kappa);
        if excess > 0.0 {
            let shear = self.elastic.shear;
            let increment = excess / (3.0 * shear + self.hardening);
            let plastic_share = 3.0 * shear * increment / q;
            stress -= deviator * plastic_share;
            state.kappa += increment;
            for i in 0..6 {
                let engineering = if i < 3 { 1.0 } else { 2.0 };
                state.strain[i] += engineering * 1.5 * increment / q * deviator[i];
            }
            if ctx.operator == Operator::Tangent {
                tangent = self.tangent(&deviator, 1.0 - plastic_share);
            }
        }
        state.write(trial);
        Ok(Response { stress, tangent })
    }

    fn free_energy(&self, strain: &Vector6<f64>, state: &[f64], _: &PointContext) -> Option<f64> {
        let state = PlasticState::read(state);
        let stored = 0.5 * self.hardening * state.kappa * state.kappa;
        Some(self.elastic.energy(&(strain - state.strain)) + stored)
    }

    fn report(&self, _: &Vector6<f64>, state: &[f64]) -> PointReport {
        PointReport {
            plastic_strain: PlasticState::read(state).strain.into(),
            ..PointReport::default()
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the radial return and its tangent.
    use fe_core::testing::{MaterialCheck, check_isotropy, check_material};
    use nalgebra::Vector6;
    use proptest::array::uniform6;
    use proptest::prelude::*;

    use super::*;

    const YOUNG: f64 = 200e3;

    fn law(hardening: f64) -> VonMises {
        VonMises::new(YOUNG, 0.3, 400.0, hardening).unwrap()
    }

    /// Contract of a law on 10^4 random paths each: tangent to 1e-6, dissipation, repeatability; isotropy.
    #[test]
    fn conforms() {
        for hardening in [0.0, 2e3] {
            let check = MaterialCheck {
                paths: 10_000,
                steps: 10,
                ..MaterialCheck::new(1e-2)
            };
            let report = check_material(&law(hardening), &check).unwrap();
            assert!(report.least_dissipation.is_some());
            check_isotropy(&law(hardening), &check).unwrap();
        }
    }

    /// Source: J2 flow theory in simple shear, tau_y = sigma_y/sqrt 3 and, with
    /// kappa = gamma_p/sqrt 3, the plastic slope dtau/dgamma_p = H/3. Target: rounding, in one step.
    #[test]
    fn simple_shear_in_one_step() {
        let law = law(3e3);
        let (tau_y, shear) = (400.0 / 3.0_f64.sqrt(), YOUNG / 2.6);
        let gamma = 0.02;
        let plastic = (shear * gamma - tau_y) / (shear + 1e3);
        let strain = Vector6::new(0.0, 0.0, 0.0, gamma, 0.0, 0.0);
        let mut state = [0.0; 7];
        let response = law
            .update(&strain, &[0.0; 7], &mut state, &PointContext::new(1.0))
            .unwrap();
        assert!((response.stress[3] - (tau_y + 1e3 * plastic)).abs() < 1e-10);
        assert!((state[3] - plastic).abs() < 1e-15);
        assert!((state[6] - plastic / 3.0_f64.sqrt()).abs() < 1e-15);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(10_000))]

        /// After a return the stress is on the yield surface, and the plastic strain keeps the volume. A
        /// step and its two halves differ by a term of second order: |2 G d_eps|^2/sigma_y at most.
        #[test]
        fn return_is_on_the_surface_and_of_first_order(
            first in uniform6(-0.02..0.02),
            second in uniform6(-1e-4..1e-4),
        ) {
            let law = law(2e3);
            let update = |strain: Vector6<f64>, committed: &[f64; 7]| {
                let (ctx, mut state) = (PointContext::new(1.0), [0.0; 7]);
                let r = law.update(&strain, committed, &mut state, &ctx);
                (r.unwrap().stress, state)
            };
            let first = Vector6::from(first);
            let (s, state) = update(first, &[0.0; 7]);
            let mean = (s[0] + s[1] + s[2]) / 3.0;
            let deviator = s - Vector6::new(mean, mean, mean, 0.0, 0.0, 0.0);
            let q = (1.5 * squared_norm(&deviator)).sqrt();
            prop_assert!(q / law.strength(state[6]) < 1.0 + 1e-12);
            prop_assert!((state[0] + state[1] + state[2]).abs() < 1e-15);

            let increment = Vector6::from(second);
            let whole = update(first + increment, &state).0;
            let (_, half) = update(first + 0.5 * increment, &state);
            let halves = update(first + increment, &half).0;
            let elastic = 2.0 * law.elastic.shear * increment.norm();
            prop_assert!((whole - halves).norm() < elastic * elastic / law.yield_stress);
        }
    }

    #[test]
    fn impossible_parameters_are_refused() {
        assert!(VonMises::new(YOUNG, 0.3, -1.0, 0.0).is_err());
        assert!(VonMises::new(YOUNG, 0.3, 400.0, -1.0).is_err());
        assert!(VonMises::new(YOUNG, 0.3, 400.0, f64::INFINITY).is_err());
    }
}
