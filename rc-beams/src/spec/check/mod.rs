//! Checks between the fields of a specimen: what no number tells alone.

mod concrete;
mod edges;
mod reinforcement;
mod sheets;
mod supports;

use std::fmt::Display;
use std::ops::RangeInclusive;

use super::specimen::Specimen;
use crate::column::slug;

/// Slack of comparisons of lengths (mm).
const TOLERANCE: f64 = 1e-6;

const ALONG: &str = "x is measured from the left end of the beam";

/// Longest name of a specimen: it names a folder.
const LONGEST_NAME: usize = 64;

/// Something wrong with a specimen.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The field, as a path such as `bars[0].axis.y_mm`.
    pub path: String,
    /// What is wrong, with value and allowed range.
    pub message: String,
    /// What to do.
    pub remedy: String,
}

/// Everything wrong with a specimen whose numbers are each in range; empty if it can be modelled.
pub fn check(specimen: &Specimen) -> Vec<Finding> {
    let mut checks = Checks {
        specimen,
        findings: Vec::new(),
    };
    checks.name();
    checks.concrete();
    checks.reinforcement();
    let supported = checks.supports() && checks.passes(Checks::plate_edges);
    checks.sheets(supported);
    checks.findings
}

struct Checks<'a> {
    specimen: &'a Specimen,
    findings: Vec<Finding>,
}

impl Checks<'_> {
    fn report(&mut self, path: impl Display, message: impl Display, remedy: impl Display) {
        self.findings.push(Finding {
            path: path.to_string(),
            message: message.to_string(),
            remedy: remedy.to_string(),
        });
    }

    /// Whether a check finds nothing: what rests on it is looked at then only, so that one mistake is told once.
    fn passes(&mut self, check: impl FnOnce(&mut Self)) -> bool {
        let before = self.findings.len();
        check(self);
        self.findings.len() == before
    }

    /// Reports a coordinate (mm) outside its range.
    fn within(
        &mut self,
        path: impl Display,
        (what, value): (&str, f64),
        range: RangeInclusive<f64>,
        remedy: &str,
    ) {
        let (low, high) = (range.start(), range.end());
        if value < low - TOLERANCE || value > high + TOLERANCE {
            let message = format!("{what} at {value} mm; allowed: {low} to {high} mm");
            self.report(path, message, remedy);
        }
    }

    /// Reports a stretch (mm) that ends before it begins.
    fn ascending(&mut self, path: impl Display, from: f64, to: f64) {
        if to <= from {
            let message = format!("ends at {to} mm; allowed: more than {from} mm, where it begins");
            let remedy = if to < from {
                "exchange the two ends"
            } else {
                "give it a length"
            };
            self.report(path, message, remedy);
        }
    }

    /// Reports a name that gives no column of its own beside those `before`; whether it gives one.
    fn named_once<'n>(
        &mut self,
        path: &str,
        (what, name): (&str, &str),
        mut before: impl Iterator<Item = &'n String>,
    ) -> bool {
        let column = slug(name);
        let path = format!("{path}.name");
        let remedy = "the results are written by name, its letters and digits in columns";
        if column.is_empty() || name.chars().any(char::is_control) {
            let message =
                format!("{name:?} cannot name a column; allowed: letters and digits, one at least");
            self.report(path, message, remedy);
            false
        } else if let Some(other) = before.find(|other| slug(other) == column) {
            let message = if other == name {
                format!("{name:?} names two {what}; allowed: a name of its own")
            } else {
                format!(
                    "{name:?} and {other:?} name {what} alike but for signs; allowed: names that differ in letters or digits"
                )
            };
            self.report(path, message, remedy);
            false
        } else {
            true
        }
    }

    fn length(&self) -> f64 {
        self.specimen.beam.length_mm.get()
    }

    fn height(&self) -> f64 {
        self.specimen.beam.height_mm.get()
    }

    fn half_width(&self) -> f64 {
        self.specimen.half_width_mm()
    }

    /// The name is that of a folder, the title a line.
    fn name(&mut self) {
        let Specimen { name, title, .. } = self.specimen;
        if title.chars().any(char::is_control) {
            self.report(
                "title",
                format!("{title:?} has control characters; allowed: one line of letters, digits and signs"),
                "take them out: the title is printed and drawn as one line",
            );
        }
        let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        let short = (1..=LONGEST_NAME).contains(&name.len());
        if !short || name.starts_with('.') || !name.chars().all(plain) {
            self.report(
                "name",
                format!(
                    "{name:?} cannot name a folder; allowed: 1 to {LONGEST_NAME} letters, digits, - _ ."
                ),
                "choose a short name, for instance \"A-SO3-1\"",
            );
        }
        // The report of the folder writes files of these names.
        if name.starts_with("report.") || name.starts_with("report-") {
            self.report(
                "name",
                format!("{name:?} is a name of the report's; allowed: any that does not begin with report. or report-"),
                "choose another name",
            );
        }
    }
}
