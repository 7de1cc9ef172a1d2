//! Protects the command `point`: the table it writes and what it says of mistakes.

use std::fs;
use std::process::{Command, Output};

const BAR: &str = include_str!("../cases/cyclic-bar.ron");
const BOND: &str = include_str!("../cases/sheet-bond.ron");

fn point(case: &str) -> (Output, String, Option<String>) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("case.ron"), case).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_rc-beams"))
        .args(["point", "case.ron", "-o", "path.csv"])
        .current_dir(folder.path())
        .env("NO_COLOR", "1")
        .output()
        .unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    (
        output,
        message,
        fs::read_to_string(folder.path().join("path.csv")).ok(),
    )
}

/// Source: sample of fe-materials. Target: 460 + 2000 (0.01 - 460/200000) = 475.4 MPa after 50 steps.
#[test]
fn the_path_of_a_bar_is_written() {
    let (output, message, table) = point(BAR);
    assert_eq!(output.status.code(), Some(0), "{message}");
    let table = table.unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert!(lines[0].starts_with("eps,sig,"), "{}", lines[0]);
    assert_eq!(lines.len(), 1 + 1 + 200);
    let stress: f64 = lines[51].split(',').nth(1).unwrap().parse().unwrap();
    assert!((stress - 475.4).abs() < 1e-9, "{stress}");
}

/// A mistake in a case: place, words, code 3, no file.
#[test]
fn mistakes_in_a_case_are_named_with_their_place() {
    for (from, to, words) in [
        (
            "yield_mpa: 460",
            "yeld_mpa: 460",
            "did you mean `yield_mpa`?",
        ),
        (
            "yield_mpa: 460",
            "yield_mpa: 460,0",
            "use a decimal point: 460.0",
        ),
        ("yield_mpa: 460", "yield_mpa: -460", "law: "),
        (
            "\"eps\": -0.01",
            "\"eps_xx\": -0.01",
            "strain has no component \"eps_xx\"",
        ),
        (
            "steps: 100",
            "steps: -100",
            "steps: a negative or far too large number; allowed: whole numbers that are not negative",
        ),
        ("steps: 100", "steps: 0", "segment 2 has steps = 0"),
        (
            "steps: 100",
            "steps: 5000000000",
            "segment 2 has steps = 5000000000, outside [1, 1000000]",
        ),
        (
            "{\"eps\": -0.01}",
            "{\"eps\": -0.01, \"eps\": 0.01}",
            "the component `eps` stands twice",
        ),
        ("\"eps\": -0.01", "\"eps\": NaN", "the target of eps is NaN"),
    ] {
        assert_eq!(BAR.matches(from).count(), 1, "{from}");
        let (output, message, table) = point(&BAR.replace(from, to));
        assert_eq!(output.status.code(), Some(3), "{to}: {message}");
        assert!(message.contains(words), "{to}: {message}");
        let line = BAR[..BAR.find(from).unwrap()].matches('\n').count() + 1;
        assert!(
            message.contains(&format!("[case.ron:{line}:")),
            "{to}: {message}"
        );
        assert_eq!(table, None, "{to}");
    }
}

/// Source: Lu et al. (2005), bilinear. Targets: tau_max = 4.47 MPa, half of the way down (4.47 - tau)/(s - s0) = 4.47/(sf - s0), a
/// straight line back to no slip, and no bond in the end.
#[test]
fn the_path_of_a_bond_is_written() {
    let (output, message, table) = point(BOND);
    assert_eq!(output.status.code(), Some(0), "{message}");
    let table = table.unwrap();
    assert!(table.starts_with("slip_1,slip_2,opening,tau_1,"), "{table}");
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|c| c.parse().unwrap()).collect())
        .collect();
    let strength = 1.5 * 2.98;
    let slips = [0.0195 * 2.98, 2.0 * 0.308 * 2.98_f64.sqrt() / strength];
    let down = strength * (slips[1] - 0.12) / (slips[1] - slips[0]);
    assert!((rows[60][3] - down).abs() < 1e-9, "{}", rows[60][3]);
    assert!((rows[70][3] - 0.5 * down).abs() < 1e-9, "{}", rows[70][3]);
    assert!(rows[180][3] < 1e-4 * strength);
}

/// A case has a law or a bond; a mistake in the bond is told there.
#[test]
fn a_case_has_one_law() {
    let both = BOND.replace("    bond:", "    law: ElasticBar(young_mpa: 1),\n    bond:");
    let none = "(program: [])".to_owned();
    let wrong = BOND.replace("width_ratio: 0.5", "width_ratio: 1.5");
    for (case, words) in [
        (both, "both of `law` and `bond` are given"),
        (none, "none of `law` and `bond` are given"),
        (wrong, "width_ratio"),
    ] {
        let (output, message, table) = point(&case);
        assert_eq!(output.status.code(), Some(3), "{message}");
        assert!(
            message.contains(words) && message.contains("[case.ron:"),
            "{message}"
        );
        assert_eq!(table, None);
    }
}

/// A stress that the law cannot reach: code 1, the path up to there is kept.
#[test]
fn a_path_that_stops_is_kept() {
    let case = "(law: Isochoric(concrete: (fck_mpa: 30)), \
                program: [(stress_mpa: {\"sig_xx\": -76}, steps: 10)])";
    let (output, message, table) = point(case);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("segment 1, step"), "{message}");
    assert!((4..12).contains(&table.unwrap().lines().count()));
}
