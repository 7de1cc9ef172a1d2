//! STAB-15: the mechanism of a column of reduced hexahedra amid cracked neighbours; the rule that is default has none.

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
        Figure::at_least("energy left, 27 points", ratio(HexRule::Full)?, 0.05),
    ])
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-15",
    title: "hourglass modes of a column between cracked neighbours",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
