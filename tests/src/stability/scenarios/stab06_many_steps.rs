//! STAB-06: the same bar in short steps: none may take many iterations, those of attempts that were
//! given up among them.

use super::stab05_crack_event::{draw, figures, weak_cell};
use crate::stability::{COARSE, Case, Figure, Scenario};

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-06",
    title: "choice of the operator: the same bar, steps of 0.002 mm",
    remark: "",
    coarse: COARSE,
    run: |method, coarse| {
        Some(draw(method, 0.002 * coarse, &weak_cell())?.map(|driven| {
            let mut figures = figures(&driven);
            let most = driven.iterations_within(0.95) as f64;
            figures.push(Figure::at_most("iterations of 95 % of steps", most, 20.0));
            Case::driven(driven, figures)
        }))
    },
};
