//! Protects the report: its figures are those of the stored files, nothing in them is changed, and one damaged beam
//! hides no other.
use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::*;
use crate::results::sheets::{
    Face, InterfacePoint, MAP, MapRow, MapState, SheetLayout, SheetPoint, SheetState, Zone,
    write_map,
};

/// A stored run whose load climbs to `peak` at 2 mm and falls.
fn store(root: &Path, name: &str, peak: f64, test: Option<f64>) {
    let folder = root.join(name);
    fs::create_dir_all(&folder).unwrap();
    let summary = serde_json::json!({
        "specimen": name, "preset": "default", "law": "fixed-crack", "driver": "secant",
        "integration": "full", "mesh": "60x4x1", "elements": 300, "steps": 3,
        "peak_load_kn": peak, "deflection_at_peak_mm": 2.0, "mode": "debonding",
        "mode_evidence": "load falls by 20.0 %", "trust": "high",
        "trust_reason": "every step meets it", "stop_reason": "the load fell",
        "post_peak_drop": 0.2, "ratio_model_to_test": test.map(|t: f64| peak / t),
        "test_load_kn": test, "wall_s": {"total": 12.34, "solve": 1.0},
    });
    fs::write(folder.join("summary.json"), summary.to_string()).unwrap();
    let history = format!(
        "step,deflection_mm,load_kn,residual\n0,0,0,\n1,1,{},1e-4\n2,2,{peak},1e-4\n3,3,{},1e-4\n",
        0.5 * peak,
        0.8 * peak
    );
    fs::write(folder.join("history.csv"), history).unwrap();
    let events = "event,step,deflection_mm,load_kn,x_mm,y_mm,z_mm,where,detail\n";
    fs::write(folder.join("events.csv"), events).unwrap();
    fs::write(
        folder.join("gauges.csv"),
        "deflection_mm,load_kn\n0,0\n1,1\n2,2\n3,3\n",
    )
    .unwrap();
    fs::write(folder.join("newton.csv"), "step,attempt\n1,1\n").unwrap();
}

fn results() -> TempDir {
    let root = tempfile::tempdir().unwrap();
    store(root.path(), "A-SO3-1", 140.0, Some(151.0));
    store(root.path(), "A-SO3-2", 220.0, Some(200.0));
    store(root.path(), "B-CO1", 99.0, None);
    fs::create_dir(root.path().join("notes")).unwrap();
    root
}

fn read(root: &TempDir, file: &str) -> String {
    fs::read_to_string(root.path().join(file)).unwrap()
}

/// Neither a sheet that ruptures while the load rises nor a staged beam that never got its sheets has a peak to compare: the run says
/// so by a ratio that is missing.
#[test]
fn a_peak_without_a_ratio_is_a_lower_bound() {
    let root = results();
    let summary = root.path().join("A-SO3-2/summary.json");
    let text = fs::read_to_string(&summary).unwrap();
    let mut stored: serde_json::Value = serde_json::from_str(&text).unwrap();
    stored["ratio_model_to_test"] = serde_json::Value::Null;
    fs::write(&summary, stored.to_string()).unwrap();
    assert_eq!(write(root.path()).unwrap().accuracy.unwrap().beams, 1);
    assert!(read(&root, "report.md").contains("| A-SO3-2 | > 220.0 |"));
}

/// A run that was stopped on its way up has no peak: it is shown as what it is and not compared.
#[test]
fn a_run_that_was_stopped_is_not_compared_with_a_test() {
    let root = results();
    let summary = root.path().join("A-SO3-2").join("summary.json");
    let stopped = fs::read_to_string(&summary).unwrap();
    let stopped = stopped.replace("\"debonding\"", "\"none (no failure reached)\"");
    fs::write(
        &summary,
        stopped.replace("the load fell", "stopped by the user"),
    )
    .unwrap();
    let report = write(root.path()).unwrap();
    assert_eq!(report.accuracy.unwrap().beams, 1);
    let text = read(&root, "report.md");
    for words in [
        "| A-SO3-2 | > 220.0 | 2.00 | none (no failure reached) | high | 200.0 | - |",
        "not compared with a test: A-SO3-2 (stopped by the user).",
    ] {
        assert!(text.contains(words), "{words} is missing in\n{text}");
    }
}

/// Target: errors of 11/151 = 7.3 % and 10 %, mean 8.6 %.
#[test]
fn the_report_has_every_beam_the_mean_error_and_a_picture_per_group() {
    let root = results();
    let report = write(root.path()).unwrap();
    assert_eq!((report.beams, &report.problems), (3, &Vec::new()));
    let accuracy = report.accuracy.as_ref().unwrap();
    assert!((accuracy.mean_error - 0.5 * (11.0 / 151.0 + 0.1)).abs() < 1e-12);
    assert_eq!(
        (accuracy.beams, accuracy.worst_beam.as_str()),
        (2, "A-SO3-2")
    );
    let line = report.line();
    let end =
        "report.md: 3 beams, mean |error| 8.6 % over 2 beams with a test, largest 10.0 % (A-SO3-2)";
    assert!(line.ends_with(end), "{line}");
    let text = read(&root, "report.md");
    for row in [
        "| A-SO3-1 | 140.0 | 2.00 | debonding | high | 151.0 | 0.93 | 12.3 | 3 |",
        "| B-CO1 | 99.0 | 2.00 | debonding | high | - | - | 12.3 | 3 |",
        "Mean |error| 8.6 %",
        "![load over deflection, A-SO3](report-A-SO3.svg)",
        "![load over deflection, B-CO](report-B-CO.svg)",
        "mesh 60x4x1: all beams",
    ] {
        assert!(text.contains(row), "{row} is missing in\n{text}");
    }
    assert!(!text.contains("## Events") && !text.contains("## Problems"));
    assert!(!text.contains("No failure was reached"));
    let picture = read(&root, "report-A-SO3.svg");
    assert!(picture.contains("A-SO3-1") && picture.contains("test 200.0 kN"));
    let csv = read(&root, "report.csv");
    assert_eq!(csv.lines().count(), 4);
    assert!(
        csv.lines()
            .nth(2)
            .unwrap()
            .starts_with("A-SO3-2,220,2,debonding,high,200,1.1,12.34,3,")
    );
    // Again, over what the first one left.
    assert_eq!(write(root.path()).unwrap(), report);
}

#[test]
fn damaged_results_are_told_once_per_beam_and_the_others_are_reported() {
    let root = results();
    let at = |file: &str| root.path().join(file);
    let history = read(&root, "A-SO3-1/history.csv");
    for (file, content, words, beams) in [
        (
            "A-SO3-1/summary.json",
            Some("{\"specimen\": \"A-SO3-1\", \"steps\": \"many\"".to_owned()),
            &["summary.json: steps: invalid type", "left out"][..],
            2,
        ),
        (
            "A-SO3-1/summary.json",
            None,
            &["summary.json is missing", "left out"],
            2,
        ),
        ("A-SO3-1/history.csv", None, &["history.csv is missing"], 3),
        (
            "A-SO3-1/history.csv",
            Some(history.replace("3,3,112", "3,3,11x")),
            &["history.csv, line 5: load_kn is \"11x\", not a number"],
            3,
        ),
        (
            "A-SO3-1/history.csv",
            Some(history[..history.len() - 8].to_owned()),
            &["history.csv, line 5"],
            3,
        ),
        (
            "A-SO3-1/history.csv",
            Some(history.replace("2,2,140", "2,2,141")),
            &["different runs"],
            3,
        ),
        (
            "A-SO3-1/events.csv",
            Some("event,step,deflection_mm,load_kn\nexplosion,1,1,1\n".to_owned()),
            &["events.csv, line 2: \"explosion\" is no event"],
            3,
        ),
        (
            "A-SO3-1/gauges.csv",
            Some(String::new()),
            &["gauges.csv is empty"],
            3,
        ),
        (
            "A-SO3-1/gauges.csv",
            Some("deflection_mm,load_kn\n0,0\n".to_owned()),
            &["gauges.csv has 1 rows for 4 of history.csv"],
            3,
        ),
        (
            "A-SO3-1/sheets.csv",
            Some("step,deflection_mm,load_kn\n1,1,70\n".to_owned()),
            &["sheets.csv does not hold the peak"],
            3,
        ),
        (
            "A-SO3-1/sheet_map.csv",
            Some("state,kind\npeak,sheet\n".to_owned()),
            &["sheet_map.csv: "],
            3,
        ),
    ] {
        let before = fs::read(at(file)).ok();
        match &content {
            Some(content) => fs::write(at(file), content).unwrap(),
            None => fs::remove_file(at(file)).unwrap(),
        }
        let report = write(root.path()).unwrap();
        assert_eq!(report.beams, beams, "{file}: {content:?}");
        assert_eq!(report.problems.len(), 1, "{file}: {:?}", report.problems);
        let problem = &report.problems[0];
        assert!(problem.starts_with("A-SO3-1: "), "{problem}");
        assert!(!problem.contains("; gauges.csv"), "{problem}");
        for word in words {
            assert!(problem.contains(word), "{problem} lacks {word}");
        }
        let text = read(&root, "report.md");
        assert!(text.contains(problem.as_str()) && text.contains("| A-SO3-2 | 220.0"));
        match before {
            Some(content) => fs::write(at(file), content).unwrap(),
            None => fs::remove_file(at(file)).unwrap(),
        }
    }
    assert!(write(root.path()).unwrap().problems.is_empty());
}

#[test]
fn a_folder_without_results_is_refused() {
    let root = tempfile::tempdir().unwrap();
    let error = write(root.path()).unwrap_err();
    assert!(error.to_string().contains("no results"), "{error}");
    assert!(fs::read_dir(root.path()).unwrap().next().is_none());
    let error = write(&root.path().join("elsewhere")).unwrap_err();
    assert!(matches!(error, ReportError::Folder { .. }), "{error}");
}

/// Two points of a strip, one of them debonded.
fn store_sheets(root: &Path) {
    let layout = SheetLayout {
        zones: vec![Zone {
            name: "strip 9".to_owned(),
            x_mm: [100.0, 200.0],
            y_mm: [0.0, 300.0],
            covered_mm: 300.0,
        }],
        stirrups_in_spans: vec![0],
    };
    let mut state = SheetState::default();
    for (y, slip_max_mm) in [(75.0, 0.25), (225.0, 0.1)] {
        let position = [150.0, y, 75.0];
        state.sheet.push(SheetPoint {
            position,
            zone: 0,
            face: Face::Side,
            area_mm2: 1.5e4,
            hoop_n_per_mm: 0.165 * 900.0,
            fibre_stress_mpa: 900.0,
            utilisation: 0.25,
        });
        state.interface.push(InterfacePoint {
            position,
            zone: 0,
            face: Face::Side,
            area_mm2: 1.5e4,
            slip_mm: slip_max_mm,
            slip_max_mm,
            s0_mm: 0.05,
            sf_mm: 0.2,
        });
    }
    let folder = Folder::open(&root.join("A-SO3-2")).unwrap();
    let rows = [MapState::Peak, MapState::End].map(|at| MapRow::of(at, &layout, &state));
    write_map(&folder, &rows.concat()).unwrap();
    let sheets = "step,deflection_mm,load_kn,utilisation,left_stress_mpa,left_force_kn,left_debonded,\
                  test_span_stress_mpa,test_span_force_kn,test_span_debonded,strip_9_debonded\n\
                  0,0,0,0,0,0,,0,0,,0\n1,1,110,0.1,999,99,,10,1,0,0\n2,2,220,0.3,999,99,,1234.4,85.05,0.04,0\n\
                  3,3,176,0.3,999,99,,600,42,0.48,1\n";
    fs::write(root.join("A-SO3-2/sheets.csv"), sheets).unwrap();
}

/// Target: wherever a table of sheets is cut, that is told, once; what is left of others is reported.
#[test]
fn tables_of_sheets_that_were_cut_are_told() {
    let root = results();
    store_sheets(root.path());
    for file in ["sheets.csv", MAP] {
        let path = root.path().join("A-SO3-2").join(file);
        let whole = fs::read_to_string(&path).unwrap();
        let header = whole.find('\n').unwrap();
        for cut in header + 1..whole.len() - 1 {
            fs::write(&path, &whole[..cut]).unwrap();
            let problems = write(root.path()).unwrap().problems;
            let told = matches!(&problems[..], [one] if one.contains(file));
            assert!(told, "{file} {:?}: {problems:?}", &whole[..cut]);
        }
        fs::write(&path, &whole).unwrap();
        assert_eq!(write(root.path()).unwrap().problems, Vec::<String>::new());
    }
}

/// Target: with perfect bond there is no slip, and no picture of it is made up.
#[test]
fn without_points_of_the_interface_there_is_no_picture_of_slip() {
    let root = results();
    store_sheets(root.path());
    let map = root.path().join("A-SO3-2").join(MAP);
    let text = fs::read_to_string(&map).unwrap();
    let sheet = |line: &&str| !line.contains("interface");
    let perfect: Vec<&str> = text.lines().filter(sheet).collect();
    fs::write(&map, perfect.join("\n") + "\n").unwrap();
    assert_eq!(write(root.path()).unwrap().problems, Vec::<String>::new());
    let folder = root.path().join("A-SO3-2");
    assert!(folder.join("sheet.svg").exists() && !folder.join("slip.svg").exists());
    let text = read(&root, "report.md");
    assert!(text.contains("A-SO3-2/sheet.svg") && !text.contains("slip.svg"));
}

#[test]
fn missing_tables_are_told() {
    let root = results();
    store_sheets(root.path());
    fs::remove_file(root.path().join("A-SO3-1/events.csv")).unwrap();
    fs::remove_file(root.path().join("A-SO3-2").join(MAP)).unwrap();
    let problems = write(root.path()).unwrap().problems;
    assert_eq!(
        problems,
        [
            "A-SO3-1: events.csv is missing".to_owned(),
            format!("A-SO3-2: {MAP} is missing")
        ]
    );
}

#[test]
fn sheets_and_events_are_tabled_and_missing_pictures_drawn_anew() {
    let root = results();
    store_sheets(root.path());
    let events = "event,step,deflection_mm,load_kn,x_mm,y_mm,z_mm,where,detail\n\
                  diagonal_crack,1,1,110,2,3,4,test span,crack width 0.05 mm\n\
                  debonding,2,2,220,2,3,4,\"strip 9, side\",slip 0.2 mm\n";
    fs::write(root.path().join("A-SO3-2/events.csv"), events).unwrap();
    let empty = events.lines().next().unwrap().to_owned() + "\n";
    fs::write(root.path().join("A-SO3-1/events.csv"), empty).unwrap();
    let map = read(&root, &format!("A-SO3-2/{MAP}"));
    let report = write(root.path()).unwrap();
    assert_eq!(report.problems, Vec::<String>::new());
    let text = read(&root, "report.md");
    for row in [
        "| A-SO3-2 | 1234 | 85.0 | 42.0 | 4 % | 48 % |",
        "| beam | first diagonal crack | first debonding |",
        "| A-SO3-2 | 110.0 kN, 1.00 mm | 220.0 kN, 2.00 mm |",
        "![slip at the peak, A-SO3-2](A-SO3-2/slip.svg)",
    ] {
        assert!(text.contains(row), "{row} is missing in\n{text}");
    }
    let slip = read(&root, "A-SO3-2/slip.svg");
    assert!(slip.contains("220.0 kN at 2.00 mm") && slip.contains("debonded"));
    assert!(read(&root, "A-SO3-2/sheet.svg").contains("fibre stress [MPa]"));
    assert_eq!(read(&root, &format!("A-SO3-2/{MAP}")), map);
    // A picture of the run is kept.
    fs::write(root.path().join("A-SO3-2/slip.svg"), "of the run").unwrap();
    // Where no load is left, the force of the sheets is not read.
    let sheets = read(&root, "A-SO3-2/sheets.csv");
    let lost = sheets.replace("3,3,176,", "3,3,11,");
    fs::write(root.path().join("A-SO3-2/sheets.csv"), lost).unwrap();
    write(root.path()).unwrap();
    assert_eq!(read(&root, "A-SO3-2/slip.svg"), "of the run");
    assert!(read(&root, "report.md").contains("| 85.0 | lost with the load | 4 % |"));
}

#[test]
fn beams_whose_names_differ_by_the_last_number_are_a_group() {
    for (name, group) in [
        ("A-SO3-4", "A-SO3"),
        ("A-SW4-1", "A-SW4"),
        ("B-CO1", "B-CO"),
        ("beam", "beam"),
        ("12", "12"),
    ] {
        assert_eq!(figures::group_of(name), group);
    }
}
