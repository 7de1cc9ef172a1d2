//! Mistakes in the bond of bars.

use super::{Case, check_cases};

const SLIP: &str = include_str!("../../specimens/examples/A-SO3-1-slip.ron");

const CASES: &[Case] = &[
    // Out of range; in range, but less than the slip at the end of the plateau.
    (
        "condition: Good,\n                confinement: PullOut,\n                rib_spacing_mm: 16",
        "condition: Good,\n                confinement: PullOut,\n                rib_spacing_mm: -16",
        "-16",
        &[
            "bars[0].bond.ModelCode.rib_spacing_mm: -16 mm is out of range",
            "allowed: 1 to 50 mm",
        ],
    ),
    (
        "condition: Other,\n                confinement: PullOut,\n                rib_spacing_mm: 16",
        "condition: Other,\n                confinement: Unconfined,\n                rib_spacing_mm: 3.5",
        "3.5",
        &[
            "bars[1].bond.rib_spacing_mm: 3.5 mm",
            "beyond 3.600 mm",
            "give the clear distance between the ribs, about half the diameter of the bar",
        ],
    ),
    // Nothing to anchor.
    (
        "bond: ModelCode(\n                condition: Good,\n                confinement: PullOut,\n                \
         rib_spacing_mm: 16,\n                source: \"assumed: at the bottom of the form; ribs half a diameter apart; \
         no splitting\",\n            ),",
        "anchored: true,",
        "true",
        &[
            "bars[0].anchored: anchored, with perfect bond",
            "leave `anchored` out",
        ],
    ),
    (
        "condition: Good",
        "condition: Poor",
        "Poor",
        &[
            "bars[0].bond.ModelCode.condition: no such choice",
            "allowed: Good, Other",
        ],
    ),
    (
        "condition: Good",
        "state: Good",
        "state",
        &["bars[0].bond.ModelCode.state: no such field"],
    ),
];

#[test]
fn mistakes_in_the_bond_of_bars_are_named_with_their_place() {
    check_cases(SLIP, CASES);
}
