//! Protects the table of the module: a history per row, on both sides of every threshold.
//! Source of the histories: loss of sheet force, debonded share and ratio of computed beams of series A.
use super::*;
use crate::results::mode::tests::{PLATEAU, falls, layout, open, peak};
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
        lost: false,
        utilisation: 0.4,
        zone: Some(ZoneDrop {
            name: "strip 9".to_owned(),
            debonded: 0.62,
            slip_max_mm: 0.171,
            fibre_mpa: [900.0, 450.0],
        }),
        flat: None,
    }
}

fn states() -> (Snapshot, Snapshot) {
    let mut end = peak();
    open(&mut end, 24, 45.0);
    (peak(), end)
}

fn judge(states: &(Snapshot, Snapshot), drop: &SheetDrop, ratio: Option<f64>) -> FailureMode {
    Diagnosis::strengthened(&layout(), (&states.0, &states.1), &falls(0.2), drop, ratio).mode
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
fn the_peak_with_perfect_bond_decides_whether_bond_or_concrete_governs() {
    use FailureMode::{ConcreteSplitting, Debonding, Mixed};
    for (loss, ratio, expected) in [
        (0.5, 1.27, Debonding),
        (0.5, 1.081, Debonding),
        (0.5, 1.079, ConcreteSplitting),
        (0.3, 1.079, ConcreteSplitting),
        (0.3, 1.149, Mixed),
        (0.3, 1.151, Debonding),
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
    // With perfect bond, in a span without sheets, and where the load of the model does not fall.
    ruptured.utilisation = 1.0;
    ruptured.spans[1].debonded = None;
    assert_eq!(judge(&states(), &ruptured, None), FailureMode::SheetRupture);
    ruptured.spans[1] = SpanDrop::default();
    assert_eq!(judge(&states(), &ruptured, None), FailureMode::SheetRupture);
    let (before, after) = states();
    let states = (&before, &after);
    let rising = Diagnosis::strengthened(&layout(), states, &falls(0.0), &ruptured, None);
    assert_eq!(rising.mode, FailureMode::SheetRupture);
    assert!(
        rising.mode_evidence.contains("sheets used to 100 %"),
        "{rising:?}"
    );
}

#[test]
fn behind_perfect_bond_the_concrete_fails_whatever_the_sheets_lose() {
    let mut perfect = drop(0.6, 0.0);
    perfect.spans[1].debonded = None;
    assert_eq!(
        judge(&states(), &perfect, None),
        FailureMode::ConcreteSplitting
    );
    let (before, after) = states();
    let states = (&before, &after);
    let said = Diagnosis::strengthened(&layout(), states, &falls(0.2), &perfect, None);
    let text = said.mode_evidence;
    assert!(text.contains("(-60 %); perfect bond; strip 9"), "{text}");
    assert!(!text.contains("would carry"), "{text}");
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
fn yield_where_diagonal_cracks_govern_leaves_the_choice_between_bond_and_concrete() {
    let mut states = states();
    states.0.bars[1].utilisation = 1.0;
    let found = [0.1, 0.6].map(|share| judge(&states, &drop(share, share), None));
    assert_eq!(
        found,
        [FailureMode::ConcreteSplitting, FailureMode::Debonding]
    );
}

#[test]
fn forces_are_not_read_where_the_load_is_lost() {
    let (before, after) = states();
    // However far the load falls later, the end of the drop counts.
    let of = |lost: bool, debonded: f64| {
        let drop = SheetDrop {
            lost,
            ..drop(-1.9, debonded)
        };
        Diagnosis::strengthened(&layout(), (&before, &after), &falls(0.99), &drop, None)
    };
    assert_eq!(of(false, 0.85).mode, FailureMode::ConcreteSplitting);
    let lost = of(true, 0.85);
    assert_eq!(lost.mode, FailureMode::Debonding);
    let evidence = lost.mode_evidence;
    assert!(
        evidence.contains("100.0 kN at the peak, lost with the load; 85 %"),
        "{evidence}"
    );
    assert!(
        evidence.contains("peak with perfect bond not known (without --counterfactual, or where its path ends before)"),
        "{evidence}"
    );
    assert_eq!(of(true, 0.3).mode, FailureMode::Mixed);
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
    let none = Diagnosis::strengthened(&layout(), states, &falls(0.049), &short, None);
    assert_eq!(none.mode, FailureMode::None);
}

#[test]
fn bars_that_yield_along_a_plateau_are_flexure() {
    let mut state = peak();
    state.bars[1].utilisation = 1.02;
    for (capacity, expected) in [
        (PLATEAU, FailureMode::Flexure),
        (falls(0.01), FailureMode::None),
    ] {
        let states = (&state, &state);
        let found = Diagnosis::strengthened(&layout(), states, &capacity, &drop(0.0, 0.0), None);
        assert_eq!(found.mode, expected);
    }
}

#[test]
fn a_span_without_sheets_fails_like_a_bare_beam() {
    let mut bare = drop(0.6, 0.6);
    bare.spans[1] = SpanDrop::default();
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
    let diagnosis = Diagnosis::strengthened(
        &layout(),
        states,
        &falls(0.21),
        &drop(0.45, 0.48),
        Some(1.27),
    );
    assert_eq!(diagnosis.counterfactual_ratio, Some(1.27));
    assert_eq!(
        diagnosis.mode_evidence,
        "load falls by 21.0 %; sheet force in the right shear span 100.0 kN at the peak, 55.0 kN at 188 kN \
         (-45 %); 48 % of its side debonded then, 4 % at the peak; strip 9 is debonded most widely, \
         over 62 %, and slips up to 0.171 mm; sheets used to 40 %; perfect bond would carry 1.27 times the peak; no stirrups in \
         the span; 100 % of the crack growth is diagonal (most in the right shear span); bottom bars reach \
         0.60 fy by the peak at x = 1500 mm; 0.0 % of a web past its strength at the peak; crushing grows by \
         0.00 % of the concrete; 0 of 12 stirrups yield"
    );
}
