//! Protects the forces of single supports and loads: they are in balance with self weight at every step, and the reported
//! load follows from them.

use std::fs;
use std::process::Command;

/// The columns of the history of B-CO1 up to a small deflection.
fn history() -> (Vec<String>, Vec<Vec<f64>>) {
    let folder = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_rc-beams"))
        .args(["run", "B-CO1", "--mesh", "48x3", "--until", "0.3"])
        .args(["--fields", "none", "-o"])
        .arg(folder.path())
        .output()
        .unwrap();
    assert!(output.status.success());
    let text = fs::read_to_string(folder.path().join("B-CO1/history.csv")).unwrap();
    let mut lines = text.lines();
    let names = lines.next().unwrap().split(',').map(str::to_owned);
    let rows = lines.map(|line| {
        line.split(',')
            .map(|c| c.parse().unwrap_or(f64::NAN))
            .collect()
    });
    (names.collect(), rows.collect())
}

#[test]
fn loads_of_two_spans_are_written_one_by_one_and_in_balance() {
    let (names, rows) = history();
    let column = |name: &str| names.iter().position(|n| n == name).unwrap();
    let reactions = ["reaction_x460_kn", "reaction_x2440_kn", "reaction_x4420_kn"].map(column);
    let loads = ["load_x1375_kn", "load_x3505_kn"].map(column);
    let sum = |row: &[f64], of: &[usize]| of.iter().map(|&c| row[c]).sum::<f64>();
    let weight = sum(&rows[0], &reactions);
    assert!(weight > 1.0 && loads.iter().all(|&c| rows[0][c] == 0.0));
    for row in &rows[1..] {
        let (up, down) = (sum(row, &reactions) - weight, sum(row, &loads));
        assert!((up / down - 1.0).abs() < 2e-3, "{up} {down}");
        // Shear in the right span: half of all loads less the reaction at its end, both net of self weight.
        let shear = 0.5 * up - (row[reactions[2]] - rows[0][reactions[2]]);
        let told = row[column("load_kn")];
        assert!((shear - told).abs() < 1e-9 * down, "{shear} {told}");
    }
    // Both spans carry.
    let last = rows.last().unwrap();
    assert!(last[loads[0]] > 0.3 * sum(last, &loads));
}
