//! Protects the command `report`: what it says, its codes, and that it runs nothing.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn report(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rc-beams"))
        .arg("report")
        .args(arguments)
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .output()
        .unwrap()
}

/// A stored beam that the program does not know, so that nothing could be run.
fn store(folder: &Path, name: &str) {
    let folder = folder.join(name);
    fs::create_dir_all(&folder).unwrap();
    let summary = format!(
        r#"{{"specimen": "{name}", "preset": "default", "law": "fixed-crack", "driver": "secant",
        "integration": "full", "mesh": "60x4x1", "steps": 2, "peak_load_kn": 90.0,
        "deflection_at_peak_mm": 2.0, "post_peak_drop": 0.2, "mode": "flexure", "mode_evidence": "bars yield",
        "trust": "limited", "trust_reason": "a jump", "stop_reason": "the load fell",
        "test_load_kn": 100.0, "ratio_model_to_test": 0.9, "wall_s": {{"total": 1.0}}}}"#
    );
    fs::write(folder.join("summary.json"), summary).unwrap();
    let history = "step,deflection_mm,load_kn\n0,0,0\n1,2,90\n2,3,70\n";
    fs::write(folder.join("history.csv"), history).unwrap();
    fs::write(folder.join("events.csv"), "event,step\n").unwrap();
    fs::write(folder.join("gauges.csv"), "load_kn\n0\n90\n70\n").unwrap();
    fs::write(folder.join("newton.csv"), "step\n").unwrap();
}

#[test]
fn stored_results_of_the_default_folder_are_reported() {
    let root = tempfile::tempdir().unwrap();
    store(&root.path().join("results"), "X-1");
    store(&root.path().join("results"), "X-2");
    let output = report(root.path(), &[]);
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty());
    assert_eq!(
        String::from_utf8(output.stdout).unwrap(),
        "results/report.md: 2 beams, mean |error| 10.0 % over 2 beams with a test, largest 10.0 % (X-2)\n"
    );
    for file in ["report.md", "report.csv", "report-X.svg"] {
        assert!(root.path().join("results").join(file).exists(), "{file}");
    }
}

#[test]
fn a_damaged_beam_is_a_warning_with_a_code_and_the_rest_is_reported() {
    let root = tempfile::tempdir().unwrap();
    store(root.path(), "X-1");
    store(root.path(), "X-2");
    fs::write(root.path().join("X-2/summary.json"), "{\"specimen\": ").unwrap();
    let output = report(root.path(), &["."]);
    assert_eq!(output.status.code(), Some(4));
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(
        message.starts_with("warning: X-2: summary.json: "),
        "{message}"
    );
    assert!(
        String::from_utf8(output.stdout)
            .unwrap()
            .contains("1 beam,")
    );
}

/// Target: who names the folder of a beam learns which one to name.
#[test]
fn the_folder_of_one_beam_is_told_from_one_of_beams() {
    let root = tempfile::tempdir().unwrap();
    store(root.path(), "X-1");
    for (from, folder, around) in [("", "X-1", "."), ("X-1", ".", "./.."), ("", "./X-1", ".")] {
        let output = report(&root.path().join(from), &[folder]);
        assert_eq!(output.status.code(), Some(4));
        let message = String::from_utf8(output.stderr).unwrap();
        let what = format!("{folder} holds the results of one beam");
        for words in [what, format!("`rc-beams report {around}`")] {
            assert!(message.contains(&words), "{words}: {message}");
        }
    }
}

#[test]
fn a_folder_without_results_is_an_error_with_a_remedy() {
    let root = tempfile::tempdir().unwrap();
    for (folder, words) in [
        (".", "there are no results in ."),
        ("nowhere", "cannot read the folder nowhere"),
    ] {
        let output = report(root.path(), &[folder]);
        assert_eq!(output.status.code(), Some(4));
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.contains(words), "{message}");
        assert!(message.contains("rc-beams run"), "{message}");
    }
}
