//! MAT-07 and the contract of [`SlipDamage`]: secant unloading, irreversibility, normal direction, residual stiffness,
//! relaxation.
//!
//! Source: Lu, Teng, Ye and Jiang (2005), bilinear model. Targets: the parameters to the digits given, the area under a
//! monotone path G_f to 1e-12, the conformance check of laws.

use fe_contact::envelope::{Exponential, ExponentialParameters, LuJoint};
use fe_contact::{BondSettings, Envelope, Normal, SlipDamage};
use fe_core::material::{Material, MaterialError, Operator, PointContext};
use fe_core::testing::{MaterialCheck, Worst, below, check_material, within};
use nalgebra::{Matrix3, Vector3};

const SCENE: LuJoint = LuJoint {
    ft_mpa: 2.2,
    width_ratio: 0.5,
};

fn law(normal: Normal) -> SlipDamage {
    let settings = BondSettings {
        normal,
        ..BondSettings::default()
    };
    SlipDamage::new(SCENE.bilinear().unwrap(), settings).unwrap()
}

/// A point driven through jumps.
struct Point {
    law: SlipDamage,
    state: Vec<f64>,
    ctx: PointContext,
}

impl Point {
    fn new(law: SlipDamage) -> Self {
        let state = vec![0.0; law.state_len()];
        Self {
            law,
            state,
            ctx: PointContext::new(1.0),
        }
    }

    fn go(&mut self, jump: [f64; 3]) -> (Vector3<f64>, Matrix3<f64>) {
        let mut trial = vec![f64::NAN; self.state.len()];
        let answer = self
            .law
            .update(&jump.into(), &self.state, &mut trial, &self.ctx)
            .unwrap();
        self.state = trial;
        (answer.stress, answer.tangent)
    }
}

/// Target: the parameters of two widths to the digits given, damage at twice s0.
#[test]
fn mat07_parameters_and_damage() {
    let law = law(Normal::Bonded);
    let curve = law.envelope();
    for (what, found, target, digits) in [
        ("tau_max (MPa)", curve.strength(), 3.30, 1e-12),
        ("s0 (mm)", curve.peak_slip(), 0.04290, 1e-12),
        ("s_f (mm)", curve.final_slip(), 0.27687, 5e-6),
        ("G_f (N/mm)", curve.energy(), 0.45684, 5e-6),
        ("K0 (MPa/mm)", curve.stiffness(), 76.92, 5e-3),
    ] {
        within(
            &format!("MAT-07: {what}, half width"),
            found,
            target,
            digits,
        );
    }
    let wide = LuJoint {
        width_ratio: 1.0,
        ..SCENE
    };
    let bond = wide.bilinear().unwrap();
    for (what, found, target, digits) in [
        ("beta_w", wide.width_factor(), 0.7454, 5e-5),
        ("tau_max (MPa)", bond.strength(), 2.460, 5e-4),
        ("s0 (mm)", bond.peak_slip(), 0.03198, 5e-6),
        ("G_f (N/mm)", bond.energy(), 0.25380, 5e-6),
        ("s_f (mm)", bond.final_slip(), 0.20637, 5e-6),
    ] {
        within(&format!("{what}, full width"), found, target, digits);
    }
    let twice = 2.0 * curve.peak_slip();
    let mut point = Point::new(law.clone());
    point.go([twice, 0.0, 0.0]);
    let damage = SlipDamage::damage(&point.state);
    within("MAT-07: damage at 2 s0", damage, 0.5917, 5e-5);
    let end = curve.final_slip();
    let d = end * (twice - curve.peak_slip()) / (twice * (end - curve.peak_slip()));
    assert!((SlipDamage::damage(&point.state) - d).abs() < 1e-14);
}

/// Monotone slip to s_f through many points, the kink among them: trapezia are exact.
#[test]
fn mat07_the_area_under_a_monotone_path_is_the_fracture_energy() {
    let settings = BondSettings {
        residual: 0.0,
        ..BondSettings::default()
    };
    let mut point = Point::new(SlipDamage::new(SCENE.bilinear().unwrap(), settings).unwrap());
    let (s0, sf) = (
        point.law.envelope().peak_slip(),
        point.law.envelope().final_slip(),
    );
    let up = (1..=50).map(|i| s0 * f64::from(i) / 50.0);
    let down = (1..=200).map(|i| s0 + (sf - s0) * f64::from(i) / 200.0);
    let (mut work, mut last) = (0.0, (0.0, 0.0));
    // At 3-4-5 to the axes: the slip counts by its length.
    for slip in up.chain(down) {
        let (t, _) = point.go([0.6 * slip, 0.8 * slip, 0.0]);
        let tau = t[0].hypot(t[1]);
        assert!((t[0] * 0.8 - t[1] * 0.6).abs() < 1e-12);
        work += 0.5 * (tau + last.1) * (slip - last.0);
        last = (slip, tau);
    }
    let miss = (work / SCENE.energy() - 1.0).abs();
    below(
        "MAT-07: area under the path against G_f, relative error",
        miss,
        1e-12,
    );
    assert!(point.law.is_debonded(&point.state) && point.law.is_softening(&point.state));
}

/// Target: secant unloading through the origin to rounding; no damage in compression.
#[test]
fn mat07_unloading_goes_through_the_origin_and_compression_does_no_damage() {
    let mut point = Point::new(law(Normal::Bonded));
    let (tau, _) = point.go([0.12, 0.0, 0.0]);
    let mut worst = Worst::new("MAT-07: unloading against the secant (MPa), error", 1e-13);
    for share in [0.7, 0.2, 0.0, -0.5, -0.99, 0.4, 0.99] {
        let (t, tangent) = point.go([share * 0.12, 0.0, 0.0]);
        worst.see(t[0] - share * tau[0], share);
        assert!((tangent[(0, 0)] - tau[0] / 0.12).abs() < 1e-10);
        assert_eq!(SlipDamage::slip_max(&point.state), 0.12);
    }
    worst.tell();
    // Loading goes on where it had stopped, in another direction as well.
    let curve = point.law.envelope().stress(0.2);
    assert!((point.go([0.0, -0.2, 0.0]).0[1] + curve).abs() < 1e-13);
    let mut pressed = Point::new(law(Normal::Unilateral));
    assert!(
        (pressed.go([0.0, 0.0, -0.5]).0[2] + 0.5 * 10.0 * pressed.law.envelope().stiffness()).abs()
            < 1e-9
    );
    assert_eq!(pressed.state, [0.0, 0.0]);
}

/// The softening branch falls with the slope of the curve; the secant operator stays positive.
#[test]
fn operators() {
    let law = law(Normal::Bonded);
    let (s0, sf) = (law.envelope().peak_slip(), law.envelope().final_slip());
    let slope = -law.envelope().strength() / (sf - s0);
    let mut point = Point::new(law);
    let (_, tangent) = point.go([0.1, 0.0, 0.01]);
    assert!((tangent[(0, 0)] - slope).abs() < 1e-9);
    let before = point.state.clone();
    point.ctx = PointContext::new(1.0).with_operator(Operator::Secant);
    for slip in [0.2, 2.0 * sf] {
        point.state.clone_from(&before);
        let (_, secant) = point.go([slip, 0.0, 0.0]);
        let k0 = point.law.envelope().stiffness();
        let expected = (point.law.envelope().stress(slip) / slip).max(1e-4 * k0);
        assert!((secant[(0, 0)] - expected).abs() < 1e-12 * k0);
        assert!((secant[(2, 2)] - 10.0 * k0).abs() < 1e-9);
    }
}

/// Unilateral: intact it resists opening, debonded it opens freely and closes with the full stiffness.
#[test]
fn debonded_faces_open_freely_and_close_again() {
    let mut point = Point::new(law(Normal::Unilateral));
    let (k0, sf) = (
        point.law.envelope().stiffness(),
        point.law.envelope().final_slip(),
    );
    assert!((point.go([0.0, 0.0, 1e-3]).0[2] - 1e-2 * k0).abs() < 1e-12);
    point.go([1.1 * sf, 0.0, 0.0]);
    let (open, _) = point.go([0.0, 0.0, 0.3]);
    assert!((open[2] - 1e-6 * 10.0 * k0 * 0.3).abs() < 1e-15);
    let (closed, _) = point.go([0.0, 0.0, -0.3]);
    assert!((closed[2] + 10.0 * k0 * 0.3).abs() < 1e-12);
    let mut bonded = Point::new(law(Normal::Bonded));
    bonded.go([1.1 * sf, 0.0, 0.0]);
    assert!((bonded.go([0.0, 0.0, 0.3]).0[2] - 10.0 * k0 * 0.3).abs() < 1e-12);
}

/// What is left of a lost bond: 1e-6 K0 in stress and tangent.
#[test]
fn residual_stiffness() {
    let mut point = Point::new(law(Normal::Bonded));
    let (k0, sf) = (
        point.law.envelope().stiffness(),
        point.law.envelope().final_slip(),
    );
    let (t, tangent) = point.go([3.0 * sf, 0.0, 0.0]);
    assert!((t[0] / (1e-6 * k0 * 3.0 * sf) - 1.0).abs() < 1e-12);
    assert!((tangent[(0, 0)] / (1e-6 * k0) - 1.0).abs() < 1e-12);
    let settings = BondSettings {
        residual: 0.5,
        ..BondSettings::default()
    };
    let refused = SlipDamage::new(SCENE.bilinear().unwrap(), settings);
    assert!(matches!(
        refused,
        Err(MaterialError::Parameter {
            parameter: "residual",
            ..
        })
    ));
}

/// Relaxation a admits the share a of the growth of kappa.
#[test]
fn relaxation_scales_the_growth_of_history() {
    let mut point = Point::new(law(Normal::Bonded));
    point.go([0.05, 0.0, 0.0]);
    for (a, expected) in [(0.0, 0.05), (0.25, 0.0875), (1.0, 0.2)] {
        let mut p = Point::new(point.law.clone());
        p.state.clone_from(&point.state);
        p.ctx.relaxation = a;
        p.go([0.2, 0.0, 0.0]);
        assert!((SlipDamage::slip_max(&p.state) - expected).abs() < 1e-15);
    }
}

#[test]
fn conformance() {
    let exponential = ExponentialParameters {
        strength_mpa: 3.3,
        fracture_energy_n_per_mm: 0.457,
    };
    for normal in [Normal::Bonded, Normal::Unilateral] {
        let settings = BondSettings {
            normal,
            ..BondSettings::default()
        };
        let laws = [
            SlipDamage::new(SCENE.bilinear().unwrap(), settings),
            SlipDamage::new(SCENE.simplified().unwrap(), settings),
            SlipDamage::new(SCENE.precise(160.0).unwrap(), settings),
            SlipDamage::new(Exponential::new(&exponential).unwrap(), settings),
        ];
        for law in laws {
            let law = law.unwrap();
            let check = MaterialCheck {
                paths: 100,
                steps: 100,
                amplitude: vec![0.3, 0.3, 0.02],
                // The curve of the precise model bends over 1e-3 mm at its start.
                difference_step: 1e-7,
                ..MaterialCheck::new(0.3)
            };
            let report =
                check_material(&law, &check).unwrap_or_else(|e| panic!("{}: {e}", law.name()));
            assert!(report.least_dissipation.is_some());
            assert!(report.least_pivot > 0.0);
        }
    }
}
