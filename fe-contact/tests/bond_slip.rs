//! Protects [`BondSlip`]: the contract of an element in a distorted host, resultants, refusals.
//!
//! Source: the formulas of its documentation. Targets: conformance check of elements; exact within rounding.

use std::sync::Arc;

use fe_contact::envelope::{Bond, Confinement, ModelCode, ModelCodeParameters};
use fe_contact::{BondSettings, BondSlip, BondSlipBar, SlipDamage};
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::material::Operator;
use fe_core::shape::hex20;
use fe_core::testing::{ElementCheck, check_element};

const BAR: [[f64; 3]; 3] = [[-15.0, -8.0, 4.0], [17.0, 6.0, 9.0], [1.0, -1.0, 6.5]];

/// A distorted hexahedron of about 50 mm.
fn host() -> [[f64; 3]; 20] {
    hex20::NODES.map(|[x, y, z]| {
        [
            25.0 * x + 2.0 * y * z,
            24.0 * y + 1.5 * x * x,
            26.0 * z - x * y,
        ]
    })
}

fn bar() -> BondSlipBar {
    let curve = ModelCode::new(&ModelCodeParameters {
        fcm_mpa: 36.0,
        rib_spacing_mm: 8.0,
        bond: Bond::Good,
        confinement: Confinement::PullOut,
    });
    BondSlipBar {
        diameter_mm: 16.0,
        transverse_mpa_per_mm: 1e3,
        law: Arc::new(SlipDamage::new(curve.unwrap(), BondSettings::default()).unwrap()),
    }
}

fn new(coords: [[f64; 3]; 3], bar: &BondSlipBar) -> Result<BondSlip, ElementError> {
    BondSlip::new(std::array::from_fn(|a| a), &coords, &host(), bar)
}

#[test]
fn conformance() {
    let mut curved = BAR;
    curved[2][1] += 3.0;
    for bar_at in [BAR, curved] {
        let element = new(bar_at, &bar()).unwrap();
        let coords: Vec<_> = bar_at.into_iter().chain(host()).collect();
        let check = ElementCheck {
            kink_share: 0.3,
            ..ElementCheck::new(0.5)
        };
        let report = check_element(&element, &coords, &check).unwrap();
        assert_eq!(report.motions, 6);
    }
}

/// The bar slides by 0.1 mm along its axis and moves by 0.01 mm across it. Targets: bond stress and transverse pressure on
/// the surface of the bar, in the sampled points and as resultants on bar and host.
#[test]
fn uniform_slip() {
    let element = new(BAR, &bar()).unwrap();
    let chord: Vec<f64> = (0..3).map(|k| BAR[1][k] - BAR[0][k]).collect();
    let length = chord.iter().map(|c| c * c).sum::<f64>().sqrt();
    let t: Vec<f64> = chord.iter().map(|c| c / length).collect();
    // A direction across the bar.
    let across = [-t[1], t[0], 0.0].map(|c| c / t[0].hypot(t[1]));
    let mut u = vec![0.0; 69];
    for node in u[..9].chunks_exact_mut(3) {
        for k in 0..3 {
            node[k] = 0.1 * t[k] + 0.01 * across[k];
        }
    }
    let state = vec![0.0; element.state_len()];
    let tau = 15.0 * 0.1_f64.powf(0.4);
    let mut surface = 0.0;
    let mut trial = state.clone();
    let mut force = vec![0.0; 69];
    let out = ElementSystem {
        force: &mut force,
        stiffness: &mut [],
    };
    let ctx = EvaluationContext::new(Operator::None);
    element.evaluate(&u, &state, &mut trial, &ctx, out).unwrap();
    element
        .sample(&u, &trial, &mut |s| {
            surface += s.volume;
            assert!((s.strain[0] - 0.1).abs() < 1e-12);
            assert!((s.strain[1].hypot(s.strain[2]) - 0.01).abs() < 1e-12);
            assert!((s.stress[0] - tau).abs() < 1e-9);
            assert!((s.stress[1].hypot(s.stress[2]) - 10.0).abs() < 1e-9);
        })
        .unwrap();
    assert!((surface / (std::f64::consts::PI * 16.0 * length) - 1.0).abs() < 1e-12);
    for k in 0..3 {
        let expected = surface * (tau * t[k] + 10.0 * across[k]);
        let bar: f64 = force[..9].iter().skip(k).step_by(3).sum();
        let host: f64 = force[9..].iter().skip(k).step_by(3).sum();
        assert!((bar - expected).abs() < 1e-6 && (bar + host).abs() < 1e-9);
    }
    assert!(element.free_energy(&u, &trial).unwrap().unwrap() > 0.0);
}

#[test]
fn bars_outside_and_impossible_numbers_are_refused() {
    let far = BAR.map(|[x, y, z]| [x + 30.0, y, z]);
    assert!(matches!(new(far, &bar()), Err(ElementError::NoHost { .. })));
    let point = [BAR[0]; 3];
    assert!(matches!(
        new(point, &bar()),
        Err(ElementError::Jacobian { .. })
    ));
    // The middle node at a tenth of the length, whose end turns back, and at no place at all.
    let near = std::array::from_fn(|k| BAR[0][k] + 0.1 * (BAR[1][k] - BAR[0][k]));
    for middle in [near, [f64::INFINITY; 3]] {
        let refused = new([BAR[0], BAR[1], middle], &bar());
        assert!(matches!(refused, Err(ElementError::Jacobian { .. })));
    }
    let thin = BondSlipBar {
        diameter_mm: 0.0,
        ..bar()
    };
    assert!(matches!(new(BAR, &thin), Err(ElementError::Input { .. })));
}
