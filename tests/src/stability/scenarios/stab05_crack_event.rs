//! STAB-05: a bar of ten cells, one 5 % weaker, drawn through its peak in ten steps.

use crate::driven::{Driven, Leg, drive};
use crate::softening_bar::{AREA, ENERGY, STRENGTH, moved};
use crate::stability::{COARSE, Case, Failure, Figure, Method, Scenario};

/// Strengths of the cells (MPa).
pub(super) fn weak_cell() -> [f64; 10] {
    let mut strengths = [STRENGTH; 10];
    strengths[4] *= 0.95;
    strengths
}

/// The bar of 500 mm drawn to 0.1 mm by a method in steps of `step` (mm); none where it does not apply.
pub(super) fn draw(
    method: Method,
    step: f64,
    strengths: &[f64],
) -> Option<Result<Driven, Failure>> {
    let mut driver = method.imposing(step)?;
    let (model, conditions) = moved(500.0, strengths);
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
    coarse: COARSE,
    run: |method, coarse| {
        Some(draw(method, 0.01 * coarse, &weak_cell())?.map(|driven| {
            let mut figures = figures(&driven);
            let iterations = driven.counters.iterations as f64;
            figures.push(Figure::at_most("iterations", iterations, 1000.0));
            Case::driven(driven, figures)
        }))
    },
};
