//! STAB-07: steps that are longer than the way to the peak.

use super::stab05_crack_event::{draw, figures, weak_cell};
use crate::stability::{COARSE, Case, Scenario};

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-07",
    title: "steps that skip the event: the same bar, steps of 0.05 mm",
    remark: "The catalogue limits the change of damage in a step to 0.1. The automatic driver limits the load that histories take away \
             in a step to 2 % instead: in one bar the two go together, but damage that hardly moves the load is not limited.",
    coarse: COARSE,
    run: |method, coarse| {
        Some(draw(method, 0.05 * coarse, &weak_cell())?.map(|driven| {
            let figures = figures(&driven);
            Case::driven(driven, figures)
        }))
    },
};
