//! What the load path of a beam says: peak, trust, error and mode of failure.

use fe_solver::capacity::{Capacity, Verdict};

use super::case::Case;
use super::caveats::{broken, pulls};
use super::walk::Walk;
use super::watch::Watch;
use super::{RunError, again, evidence};
use crate::analysis::{Outcome, Snapshot as State};
use crate::build::Beam;
use crate::results::evidence::{Layout, Snapshot};
use crate::results::mode::Diagnosis;
use crate::results::numerical_error::NumericalError;
use crate::results::sheets::{SheetDrop, end_of_drop};
use crate::results::summary::Figures;

/// What a load path says.
pub(super) struct Judgement<'a> {
    pub capacity: Capacity,
    /// Whether the peak is that of the specimen: the load fell behind it, and a beam to be strengthened had been.
    pub is_peak: bool,
    pub figures: Figures,
    pub verdict: Verdict,
    pub diagnosis: Diagnosis,
    pub numerical_error: Option<NumericalError>,
    /// Largest principal tension of cracked concrete up to the peak over its strength.
    pub tension_over_strength: f64,
    /// State at the peak, and what it shows.
    pub peak: (&'a State, Snapshot),
    /// State at the end of the fall, or of the path.
    pub end: &'a State,
    /// What was asked for and could not be found out.
    pub missing: Vec<String>,
}

impl<'a> Judgement<'a> {
    /// Judges a path; none without a step to judge. Runs the beam again as the options ask.
    pub(super) fn of(
        case: &Case<'_>,
        beam: &Beam,
        walk: &'a Walk<'_>,
    ) -> Result<Option<Self>, RunError> {
        let (outcome, watch, options) = (&walk.outcome, walk.recording.watch(), case.options);
        let Some(capacity) = Capacity::of(&outcome.path) else {
            return Ok(None);
        };
        // A beam that is to be strengthened under load and fails before is none that was tested.
        let strengthened = case.specimen.staged.is_none() || !outcome.before.is_empty();
        let is_peak = strengthened && capacity.is_reached();
        let mut missing = Vec::new();
        let numerical_error = match outcome.path.get(capacity.peak) {
            Some(peak) if is_peak && options.band => {
                let found = again::numerical_error(case, peak.load);
                found_or(found, "no error bar", &mut missing)
            }
            _ => None,
        };
        let before = outcome.before.len();
        let tension_over_strength =
            watch.largest_tension(before + outcome.path.len(), before + capacity.peak);
        let at_peak = outcome.peak.as_ref().unwrap_or(&outcome.last);
        let peak = evidence::snapshot(beam, at_peak)?;
        let mut verdict = verdict(outcome, &capacity, watch, tension_over_strength);
        for bar in broken(case.specimen, &peak) {
            verdict.distrust(&bar);
        }
        if let Some(error) = &numerical_error {
            verdict.limit_by_change("half the steps", error.half_steps.change);
            verdict.limit_by_change("a finer mesh", error.finer_mesh.change);
        }
        let Some(figures) = Figures::of(&outcome.path, &capacity, &verdict) else {
            return Ok(None);
        };
        let ratio = match &beam.sheets {
            Some(_) if options.counterfactual && capacity.is_reached() => {
                let found = again::perfect_bond(case, figures.peak_load_kn);
                found_or(found, "no peak with perfect bond", &mut missing)
            }
            _ => None,
        };
        let end = outcome.fallen.as_ref().unwrap_or(&outcome.last);
        let last = evidence::snapshot(beam, end)?;
        let states = (&peak, &last);
        let diagnosis = diagnosis(&walk.layout, states, outcome, (&capacity, ratio), watch);
        Ok(Some(Self {
            capacity,
            is_peak,
            figures,
            verdict,
            diagnosis,
            numerical_error,
            tension_over_strength,
            peak: (at_peak, peak),
            end,
            missing,
        }))
    }
}

/// How far the path itself can be trusted.
fn verdict(outcome: &Outcome, capacity: &Capacity, watch: &Watch, tension: f64) -> Verdict {
    // What has led to the bonding of the sheets counts as well.
    let whole = [outcome.before.as_slice(), &outcome.path].concat();
    let mut verdict = Verdict::of(&whole, &capacity.behind(outcome.before.len()));
    verdict.limit_by_locking(tension);
    let steps = outcome.path.len();
    let torn = watch.largest_utilisation(steps, capacity.peak);
    if torn >= 1.0 {
        verdict.distrust(&format!(
            "sheets carry up to {torn:.2} times their strength: none tears in this model"
        ));
    }
    if let Some(text) = pulls(watch.backward(steps, capacity.peak)) {
        verdict.limit(&text);
    }
    verdict
}

fn diagnosis(
    layout: &Layout,
    (peak, last): (&Snapshot, &Snapshot),
    outcome: &Outcome,
    (capacity, ratio): (&Capacity, Option<f64>),
    watch: &Watch,
) -> Diagnosis {
    let rows = watch.rows(outcome.path.len());
    let drop = SheetDrop::of(watch.sheet_layout(), rows, &outcome.path, capacity);
    let mut diagnosis = match drop {
        Some(sheets) if !watch.sheet_layout().zones.is_empty() => {
            let states = (peak, last);
            Diagnosis::strengthened(layout, states, capacity, &sheets, ratio)
        }
        _ => Diagnosis::of(layout, peak, last, capacity),
    };
    let end = end_of_drop(&outcome.path, capacity);
    let end = end.map_or(outcome.path.last(), |i| outcome.path.get(i));
    if let Some(end) = end.filter(|end| end.flagged) {
        let told = format!(
            "; at the end of the drop the residual is {:.1e}: the beam moves there, no equilibrium was found",
            end.residual
        );
        diagnosis.mode_evidence += &told;
    }
    diagnosis
}

/// What a further run has found; that it cannot be run takes nothing away from what has been, and is added to what is `missing`.
fn found_or<T>(
    found: Result<Option<T>, RunError>,
    what: &str,
    missing: &mut Vec<String>,
) -> Option<T> {
    found.unwrap_or_else(|error| {
        missing.push(format!("{what}: {error}"));
        None
    })
}
