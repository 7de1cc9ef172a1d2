//! STAB-10: row sums of the shape functions, negative at the corners of a quadrilateral, would make springs of negative
//! stiffness at the nodes of an interface; points of integration do not.

use std::sync::Arc;

use fe_contact::{Interface16, InterfaceRule};
use fe_core::element::{Element, ElementSystem, EvaluationContext};
use fe_core::material::Operator;

use super::stab09_traction::elastic;
use crate::stability::{Case, Failure, Figure, Method, Scenario};
use crate::strip::square;

/// Diagonal of corner and mid-side over K A/4 by a rule.
fn diagonal(rule: InterfaceRule) -> Result<[f64; 2], Failure> {
    let nodes = std::array::from_fn(|a| a);
    let law = Arc::new(elastic(100.0)?);
    let element = Interface16::new(nodes, &square(20.0), [1.0, 0.0, 0.0], rule, law)?;
    let state = vec![0.0; element.state_len()];
    let (mut force, mut stiffness) = (vec![0.0; 48], vec![0.0; 48 * 48]);
    let out = ElementSystem {
        force: &mut force,
        stiffness: &mut stiffness,
    };
    let ctx = EvaluationContext::new(Operator::Tangent);
    element.evaluate(&[0.0; 48], &state, &mut state.clone(), &ctx, out)?;
    Ok([0, 4].map(|node| stiffness[3 * node * 49] / (100.0 * 400.0 / 4.0)))
}

fn figures() -> Result<Vec<Figure>, Failure> {
    let mut figures = Vec::new();
    for rule in [
        InterfaceRule::Gauss2,
        InterfaceRule::Gauss3,
        InterfaceRule::Lobatto3,
    ] {
        let [corner, side] = diagonal(rule)?;
        figures.push(Figure::at_least(
            format!("least diagonal, {rule:?}"),
            corner.min(side),
            1e-3,
        ));
    }
    let [corner, side] = diagonal(InterfaceRule::Lobatto3)?;
    figures.push(Figure::near("corner, Lobatto3", corner, 2.0 / 9.0, 1e-12));
    figures.push(Figure::near("mid-side, Lobatto3", side, 8.0 / 9.0, 1e-12));
    Ok(figures)
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-10",
    title: "nodal integration: no node of an interface has a negative stiffness",
    remark: "",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
