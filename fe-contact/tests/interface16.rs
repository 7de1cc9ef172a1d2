//! Protects [`Interface16`]: axes, rigid motions, resultants, areas, refusals, the contract of an element.
//!
//! Source: the formulas of its documentation. Targets: exact within rounding; conformance check of elements.

use std::sync::Arc;

use fe_contact::envelope::LuJoint;
use fe_contact::{
    BondSettings, Interface, Interface16, InterfaceRule, MixedMode, MixedModeParameters, Normal,
    SlipDamage,
};
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::material::{Material, Operator};
use fe_core::shape::quad8;
use fe_core::testing::{ElementCheck, check_element};

const RULES: [InterfaceRule; 3] = [
    InterfaceRule::Gauss3,
    InterfaceRule::Gauss2,
    InterfaceRule::Lobatto3,
];

/// A slightly curved, skew face of about 40 mm in space.
fn curved() -> [[f64; 3]; 8] {
    quad8::NODES.map(|[x, y]| {
        [
            20.0 * x + 2.0 * x * y,
            14.0 * y + x - 3.0 * x * x,
            10.0 * y + 1.5 * x * y,
        ]
    })
}

/// A rectangle of 40 x 20 mm in the plane z = 5, normal +z.
fn flat() -> [[f64; 3]; 8] {
    quad8::NODES.map(|[x, y]| [20.0 * x, 10.0 * y, 5.0])
}

fn both(face: [[f64; 3]; 8]) -> Vec<[f64; 3]> {
    face.into_iter().chain(face).collect()
}

fn bond(normal: Normal) -> Arc<dyn Material<Interface>> {
    let joint = LuJoint {
        ft_mpa: 2.2,
        width_ratio: 0.5,
    };
    let settings = BondSettings {
        normal,
        ..BondSettings::default()
    };
    Arc::new(SlipDamage::new(joint.bilinear().unwrap(), settings).unwrap())
}

fn element(
    face: &[[f64; 3]; 8],
    rule: InterfaceRule,
    law: Arc<dyn Material<Interface>>,
) -> Interface16 {
    Interface16::new(std::array::from_fn(|a| a), face, [1.0, 0.2, 0.1], rule, law).unwrap()
}

#[test]
fn conformance() {
    let delamination = MixedModeParameters {
        stiffness_mpa_per_mm: 1e4,
        normal_strength_mpa: 80.0,
        shear_strength_mpa: 100.0,
        mode_1_energy_n_per_mm: 0.969,
        mode_2_energy_n_per_mm: 1.719,
        exponent: 2.284,
        residual: 1e-6,
    };
    let laws: [(Arc<dyn Material<Interface>>, f64); 3] = [
        (bond(Normal::Bonded), 0.1),
        (bond(Normal::Unilateral), 0.1),
        (Arc::new(MixedMode::new(delamination).unwrap()), 0.01),
    ];
    for (law, amplitude) in laws {
        for rule in RULES {
            for face in [curved(), flat()] {
                let element = element(&face, rule, Arc::clone(&law));
                let check = ElementCheck {
                    paths: 4,
                    // Many points, each with a kink of its own.
                    kink_share: 0.3,
                    ..ElementCheck::new(amplitude)
                };
                let report = check_element(&element, &both(face), &check)
                    .unwrap_or_else(|e| panic!("{} {rule:?}: {e}", law.name()));
                assert_eq!(report.motions, 6);
            }
        }
    }
}

/// Large rigid translations and rotations of coincident faces: no jump at any point, hence no force.
#[test]
fn rigid_bodies_have_no_jump() {
    let face = curved();
    for rule in RULES {
        let element = element(&face, rule, bond(Normal::Bonded));
        let u: Vec<f64> = both(face)
            .iter()
            .flat_map(|[x, y, z]| [3.0 - 0.4 * y, -2.0 + 0.4 * x + 0.7 * z, 5.0 - 0.7 * y])
            .collect();
        let state = vec![0.0; element.state_len()];
        let mut visited = 0;
        element
            .sample(&u, &state, &mut |s| {
                visited += 1;
                assert!(s.strain.iter().all(|d| d.abs() < 1e-13), "{:?}", s.strain);
            })
            .unwrap();
        assert_eq!(visited, if rule == InterfaceRule::Gauss2 { 4 } else { 9 });
    }
}

/// A uniform motion of the upper face by (0.01, 0.02, 0.001): jump in the axes, traction, resultants, energy.
#[test]
fn uniform_jump_on_a_rectangle() {
    for rule in RULES {
        let element = Interface16::new(
            std::array::from_fn(|a| a),
            &flat(),
            // t1 along y: t2 = n x t1 = -x.
            [0.0, 3.0, 1.0],
            rule,
            bond(Normal::Bonded),
        )
        .unwrap();
        let mut u = vec![0.0; 48];
        for node in u[24..].chunks_exact_mut(3) {
            node.copy_from_slice(&[0.01, 0.02, 0.001]);
        }
        let k0 = 1.5 / 0.0195;
        let state = vec![0.0; element.state_len()];
        let mut area = 0.0;
        element
            .sample(&u, &state, &mut |s| {
                area += s.volume;
                assert!((s.position[2] - 5.0).abs() < 1e-13);
                for (found, target) in s.strain.iter().zip([0.02, -0.01, 0.001]) {
                    assert!((found - target).abs() < 1e-15);
                }
                for (found, target) in s.stress.iter().zip([0.02 * k0, -0.01 * k0, 0.01 * k0]) {
                    assert!((found - target).abs() < 1e-12);
                }
            })
            .unwrap();
        assert!((area - 800.0).abs() < 1e-10);
        let mut force = vec![0.0; 48];
        let out = ElementSystem {
            force: &mut force,
            stiffness: &mut [],
        };
        let mut trial = state.clone();
        let ctx = EvaluationContext::new(Operator::None);
        element.evaluate(&u, &state, &mut trial, &ctx, out).unwrap();
        for (k, target) in [0.01, 0.02, 0.01].into_iter().enumerate() {
            let upper: f64 = force[24..].iter().skip(k).step_by(3).sum();
            let lower: f64 = force[..24].iter().skip(k).step_by(3).sum();
            assert!((upper - 800.0 * k0 * target).abs() < 1e-9);
            assert!((upper + lower).abs() < 1e-9);
        }
        let energy = element.free_energy(&u, &trial).unwrap().unwrap();
        let work: f64 = force.iter().zip(&u).map(|(f, u)| f * u).sum();
        assert!((2.0 * energy / work - 1.0).abs() < 1e-12);
    }
}

#[test]
fn impossible_faces_and_directions_are_refused() {
    let new = |face: [[f64; 3]; 8], direction| {
        let nodes = std::array::from_fn(|a| a);
        Interface16::new(
            nodes,
            &face,
            direction,
            InterfaceRule::Gauss3,
            bond(Normal::Bonded),
        )
    };
    let line = flat().map(|[x, _, z]| [x, 0.0, z]);
    assert!(matches!(
        new(line, [1.0, 0.0, 0.0]),
        Err(ElementError::Jacobian { .. })
    ));
    let mut folded = flat();
    for k in 0..3 {
        // The middle of the first side lies beyond its end.
        folded[4][k] = 1.2 * folded[1][k] - 0.2 * folded[0][k];
    }
    assert!(matches!(
        new(folded, [1.0, 0.0, 0.0]),
        Err(ElementError::Jacobian { .. })
    ));
    for direction in [[0.0, 0.0, 1.0], [0.0; 3], [f64::NAN, 0.0, 0.0]] {
        assert!(matches!(
            new(flat(), direction),
            Err(ElementError::Input { .. })
        ));
    }
}

/// Two corners of a side exchanged, as by a slip in a list of nodes, are refused whatever the rule sees.
#[test]
fn exchanged_corners_are_refused() {
    for a in 0..4 {
        for rule in RULES {
            let mut face = flat();
            face.swap(a, (a + 1) % 4);
            let (nodes, law) = (std::array::from_fn(|a| a), bond(Normal::Bonded));
            let turned = Interface16::new(nodes, &face, [1.0, 0.3, 0.0], rule, law);
            let refused = matches!(turned, Err(ElementError::Jacobian { .. }));
            assert!(refused, "{a} {rule:?}");
        }
    }
}
