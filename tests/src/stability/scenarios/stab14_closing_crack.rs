//! STAB-14: a crack that is closed and opened again.

use super::stab05_crack_event::weak_cell;
use crate::driven::{Leg, drive};
use crate::softening_bar::moved;
use crate::stability::{COARSE, Case, Failure, Figure, Method, Scenario};

fn run(method: Method, coarse: f64) -> Option<Result<Case, Failure>> {
    let step = 0.005 * coarse;
    let mut driver = method.imposing(step)?;
    let (model, conditions) = moved(500.0, &weak_cell());
    let legs = [0.05, -0.02, 0.06, 0.0, 0.08].map(|to| Leg { to, step });
    let driven = drive(&model, &conditions, &legs, 1e-4, driver.as_mut());
    Some(driven.map_err(Failure::from).map(|driven| {
        let figures = vec![
            Figure::at_most("energy created, N mm", driven.created(), 1e-3),
            Figure::at_most(
                "iterations of 95 % of steps",
                driven.iterations_within(0.95) as f64,
                15.0,
            ),
        ];
        Case::driven(driven, figures)
    }))
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-14",
    title: "a crack closes and opens again, twice",
    coarse: COARSE,
    run,
};
