//! Protects runs of beams with fibre sheets: what they write, their energy, sheets of a user's own, and sheets
//! bonded under load.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Runs a beam or specimen file; returns the folder of its results.
fn run(root: &Path, beam: &str, flags: &[&str]) -> PathBuf {
    let output = Command::new(env!("CARGO_BIN_EXE_rc-beams"))
        .args(["run", beam, "--fields", "none", "-o"])
        .arg(root)
        .args(flags)
        .output()
        .unwrap();
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    let mut folders = fs::read_dir(root).unwrap();
    folders.next().unwrap().unwrap().path()
}

fn summary(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("summary.json")).unwrap()).unwrap()
}

/// A column of a table; NaN for an empty cell.
fn column(folder: &Path, file: &str, name: &str) -> Vec<f64> {
    let mut table = csv::Reader::from_path(folder.join(file)).unwrap();
    let header = table.headers().unwrap().clone();
    let at = header.iter().position(|h| h == name);
    let at = at.unwrap_or_else(|| panic!("{file} has no column {name}: {header:?}"));
    let cell = |text: &str| text.parse().unwrap_or(f64::NAN);
    table.records().map(|r| cell(&r.unwrap()[at])).collect()
}

fn specimen(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("specimens")
        .join(file);
    fs::read_to_string(path).unwrap()
}

/// Coarse mesh, up to the first slips.
const COARSE: [&str; 4] = ["--mesh", "44x4x1", "--until", "2.6"];

/// Targets: the same history for any number of threads; external work equals stored plus dissipated energy to
/// 1e-3; the fibres of the sheets are stretched once the concrete has cracked, and the bond slips.
#[test]
fn a_sheet_takes_its_share() {
    let roots = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let [one, two] = [("1", &roots[0]), ("2", &roots[1])].map(|(threads, root)| {
        let flags = [&COARSE[..], &["--threads", threads]].concat();
        run(root.path(), "A-SO3-4", &flags)
    });
    let history = |folder: &Path| fs::read(folder.join("history.csv")).unwrap();
    assert_eq!(history(&one), history(&two));
    let summary = summary(&one);
    let closure = summary["energy"]["closure"].as_f64().unwrap();
    assert!(closure.abs() < 1e-3, "{closure}");
    let slip = summary["energy"]["parts"]["interface"]["work_j"].as_f64();
    assert!(slip.unwrap() > 0.0);
    let error = summary["bond_error"]["relative"].as_f64().unwrap();
    assert!((0.0..0.1).contains(&error), "{error}");
    let stress = column(&one, "sheets.csv", "test_span_stress_mpa");
    assert!(stress.last().unwrap() > &100.0, "{stress:?}");
    let gauge = column(&one, "gauges.csv", "sheet_x2140");
    assert!(gauge.last().unwrap().abs() > 1e-6, "{gauge:?}");
    let events = fs::read_to_string(one.join("events.csv")).unwrap();
    assert!(events.contains("flexural_crack"), "{events}");
    for file in ["slip.svg", "sheet.svg", "sheet_map.csv"] {
        assert!(fs::metadata(one.join(file)).unwrap().len() > 1000, "{file}");
    }
}

/// Fibres at 45 degrees across the diagonal crack, two plies, another width: a user's own file runs.
#[test]
fn sheets_of_a_user_run() {
    let root = tempfile::tempdir().unwrap();
    let text = specimen("A-SO3-4.ron")
        .replace("x_from_mm: 670,", "x_from_mm: 1730,")
        .replace(
            "(face: Side, from_mm: 0, to_mm: 305, angles_deg: [90])",
            "(face: Side, from_mm: 0, to_mm: 305, angles_deg: [45, 45])",
        );
    let file = root.path().join("own.ron");
    fs::write(&file, text).unwrap();
    let results = root.path().join("results");
    let folder = run(&results, file.to_str().unwrap(), &COARSE);
    let stress = column(&folder, "sheets.csv", "test_span_stress_mpa");
    assert!(stress.last().unwrap() > &50.0, "{stress:?}");
    let other = "shear_span_from_610_to_1370_mm_stress_mpa";
    assert!(
        column(&folder, "sheets.csv", other)
            .iter()
            .all(|&s| s == 0.0)
    );
}

/// Sheets bonded at 90 kN, within 0.5, carry nothing at that moment and something afterwards; their gauges are silent before.
/// Unloading first takes the load off.
#[test]
fn sheets_bonded_under_load_start_free_of_stress() {
    for hold in ["Hold", "Unload"] {
        let root = tempfile::tempdir().unwrap();
        let text = specimen("examples/A-SO3-4-staged.ron");
        let file = root.path().join("staged.ron");
        fs::write(&file, text.replace("hold: Hold", &format!("hold: {hold}"))).unwrap();
        let results = root.path().join("results");
        let folder = run(&results, file.to_str().unwrap(), &COARSE);
        let load = column(&folder, "history.csv", "load_kn");
        let gauge = column(&folder, "gauges.csv", "sheet_x2140");
        let stress = column(&folder, "sheets.csv", "test_span_stress_mpa");
        let bonded = gauge.iter().position(|g| !g.is_nan()).unwrap();
        let largest = load[..bonded].iter().copied().fold(0.0, f64::max);
        assert!(bonded > 5 && (largest - 90.0).abs() < 0.5, "{hold}");
        let wanted = if hold == "Unload" { 0.0 } else { 90.0 };
        assert!((load[bonded - 1] - wanted).abs() < 0.5, "{hold}: {load:?}");
        let told = summary(&folder)["bonded_at_kn"].as_f64().unwrap();
        assert!((told - load[bonded - 1]).abs() < 1e-9, "{hold}");
        let end = stress.len() - 1;
        assert!(stress[..bonded].iter().all(|&s| s == 0.0), "{hold}");
        assert!(stress[bonded] < 0.2 * stress[end], "{hold}: {stress:?}");
        assert!(load[end] > 100.0 && stress[end] > 50.0, "{hold}: {load:?}");
        let closure = summary(&folder)["energy"]["closure"].as_f64().unwrap();
        assert!(closure.abs() < 5e-3, "{hold}: {closure}");
    }
}

/// A beam whose sheets were never bonded, because its path ended before: results of the bare beam, and what to do.
#[test]
fn sheets_that_were_never_bonded_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let staged = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/specimens/examples/A-SO3-4-staged.ron"
    );
    let output = Command::new(env!("CARGO_BIN_EXE_rc-beams"))
        .args(["run", staged, "--until", "0.1", "--steps", "1", "-o"])
        .arg(folder.path())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
    let line = String::from_utf8(output.stdout).unwrap();
    assert!(line.contains("lower load in staged.load_kn"), "{line}");
    let beam = folder.path().join("A-SO3-4-staged");
    for file in [
        "summary.json",
        "history.csv",
        "fields_0001.vtu",
        "crack.svg",
    ] {
        assert!(beam.join(file).exists(), "{file}");
    }
}
