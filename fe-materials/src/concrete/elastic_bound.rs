//! Bounds that tell an elastic stress without its principal values.

use nalgebra::Vector6;

use super::CompressionCurve;

/// Whether a stress (MPa) is elastic for [`Isochoric`](super::Isochoric) plasticity by a bound; where it is not, it may be
/// elastic all the same.
///
/// Tension is elastic. F, convex and of degree one, is for the compressive part of the stress at most what the
/// principal stresses need one by one,
///
/// $$ F(\mathrm{neg}(\sigma)) \le \sum_i F(\mathrm{neg}(\sigma_i)) \le \sum_i |\sigma_i|. $$
pub(super) fn surely_elastic(stress: &Vector6<f64>, kappa: f64, curve: &CompressionCurve) -> bool {
    is_tensile(stress) || kappa > 0.0 && absolute_sum(stress) <= curve.at(curve.eta(kappa)).stress
}

/// Upper bound of |sigma_1| + |sigma_2| + |sigma_3| (MPa); the sum itself where the three have one sign.
pub(super) fn absolute_sum(stress: &Vector6<f64>) -> f64 {
    if is_tensile(stress) || is_tensile(&-stress) {
        (stress[0] + stress[1] + stress[2]).abs()
    } else {
        3.0_f64.sqrt() * norm(stress)
    }
}

/// Norm (sigma : sigma)^(1/2) (MPa) of a Voigt stress: no principal stress is larger.
pub(super) fn norm(stress: &Vector6<f64>) -> f64 {
    let [x, y, z, xy, yz, xz] = (*stress).into();
    (x * x + y * y + z * z + 2.0 * (xy * xy + yz * yz + xz * xz)).sqrt()
}

/// Whether all principal stresses are positive: the leading minors are (Sylvester).
fn is_tensile(stress: &Vector6<f64>) -> bool {
    let [x, y, z, xy, yz, xz] = (*stress).into();
    let minor = x * y - xy * xy;
    let determinant = minor * z - x * yz * yz - y * xz * xz + 2.0 * xy * yz * xz;
    x > 0.0 && minor > 0.0 && determinant > 0.0
}

#[cfg(test)]
mod tests {
    //! Protects the bounds: a stress that they call elastic is elastic, and they do find what is.
    use super::*;
    use crate::concrete::{ConcreteScalars, Isochoric};
    use fe_core::material::Operator;
    use nalgebra::Matrix6;
    use proptest::prelude::*;

    fn law() -> Isochoric {
        Isochoric::new(&ConcreteScalars::from_characteristic(30.0).unwrap()).unwrap()
    }

    proptest! {
        #[test]
        fn what_they_call_elastic_is(
            strain in prop::array::uniform6(-5e-4..5e-4),
            kappa in 0.0..2e-3,
        ) {
            let (law, strain) = (law(), Vector6::from(strain));
            let committed = crate::plastic_state::PlasticState { strain: Vector6::zeros(), kappa };
            let stress = law.trial_stress(&strain, &committed);
            let found = law.respond(&stress, &committed, law.curve(), Operator::Tangent).unwrap();
            let elastic = found.state == committed;
            if surely_elastic(&stress, kappa, law.curve()) {
                prop_assert!(elastic);
                prop_assert_eq!(found.stress, stress);
                prop_assert_eq!(found.tangent, law.elastic().stiffness);
            }
            let margin = 1.0 + 1e-12;
            prop_assert!(found.principal.amax() <= norm(&found.stress) * margin);
            prop_assert!(found.principal.lp_norm(1) <= absolute_sum(&found.stress) * margin);
            prop_assert_eq!(is_tensile(&stress), {
                let e: Matrix6<f64> = law.elastic().stiffness;
                fe_core::voigt::stress_tensor(&(e * strain)).symmetric_eigenvalues().min() > 0.0
            });
        }
    }

    #[test]
    fn they_find_tension_and_unloading() {
        let law = law();
        let pulled = Vector6::new(2.0, 1.0, 1.0, 0.1, -0.1, 0.2);
        assert!(surely_elastic(&pulled, 0.0, law.curve()));
        let pressed = Vector6::new(-5.0, 0.1, 0.1, 0.5, 0.0, 0.0);
        assert!(!surely_elastic(&pressed, 0.0, law.curve()));
        assert!(surely_elastic(&pressed, 1e-4, law.curve()));
    }
}
