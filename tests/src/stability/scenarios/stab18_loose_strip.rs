//! STAB-18: strip of 100 mm that has come off entirely.
//!
//! Source: without a residual the matrix has a rigid motion of the strip and whatever displacement comes out is arbitrary.
//! Targets: no negative pivot with either operator; stiffness of the strip 1e-6 K0 L b_f; reactions that
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

use crate::mesh::lines;
use crate::stability::{Case, Failure, Figure, Method, Scenario};
use crate::strip::{Strip, WIDTH, bond};

const LENGTH: f64 = 100.0;

/// Negative pivots seen.
struct Pivots(usize);

impl Recorder for Pivots {
    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue> {
        self.0 = self.0.max(view.negative_pivots.unwrap_or(0));
        Ok(Continue::Yes)
    }
}

fn figures() -> Result<Vec<Figure>, Failure> {
    let law = Arc::new(SlipDamage::new(bond()?, BondSettings::default())?);
    let x = lines(0.0, LENGTH, 10);
    let strip = Strip::new(&x, InterfaceRule::Gauss3, &(law.clone() as _))?;
    let model = &strip.model;
    let mut state = StateStore::new(model.elements());
    let virgin = vec![0.0; model.dofs().len()];

    let mut off = strip.held()?;
    for &node in &strip.sheet {
        off.prescribe(model, node, Dof::Ux, 1.5 * bond()?.final_slip())?;
    }
    let once = StepControl {
        criterion: 1e-9,
        ..StepControl::new(1.0, 1.0)
    };
    let mut newton = NewtonRaphson::new(NewtonSettings::default());
    let mut stage = Stage::new(model, off, &mut state, virgin.clone())?;
    once.run(&mut stage, &mut newton, &mut Pivots(0))?;
    let bonded = (10..model.elements().len())
        .flat_map(|e| state.committed(e).chunks_exact(2))
        .filter(|point| !law.is_debonded(point))
        .count();

    let mut loaded = strip.held()?;
    for (node, share) in strip.line(LENGTH) {
        loaded.add_reference(model, node, Dof::Ux, share)?;
    }
    let mut stage = Stage::new(model, loaded, &mut state, virgin.clone())?;
    let mut negative = 0;
    for operator in [Operator::Tangent, Operator::Secant] {
        stage.residual(&virgin, 0.0, &EvaluationContext::new(operator))?;
        stage.factorise()?;
        negative += stage.counters().negative_pivots;
    }
    // The condition of the matrix, about 1e8, limits how small a residual can be.
    let loosely = StepControl {
        criterion: 1e-7,
        ..once
    };
    let mut pivots = Pivots(0);
    loosely.run(&mut stage, &mut newton, &mut pivots)?;
    let at = |node| model.dof(node, Dof::Ux);
    let mut reactions = 0.0;
    for &node in &strip.face {
        reactions += stage.reaction(at(node)?);
    }
    let mut mean = 0.0;
    for (node, weight) in strip.line(0.0) {
        mean += weight * stage.displacement()[at(node)?];
    }
    let expected = 1.0 / (1e-6 * law.envelope().stiffness() * LENGTH * WIDTH);
    Ok(vec![
        Figure::at_most("points still bonded", bonded as f64, 0.0),
        Figure::at_most("negative pivots", (negative + pivots.0) as f64, 0.0),
        Figure::near("reactions, N", reactions, -1.0, 1e-6),
        Figure::near("displacement, mm", mean, expected, 1e-3),
    ])
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-18",
    title: "floating strip: what has come off stays where the residual holds it",
    remark: "",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
