//! Protects the promise of the automatic driver: in no scene of the stability matrix is it wrong and silent, and in all of them
//! it arrives. The whole matrix is `docs/stability.md`.

use fe_tests::stability::{Case, Method, Outcome, SCENARIOS, Scenario};

fn assert_outcome(scenario: &Scenario, (method, coarse): (Method, f64), outcome: Outcome) -> Case {
    let case = Case::run(scenario, method, coarse).unwrap();
    assert_eq!(case.outcome(), outcome, "{}: {case:?}", scenario.title);
    case
}

#[test]
fn the_automatic_driver_arrives_everywhere() {
    for scenario in &SCENARIOS {
        assert_outcome(scenario, (Method::Automatic, 2.0), Outcome::Correct);
    }
}

/// Load control cannot pass a limit point: it is to stop at the peak and to say so.
#[test]
fn load_control_stops_and_says_so() {
    for scenario in &SCENARIOS {
        let case = assert_outcome(scenario, (Method::Load, 1.0), Outcome::Stopped);
        assert!(case.figures[0].found > 200.0, "{case:?}");
    }
}
