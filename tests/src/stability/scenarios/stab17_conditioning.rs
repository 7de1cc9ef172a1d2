//! STAB-17: a penalty of 1e6 MPa/mm makes the matrix 400 times worse conditioned than a bond does; a direct solver does not
//! mind.

use std::sync::Arc;

use fe_contact::InterfaceRule;
use fe_core::dof::Dof;

use super::stab09_traction::elastic;
use crate::mesh::lines;
use crate::solve::solve_to;
use crate::stability::{Case, Failure, Figure, Method, Scenario};
use crate::strip::Strip;

/// Sum of all forces along the strip over the force at its end.
fn imbalance(stiffness: f64) -> Result<f64, Failure> {
    let law = Arc::new(elastic(stiffness)?);
    let strip = Strip::new(&lines(0.0, 400.0, 80), InterfaceRule::Gauss3, &(law as _))?;
    let mut conditions = strip.held()?;
    for (node, share) in strip.line(400.0) {
        conditions.add_reference(&strip.model, node, Dof::Ux, 1000.0 * share)?;
    }
    let solution = solve_to(1e-9, &strip.model, conditions)?;
    Ok((solution.reaction(&strip.model, &strip.face, Dof::Ux) / 1000.0 + 1.0).abs())
}

fn figures() -> Result<Vec<Figure>, Failure> {
    let stiffnesses = [76.9, 1e3, 1e4, 1e6];
    let figure = |k: f64| -> Result<Figure, Failure> {
        Ok(Figure::at_most(
            format!("imbalance at {k:e} MPa/mm"),
            imbalance(k)?,
            1e-9,
        ))
    };
    stiffnesses.map(figure).into_iter().collect()
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-17",
    title: "conditioning: a bond stiffness of up to 1e6 MPa/mm",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
