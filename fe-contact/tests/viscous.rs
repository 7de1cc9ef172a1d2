//! Protects [`Viscous`]: no change at a share of 1, account of energy, tangent.
//!
//! Targets: work = dissipation of the damage + energy in store, whatever the viscosity; the viscous part vanishes with finer
//! steps of the same share, and tangent and energy agree with the contract of a law.

use std::sync::Arc;

use fe_contact::envelope::{Bilinear, LuJoint};
use fe_contact::{BondSettings, Interface, MixedMode, MixedModeParameters, SlipDamage, Viscous};
use fe_core::material::{Material, MaterialError, Operator, PointContext};
use fe_core::testing::{MaterialCheck, check_material};
use nalgebra::Vector3;

fn bond() -> Bilinear {
    let joint = LuJoint {
        ft_mpa: 2.2,
        width_ratio: 0.5,
    };
    joint.bilinear().unwrap()
}

fn law(share: f64) -> Result<Viscous, MaterialError> {
    let law = SlipDamage::new(bond(), BondSettings::default())?;
    Viscous::new(Arc::new(law), share)
}

/// Monotone slip to 0.5 mm, beyond s_f, in `n` steps: work and viscous energy.
fn pull(share: f64, n: u32) -> [f64; 2] {
    let law = law(share).unwrap();
    let mut state = vec![0.0; law.state_len()];
    law.init_state(&mut state);
    let (mut work, mut last) = (0.0, 0.0);
    let step = 0.5 / f64::from(n);
    for i in 1..=n {
        let jump = Vector3::new(f64::from(i) * step, 0.0, 0.0);
        let mut trial = vec![f64::NAN; state.len()];
        let ctx = PointContext::new(1.0).with_operator(Operator::None);
        let tau = law.update(&jump, &state, &mut trial, &ctx).unwrap().stress[0];
        work += 0.5 * (tau + last) * step;
        last = tau;
        state = trial;
    }
    [work, law.viscous_energy(&state)]
}

#[test]
fn energy_of_the_viscosity() {
    use fe_contact::Envelope;
    let [inviscid, none] = pull(1.0, 1000);
    assert!((inviscid / bond().energy() - 1.0).abs() < 1e-4);
    assert_eq!(none, 0.0);
    let [work, viscous] = pull(0.1, 1000);
    assert!(viscous > 0.01 * inviscid, "{viscous}");
    // The excess of work is what the account says, up to the order of the step.
    assert!(
        ((work - inviscid) / viscous - 1.0).abs() < 0.15,
        "{work} {inviscid} {viscous}"
    );
    let [_, finer] = pull(0.1, 4000);
    assert!(finer < 0.3 * viscous, "{finer}");
}

#[test]
fn tangent_is_that_of_the_lagging_damage() {
    let law = law(0.3).unwrap();
    let mut state = vec![0.0; law.state_len()];
    let ctx = PointContext::new(1.0);
    let at = |slip: f64, committed: &[f64], trial: &mut [f64]| {
        law.update(&Vector3::new(slip, 0.0, 0.0), committed, trial, &ctx)
            .unwrap()
    };
    let mut trial = state.clone();
    at(0.08, &state, &mut trial);
    state.clone_from(&trial);
    let tangent = at(0.12, &state, &mut trial).tangent[(0, 0)];
    let h = 1e-6;
    let up = at(0.12 + h, &state, &mut trial).stress[0];
    let down = at(0.12 - h, &state, &mut trial).stress[0];
    assert!((tangent - (up - down) / (2.0 * h)).abs() < 1e-5);
}

/// Contract of a law on 10^4 random steps: repeatable, tangent to 1e-6, secant positive definite. Its stress changes at a held jump,
/// which is not checked.
#[test]
fn conformance() {
    let check = MaterialCheck {
        paths: 100,
        steps: 100,
        amplitude: vec![0.3, 0.3, 0.02],
        drift_tolerance: f64::INFINITY,
        ..MaterialCheck::new(0.3)
    };
    check_material(&law(0.3).unwrap(), &check).unwrap();
}

#[test]
fn impossible_shares_are_refused() {
    for share in [0.0, 1.5, f64::NAN] {
        assert!(matches!(law(share), Err(MaterialError::Parameter { .. })));
    }
}

/// A share of growth that is none would write a history that is no number, or one that heals: every law refuses it.
#[test]
fn relaxations_outside_their_range_are_refused() {
    let delamination = MixedMode::new(MixedModeParameters {
        stiffness_mpa_per_mm: 1e4,
        normal_strength_mpa: 30.0,
        shear_strength_mpa: 60.0,
        mode_1_energy_n_per_mm: 0.3,
        mode_2_energy_n_per_mm: 1.0,
        exponent: 1.8,
        residual: 1e-6,
    });
    let laws: [Box<dyn Material<Interface>>; 3] = [
        Box::new(SlipDamage::new(bond(), BondSettings::default()).unwrap()),
        Box::new(delamination.unwrap()),
        Box::new(law(0.3).unwrap()),
    ];
    for law in laws {
        let (state, mut trial) = (vec![0.0; law.state_len()], vec![0.0; law.state_len()]);
        for relaxation in [f64::NAN, f64::INFINITY, -0.1, 1.5] {
            let ctx = PointContext {
                relaxation,
                ..PointContext::new(1.0)
            };
            let refused = law.update(&Vector3::new(0.1, 0.0, 0.1), &state, &mut trial, &ctx);
            let refused = refused.unwrap_err().to_string();
            assert!(refused.contains("relaxation"), "{refused}");
        }
    }
}
