//! Tables of `docs/accuracy.md`.

use std::collections::BTreeMap;

use super::cases::{ALL, Case, DEFAULT, KNOWN, MOTION, TWICE};
use super::outcome::Outcome;
use crate::sample::mean_and_variation;

/// Results by case and beam.
pub type Outcomes = BTreeMap<(&'static str, &'static str), Outcome>;

pub(super) fn percent(share: Option<f64>) -> String {
    share.map_or_else(String::new, |s| {
        let text = format!("{:+.1}", 100.0 * s);
        if text == "-0.0" { "+0.0".into() } else { text }
    })
}

pub(super) fn fixed(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(String::new, |v| format!("{v:.digits$}"))
}

pub(super) fn row(cells: impl IntoIterator<Item = String>) -> String {
    let cells: Vec<String> = cells.into_iter().collect();
    format!("| {} |\n", cells.join(" | "))
}

pub(super) fn header(names: &[&str]) -> String {
    let lines = vec!["---".to_owned(); names.len()];
    row(names.iter().map(|n| (*n).to_owned())) + &row(lines)
}

/// Every beam: peak, mode, cost and numerical error.
pub fn beams(outcomes: &Outcomes) -> String {
    let mut text = header(&[
        "beam",
        "peak, kN",
        "test, kN",
        "error, %",
        "at, mm",
        "mode",
        "perfect bond over bond",
        "trust",
        "half the steps, %",
        "finer mesh, %",
        "error bar, %",
        "twice the elements, %",
        "slow motion, %",
        "factorisations",
        "evaluations",
        "tension over strength",
    ]);
    for beam in DEFAULT.beams {
        let Some(o) = outcomes.get(&(DEFAULT.name, *beam)) else {
            text += &row([(*beam).to_owned()]);
            continue;
        };
        let change = |of| percent(o.number(&["numerical_error", of, "change"]));
        text += &row([
            (*beam).to_owned(),
            fixed(o.peak(), 1),
            fixed(o.number(&["test_load_kn"]), 1),
            percent(o.error()),
            fixed(o.number(&["deflection_at_peak_mm"]), 2),
            o.text(&["mode"]).unwrap_or_default().to_owned(),
            fixed(o.number(&["counterfactual_ratio"]), 2),
            o.text(&["trust"]).unwrap_or_default().to_owned(),
            change("half_steps"),
            change("finer_mesh"),
            fixed(
                o.number(&["numerical_error", "error_bar"])
                    .map(|e| 100.0 * e),
                0,
            ),
            percent(change_by(outcomes, TWICE.name, beam)),
            trusted_change(outcomes, MOTION.name, beam),
            fixed(Some(o.cost[0]), 2),
            fixed(Some(o.cost[1]), 1),
            fixed(o.number(&["tension_over_strength"]), 1),
        ]);
    }
    text
}

/// Relative change of the peak of a beam by a case.
fn change_by(outcomes: &Outcomes, case: &'static str, beam: &'static str) -> Option<f64> {
    let peak = |case| outcomes.get(&(case, beam)).and_then(Outcome::peak);
    Some(peak(case)? / peak(DEFAULT.name)? - 1.0)
}

/// The same (%), marked where the run itself trusts little in it.
fn trusted_change(outcomes: &Outcomes, case: &'static str, beam: &'static str) -> String {
    let trust = outcomes.get(&(case, beam)).and_then(|o| o.text(&["trust"]));
    let note = match trust {
        Some("low") => " (trust low)",
        _ => "",
    };
    percent(change_by(outcomes, case, beam)) + note
}

/// How many error bars reach the peak with half the steps, and with twice the elements.
pub fn coverage(outcomes: &Outcomes) -> String {
    let found = DEFAULT.beams.iter().filter_map(|beam| {
        let o = outcomes.get(&(DEFAULT.name, *beam))?;
        let bar = o.number(&["numerical_error", "error_bar"])?;
        let halved = o.number(&["numerical_error", "half_steps", "change"])?;
        let twice = change_by(outcomes, TWICE.name, beam)?;
        Some((beam, [halved, twice].map(|change| change.abs() <= bar)))
    });
    let found: Vec<_> = found.collect();
    let covered = |i: usize| found.iter().filter(|(_, reached)| reached[i]).count();
    let missed = found.iter().filter(|(_, reached)| reached.contains(&false));
    let missed: Vec<&str> = missed.map(|(beam, _)| **beam).collect();
    format!(
        "Of {} error bars, {} reach the peak with half the steps and {} that with twice the elements along and up \
         ({}); not: {}.\n",
        found.len(),
        covered(0),
        covered(1),
        TWICE.written_options(),
        if missed.is_empty() {
            "none".to_owned()
        } else {
            missed.join(", ")
        }
    )
}

/// Mean and worst error, mean ratio and coefficient of variation of the beams whose tests are known.
pub fn statistics(outcomes: &Outcomes) -> String {
    let errors = errors(outcomes, DEFAULT.name);
    let ratios: Vec<f64> = errors.iter().map(|e| 1.0 + e).collect();
    let [ratio, variation] = mean_and_variation(&ratios);
    let inverse: Vec<f64> = ratios.iter().map(|r| r.recip()).collect();
    let [test, scatter] = mean_and_variation(&inverse);
    let worst = errors.iter().fold(0.0_f64, |a, e| a.max(e.abs()));
    format!(
        "Of {} beams whose tests are known: mean |error| {:.1} %, worst {:.0} %; mean of model over test {ratio:.3}, coefficient of \
         variation {:.1} %; of test over model {test:.3} and {:.1} %.\n",
        errors.len(),
        100.0 * mean(&errors, f64::abs),
        100.0 * worst,
        100.0 * variation,
        100.0 * scatter
    )
}

/// Mean of a function of the errors.
pub(super) fn mean(errors: &[f64], of: impl Fn(f64) -> f64) -> f64 {
    errors.iter().map(|e| of(*e)).sum::<f64>() / errors.len().max(1) as f64
}

fn errors(outcomes: &Outcomes, case: &'static str) -> Vec<f64> {
    let known = KNOWN.iter();
    known
        .filter_map(|beam| outcomes.get(&(case, *beam))?.error())
        .collect()
}

/// Change of the peak (%) by each case against the default, by beam.
pub fn changes(outcomes: &Outcomes, cases: &[Case]) -> String {
    let concerned = |beam: &&str| cases.iter().any(|c| c.beams.contains(beam));
    let beams: Vec<&'static str> = ALL.into_iter().filter(concerned).collect();
    let mut text = header(&[&["", "options"], beams.as_slice()].concat());
    for case in cases {
        let cells = beams
            .iter()
            .map(|beam| trusted_change(outcomes, case.name, beam));
        text += &row([case.what.to_owned(), case.written_options()]
            .into_iter()
            .chain(cells));
    }
    text
}

/// Error against the test (%) of each case, by beam, and its mean.
pub fn sensitivities(outcomes: &Outcomes, cases: &[Case]) -> String {
    let mut text = header(&[&["", "options"], KNOWN, &["mean"]].concat());
    let default = [(DEFAULT.what, String::new(), DEFAULT.name)];
    let others = cases.iter();
    let others = others.map(|c| (c.what, c.written_options(), c.name));
    for (what, options, name) in default.into_iter().chain(others) {
        let cells = KNOWN
            .iter()
            .map(|beam| percent(outcomes.get(&(name, *beam)).and_then(Outcome::error)));
        let errors = errors(outcomes, name);
        let complete = errors.len() == KNOWN.len();
        let mean = complete.then(|| 100.0 * mean(&errors, f64::abs));
        let mean = fixed(mean, 1);
        let first = [what.to_owned(), options];
        text += &row(first.into_iter().chain(cells).chain([mean]));
    }
    text
}

#[cfg(test)]
mod tests {
    //! Protects the form of changes.
    use super::*;

    #[test]
    fn no_change_has_no_sign_of_a_fall() {
        assert_eq!(percent(Some(-0.0004)), "+0.0");
        assert_eq!(percent(Some(-0.0116)), "-1.2");
        assert_eq!(percent(None), "");
    }
}
