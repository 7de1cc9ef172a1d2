//! Mode of failure of a beam with bonded sheets.
//!
//! Bond fails locally in every strengthened beam, whatever brings it down: that some point has lost its bond
//! says nothing. What tells the modes apart is the force of the sheets while the load falls, from the peak to
//! 0.8 of it, in the span that fails: the shear span in which the diagonal cracks grow most, the test span where
//! none grow. Measures, beside those of [`super`]:
//!
//! - *loss*: of the force SVf ([`SpanReading::force_kn`](crate::results::sheets::SpanReading)), relative to the peak;
//! - *debonded*: share of the side of the span at the end of the drop;
//! - *utilisation*: largest of any sheet up to the peak;
//! - *ratio*: peak of the same beam with perfect bond over that of the beam, where it is known. At least
//!   1.15, bond governs; at most 1.08, concrete does.
//!
//! A span that carries no sheet fails by the rules for bare beams. Else the first row that fits counts; rows 5 to 8
//! need a drop to 0.8 of the peak.
//!
//! | | evidence | mode |
//! |---|---|---|
//! | 1 | load falls by less than 5 % | none |
//! | 2 | utilisation at least 1 | sheet rupture |
//! | 3 | loss at least 40 %, debonded at least 35 %, no bar yields, softened web below 10 %, ratio not at most 1.08 | debonding |
//! | 4 | loss below 40 % or debonded below 35 %; the rule for flexure of bare beams | flexure |
//! | 5 | loss at most 25 %, no bar yields, softened web at least 10 %, ratio not at least 1.15 | shear (web crushing) |
//! | 6 | loss at most 25 %, no bar yields, the rule for crushing of bare beams, ratio not at least 1.15 | concrete crushing |
//! | 7 | loss at most 25 %, no bar yields, ratio not at least 1.15 | concrete splitting |
//! | 8 | otherwise | mixed |
//! | 9 | otherwise, without a drop to 0.8 of the peak | undecided |
//!
//! Row 7 is what remains when steel is elastic and the sheets keep their force: the concrete. The thresholds of
//! loss, debonded share and ratio were set on ten histories of strengthened beams, not on an independent
//! set; refining a mesh can move a beam by one row.

use std::fmt;

use fe_solver::capacity::DROP_FALL;

use super::{CRUSHING_GROWTH, DIAGONAL_MINOR, Diagnosis, FailureMode, Measures, SOFTENED_WEB};
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
    /// Judges a beam with sheets by its states at the peak and at the end of the drop after it, over which the
    /// load falls by the share `drop`, and by what its sheets lose. `ratio` is the peak with perfect bond over
    /// that of the beam, where it is known.
    pub fn strengthened(
        layout: &Layout,
        (peak, end): (&Snapshot, &Snapshot),
        drop: f64,
        sheets: &SheetDrop,
        ratio: Option<f64>,
    ) -> Self {
        let measures = Measures::of(layout, peak, end);
        let test = layout.shear_spans.iter().position(|s| s.name == TEST_SPAN);
        let index = measures.span.or(test);
        let span = index.and_then(|i| sheets.spans.get(i));
        let Some((span, debonded)) = span.and_then(|s| Some((s, s.debonded?))) else {
            return Self {
                counterfactual_ratio: ratio,
                ..Self::of(layout, peak, end, drop)
            };
        };
        let bond = Bond {
            span,
            name: index.map_or(TEST_SPAN, |i| layout.shear_spans[i].name.as_str()),
            debonded,
            sheets,
            ratio,
        };
        Self {
            mode: mode(&measures, &bond, drop),
            mode_evidence: format!("load falls by {:.1} %; {bond}; {measures}", 100.0 * drop),
            counterfactual_ratio: ratio,
        }
    }
}

/// Name of the span under test in a layout.
const TEST_SPAN: &str = "test span";

/// The sheets of the span that fails.
struct Bond<'a> {
    span: &'a SpanDrop,
    name: &'a str,
    debonded: [f64; 2],
    sheets: &'a SheetDrop,
    ratio: Option<f64>,
}

/// The table of the module.
fn mode(measures: &Measures, bond: &Bond<'_>, drop: f64) -> FailureMode {
    let loss = bond.span.loss();
    let debonds = loss >= DEBONDING_LOSS && bond.debonded[1] >= DEBONDING_SHARE;
    let softened = measures.softened_web >= SOFTENED_WEB;
    let minor = measures.diagonal_share <= DIAGONAL_MINOR;
    let bond_governs = bond.ratio.is_some_and(|r| r >= BOND_GOVERNS);
    let concrete_governs = bond.ratio.is_some_and(|r| r <= CONCRETE_GOVERNS);
    let stays = loss <= BONDED_LOSS && !measures.yielded && !bond_governs;
    if drop < DROP_FALL {
        FailureMode::None
    } else if bond.sheets.utilisation >= 1.0 {
        FailureMode::SheetRupture
    } else if debonds && !measures.yielded && !softened && !concrete_governs {
        FailureMode::Debonding
    } else if !debonds && measures.yielded && !softened && minor {
        FailureMode::Flexure
    } else if !bond.sheets.complete {
        FailureMode::Undecided
    } else if stays && softened {
        FailureMode::WebCrushing
    } else if stays && minor && measures.crushing_growth >= CRUSHING_GROWTH {
        FailureMode::ConcreteCrushing
    } else if stays {
        FailureMode::ConcreteSplitting
    } else {
        FailureMode::Mixed
    }
}

impl fmt::Display for Bond<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [before, after] = self.span.force_kn;
        let [at_peak, at_end] = self.debonded.map(|share| 100.0 * share);
        write!(
            f,
            "sheet force in the {} {before:.1} kN at the peak, {after:.1} kN at {:.0} kN ({:+.0} %); {at_end:.0} \
             % of its side debonded then, {at_peak:.0} % at the peak",
            self.name,
            self.sheets.end_load_kn,
            // Adding 0 turns -0 into 0.
            (-100.0 * self.span.loss()).round() + 0.0
        )?;
        if let Some(zone) = &self.sheets.zone {
            write!(
                f,
                "; slip up to {:.3} mm, beyond s_f over {:.0} % of {}",
                zone.slip_max_mm,
                100.0 * zone.debonded,
                zone.name
            )?;
        }
        write!(
            f,
            "; sheets used to {:.0} %",
            100.0 * self.sheets.utilisation
        )?;
        if let Some(ratio) = self.ratio {
            write!(f, "; perfect bond would carry {ratio:.2} times the peak")?;
        }
        match self.span.stirrups {
            0 => f.write_str("; no stirrups in the span"),
            1 => f.write_str("; 1 stirrup in the span"),
            n => write!(f, "; {n} stirrups in the span"),
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the table of the module: a history per row, on both sides of every threshold.
    //! Source of the histories: loss of sheet force, debonded share and ratio of computed beams of series A.
    use super::super::tests::{layout, open, peak};
    use super::*;
    use crate::results::sheets::ZoneDrop;

    /// A drop in the right shear span, where a diagonal crack opens.
    fn drop(loss: f64, debonded: f64) -> SheetDrop {
        SheetDrop {
            spans: vec![
                SpanDrop {
                    force_kn: [40.0, 40.0],
                    debonded: Some([0.0, 0.0]),
                    stirrups: 6,
                },
                SpanDrop {
                    force_kn: [100.0, 100.0 * (1.0 - loss)],
                    debonded: Some([0.04, debonded]),
                    stirrups: 0,
                },
            ],
            complete: true,
            end_load_kn: 188.0,
            utilisation: 0.4,
            zone: Some(ZoneDrop {
                name: "strip 9".to_owned(),
                debonded: 0.62,
                slip_max_mm: 0.171,
            }),
        }
    }

    fn states() -> (Snapshot, Snapshot) {
        let mut end = peak();
        open(&mut end, 24, 45.0);
        (peak(), end)
    }

    fn judge(states: &(Snapshot, Snapshot), drop: &SheetDrop, ratio: Option<f64>) -> FailureMode {
        Diagnosis::strengthened(&layout(), (&states.0, &states.1), 0.2, drop, ratio).mode
    }

    #[test]
    fn loss_of_force_and_debonded_share_decide_between_bond_and_concrete() {
        use FailureMode::{ConcreteSplitting, Debonding, Mixed};
        for (loss, debonded, expected) in [
            (0.45, 0.48, Debonding),
            (0.51, 0.37, Debonding),
            (0.83, 0.90, Debonding),
            (0.401, 0.351, Debonding),
            (0.399, 0.9, Mixed),
            (0.9, 0.349, Mixed),
            (0.251, 0.31, Mixed),
            (0.249, 0.31, ConcreteSplitting),
            (0.18, 0.19, ConcreteSplitting),
            (0.0, 0.31, ConcreteSplitting),
            (-0.1, 0.9, ConcreteSplitting),
        ] {
            let found = judge(&states(), &drop(loss, debonded), None);
            assert_eq!(found, expected, "loss {loss}, debonded {debonded}");
        }
    }

    #[test]
    fn the_peak_with_perfect_bond_confirms_or_contradicts() {
        use FailureMode::{ConcreteSplitting, Debonding, Mixed};
        for (loss, ratio, expected) in [
            (0.5, 1.27, Debonding),
            (0.5, 1.081, Debonding),
            (0.5, 1.079, Mixed),
            (0.1, 1.01, ConcreteSplitting),
            (0.1, 1.149, ConcreteSplitting),
            (0.1, 1.151, Mixed),
        ] {
            let found = judge(&states(), &drop(loss, 0.5), Some(ratio));
            assert_eq!(found, expected, "loss {loss}, ratio {ratio}");
        }
    }

    #[test]
    fn a_sheet_that_ruptures_by_the_peak_is_rupture_whatever_follows() {
        let mut ruptured = drop(0.9, 0.9);
        ruptured.utilisation = 1.0;
        assert_eq!(judge(&states(), &ruptured, None), FailureMode::SheetRupture);
        ruptured.utilisation = 0.999;
        assert_eq!(judge(&states(), &ruptured, None), FailureMode::Debonding);
    }

    #[test]
    fn yielding_bars_with_vertical_cracks_are_flexure_unless_the_bond_fails_too() {
        let mut states = (peak(), peak());
        states.0.bars[1].utilisation = 1.0;
        open(&mut states.1, 15, 5.0);
        assert_eq!(judge(&states, &drop(0.1, 0.1), None), FailureMode::Flexure);
        // No diagonal crack grows: the bond of the test span is looked at, and there is none here.
        let mut failing = drop(0.1, 0.1);
        open(&mut states.1, 24, 45.0);
        for i in 10..15 {
            open(&mut states.1, i, 5.0);
        }
        assert_eq!(judge(&states, &failing, None), FailureMode::Flexure);
        failing = drop(0.6, 0.6);
        assert_eq!(judge(&states, &failing, None), FailureMode::Mixed);
        states.0.bars[1].utilisation = 0.99;
        assert_eq!(judge(&states, &failing, None), FailureMode::Debonding);
    }

    #[test]
    fn crushing_behind_bonded_sheets_keeps_its_place() {
        let mut web = states();
        web.0.concrete[24].crushing = 0.1;
        assert_eq!(judge(&web, &drop(0.1, 0.1), None), FailureMode::WebCrushing);
        assert_eq!(judge(&web, &drop(0.6, 0.6), None), FailureMode::Mixed);
        // Most cracks grow between the loads, where the concrete crushes.
        let mut crushing = states();
        for i in 12..15 {
            open(&mut crushing.1, i, 5.0);
        }
        crushing.1.concrete[15].crushing = 0.5;
        let found = judge(&crushing, &drop(0.1, 0.1), None);
        assert_eq!(found, FailureMode::ConcreteCrushing);
    }

    #[test]
    fn a_drop_that_is_not_complete_decides_debonding_alone() {
        let mut short = drop(0.1, 0.1);
        short.complete = false;
        assert_eq!(judge(&states(), &short, None), FailureMode::Undecided);
        let mut short = drop(0.6, 0.6);
        short.complete = false;
        assert_eq!(judge(&states(), &short, None), FailureMode::Debonding);
        let (before, after) = states();
        let states = (&before, &after);
        let none = Diagnosis::strengthened(&layout(), states, 0.049, &short, None);
        assert_eq!(none.mode, FailureMode::None);
    }

    #[test]
    fn a_span_without_sheets_fails_like_a_bare_beam() {
        let mut bare = drop(0.6, 0.6);
        bare.spans[1].debonded = None;
        assert_eq!(judge(&states(), &bare, None), FailureMode::DiagonalTension);
        // The span whose cracks grow decides, not the one that debonds.
        let mut left = (peak(), peak());
        open(&mut left.1, 4, 45.0);
        let found = judge(&left, &drop(0.6, 0.6), None);
        assert_eq!(found, FailureMode::ConcreteSplitting);
    }

    #[test]
    fn the_evidence_is_one_line_with_numbers() {
        let (before, after) = states();
        let states = (&before, &after);
        let diagnosis =
            Diagnosis::strengthened(&layout(), states, 0.21, &drop(0.45, 0.48), Some(1.27));
        assert_eq!(diagnosis.counterfactual_ratio, Some(1.27));
        assert_eq!(
            diagnosis.mode_evidence,
            "load falls by 21.0 %; sheet force in the right shear span 100.0 kN at the peak, 55.0 kN at 188 kN \
             (-45 %); 48 % of its side debonded then, 4 % at the peak; slip up to 0.171 mm, beyond s_f over \
             62 % of strip 9; sheets used to 40 %; perfect bond would carry 1.27 times the peak; no stirrups in \
             the span; 100 % of the crack growth is diagonal (most in the right shear span); bottom bars reach \
             0.60 fy by the peak at x = 1500 mm; 0.0 % of a web past its strength at the peak; crushing grows by \
             0.00 % of the concrete"
        );
    }
}
