//! What tests print of their findings is what the verification manual reads.

use std::process::Command;

use fe_core::testing::{Worst, between, counted, curve, within, within_share};
use fe_tests::verification::findings::Findings;

/// Says one of everything for the other test.
#[test]
fn spoken() {
    within("load (N), 2 x 2", 2.50159, 2.5, 0.01);
    within_share("ratio", 0.99, 1.0, 0.02);
    between("share", 0.5, [0.0, 1.0]);
    counted("zeros", 6, 6);
    let mut worst = Worst::new("error", 1e-12);
    worst.see(-3e-14, "here");
    worst.tell();
    curve("spoken", [[0.0, 1.0], [0.5, -2e-9]]);
}

/// Protects the results of the manual. Target: all of them, with their place, digits and targets.
#[test]
fn what_is_said_is_read() {
    let tests = std::env::current_exe().unwrap();
    let said = Command::new(tests)
        .args(["--exact", "spoken", "--show-output"])
        .output()
        .unwrap();
    let findings = Findings::read(&String::from_utf8(said.stdout).unwrap()).unwrap();
    let found = findings.of(file!(), "spoken").iter();
    let found: Vec<_> = found
        .map(|f| (f.parts(), f.target.as_str(), f.found.as_str()))
        .collect();
    let expected = [
        ((None, "load (N), 2 x 2"), "2.5 ± 0.01", "2.502"),
        ((None, "ratio"), "1 ± 2 %", "0.990"),
        ((None, "share"), "0 to 1", "0.50"),
        ((None, "zeros"), "6", "6"),
        ((None, "error"), "< 1e-12", "< 1e-13"),
    ];
    assert_eq!(found, expected);
    assert_eq!(
        findings.curve("spoken").unwrap(),
        [[0.0, 1.0], [0.5, -2e-9]]
    );
}
