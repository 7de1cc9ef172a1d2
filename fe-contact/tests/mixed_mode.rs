//! Protects [`MixedMode`]: strengths and energies of the pure modes, the criterion of Benzeggagh and Kenane (1996) in
//! between, contact, the contract of a law.
//!
//! Targets: energy along proportional paths to 1e-12 (bilinear, trapezia are exact), conformance.

use fe_contact::{MixedMode, MixedModeParameters};
use fe_core::material::{Material, MaterialError, PointContext};
use fe_core::testing::{MaterialCheck, check_material};
use nalgebra::Vector3;

/// AS4/PEEK of Camanho and Davila (2002), table 1, with a stiffness that leaves branches of one order.
const P: MixedModeParameters = MixedModeParameters {
    stiffness_mpa_per_mm: 1e4,
    normal_strength_mpa: 80.0,
    shear_strength_mpa: 100.0,
    mode_1_energy_n_per_mm: 0.969,
    mode_2_energy_n_per_mm: 1.719,
    exponent: 2.284,
    residual: 0.0,
};

fn stress(law: &MixedMode, jump: Vector3<f64>, state: &mut [f64; 1]) -> Vector3<f64> {
    let mut trial = [f64::NAN];
    let t = law
        .update(&jump, state, &mut trial, &PointContext::new(1.0))
        .unwrap()
        .stress;
    *state = trial;
    t
}

#[test]
fn proportional_paths_dissipate_the_energy_of_the_criterion() {
    let law = MixedMode::new(P).unwrap();
    for share in [0.0, 0.1, 0.35, 0.5, 0.8, 1.0_f64] {
        let direction = Vector3::new(0.6 * share.sqrt(), 0.8 * share.sqrt(), (1.0 - share).sqrt());
        let (onset, end) = law.jumps(share);
        let mut state = [0.0];
        let at_onset = stress(&law, direction * onset, &mut state);
        // Quadratic criterion of strengths.
        let used = (at_onset[2] / 80.0).hypot(at_onset.xy().norm() / 100.0);
        assert!((used - 1.0).abs() < 1e-12, "{share}: {used}");
        let middle = stress(&law, direction * (0.5 * (onset + end)), &mut state);
        let last = stress(&law, direction * end, &mut state);
        let half = 0.5 * (end - onset);
        let [a, b, c] = [at_onset, middle, last].map(|t| t.dot(&direction));
        let work = 0.5 * a * onset + 0.5 * (a + b) * half + 0.5 * (b + c) * half;
        let target = 0.969 + (1.719 - 0.969) * share.powf(2.284);
        assert!((work / target - 1.0).abs() < 1e-12, "{share}: {work}");
        assert!((law.energy(share) - target).abs() < 1e-15);
        assert!(law.is_debonded(&state));
    }
}

#[test]
fn contact_keeps_its_stiffness_and_does_no_damage() {
    let law = MixedMode::new(P).unwrap();
    let mut state = [0.0];
    assert_eq!(
        stress(&law, Vector3::new(0.0, 0.0, -0.1), &mut state)[2],
        -1e3
    );
    assert_eq!(state, [0.0]);
    let (_, end) = law.jumps(1.0);
    stress(&law, Vector3::new(end, 0.0, -0.1), &mut state);
    assert_eq!(state, [1.0]);
    assert_eq!(
        stress(&law, Vector3::new(0.0, 0.0, -0.1), &mut state)[2],
        -1e3
    );
    assert_eq!(
        stress(&law, Vector3::new(0.0, 0.0, 0.1), &mut state)[2],
        0.0
    );
}

/// A change of mode on the way must not heal.
#[test]
fn damage_never_falls() {
    let law = MixedMode::new(P).unwrap();
    let mut state = [0.0];
    let mut last = 0.0;
    for i in 0..=200 {
        let angle = f64::from(i) / 200.0 * std::f64::consts::FRAC_PI_2;
        stress(
            &law,
            Vector3::new(0.018 * angle.sin(), 0.0, 0.018 * angle.cos()),
            &mut state,
        );
        assert!(state[0] >= last);
        last = state[0];
    }
    assert!(last > 0.3 && last < 1.0);
}

#[test]
fn conformance() {
    for residual in [0.0, 1e-6] {
        let law = MixedMode::new(MixedModeParameters { residual, ..P }).unwrap();
        let check = MaterialCheck {
            paths: 100,
            steps: 100,
            ..MaterialCheck::new(0.05)
        };
        let report = check_material(&law, &check).unwrap();
        assert!(report.least_dissipation.is_some());
    }
}

#[test]
fn impossible_parameters_are_refused() {
    for (p, name) in [
        (MixedModeParameters { exponent: 0.5, ..P }, "exponent"),
        (
            MixedModeParameters {
                residual: -1.0,
                ..P
            },
            "residual",
        ),
        (
            MixedModeParameters {
                shear_strength_mpa: 0.0,
                ..P
            },
            "shear_strength_mpa",
        ),
        // K small: the rising branch would need more than the fracture energy.
        (
            MixedModeParameters {
                stiffness_mpa_per_mm: 1e3,
                ..P
            },
            "stiffness_mpa_per_mm",
        ),
    ] {
        match MixedMode::new(p) {
            Err(MaterialError::Parameter { parameter, .. }) => assert_eq!(parameter, name),
            other => panic!("{other:?}"),
        }
    }
}

/// Strengths so small that the branch is lost in rounding are refused, as those that leave no softening are.
#[test]
fn a_branch_that_is_no_number_is_refused() {
    for normal_strength_mpa in [1e-200, 1e200] {
        let parameters = MixedModeParameters {
            normal_strength_mpa,
            ..P
        };
        assert!(MixedMode::new(parameters).is_err());
    }
}
