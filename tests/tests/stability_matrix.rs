//! Protects the promise of the automatic driver: in no scenario of the stability matrix is it wrong and silent, and in all
//! but those named here it arrives. The whole matrix is `docs/stability.md`.

use fe_tests::stability::{Case, Method, Outcome, SCENARIOS, Scenario};

fn case(scenario: &Scenario, method: Method, coarse: f64) -> Option<Case> {
    let case = (scenario.run)(method, coarse)?;
    Some(case.unwrap_or_else(|error| panic!("{}: {error}", scenario.id)))
}

/// Fixed cracks lock, and say so; `docs/stability.md` says how much.
const UNSOLVED: [&str; 1] = ["the same, law fixed-crack, shear transfer by interlock"];

/// Every scenario in its longest steps.
#[test]
fn the_automatic_driver_arrives_everywhere() {
    for scenario in &SCENARIOS {
        let coarse = scenario.coarse.last().copied().unwrap_or(1.0);
        let case = case(scenario, Method::Automatic, coarse).expect("applies");
        let name = format!("{} {}", scenario.id, scenario.title);
        let solved = !UNSOLVED.contains(&scenario.title);
        let expected = if solved {
            Outcome::Correct
        } else {
            Outcome::Reported
        };
        assert_eq!(case.outcome(), expected, "{name}: {case:?}");
    }
}

/// Load control cannot pass a limit point: it is to stop at the peak and to say so.
#[test]
fn load_control_stops_and_says_so() {
    for scenario in SCENARIOS
        .iter()
        .filter(|s| ["STAB-01 to -04", "STAB-24"].contains(&s.id))
    {
        let case = case(scenario, Method::Load, 1.0).expect("applies");
        assert_eq!(
            case.outcome(),
            Outcome::Stopped,
            "{}: {case:?}",
            scenario.title
        );
        assert!(case.figures[0].found > 200.0, "{case:?}");
    }
}
