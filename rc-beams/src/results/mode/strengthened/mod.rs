//! Mode of failure of a beam with sheets.
//!
//! Bond fails locally in every strengthened beam, whatever brings it down: that some point has lost its bond
//! says nothing. What tells the modes apart is the force of the sheets while the load falls, from the peak to
//! 0.8 of it, in the span that fails: the shear span in which the diagonal cracks grow most, the test span where
//! none grow. Measures, beside those of [`super`]:
//!
//! - *utilisation*: largest of any sheet up to the peak. From 1 on the sheet ruptures, whatever else is seen and
//!   whether or not the load of the model, in which no sheet tears, falls: **sheet rupture**;
//! - *loss*: of the force SVf ([`SpanReading::force_kn`](crate::results::sheets::SpanReading)), relative to the peak; all
//!   of it where the load is lost there, [`LOST`](crate::results::sheets::LOST) or more of it, as what is left is a motion,
//!   no equilibrium that forces could be read from;
//! - *debonded*: share of the side of the span at the end of the drop;
//! - *ratio*: peak of the same beam with perfect bond over that of the beam, where it is known. At least
//!   1.15, bond governs; at most 1.08, concrete does, whatever the sheets lose once it has failed; with perfect bond it does.
//!
//! *No yield* includes bars that yield where diagonal cracks govern, see [`super`]. A span on whose side no sheet carries
//! tension fails by the rules of [`flat`]. Else the first row that fits counts; rows 4 to 7 need a drop to 0.8 of the peak.
//!
//! | | evidence | mode |
//! |---|---|---|
//! | 1 | load falls by less than 5 % | the same as for bare beams: flexure or none |
//! | 2 | loss at least 40 % and debonded at least 35 %, or loss above 25 % and ratio at least 1.15; no yield, softened web below 10 %, ratio not at most 1.08 | debonding |
//! | 3 | loss below 40 % or debonded below 35 %; the rule for flexure of bare beams | flexure |
//! | 4 | *bonded*: loss at most 25 % and ratio not at least 1.15, or ratio at most 1.08; no yield; softened web at least 10 % | shear (web crushing) |
//! | 5 | bonded, no yield, the rule for crushing of bare beams | concrete crushing |
//! | 6 | bonded, no yield | concrete splitting |
//! | 7 | otherwise | mixed |
//! | 8 | otherwise, without a drop to 0.8 of the peak | undecided |
//!
//! Row 6 is what remains when steel is elastic and bond does not govern: the concrete. The thresholds of loss,
//! debonded share and ratio were set on ten histories of strengthened beams, not on an independent set; refining
//! a mesh can move a beam by one row.

pub mod flat;

use std::fmt;

use fe_solver::capacity::Capacity;

use super::{
    CRUSHING_GROWTH, DIAGONAL_MINOR, Diagnosis, FailureMode, Measures, SOFTENED_WEB, evidence,
};
use crate::column::TEST_SPAN;
use crate::results::evidence::{Layout, Snapshot};
use crate::results::sheets::{SheetDrop, SpanDrop};

/// Loss of sheet force from which it is debonding.
pub const DEBONDING_LOSS: f64 = 0.40;
/// Debonded share of the side from which it is debonding.
pub const DEBONDING_SHARE: f64 = 0.35;
/// Loss of sheet force up to which the sheets stay bonded.
pub const BONDED_LOSS: f64 = 0.25;
/// Ratio of the peak with perfect bond to the peak from which bond governs.
pub const BOND_GOVERNS: f64 = 1.15;
/// Ratio up to which concrete governs.
pub const CONCRETE_GOVERNS: f64 = 1.08;

impl Diagnosis {
    /// Judges a beam with sheets by its states at the peak and at the end of the drop after it, and by what its sheets
    /// lose. `ratio` is the peak with perfect bond over that of the beam, where it is known.
    pub fn strengthened(
        layout: &Layout,
        (peak, end): (&Snapshot, &Snapshot),
        capacity: &Capacity,
        sheets: &SheetDrop,
        ratio: Option<f64>,
    ) -> Self {
        let measures = Measures::of(layout, peak, end);
        let test = layout.shear_spans.iter().position(|s| s.name == TEST_SPAN);
        let index = measures.span.or(test);
        let span = index.and_then(|i| sheets.spans.get(i));
        let (mode, said) = match span.filter(|span| span.is_covered()) {
            Some(span) => {
                let bond = Bond {
                    span,
                    name: index.map_or(TEST_SPAN, |i| layout.shear_spans[i].name.as_str()),
                    sheets,
                    ratio,
                };
                (mode(&measures, &bond, capacity), bond.to_string())
            }
            None => (
                flat::mode(&measures, sheets, capacity),
                flat::evidence(sheets),
            ),
        };
        Self {
            mode: if sheets.utilisation >= 1.0 {
                FailureMode::SheetRupture
            } else {
                mode
            },
            mode_evidence: evidence(capacity, &format_args!("{said}; {measures}"), (end, layout)),
            counterfactual_ratio: ratio,
        }
    }
}

/// The sheets of the span that fails.
struct Bond<'a> {
    span: &'a SpanDrop,
    name: &'a str,
    sheets: &'a SheetDrop,
    ratio: Option<f64>,
}

impl Bond<'_> {
    /// The measure *loss* of the module.
    fn loss(&self) -> f64 {
        if self.sheets.lost {
            1.0
        } else {
            self.span.loss()
        }
    }
}

/// The table of the module.
fn mode(measures: &Measures, bond: &Bond<'_>, capacity: &Capacity) -> FailureMode {
    if let Some(held) = measures.mode_without_drop(capacity) {
        return held;
    }
    let loss = bond.loss();
    let debonded = bond.span.debonded.map_or(0.0, |share| share[1]);
    let debonds = loss >= DEBONDING_LOSS && debonded >= DEBONDING_SHARE;
    let softened = measures.softened_web >= SOFTENED_WEB;
    let minor = measures.diagonal_share <= DIAGONAL_MINOR;
    let bond_governs = bond.ratio.is_some_and(|r| r >= BOND_GOVERNS);
    let perfect = bond.span.debonded.is_none();
    let concrete_governs = perfect || bond.ratio.is_some_and(|r| r <= CONCRETE_GOVERNS);
    let bends = measures.bends();
    let keeps = loss <= BONDED_LOSS;
    let bond_fails = (debonds || !keeps && bond_governs) && !concrete_governs;
    let bonded = (concrete_governs || keeps && !bond_governs) && !bends;
    if bond_fails && !bends && !softened {
        FailureMode::Debonding
    } else if !debonds && measures.mode() == FailureMode::Flexure {
        FailureMode::Flexure
    } else if !bond.sheets.complete {
        FailureMode::Undecided
    } else if bonded && softened {
        FailureMode::WebCrushing
    } else if bonded && minor && measures.crushing_growth >= CRUSHING_GROWTH {
        FailureMode::ConcreteCrushing
    } else if bonded {
        FailureMode::ConcreteSplitting
    } else {
        FailureMode::Mixed
    }
}

impl fmt::Display for Bond<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [before, after] = self.span.force_kn;
        write!(
            f,
            "sheet force in the {} {before:.1} kN at the peak, ",
            self.name
        )?;
        if self.sheets.lost {
            f.write_str("lost with the load; ")?;
        } else {
            // Adding 0 turns -0 into 0.
            let change = (-100.0 * self.loss()).round() + 0.0;
            let load = self.sheets.end_load_kn;
            write!(f, "{after:.1} kN at {load:.0} kN ({change:+.0} %); ")?;
        }
        match self.span.debonded {
            Some(share) => {
                let [at_peak, at_end] = share.map(|share| 100.0 * share);
                write!(
                    f,
                    "{at_end:.0} % of its side debonded then, {at_peak:.0} % at the peak"
                )?;
            }
            None => f.write_str("perfect bond")?,
        }
        if let Some(zone) = &self.sheets.zone {
            write!(
                f,
                "; {} is debonded most widely, over {:.0} %, and slips up to {:.3} mm",
                zone.name,
                100.0 * zone.debonded,
                zone.slip_max_mm
            )?;
        }
        write!(
            f,
            "; sheets used to {:.0} %",
            100.0 * self.sheets.utilisation
        )?;
        match self.ratio {
            _ if self.span.debonded.is_none() => {}
            Some(ratio) => write!(f, "; perfect bond would carry {ratio:.2} times the peak")?,
            None => f.write_str("; peak with perfect bond not known (without --counterfactual, or where its path ends before)")?,
        }
        match self.span.stirrups {
            0 => f.write_str("; no stirrups in the span"),
            1 => f.write_str("; 1 stirrup in the span"),
            n => write!(f, "; {n} stirrups in the span"),
        }
    }
}

#[cfg(test)]
mod tests;
