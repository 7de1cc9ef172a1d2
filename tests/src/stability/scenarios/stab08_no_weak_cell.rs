//! STAB-08: no cell is weak; strengths scatter by 1 %, five times.

use fe_core::testing::Random;

use super::stab05_crack_event::draw;
use crate::softening_bar::{AREA, ENERGY, STRENGTH};
use crate::stability::{COARSE, Case, Failure, Figure, Method, Scenario};

fn run(method: Method, coarse: f64) -> Option<Result<Case, Failure>> {
    let mut figures = Vec::new();
    let mut worst: Option<Case> = None;
    for seed in 1..=5 {
        let mut random = Random::new(seed);
        let strengths: [f64; 10] = std::array::from_fn(|_| STRENGTH * random.uniform(0.99, 1.01));
        let weakest = strengths.iter().fold(f64::INFINITY, |a, &b| a.min(b));
        let driven = match draw(method, 0.01 * coarse, &strengths)? {
            Ok(driven) => driven,
            Err(error) => return Some(Err(error)),
        };
        figures.push(Figure::near(
            format!("peak {seed}, N"),
            driven.peak(),
            weakest * AREA,
            1e-2,
        ));
        figures.push(Figure::near(
            format!("dissipation {seed}, N mm"),
            driven.dissipated(),
            ENERGY * AREA,
            1e-2,
        ));
        let case = Case::driven(driven, Vec::new());
        let sum = worst.get_or_insert_with(|| Case::checked(Vec::new()));
        sum.marked += case.marked;
        sum.stopped = sum.stopped.take().or(case.stopped);
        sum.counters.steps += case.counters.steps;
        sum.counters.cutbacks += case.counters.cutbacks;
        sum.counters.iterations += case.counters.iterations;
        sum.counters.factorisations += case.counters.factorisations;
        sum.counters.force_evaluations += case.counters.force_evaluations;
    }
    worst.map(|case| Ok(Case { figures, ..case }))
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-08",
    title: "no weak cell: strengths scatter by 1 %, five seeds",
    remark: "",
    coarse: COARSE,
    run,
};
