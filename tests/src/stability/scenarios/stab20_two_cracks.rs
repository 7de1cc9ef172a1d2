//! STAB-20: two places where a crack may open, one 1 % weaker; a model of half the bar forces both to.

use super::stab05_crack_event::draw;
use crate::softening_bar::{AREA, ENERGY, STRENGTH};
use crate::stability::{COARSE, Case, Failure, Figure, Method, Scenario};

/// Strengths of cells of which only those in `places` can crack.
fn at(places: &[(usize, f64)]) -> [f64; 10] {
    let mut strengths = [1.5 * STRENGTH; 10];
    for (i, share) in places {
        strengths[*i] = share * STRENGTH;
    }
    strengths
}

fn run(method: Method, coarse: f64) -> Option<Result<Case, Failure>> {
    let both = draw(method, 0.01 * coarse, &at(&[(2, 1.0), (7, 0.99)]))?;
    let alone = draw(method, 0.01 * coarse, &at(&[(2, 1.0)]))?;
    Some(both.and_then(|both| {
        let alone = alone?;
        let figures = vec![
            Figure::near("peak, N", both.peak(), 0.99 * STRENGTH * AREA, 1e-2),
            Figure::near("dissipation, N mm", both.dissipated(), ENERGY * AREA, 1e-2),
            Figure::near(
                "peak over that of one place",
                both.peak() / alone.peak(),
                0.99,
                1e-2,
            ),
        ];
        Ok(Case::driven(both, figures))
    }))
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-20",
    title: "bifurcation: two places may crack, one is 1 % weaker",
    coarse: COARSE,
    run,
};
