//! STAB-18: strip of 100 mm that has come off entirely.
//!
//! Source: without a residual the matrix has a rigid motion of the strip and whatever displacement comes out is arbitrary.
//! Targets: no negative or vanishing pivot with either operator; stiffness of the strip 1e-6 K0 L b_f; reactions that
//! balance a unit load to 1e-6.

use std::sync::Arc;

use fe_contact::{BondSettings, Envelope, InterfaceRule, SlipDamage};
use fe_core::dof::Dof;
use fe_core::element::EvaluationContext;
use fe_core::material::Operator;
use fe_core::state::StateStore;
use fe_solver::control::StepControl;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::recorder::{Continue, Recorder, StepView};
use fe_solver::stage::Stage;
use fe_tests::mesh::lines;
use fe_tests::strip::{Strip, WIDTH, bond};

const LENGTH: f64 = 100.0;

/// Negative pivots seen.
struct Pivots(usize);

impl Recorder for Pivots {
    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue> {
        self.0 = self.0.max(view.negative_pivots);
        Ok(Continue::Yes)
    }
}

#[test]
fn a_loose_strip_stays_where_the_residual_holds_it() {
    let law = Arc::new(SlipDamage::new(bond().unwrap(), BondSettings::default()).unwrap());
    let x = lines(0.0, LENGTH, 10);
    let strip = Strip::new(&x, InterfaceRule::Gauss3, &(law.clone() as _)).unwrap();
    let model = &strip.model;
    let mut state = StateStore::new(model.elements());
    let virgin = vec![0.0; model.dofs().len()];

    let mut off = strip.held().unwrap();
    for &node in &strip.sheet {
        off.prescribe(model, node, Dof::Ux, 1.5 * bond().unwrap().final_slip())
            .unwrap();
    }
    let once = StepControl {
        criterion: 1e-9,
        ..StepControl::new(1.0, 1.0)
    };
    let mut newton = NewtonRaphson::new(NewtonSettings::default());
    let mut stage = Stage::new(model, off, &mut state, virgin.clone()).unwrap();
    once.run(&mut stage, &mut newton, &mut Pivots(0)).unwrap();
    for (e, element) in model.elements().iter().enumerate().skip(10) {
        for point in state.committed(e).chunks_exact(2) {
            assert!(law.is_debonded(point), "{element:?}");
        }
    }

    let mut loaded = strip.held().unwrap();
    for (node, share) in strip.line(LENGTH) {
        loaded.add_reference(model, node, Dof::Ux, share).unwrap();
    }
    let mut stage = Stage::new(model, loaded, &mut state, virgin.clone()).unwrap();
    for operator in [Operator::Tangent, Operator::Secant] {
        let ctx = EvaluationContext::new(operator);
        stage.residual(&virgin, 0.0, &ctx).unwrap();
        stage.factorise().unwrap();
        assert_eq!(stage.counters().negative_pivots, 0, "{operator:?}");
    }
    // The condition of the matrix, about 1e8, limits how small a residual can be.
    let loosely = StepControl {
        criterion: 1e-7,
        ..once
    };
    let mut pivots = Pivots(0);
    loosely.run(&mut stage, &mut newton, &mut pivots).unwrap();
    assert_eq!(pivots.0, 0);
    let at = |node| model.dof(node, Dof::Ux).unwrap();
    let reactions: f64 = strip.face.iter().map(|&n| stage.reaction(at(n))).sum();
    assert!((reactions + 1.0).abs() < 1e-6, "{reactions}");
    let free = strip.line(0.0);
    let mean: f64 = free
        .iter()
        .map(|&(n, w)| w * stage.displacement()[at(n)])
        .sum();
    let expected = 1.0 / (1e-6 * law.envelope().stiffness() * LENGTH * WIDTH);
    assert!((mean / expected - 1.0).abs() < 1e-3, "{mean}, {expected}");
}
