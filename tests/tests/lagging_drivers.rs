//! Drivers that end steps out of equilibrium, on a bar of 500 mm with a weak cell, drawn through its peak of 209 N.
//!
//! Source: STR-03, closed form: 209 N, G_F A = 8 N mm. Targets: what each driver tells of its error is there, and falls
//! with its cause.

use fe_core::state::StateStore;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::implex::Implex;
use fe_solver::journal::Entry;
use fe_solver::newton::NewtonSettings;
use fe_solver::stage::Stage;
use fe_solver::viscous::Viscous;
use fe_tests::driven::{Driven, Leg, drive};
use fe_tests::journal::Journal;
use fe_tests::softening_bar::{STRENGTH, moved};

fn draw(driver: &mut dyn Driver, step: f64) -> Driven {
    let mut strengths = [STRENGTH; 10];
    strengths[4] *= 0.95;
    let (model, conditions) = moved(500.0, &strengths);
    drive(&model, &conditions, &[Leg { to: 0.1, step }], 1e-4, driver).unwrap()
}

/// Where the cell has come apart, nothing holds the rest: the driver stops there, and says so.
#[test]
fn viscosity_costs_strength_and_energy_and_tells_how_much() {
    let [little, more] = [0.05, 0.2].map(|lag| {
        let mut driver = Viscous::new(lag * 0.0005, NewtonSettings::default()).unwrap();
        draw(&mut driver, 0.0005)
    });
    assert!(
        (little.peak() / 209.0 - 1.0).abs() < 1e-3,
        "{}",
        little.peak()
    );
    assert!((little.dissipated() / 8.0 - 1.0).abs() < 5e-3);
    assert!(more.peak() > 1.005 * little.peak(), "{}", more.peak());
    let [a, b] = [&little, &more].map(|d| d.viscous.unwrap());
    assert!(0.0 < a && a < 0.005 && b > 2.0 * a, "{a} {b}");
    for driven in [&little, &more] {
        let stopped = driven.stopped.as_deref().unwrap_or_default();
        assert!(stopped.contains("singular"), "{stopped}");
        assert!(driven.points.last().unwrap()[0] > 0.0725);
    }
}

/// No step fails and none is in equilibrium once the cell cracks; shorter steps come nearer.
#[test]
fn steps_without_iteration_tell_that_they_are_no_equilibria() {
    let [short, long] = [0.0005, 0.002].map(|step| draw(&mut Implex, step));
    for driven in [&short, &long] {
        assert!(driven.stopped.is_none());
        assert!(driven.marked > 10, "{}", driven.marked);
        assert!(driven.counters.iterations == driven.counters.steps);
    }
    let [a, b] = [short.peak() / 209.0 - 1.0, long.peak() / 209.0 - 1.0];
    assert!(0.0 < a && a < 0.04 && a < 0.7 * b, "{a} {b}");
}

/// Viscous work over the work of every step, with a journal.
#[derive(Default)]
struct Seen {
    kept: Vec<Entry>,
    viscous: Vec<Option<f64>>,
}

/// Draws a virgin bar into its softening, beginning with the steps of an earlier run.
fn lead(driver: &mut Viscous, earlier: Vec<Entry>) -> Seen {
    let (model, conditions) = moved(500.0, &[STRENGTH, 0.95 * STRENGTH, STRENGTH]);
    let mut state = StateStore::new(model.elements());
    let zero = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, zero).unwrap();
    let mut seen = Seen::default();
    let mut journal = Journal::after(earlier, |view| {
        seen.viscous.push(view.viscous);
    });
    let control = StepControl::new(0.002, 0.044);
    control.run(&mut stage, driver, &mut journal).unwrap();
    seen.kept = journal.kept;
    seen
}

/// Protects the account of a stage from the one before, led or recalled. Target: the same to the last bit in every stage.
#[test]
fn viscous_work_is_that_of_the_stage() {
    let viscous = || Viscous::new(1e-4, NewtonSettings::default()).unwrap();
    let mut driver = viscous();
    let first = lead(&mut driver, Vec::new());
    assert!(first.viscous.last().unwrap().unwrap() > 0.0);
    assert_eq!(lead(&mut driver, Vec::new()).viscous, first.viscous);
    let mut resumed = viscous();
    assert_eq!(lead(&mut resumed, first.kept).viscous, first.viscous);
    assert_eq!(lead(&mut resumed, Vec::new()).viscous, first.viscous);
}
