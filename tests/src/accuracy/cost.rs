//! What models cost beside how near they come to the tests.

use super::cases::{Case, DEFAULT, KINDS, MOTION, NUMERICS};
use super::outcome::Outcome;
use super::tables::{Outcomes, fixed, header, mean, row};
use crate::figure::{Axis, Chart, Series, svg};

/// One way to compute the beams of each kind.
struct Cost {
    case: &'static Case,
    /// DOFs of a bare and of a strengthened beam.
    dofs: [f64; 2],
    /// Evaluations of the forces, all beams.
    evaluations: f64,
    /// DOFs times evaluations, all beams, in millions.
    work: f64,
    /// Mean |error| (%).
    error: f64,
    /// Largest |change| of a peak against the default (%).
    change: f64,
}

/// The default, and the numerical settings that all beams of each kind were run with.
fn costs(outcomes: &Outcomes) -> Vec<Cost> {
    let cases = std::iter::once(&DEFAULT).chain(&NUMERICS).chain([&MOTION]);
    let cost = |case: &'static Case| {
        let of = |name| -> Option<Vec<&Outcome>> {
            KINDS
                .iter()
                .map(|beam| outcomes.get(&(name, *beam)))
                .collect()
        };
        let (own, default) = (of(case.name)?, of(DEFAULT.name)?);
        let numbers =
            |name| -> Option<Vec<f64>> { own.iter().map(|o| o.number(&[name])).collect() };
        let (dofs, evaluations) = (numbers("dofs")?, numbers("force_evaluations")?);
        let errors: Vec<f64> = own.iter().filter_map(|o| o.error()).collect();
        let changes = own
            .iter()
            .zip(&default)
            .filter_map(|(a, b)| Some(a.peak()? / b.peak()? - 1.0));
        Some(Cost {
            case,
            dofs: [dofs[0], dofs[2]],
            evaluations: evaluations.iter().sum(),
            work: 1e-6
                * dofs
                    .iter()
                    .zip(&evaluations)
                    .map(|(n, e)| n * e)
                    .sum::<f64>(),
            error: 100.0 * mean(&errors, f64::abs),
            change: 100.0 * changes.fold(0.0, |a: f64, c| a.max(c.abs())),
        })
    };
    cases.filter_map(cost).collect()
}

/// DOFs, evaluations and errors of each.
pub fn table(outcomes: &Outcomes) -> String {
    let mut text = header(&[
        "",
        "DOFs, bare",
        "strengthened",
        "evaluations",
        "DOFs times evaluations, 10^6",
        "mean error, %",
        "largest change, %",
    ]);
    for cost in costs(outcomes) {
        text += &row([
            cost.case.what.to_owned(),
            fixed(Some(cost.dofs[0]), 0),
            fixed(Some(cost.dofs[1]), 0),
            fixed(Some(cost.evaluations), 0),
            fixed(Some(cost.work), 0),
            fixed(Some(cost.error), 1),
            fixed(Some(cost.change), 1),
        ]);
    }
    text
}

/// Work against error.
///
/// # Errors
///
/// Never in practice: writing to a string does not fail.
pub fn chart(outcomes: &Outcomes) -> Result<String, std::fmt::Error> {
    let series = costs(outcomes)
        .into_iter()
        .enumerate()
        .map(|(style, cost)| Series {
            name: cost.case.what.to_owned(),
            style,
            line: Vec::new(),
            marks: vec![[cost.work, cost.error]],
        });
    let chart = Chart {
        title: "A-SO3-1, A-SW3-1, A-SO3-2, A-SW3-2".into(),
        x: Axis::decades("DOFs times evaluations, 10^6", [10.0, 1e4]),
        y: Axis::from_zero("mean error against the tests, %", 12.0, 2.0),
        legend: None,
        series: series.collect(),
    };
    svg(
        &[chart],
        [
            "What other models, iterations and steps cost, and what they gain:",
            "written by tests/accuracy.sh.",
        ],
    )
}
