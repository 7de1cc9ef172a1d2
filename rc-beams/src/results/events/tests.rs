//! Protects the definition of every event: reached at its threshold, not before, once, by the right points.
use super::*;
use crate::results::evidence::{ConcretePoint, Layout, ShearSpan};
use crate::results::folder::Folder;
use crate::results::sheets::{Face, InterfacePoint, SheetPoint, SheetState, Zone};

fn layout() -> Layout {
    Layout {
        shear_spans: vec![ShearSpan {
            name: "test span".to_owned(),
            from_mm: 1680.0,
            to_mm: 2440.0,
        }],
        height_mm: 305.0,
        stirrups: 0,
    }
}

/// A crack of the given width in a band of 40 mm, its normal at `degrees` to the beam axis.
fn crack(x: f64, width_mm: f64, degrees: f64) -> ConcretePoint {
    let (sin, cos) = degrees.to_radians().sin_cos();
    ConcretePoint {
        position: [x, 150.0, 40.0],
        volume: 1e4,
        crack_strain: width_mm / 40.0,
        crack_normal: [-cos, sin, 0.0],
        crushing: 0.0,
    }
}

fn sees(look: impl Fn(&mut Survey<'_>)) -> Vec<&'static str> {
    let root = tempfile::tempdir().unwrap();
    let folder = Folder::create(root.path(), "beam").unwrap();
    let mut log = EventLog::create(&folder).unwrap();
    let layout = layout();
    let mut survey = Survey::new(&layout);
    look(&mut survey);
    let evidence = survey.finish(1, 0.1, 10.0);
    let events = log.step(&evidence).unwrap();
    events.iter().map(|e| e.kind.key()).collect()
}

#[test]
fn cracks_count_by_width_direction_and_place() {
    for (x, width, degrees, expected) in [
        (1500.0, 0.0501, 0.0, &["flexural_crack"][..]),
        (1500.0, 0.0499, 0.0, &[]),
        (2000.0, 0.06, 29.5, &["flexural_crack"]),
        (2000.0, 0.06, 30.5, &["diagonal_crack"]),
        (2000.0, 0.0499, 45.0, &[]),
        (2000.0, 0.06, 74.5, &["diagonal_crack"]),
        // Cracks along the bars are neither; inclined ones between the loads are no diagonal cracks.
        (2000.0, 0.06, 75.5, &[]),
        (1500.0, 0.06, 45.0, &[]),
    ] {
        let point = crack(x, width, degrees);
        assert_eq!(
            sees(|s| s.concrete(&point, 40.0)),
            expected,
            "{width} mm at {degrees} degrees"
        );
    }
}

#[test]
fn steel_yields_at_its_yield_stress() {
    assert!(sees(|s| s.stirrup("stirrup", [0.0; 3], 349.0, 350.0)).is_empty());
    assert_eq!(
        sees(|s| s.stirrup("stirrup", [0.0; 3], 350.0, 350.0)),
        ["stirrup_yield"]
    );
    assert_eq!(
        sees(|s| s.bar("bottom", [0.0; 3], 461.0, 460.0)),
        ["bar_yield"]
    );
    assert!(sees(|s| s.bar("bottom", [0.0; 3], -470.0, 460.0)).is_empty());
}

#[test]
fn crushing_has_two_events() {
    let crushing = |share| {
        let mut point = crack(2000.0, 0.0, 0.0);
        point.crushing = share;
        sees(|s| s.concrete(&point, 40.0))
    };
    assert!(crushing(0.0).is_empty());
    assert_eq!(crushing(1e-6), ["crushing"]);
    assert_eq!(crushing(0.999), ["crushing"]);
    assert_eq!(crushing(1.0), ["crushing", "crushed"]);
}

fn zones() -> Vec<Zone> {
    vec![Zone {
        name: "strip 9".to_owned(),
        x_mm: [1680.0, 1755.0],
        y_mm: [0.0, 305.0],
        covered_mm: 300.0,
    }]
}

fn interface(slip_max_mm: f64) -> SheetState {
    SheetState {
        sheet: Vec::new(),
        interface: vec![InterfacePoint {
            position: [1700.0, 40.0, 75.0],
            zone: 0,
            face: Face::Side,
            area_mm2: 100.0,
            slip_mm: 0.0,
            slip_max_mm,
            s0_mm: 0.05,
            sf_mm: 0.17,
        }],
    }
}

#[test]
fn the_interface_counts_by_its_largest_slip_and_the_sheet_by_its_utilisation() {
    let zones = zones();
    for (slip, expected) in [
        (0.049, &[][..]),
        (0.051, &["interface_strength"]),
        (0.169, &["interface_strength"]),
        (0.171, &["interface_strength", "debonding"]),
    ] {
        let state = interface(slip);
        let layout = layout();
        let mut survey = Survey::new(&layout);
        survey.sheets(&zones, &state);
        let evidence = survey.finish(1, 0.0, 0.0);
        let reached: Vec<&str> = EventKind::ALL
            .into_iter()
            .filter(|&k| evidence.reading(k).is_some_and(|r| k.is_reached(r.value)))
            .map(EventKind::key)
            .collect();
        assert_eq!(reached, expected, "{slip}");
    }
    for (utilisation, expected) in [(0.999, 0), (1.0, 1)] {
        let state = SheetState {
            sheet: vec![SheetPoint {
                position: [1700.0, 40.0, 75.0],
                zone: 0,
                face: Face::Side,
                area_mm2: 100.0,
                hoop_n_per_mm: 0.165 * 3790.0 * utilisation,
                fibre_stress_mpa: 3790.0 * utilisation,
                utilisation,
            }],
            interface: Vec::new(),
        };
        let layout = layout();
        let mut survey = Survey::new(&layout);
        survey.sheets(&zones, &state);
        let evidence = survey.finish(1, 0.0, 0.0);
        let ruptured = evidence.reading(EventKind::SheetRupture).unwrap();
        assert_eq!(
            usize::from(EventKind::SheetRupture.is_reached(ruptured.value)),
            expected
        );
    }
}

#[test]
fn an_event_is_written_when_it_happens_once_and_at_its_largest_reading() {
    let root = tempfile::tempdir().unwrap();
    let folder = Folder::create(root.path(), "beam").unwrap();
    let read = || std::fs::read_to_string(folder.path().join("events.csv")).unwrap();
    let mut log = EventLog::create(&folder).unwrap();
    let (layout, zones) = (layout(), zones());
    assert_eq!(read().lines().count(), 1);
    for (step, slip) in [(1, 0.04), (2, 0.171), (3, 0.5)] {
        let state = interface(slip);
        let mut survey = Survey::new(&layout);
        survey.concrete(&crack(1900.0, 0.02 * f64::from(step), 45.0), 40.0);
        survey.concrete(&crack(1950.0, 0.0252 * f64::from(step), 45.0), 40.0);
        survey.concrete(&crack(2000.0, f64::NAN, 45.0), 40.0);
        survey.sheets(&zones, &state);
        let evidence = survey.finish(step as usize, 0.5 * f64::from(step), 94.0);
        let new = log.step(&evidence).unwrap().len();
        assert_eq!(new, if step == 2 { 3 } else { 0 });
        assert_eq!(read().lines().count(), if step == 1 { 1 } else { 4 });
    }
    let text = read();
    assert_eq!(
        text.lines().collect::<Vec<_>>(),
        [
            "event,step,deflection_mm,load_kn,x_mm,y_mm,z_mm,where,detail",
            "diagonal_crack,2,1,94,1950,150,40,test span,crack width 0.050 mm",
            "interface_strength,2,1,94,1700,40,75,\"strip 9, side\",slip 0.171 mm",
            "debonding,2,1,94,1700,40,75,\"strip 9, side\",slip 0.171 mm",
        ]
    );
    assert_eq!(
        log.events()[2].to_string(),
        "first debonding at 94.0 kN, 1.00 mm: slip 0.171 mm, strip 9, side (x 1700, y 40, z 75 mm)"
    );
}
