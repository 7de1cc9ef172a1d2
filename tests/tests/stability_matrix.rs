//! Protects the promise of the automatic driver: in no scenario of the stability matrix is it wrong and silent, and in all
//! but those named here it arrives. The whole matrix is `docs/stability.md`.

use fe_tests::stability::{Case, Figure, Method, Outcome, SCENARIOS, Scenario};

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

/// STAB-25: viscosity tells what it swallows, and may not swallow much. Targets: 2 % of the work at most, and some; the peak the
/// same within 1 % when it is halved, in short steps. (In usual steps the share is 1.2 % and the peak changes by 1.0 %; in long
/// ones they are 2.2 %, and 1.0 %. At no length is the bar drawn apart: the tangent becomes singular, and the driver says so.)
#[test]
fn viscosity_is_told() {
    let scenario = SCENARIOS.iter().find(|s| s.id == "STAB-25").unwrap();
    let case = case(scenario, Method::Viscous, 0.5).expect("applies");
    for name in [
        "viscous share of the work",
        "peak with half of the viscosity, N",
    ] {
        let figure = case.figures.iter().find(|f| f.name == name);
        assert!(figure.is_some_and(Figure::holds), "{name}: {figure:?}");
    }
    assert_eq!(case.outcome(), Outcome::Stopped);
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
