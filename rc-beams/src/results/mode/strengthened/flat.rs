//! Mode of failure where no sheet on the side carries tension in the span that fails: sheets on the soffit or the top.
//!
//! They act along the beam, in bending, and their fibre stress stands for their force. Of the stretches of sheet that leave the
//! side bare, that one counts of which most is debonded at the end of the drop; *loss* is that of its largest fibre stress since
//! the peak, all of it where the load is lost. Bars may yield: sheets that peel off a beam in bending mostly do so behind it.
//!
//! | | evidence | mode |
//! |---|---|---|
//! | 1 | load falls by less than 5 % | the same as for bare beams: flexure or none |
//! | 2 | loss at least 40 % and debonded at least 35 %; diagonal share below 0.6, softened web below 10 % | debonding |
//! | 3 | the same loss and share, otherwise | mixed |
//! | 4 | loss above 25 % and debonded at least 35 % | undecided |
//! | 5 | otherwise | the same as for bare beams |
//!
//! The thresholds are those of sheets on the side, assumed here: no computed or measured history stands behind them.

use fe_solver::capacity::Capacity;

use super::{BONDED_LOSS, DEBONDING_LOSS, DEBONDING_SHARE};
use crate::results::mode::{DIAGONAL_GOVERNS, FailureMode, Measures, SOFTENED_WEB};
use crate::results::sheets::{SheetDrop, ZoneDrop};

/// The measure *loss* of the module.
fn loss(zone: &ZoneDrop, sheets: &SheetDrop) -> f64 {
    if sheets.lost { 1.0 } else { zone.loss() }
}

/// The table of the module.
pub(super) fn mode(measures: &Measures, sheets: &SheetDrop, capacity: &Capacity) -> FailureMode {
    if let Some(held) = measures.mode_without_drop(capacity) {
        return held;
    }
    let peeling = sheets.flat.as_ref();
    let peeling = peeling.filter(|zone| zone.debonded >= DEBONDING_SHARE);
    let lost = peeling.map_or(0.0, |zone| loss(zone, sheets));
    let shears =
        measures.diagonal_share >= DIAGONAL_GOVERNS || measures.softened_web >= SOFTENED_WEB;
    if lost >= DEBONDING_LOSS {
        if shears {
            FailureMode::Mixed
        } else {
            FailureMode::Debonding
        }
    } else if lost > BONDED_LOSS {
        FailureMode::Undecided
    } else {
        measures.mode()
    }
}

/// What the sheets lose, in words.
pub(super) fn evidence(sheets: &SheetDrop) -> String {
    let used = 100.0 * sheets.utilisation;
    let Some(zone) = &sheets.flat else {
        return format!(
            "no sheet on the side of the span carries tension, none on soffit or top debonds; sheets used to {used:.0} %"
        );
    };
    let (name, share) = (&zone.name, 100.0 * zone.debonded);
    let [before, after] = zone.fibre_mpa;
    let then = if sheets.lost {
        "lost with the load".to_owned()
    } else {
        // Adding 0 turns -0 into 0.
        let change = (-100.0 * zone.loss()).round() + 0.0;
        format!(
            "{after:.0} MPa at {:.0} kN ({change:+.0} %)",
            sheets.end_load_kn
        )
    };
    format!(
        "no sheet on the side of the span carries tension; {name} is debonded over {share:.0} % and slips up to {:.3} mm, its \
         fibres carry {before:.0} MPa at the peak, {then}; sheets used to {used:.0} %",
        zone.slip_max_mm
    )
}

#[cfg(test)]
mod tests {
    //! Protects the table of the module on both sides of its thresholds; the histories are made up.
    use super::*;
    use crate::results::evidence::Snapshot;
    use crate::results::mode::Diagnosis;
    use crate::results::mode::tests::{PLATEAU, falls, layout, open, peak};
    use crate::results::sheets::SpanDrop;

    /// A soffit sheet under a beam whose bars yield.
    fn drop(loss: f64, debonded: f64) -> SheetDrop {
        SheetDrop {
            spans: vec![SpanDrop::default(); 2],
            complete: true,
            end_load_kn: 120.0,
            utilisation: 0.3,
            flat: Some(ZoneDrop {
                name: "soffit".to_owned(),
                debonded,
                slip_max_mm: 1.5,
                fibre_mpa: [800.0, 800.0 * (1.0 - loss)],
            }),
            ..SheetDrop::default()
        }
    }

    fn judge(place: usize, degrees: f64, drop: &SheetDrop, capacity: &Capacity) -> Diagnosis {
        let mut before: Snapshot = peak();
        before.bars[1].utilisation = 1.0;
        let mut after = before.clone();
        open(&mut after, place, degrees);
        Diagnosis::strengthened(&layout(), (&before, &after), capacity, drop, None)
    }

    #[test]
    fn loss_and_debonded_share_tell_peeling_from_bending() {
        use FailureMode::{Debonding, Flexure, Undecided};
        for (loss, debonded, expected) in [
            (0.9, 0.9, Debonding),
            (0.41, 0.36, Debonding),
            (0.9, 0.34, Flexure),
            (0.39, 0.36, Undecided),
            (0.24, 0.9, Flexure),
            (-0.1, 0.0, Flexure),
        ] {
            let found = judge(15, 5.0, &drop(loss, debonded), &falls(0.3)).mode;
            assert_eq!(found, expected, "loss {loss}, debonded {debonded}");
        }
    }

    #[test]
    fn a_sheet_that_peels_where_diagonal_cracks_govern_is_mixed() {
        let of = |loss| judge(24, 45.0, &drop(loss, 0.9), &falls(0.3)).mode;
        assert_eq!(of(0.6), FailureMode::Mixed);
        assert_eq!(of(0.1), FailureMode::DiagonalTension);
    }

    #[test]
    fn a_load_that_holds_or_is_lost_is_told_from_one_that_falls() {
        let peeled = drop(0.1, 0.9);
        let of = |drop: &SheetDrop, capacity| judge(15, 5.0, drop, &capacity).mode;
        assert_eq!(of(&peeled, PLATEAU), FailureMode::Flexure);
        assert_eq!(of(&peeled, falls(0.01)), FailureMode::None);
        let lost = SheetDrop {
            lost: true,
            ..peeled
        };
        assert_eq!(of(&lost, falls(0.99)), FailureMode::Debonding);
    }

    #[test]
    fn the_evidence_speaks_of_the_sheet_that_leaves_the_side_bare() {
        let found = judge(15, 5.0, &drop(0.5, 0.6), &falls(0.3)).mode_evidence;
        let expected = "load falls by 30.0 %; no sheet on the side of the span carries tension; soffit is debonded over 60 % and \
                        slips up to 1.500 mm, its fibres carry 800 MPa at the peak, 400 MPa at 120 kN (-50 %); sheets used to 30 %; ";
        assert!(found.starts_with(expected), "{found}");
    }
}
