//! Protects dowels that slide at their strength: the stiffness is the derivative of the forces to the last digits that differences
//! give, and slides do not depend on rate.

use std::sync::Arc;

use fe_core::element::{Element, ElementSystem, EvaluationContext};
use fe_core::material::Operator;
use fe_core::mesh::{CellKind, Mesh};
use fe_core::shape::hex20::NODES;
use fe_core::testing::{ElementCheck, check_element};
use fe_elements::{Bar, Dowel, EmbeddedBar, embed};
use fe_materials::Biso;

const YIELD: f64 = 460.0;

/// A distorted cell of some 40 mm.
fn cell() -> [[f64; 3]; 20] {
    std::array::from_fn(|a| {
        let shift = [(a as f64).sin(), (2.0 * a as f64).cos(), 0.0];
        std::array::from_fn(|k| 20.0 * NODES[a][k] + 0.5 * shift[k])
    })
}

/// An oblique bar in it, whose dowel has the strength of one of `diameter` (mm).
fn bar(diameter: f64) -> EmbeddedBar {
    let mut mesh = Mesh::new(cell().to_vec()).unwrap();
    mesh.add_block("host", CellKind::Hex20, (0..20).collect())
        .unwrap();
    let dowel = Dowel::he_kwan(16.0, 38.0, 200e3, 50.0, [0.0, 0.0, 1.0]).unwrap();
    let bar = Bar {
        name: "bar".into(),
        polyline: vec![[-15.0, -12.0, -14.0], [3.0, 5.0, 1.0], [12.0, 4.0, 15.0]],
        area_mm2: 201.0,
        law: Arc::new(Biso::hot_rolled(200e3, YIELD, 2e3).unwrap()),
        dowel: Some(dowel.bounded(diameter, 38.0, YIELD).unwrap()),
    };
    embed(&[bar], &mesh, &["host"]).unwrap().remove(0)
}

/// Strong dowels slide near the yield stress, where their strength falls steeply. With the usual step of differences the curvature
/// of that fall leaves 1e-6; it goes with the square of the step, and nothing is left of it here. Target: 1e-8.
#[test]
fn stiffness_is_exact_where_the_strength_falls() {
    for diameter in [0.2, 2.0, 16.0] {
        for amplitude in [0.05, 0.3] {
            let check = ElementCheck {
                paths: 10,
                steps: 20,
                difference_step: 1e-6,
                tangent_tolerance: 1e-8,
                ..ElementCheck::new(amplitude)
            };
            let report = check_element(&bar(diameter), &cell(), &check).unwrap();
            assert!(report.kinks < 10, "{diameter} {amplitude}: {report:?}");
        }
    }
}

/// The forces of a state that a step has left, asked for with histories that are frozen or lag, are those of the step; and the next
/// step slides as far whatever the relaxation.
#[test]
fn slides_do_not_depend_on_rate() {
    let element = bar(2.0);
    let n = 60;
    let evaluate = |u: &[f64], state: &[f64], relaxation: f64| {
        let (mut force, mut trial) = (vec![0.0; n], vec![f64::NAN; state.len()]);
        let ctx = EvaluationContext {
            relaxation,
            ..EvaluationContext::new(Operator::None)
        };
        let out = ElementSystem {
            force: &mut force,
            stiffness: &mut [],
        };
        element.evaluate(u, state, &mut trial, &ctx, out).unwrap();
        (force, trial)
    };
    let mut virgin = vec![0.0; element.state_len()];
    element.init_state(&mut virgin);
    let displacement = |size: f64| -> Vec<f64> {
        let shear = |[x, y, z]: [f64; 3]| [2e-3 * y, 1e-3 * x + 1e-3 * z, -1e-3 * x];
        cell()
            .into_iter()
            .flat_map(|x| shear(x).map(|u| size * u))
            .collect()
    };
    let (u, further) = (displacement(1.0), displacement(1.5));
    let (force, state) = evaluate(&u, &virgin, 1.0);
    let slid = state.iter().rev().take(8).any(|gamma| gamma.abs() > 1e-4);
    assert!(slid, "{state:?}");
    let largest = force.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    let next = evaluate(&further, &state, 1.0);
    for relaxation in [0.0, 0.3] {
        let (again, _) = evaluate(&u, &state, relaxation);
        for (a, b) in force.iter().zip(&again) {
            assert!((a - b).abs() < 1e-12 * largest, "{a} {b}");
        }
        assert_eq!(evaluate(&further, &state, relaxation), next);
    }
}
