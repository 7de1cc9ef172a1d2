//! Protects the measures of the sheets against their definitions on states that are worked by hand, and
//! their tables and pictures on the way to a reader.
use fe_solver::capacity::{Capacity, PathPoint};

use super::*;
use crate::results::drawing::Picture;
use crate::results::evidence::{Layout, ShearSpan};
use crate::results::folder::Folder;

pub(in crate::results) fn layout() -> Layout {
    let span = |name: &str, from_mm, to_mm| ShearSpan {
        name: name.to_owned(),
        from_mm,
        to_mm,
    };
    Layout {
        shear_spans: vec![
            span("shear span from 0 to 1000 mm", 0.0, 1000.0),
            span("test span", 2000.0, 3000.0),
        ],
        height_mm: 300.0,
        stirrups: 12,
    }
}

/// Two strips of 100 x 300 in the test span.
pub(in crate::results) fn sheets() -> SheetLayout {
    let zone = |name: &str, from| Zone {
        name: name.to_owned(),
        x_mm: [from, from + 100.0],
        y_mm: [0.0, 300.0],
        covered_mm: 300.0,
    };
    SheetLayout {
        zones: vec![zone("strip 1", 2100.0), zone("strip 2", 2300.0)],
        stirrups_in_spans: vec![6, 0],
    }
}

/// A 2 x 3 grid of points per strip; stress and slip as functions of zone, column and line.
fn state(
    stress: impl Fn(usize, u32, u32) -> f64,
    slip: impl Fn(usize, u32, u32) -> f64,
) -> SheetState {
    let mut state = SheetState::default();
    for zone in 0..2 {
        for (i, j) in (0..2).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let position = [
                2125.0 + 200.0 * zone as f64 + 50.0 * f64::from(i),
                50.0 + 100.0 * f64::from(j),
                75.0,
            ];
            state.sheet.push(SheetPoint {
                position,
                zone,
                face: Face::Side,
                area_mm2: 5000.0,
                hoop_n_per_mm: 0.2 * stress(zone, i, j),
                fibre_stress_mpa: stress(zone, i, j),
                utilisation: stress(zone, i, j) / 3500.0,
            });
            let slip_max_mm = slip(zone, i, j);
            state.interface.push(InterfacePoint {
                position,
                zone,
                face: Face::Side,
                area_mm2: 5000.0,
                slip_mm: 0.5 * slip_max_mm,
                slip_max_mm,
                s0_mm: 0.05,
                sf_mm: 0.2,
            });
        }
    }
    state
}

/// Target: per strip two columns of 50 mm. Strip 1: largest stresses 300 and 400 MPa; strip 2: compression
/// only. SVf = 2 x 0.2 mm x 50 mm x (300 + 400) MPa = 14 kN.
#[test]
fn the_largest_force_is_the_sum_over_columns_of_both_sides() {
    let stress = |zone: usize, i: u32, j: u32| match (zone, i, j) {
        (0, 0, 1) => 300.0,
        (0, 1, 2) => 400.0,
        (0, _, _) => 100.0,
        _ => -50.0,
    };
    let mut at = state(stress, |_, _, _| 0.0);
    // The soffit counts for the stress, not for the force.
    at.sheet.push(SheetPoint {
        face: Face::Soffit,
        fibre_stress_mpa: 900.0,
        ..at.sheet[0]
    });
    let row = SheetRow::of(&layout(), &sheets(), &at, (3, 1.0, 80.0));
    assert!((row.spans[1].force_kn - 14.0).abs() < 1e-12, "{row:?}");
    assert_eq!(row.spans[1].stress_mpa, 900.0);
    assert_eq!(row.spans[0], SpanReading::default());
    assert!((row.utilisation - 400.0 / 3500.0).abs() < 1e-12);
}

/// Target: strip 2 debonded at 2 of its 6 points, a third of it and a sixth of the side; at the slip s_f the
/// bond is lost.
#[test]
fn debonded_shares_are_shares_of_area() {
    let slip = |zone: usize, i: u32, j: u32| match (zone, i, j) {
        (1, 0, 0) => 0.2,
        (1, 1, 0) => 0.31,
        _ => 0.199,
    };
    let row = SheetRow::of(
        &layout(),
        &sheets(),
        &state(|_, _, _| 0.0, slip),
        (1, 0.0, 0.0),
    );
    assert_eq!(row.zones[0].debonded, Some(0.0));
    assert!((row.zones[1].debonded.unwrap() - 1.0 / 3.0).abs() < 1e-12);
    assert_eq!(row.zones[1].slip_max_mm, 0.31);
    assert!((row.spans[1].debonded.unwrap() - 1.0 / 6.0).abs() < 1e-12);
    assert_eq!(row.spans[0].debonded, None, "no sheet there");
}

#[test]
fn the_table_is_on_disk_after_every_step() {
    let root = tempfile::tempdir().unwrap();
    let folder = Folder::create(root.path(), "beam").unwrap();
    let mut table = SheetTable::create(&folder, &layout(), &sheets()).unwrap();
    let at = state(|_, _, _| 350.0, |zone, _, _| 0.2 * zone as f64);
    let row = SheetRow::of(&layout(), &sheets(), &at, (7, 1.5, 80.25));
    table.step(&row).unwrap();
    let text = std::fs::read_to_string(folder.path().join("sheets.csv")).unwrap();
    let expected = "step,deflection_mm,load_kn,utilisation,shear_span_from_0_to_1000_mm_stress_mpa,\
                    shear_span_from_0_to_1000_mm_force_kn,shear_span_from_0_to_1000_mm_debonded,\
                    test_span_stress_mpa,test_span_force_kn,test_span_debonded,strip_1_debonded,\
                    strip_1_slip_max_mm,strip_1_fibre_mpa,strip_2_debonded,strip_2_slip_max_mm,strip_2_fibre_mpa\n\
                    7,1.5,80.25,0.1,0,0,,350,28,0.5,0,0,350,1,0.2,350\n";
    assert_eq!(text, expected);
}

fn path(loads: &[f64]) -> Vec<PathPoint> {
    let point = |(i, &load): (usize, &f64)| PathPoint {
        deflection: i as f64,
        load,
        work_conjugate_load: load,
        residual: 1e-4,
        flagged: false,
        held: false,
        unstable: false,
        kinetic: None,
        viscous: None,
    };
    loads.iter().enumerate().map(point).collect()
}

#[test]
fn the_drop_ends_at_the_first_point_at_or_below_four_fifths_of_the_peak() {
    for (loads, end) in [
        (&[50.0, 100.0, 90.0, 80.0, 10.0][..], Some(3)),
        (&[50.0, 100.0, 90.0, 80.1], None),
        (&[50.0, 100.0, 40.0, 10.0], Some(2)),
        (&[50.0, 100.0], None),
    ] {
        let path = path(loads);
        let capacity = Capacity::of(&path).unwrap();
        assert_eq!(end_of_drop(&path, &capacity), end, "{loads:?}");
    }
}

#[test]
fn the_drop_compares_the_peak_with_its_end_not_with_the_last_step() {
    let path = path(&[50.0, 100.0, 78.0, 10.0]);
    let capacity = Capacity::of(&path).unwrap();
    let rows: Vec<SheetRow> = [(200.0, 0.0), (350.0, 0.1), (175.0, 0.3), (0.0, 0.9)]
        .into_iter()
        .zip(&path)
        .map(|((stress, slip), p)| {
            let at = state(
                |_, _, _| stress,
                |zone, _, _| if zone == 1 { slip } else { 0.1 },
            );
            SheetRow::of(&layout(), &sheets(), &at, (0, p.deflection, p.load))
        })
        .collect();
    let drop = SheetDrop::of(&sheets(), &rows, &path, &capacity).unwrap();
    let span = drop.spans[1];
    assert!(drop.complete && drop.end_load_kn == 78.0 && !drop.lost);
    assert!((span.loss() - 0.5).abs() < 1e-12);
    assert_eq!((span.debonded, span.stirrups), (Some([0.0, 0.5]), 0));
    assert_eq!(drop.spans[0].debonded, None);
    assert!((drop.utilisation - 0.1).abs() < 1e-12);
    let zone = drop.zone.unwrap();
    assert_eq!(
        (zone.name.as_str(), zone.debonded, zone.slip_max_mm),
        ("strip 2", 1.0, 0.3)
    );
    assert!(drop.flat.is_none() && zone.fibre_mpa == [350.0, 175.0]);
    // The same strip as one that leaves the side bare.
    let mut flat = sheets();
    flat.zones[1].covered_mm = 0.0;
    let found = SheetDrop::of(&flat, &rows, &path, &capacity).unwrap().flat;
    assert_eq!(found, Some(zone));
    assert!(SheetDrop::of(&sheets(), &rows[..1], &path, &capacity).is_none());
}

fn map() -> Vec<MapRow> {
    let peak = state(
        |_, _, j| 500.0 * f64::from(j),
        |zone, _, _| 0.25 * zone as f64,
    );
    let end = state(|_, _, _| 0.0, |_, _, _| 0.4);
    let mut rows = MapRow::of(MapState::Peak, &sheets(), &peak);
    rows.extend(MapRow::of(MapState::End, &sheets(), &end));
    rows
}

#[test]
fn the_map_reads_back_as_it_was_written() {
    let root = tempfile::tempdir().unwrap();
    let folder = Folder::create(root.path(), "beam").unwrap();
    write_map(&folder, &map()).unwrap();
    let text = std::fs::read_to_string(folder.path().join(MAP)).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 1 + 2 * 24);
    assert_eq!(
        lines[0],
        "state,kind,face,zone,x_mm,y_mm,z_mm,fibre_stress_mpa,slip_mm,slip_max_mm,debonded"
    );
    assert_eq!(
        lines[2],
        "peak,sheet,side,strip 1,2125.0,150.0,75.0,500.0,,,"
    );
    assert_eq!(
        lines[24],
        "peak,interface,side,strip 2,2375.0,250.0,75.0,,0.125,0.25,1"
    );
    assert_eq!(read_map(text.as_bytes()).unwrap(), map());
    let damaged = text.replacen("2125.0", "21x", 1);
    let error = read_map(damaged.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("line: 2"), "{error}");
    assert!(matches!(
        read_map(lines[0].as_bytes()),
        Err(MapError::Empty)
    ));
}

#[test]
fn pictures_are_drawn_from_the_rows_alone_and_mark_what_is_debonded() {
    let rows = map();
    let view = |shown, state| SheetView {
        specimen: "A-SO3-3",
        title: "slip at the peak",
        shown,
        state,
        rows: &rows,
        zones: &[],
        elements: &[],
        supports: &[],
        loads: &[],
    };
    let strokes = |svg: &str| svg.matches("#56B4E9").count();
    let peak = view(Shown::Slip, MapState::Peak).to_svg().unwrap();
    assert!(peak.contains("slip [mm]") && peak.contains("debonded") && peak.contains("0.125"));
    // Both strips are debonded at the end, one at the peak; the legend has strokes, too.
    let end = view(Shown::Slip, MapState::End).to_svg().unwrap();
    assert!(strokes(&peak) > 10 && strokes(&end) > strokes(&peak) + 10);
    let stress = view(Shown::FibreStress, MapState::Peak).to_svg().unwrap();
    assert!(stress.contains("fibre stress [MPa]") && stress.contains("1000"));
    assert_eq!(strokes(&stress), 0);
}
