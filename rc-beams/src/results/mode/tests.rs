//! Protects the table of the module: one history per row, and the honesty of the last one.
use super::*;
use crate::results::evidence::{ConcretePoint, ShearSpan};

/// A beam of 3000 x 300 with loads at 1000 and 2000.
pub(in crate::results) fn layout() -> Layout {
    let span = |name: &str, from_mm, to_mm| ShearSpan {
        name: name.to_owned(),
        from_mm,
        to_mm,
    };
    Layout {
        shear_spans: vec![
            span("left shear span", 0.0, 1000.0),
            span("right shear span", 2000.0, 3000.0),
        ],
        height_mm: 300.0,
        stirrups: 12,
    }
}

/// 30 points at mid-height, 100 mm apart, with a vertical crack each and a bar below yield.
pub(in crate::results) fn peak() -> Snapshot {
    let point = |i: u32| ConcretePoint {
        position: [50.0 + 100.0 * f64::from(i), 150.0, 37.5],
        volume: 1e6,
        crack_strain: 1e-3,
        crack_normal: [1.0, 0.0, 0.0],
        crushing: 0.0,
    };
    Snapshot {
        concrete: (0..30).map(point).collect(),
        bars: vec![
            BarReach {
                bar: "top".to_owned(),
                x_mm: 100.0,
                utilisation: 0.1,
            },
            BarReach {
                bar: "bottom".to_owned(),
                x_mm: 1500.0,
                utilisation: 0.6,
            },
        ],
        stirrups: vec![],
    }
}

/// Opens a crack at point `i` whose normal is inclined by `degrees`.
pub(in crate::results) fn open(state: &mut Snapshot, i: usize, degrees: f64) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    state.concrete[i].crack_strain += 0.01;
    state.concrete[i].crack_normal = [cos, sin, 0.0];
}

/// A load that falls by a share, at once.
pub(in crate::results) const fn falls(share: f64) -> Capacity {
    Capacity {
        peak: 0,
        fell: false,
        first_drop: None,
        post_peak_drop: share,
        vertical_drop: false,
        plateau: false,
    }
}

/// A load that hardly falls, far beyond its peak.
pub(in crate::results) const PLATEAU: Capacity = Capacity {
    plateau: true,
    ..falls(0.01)
};

fn mode(peak: &Snapshot, end: &Snapshot) -> FailureMode {
    Diagnosis::of(&layout(), peak, end, &falls(0.3)).mode
}

#[test]
fn a_load_that_does_not_fall_is_flexure_if_bars_yield_along_a_plateau_and_else_none_that_is_known()
{
    let mut yielding = peak();
    yielding.bars[1].utilisation = 1.02;
    let diagnosis = Diagnosis::of(&layout(), &yielding, &yielding, &falls(0.01));
    assert_eq!(diagnosis.mode, FailureMode::None);
    assert!(diagnosis.mode_evidence.contains("1.02 fy"));
    let of = |state: &Snapshot| Diagnosis::of(&layout(), state, state, &PLATEAU).mode;
    assert_eq!(of(&yielding), FailureMode::Flexure);
    assert_eq!(of(&peak()), FailureMode::Undecided);
}

#[test]
fn a_vertical_crack_through_plain_concrete_is_flexure() {
    let [before, mut end] = [peak(), peak()].map(|state| Snapshot {
        bars: vec![],
        ..state
    });
    open(&mut end, 15, 0.0);
    assert_eq!(mode(&before, &end), FailureMode::Flexure);
    open(&mut end, 24, 45.0);
    open(&mut end, 25, 45.0);
    assert_eq!(mode(&before, &end), FailureMode::DiagonalTension);
}

#[test]
fn diagonal_cracks_that_open_in_a_shear_span_are_diagonal_tension() {
    let (before, mut end) = (peak(), peak());
    open(&mut end, 24, 45.0);
    open(&mut end, 25, 45.0);
    open(&mut end, 15, 0.0);
    // A crack along the bars and a closing one do not count.
    open(&mut end, 26, 88.0);
    end.concrete[3].crack_strain = 0.0;
    let diagnosis = Diagnosis::of(&layout(), &before, &end, &falls(0.3));
    assert_eq!(diagnosis.mode, FailureMode::DiagonalTension);
    assert_eq!(
        diagnosis.mode_evidence,
        "load falls by 30.0 %; 67 % of the crack growth is diagonal (most in the right shear span); \
         bottom bars reach 0.60 fy by the peak at x = 1500 mm; 0.0 % of a web past its strength at \
         the peak; crushing grows by 0.00 % of the concrete; 0 of 12 stirrups yield"
    );
}

#[test]
fn inclined_cracks_between_the_loads_are_no_shear() {
    let (before, mut end) = (peak(), peak());
    open(&mut end, 15, 45.0);
    assert_ne!(mode(&before, &end), FailureMode::DiagonalTension);
}

#[test]
fn vertical_cracks_in_a_shear_span_are_flexure_only_where_bars_yield() {
    let (mut before, mut end) = (peak(), peak());
    open(&mut end, 24, 45.0);
    open(&mut end, 23, 10.0);
    open(&mut end, 22, 10.0);
    assert_eq!(mode(&before, &end), FailureMode::DiagonalTension);
    before.bars[1].utilisation = 1.1;
    assert_eq!(mode(&before, &end), FailureMode::Flexure);
}

#[test]
fn yield_with_vertical_cracks_is_flexure() {
    let (mut before, mut end) = (peak(), peak());
    before.bars[1].utilisation = 1.0;
    open(&mut end, 15, 5.0);
    assert_eq!(mode(&before, &end), FailureMode::Flexure);
}

#[test]
fn bars_that_yield_where_diagonal_cracks_govern_do_not_hide_shear() {
    let (mut before, mut end) = (peak(), peak());
    before.bars[1].utilisation = 1.0;
    open(&mut end, 24, 45.0);
    assert_eq!(mode(&before, &end), FailureMode::DiagonalTension);
    before.concrete[24].crushing = 0.1;
    assert_eq!(mode(&before, &end), FailureMode::WebCrushing);
}

#[test]
fn a_web_past_its_strength_at_the_peak_is_web_crushing_whatever_opens_later() {
    let (mut before, mut end) = (peak(), peak());
    before.concrete[24].crushing = 0.1;
    open(&mut end, 24, 45.0);
    assert_eq!(mode(&before, &end), FailureMode::WebCrushing);
    // Outside the middle half of the height it is no web.
    before.concrete[24].position[1] = 280.0;
    assert_eq!(mode(&before, &end), FailureMode::DiagonalTension);
}

#[test]
fn crushing_between_the_loads_with_elastic_bars_is_concrete_crushing() {
    let (before, mut end) = (peak(), peak());
    end.concrete[15].crushing = 0.5;
    assert_eq!(mode(&before, &end), FailureMode::ConcreteCrushing);
}

#[test]
fn conflicting_or_missing_evidence_is_undecided() {
    let (mut before, mut end) = (peak(), peak());
    assert_eq!(mode(&before, &end), FailureMode::Undecided);
    open(&mut end, 24, 45.0);
    open(&mut end, 15, 0.0);
    assert_eq!(mode(&before, &end), FailureMode::Undecided);
    before.concrete[24].crushing = 0.1;
    before.bars[1].utilisation = 1.0;
    assert_eq!(mode(&before, &end), FailureMode::Undecided);
}
