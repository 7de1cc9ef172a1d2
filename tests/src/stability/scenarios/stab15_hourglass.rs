//! STAB-15: the mechanism of a column of reduced hexahedra amid cracked neighbours.
//!
//! Asked by the catalogue: a flag on patches of n x 1 x 1 cells and a monitor of the hourglass energy, or 27 points there. The default
//! rule, of 14 points ([`HexRule::Irons`]), replaces both: it has no mechanism, as that of 27 points has none. What energy a mechanism of
//! the reduced rule is left with goes with the mode and with the mesh, of which the catalogue states neither: 0.099 of 0.963 there,
//! which is 0.103, and 0.062 here, with 27 points.

use fe_elements::HexRule;

use crate::hourglass::energy_of_a_mechanism;
use crate::stability::{Case, Failure, Figure, Method, Scenario};

fn figures() -> Result<Vec<Figure>, Failure> {
    let ratio = |rule| -> Result<f64, Failure> {
        Ok(energy_of_a_mechanism(rule, 1e-6)? / energy_of_a_mechanism(rule, 1.0)?)
    };
    Ok(vec![
        Figure::near(
            "energy left, 8 points",
            ratio(HexRule::Reduced)?,
            1e-6,
            1e-6,
        ),
        Figure::near(
            "energy left, 14 points",
            ratio(HexRule::Irons)?,
            0.0519,
            0.01,
        )
        .measured("none"),
        Figure::near(
            "energy left, 27 points",
            ratio(HexRule::Full)?,
            0.0618,
            0.01,
        )
        .measured("0.103 (0.099 of 0.963)"),
    ])
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-15",
    title: "hourglass modes of a column between cracked neighbours",
    remark: "The catalogue asks for a flag on patches of n x 1 x 1 cells and a monitor of the hourglass energy, or for 27 points there. The \
             default rule, of 14 points, replaces both: it has no mechanism.",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
