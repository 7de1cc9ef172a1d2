//! Protects the promise of the automatic driver: in no scene of the stability matrix is it wrong and silent, and in all of them
//! it arrives. The whole matrix is `docs/stability.md`.

use fe_tests::stability::{Case, Method, Outcome, SCENARIOS};

#[test]
fn the_automatic_driver_arrives_everywhere() {
    for scenario in &SCENARIOS {
        let case = Case::run(scenario, Method::Automatic, 2.0).unwrap();
        assert_eq!(
            case.outcome(),
            Outcome::Correct,
            "{}: {case:?}",
            scenario.title
        );
    }
}

/// Load control cannot pass a limit point: it is to stop at the peak and to say so.
#[test]
fn load_control_stops_and_says_so() {
    for scenario in &SCENARIOS {
        let case = Case::run(scenario, Method::Load, 1.0).unwrap();
        assert_eq!(
            case.outcome(),
            Outcome::Stopped,
            "{}: {case:?}",
            scenario.title
        );
        assert!(case.figures[0].found > 200.0, "{case:?}");
    }
}
