//! Protects the conformance checks: a sound law or element passes, and each breach of the contract is
//! found and named. A check that lets a wrong law pass would let it into a structure.

mod common;

use std::sync::Arc;

use common::{Damage, Elastic, Flaw, Truss};
use fe_core::kinematics::Solid;
use fe_core::material::{Material, MaterialError, PointContext, Response, StateVar};
use fe_core::testing::{
    CheckFailure, ElementCheck, MaterialCheck, check_element, check_isotropy, check_material,
};
use fe_core::voigt;
use nalgebra::{Matrix6, Vector6};

fn check() -> MaterialCheck {
    MaterialCheck::new(1e-3)
}

fn failure(flaw: Flaw) -> CheckFailure {
    check_material(&Damage(flaw), &check()).unwrap_err()
}

#[test]
fn a_sound_law_passes() {
    let report = check_material(&Damage(Flaw::None), &check()).unwrap();
    assert_eq!(report.steps, 10_000);
    assert!(report.kinks == 0, "{report:?}");
    assert!(
        report.worst_tangent > 0.0 && report.worst_tangent < 1e-8,
        "{report:?}"
    );
    assert!(report.least_dissipation.unwrap() >= 0.0 && report.least_pivot > 0.0);
}

#[test]
fn elasticity_passes_in_three_dimensions_and_is_isotropic() {
    let law = Elastic::isotropic(30e3, 0.2);
    let report = check_material(&law, &check()).unwrap();
    assert_eq!(report.kinks, 0);
    assert!(
        report.worst_tangent < 1e-9 && report.worst_drift == 0.0,
        "{report:?}"
    );
    assert!(check_isotropy(&law, &check()).unwrap().worst < 2e-14);
}

#[test]
fn a_tangent_off_by_one_percent_is_found() {
    let found = failure(Flaw::TangentOffByOnePercent);
    let CheckFailure::Tangent {
        given, difference, ..
    } = found
    else {
        panic!("{found}")
    };
    assert!((given / difference - 1.01).abs() < 1e-6);
}

/// All tolerances are measured by it: with an infinite one nothing would be found.
#[test]
fn a_virgin_tangent_that_is_no_number_is_found() {
    let found = failure(Flaw::RigidAtRest).to_string();
    assert!(found.contains("virgin tangent is inf"), "{found}");
    let found = element_failure(Flaw::RigidAtRest, Flaw::None).to_string();
    assert!(found.contains("virgin stiffness is"), "{found}");
}

#[test]
fn a_law_that_reads_the_trial_state_is_found() {
    assert!(matches!(
        failure(Flaw::ReadsTrial),
        CheckFailure::NotRepeatable { .. }
    ));
}

#[test]
fn a_state_entry_left_unwritten_is_found_and_named() {
    let found = failure(Flaw::ForgetsAnEntry);
    assert!(matches!(found, CheckFailure::NotFinite { .. }));
    assert!(
        found
            .to_string()
            .starts_with("path 0, step 0: state variable last is NaN"),
        "{found}"
    );
}

#[test]
fn a_law_that_creates_energy_is_found() {
    assert!(matches!(
        failure(Flaw::SoftensOnUnloading),
        CheckFailure::Dissipation { .. }
    ));
}

#[test]
fn a_free_energy_that_is_no_number_is_found() {
    let failure = failure(Flaw::EndlessEnergy);
    assert!(
        matches!(&failure, CheckFailure::NotFinite { quantity, .. } if quantity == "free energy"),
        "{failure}"
    );
}

/// Elastic at rest, broken from its first step on: what is left of its stress is rounding.
#[derive(Debug)]
struct Broken;

impl Material<Solid> for Broken {
    fn name(&self) -> &'static str {
        "broken"
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        _: &[f64],
        _: &mut [f64],
        _: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        let tensor = voigt::strain_tensor(strain);
        let (values, axes) = voigt::principal(&tensor);
        let lost = voigt::stress_along(&axes, &values);
        Ok(Response {
            stress: 30e3 * (voigt::stress_voigt(&tensor) - lost),
            tangent: Matrix6::identity() * 30e3,
        })
    }
}

/// Rounding turns with no axes: it is held against the stress that there would be without the crack.
#[test]
fn a_point_that_breaks_in_its_first_step_is_isotropic() {
    let report = check_isotropy(&Broken, &check()).unwrap();
    assert!(report.worst > 0.0, "{report:?}");
}

#[test]
fn an_indefinite_secant_is_found() {
    assert!(matches!(
        failure(Flaw::IndefiniteSecant),
        CheckFailure::SecantIndefinite { .. }
    ));
}

#[test]
fn a_stress_that_does_not_belong_to_the_written_state_is_found() {
    // The tangent is a breach as well; without the drift check it alone would be reported.
    assert!(matches!(
        failure(Flaw::StressOfTheOldState),
        CheckFailure::Drift { .. }
    ));
}

#[test]
fn a_stress_that_depends_on_the_operator_is_found() {
    let found = failure(Flaw::OtherStressWithoutOperator);
    assert!(
        matches!(found, CheckFailure::NotRepeatable { .. }),
        "{found}"
    );
}

#[test]
fn an_orthotropic_law_is_not_isotropic() {
    let mut d = fe_core::voigt::isotropic(30e3, 0.2);
    d[(0, 0)] *= 1.001;
    let found = check_isotropy(&Elastic::new(&d), &check()).unwrap_err();
    assert!(matches!(found, CheckFailure::Anisotropic { .. }));
    assert!(check_material(&Elastic::new(&d), &check()).is_ok());
}

#[test]
fn an_unsymmetric_operator_is_found() {
    let symmetric = Matrix6::identity() * 1e4;
    let mut skew = symmetric;
    skew[(0, 3)] = 1.0;
    for (tangent, secant, expected) in [
        (skew, symmetric, "tangent"),
        (symmetric, skew, "secant operator"),
    ] {
        let found = check_material(&Elastic { tangent, secant }, &check()).unwrap_err();
        assert!(
            matches!(found, CheckFailure::Unsymmetric { operator, .. } if operator == expected),
            "{found}"
        );
    }
}

#[test]
fn points_answered_otherwise_together_than_alone_are_found() {
    for flaw in [Flaw::OtherStressTogether, Flaw::DropsAPoint] {
        let found = failure(flaw);
        assert!(
            matches!(found, CheckFailure::NotRepeatable { between, .. } if between.contains("update_many")),
            "{found}"
        );
    }
}

#[test]
fn kinks_beyond_the_allowed_share_are_refused() {
    let strict = MaterialCheck {
        kink_share: 0.0,
        difference_step: 1e-2,
        tangent_tolerance: 1e-2,
        ..check()
    };
    let found = check_material(&Damage(Flaw::None), &strict).unwrap_err();
    assert!(
        matches!(found, CheckFailure::TooManyKinks { .. }),
        "{found}"
    );
}

#[test]
fn impossible_settings_are_refused() {
    for bad in [
        MaterialCheck::new(f64::NAN),
        MaterialCheck {
            amplitude: Vec::new(),
            ..check()
        },
        MaterialCheck {
            difference_step: 0.0,
            context: PointContext::new(1.0),
            ..check()
        },
        MaterialCheck {
            paths: 0,
            ..check()
        },
        MaterialCheck {
            dissipation_tolerance: f64::NAN,
            ..check()
        },
    ] {
        let found = check_material(&Damage(Flaw::None), &bad).unwrap_err();
        assert!(matches!(found, CheckFailure::Setting { .. }), "{found}");
    }
}

const ENDS: [[f64; 3]; 2] = [[10.0, 20.0, -5.0], [110.0, -30.0, 40.0]];

fn element_failure(law: Flaw, truss: Flaw) -> CheckFailure {
    let element = Truss::new([0, 1], &ENDS, Arc::new(Damage(law)), truss);
    check_element(&element, &ENDS, &ElementCheck::new(0.05)).unwrap_err()
}

/// Turning about its axis moves no node of it.
#[test]
fn a_bar_along_an_axis_passes() {
    let ends = [[0.0; 3], [10.0, 0.0, 0.0]];
    let element = Truss::new([0, 1], &ends, Arc::new(Damage(Flaw::None)), Flaw::None);
    check_element(&element, &ends, &ElementCheck::new(0.05)).unwrap();
}

#[test]
fn a_sound_element_passes() {
    let element = Truss::new([0, 1], &ENDS, Arc::new(Damage(Flaw::None)), Flaw::None);
    let report = check_element(&element, &ENDS, &ElementCheck::new(0.05)).unwrap();
    assert_eq!((report.motions, report.steps), (6, 30));
    assert!(
        report.worst_rigid < 1e-14 && report.worst_balance < 1e-13,
        "{report:?}"
    );
    assert!(
        report.worst_tangent < 1e-6 && report.kinks < 2,
        "{report:?}"
    );
}

#[test]
fn a_stiffness_off_by_one_percent_is_found() {
    let found = element_failure(Flaw::None, Flaw::TangentOffByOnePercent);
    assert!(matches!(found, CheckFailure::Tangent { .. }), "{found}");
}

#[test]
fn a_negative_secant_operator_of_an_element_is_found() {
    let found = element_failure(Flaw::IndefiniteSecant, Flaw::None);
    assert!(
        matches!(found, CheckFailure::SecantNegative { .. }),
        "{found}"
    );
}

#[test]
fn a_force_that_does_not_belong_to_the_written_state_is_found() {
    // Its tangent, that of the state to come, is a breach as well.
    let check = ElementCheck {
        tangent_tolerance: f64::INFINITY,
        ..ElementCheck::new(0.05)
    };
    let law = Arc::new(Damage(Flaw::StressOfTheOldState));
    let element = Truss::new([0, 1], &ENDS, law, Flaw::None);
    let found = check_element(&element, &ENDS, &check).unwrap_err();
    assert!(matches!(found, CheckFailure::ForceDrift { .. }), "{found}");
}

#[test]
fn an_unsymmetric_stiffness_that_is_no_derivative_is_found() {
    let found = element_failure(Flaw::None, Flaw::Unsymmetric);
    assert!(matches!(found, CheckFailure::Tangent { .. }), "{found}");
}

#[test]
fn a_promised_symmetric_part_that_is_not_filled_is_found() {
    let found = element_failure(Flaw::None, Flaw::PromisesSymmetricPart);
    let expected = matches!(found, CheckFailure::SymmetricPart { .. });
    assert!(expected, "{found}");
}

#[test]
fn an_element_held_in_space_is_found() {
    let found = element_failure(Flaw::None, Flaw::Grounded);
    let CheckFailure::RigidBody { motion, .. } = found else {
        panic!("{found}")
    };
    assert_eq!(motion, "a translation along x");
}

#[test]
fn flaws_of_the_law_are_found_through_the_element() {
    let found = element_failure(Flaw::ReadsTrial, Flaw::None);
    assert!(
        matches!(found, CheckFailure::NotRepeatable { .. }),
        "{found}"
    );
    let found = element_failure(Flaw::ForgetsAnEntry, Flaw::None);
    assert!(matches!(found, CheckFailure::NotFinite { .. }), "{found}");
}

#[test]
fn a_wrong_number_of_coordinates_is_refused() {
    let element = Truss::new([0, 1], &ENDS, Arc::new(Damage(Flaw::None)), Flaw::None);
    let found = check_element(&element, &ENDS[..1], &ElementCheck::new(0.05)).unwrap_err();
    assert!(matches!(found, CheckFailure::Setting { .. }), "{found}");
}
