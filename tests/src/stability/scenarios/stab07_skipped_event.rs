//! STAB-07: steps that are longer than the way to the peak.

use super::stab05_crack_event::{draw, figures, weak_cell};
use crate::stability::{COARSE, Case, Scenario};

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-07",
    title: "steps that skip the event: the same bar, steps of 0.05 mm",
    coarse: COARSE,
    run: |method, coarse| {
        Some(draw(method, 0.05 * coarse, &weak_cell())?.map(|driven| {
            let figures = figures(&driven);
            Case::driven(driven, figures)
        }))
    },
};
