//! STAB-20: two places where a crack may open, one 1 % weaker: that one opens alone. A model of half the bar knows nothing of it
//! and makes both crack: twice the dissipation, under 1/0.99 of the peak.
//!
//! The negative pivots along the path tell the two apart: one in the cell that cracks, with a second place as without, where a
//! bar with two places that are equal, which stays symmetric, has three after its peak, and so says that other paths branch
//! off.

use super::stab05_crack_event::draw;
use crate::driven::Driven;
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

/// Largest number of negative pivots; not a number if it was not told at every step.
fn pivots(driven: &Driven) -> f64 {
    driven.most_negative().map_or(f64::NAN, |n| n as f64)
}

fn run(method: Method, coarse: f64) -> Option<Result<Case, Failure>> {
    let draw = |strengths: &[f64]| draw(method, 0.01 * coarse, strengths);
    let both = draw(&at(&[(2, 1.0), (7, 0.99)]))?;
    let alone = draw(&at(&[(2, 1.0)]))?;
    let equal = draw(&at(&[(2, 1.0), (7, 1.0)]))?;
    let half = draw(&at(&[(2, 1.0)])[..5])?;
    Some(both.and_then(|both| {
        let (alone, equal, half) = (alone?, equal?, half?);
        let figures = vec![
            Figure::near("peak, N", both.peak(), 0.99 * STRENGTH * AREA, 2e-3),
            Figure::near("dissipation, N mm", both.dissipated(), ENERGY * AREA, 1e-2),
            Figure::near(
                "peak over that of one place",
                both.peak() / alone.peak(),
                0.99,
                2e-3,
            ),
            Figure::near(
                "peak over that of half a bar",
                both.peak() / half.peak(),
                0.99,
                2e-3,
            ),
            Figure::near(
                "dissipation of two halves over that",
                2.0 * half.dissipated() / both.dissipated(),
                2.0,
                1e-2,
            ),
            Figure::near("negative pivots", pivots(&both), 1.0, 0.0),
            Figure::near("negative pivots, one place", pivots(&alone), 1.0, 0.0),
            Figure::near("negative pivots, equal places", pivots(&equal), 3.0, 0.0),
        ];
        Ok(Case::driven(both, figures))
    }))
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-20",
    title: "bifurcation: two places may crack, one is 1 % weaker",
    remark: "The catalogue has a beam that fails in shear on one side, full against half. Here are a bar in tension and its half: no \
             diagonal crack, no full against half beam.",
    coarse: COARSE,
    run,
};
