//! STR-04: double cantilever beam (mode I) and end-notched flexure (mode II); E = 120 000 MPa, width 20 mm, arms of 1.5 mm,
//! G_c = 0.28 N/mm.
//!
//! Source: beam theory. DCB: P = sqrt(G_c b^2 E h^3/12)/a, w = 8 P a^3/(E b h^3), hence 64.807 N at 1.7282 mm (a = 30 mm),
//! 48.606 N at 3.0724 mm (40 mm). ENF over 2 L = 100 mm: P = 4b/(3a) sqrt(G_c E h^3),
//! w = P (2 L^3 + 3 a^3)/(8 b h^3 E); displacement control follows from a = 34.67 mm on. The give of crack tip and interface
//! lengthens a in both formulas alike, so that load over displacement stays the same curve.

use fe_core::dof::Dof;
use fe_core::model::{Conditions, Model};
use fe_core::testing::{Worst, curve, within, within_share};
use fe_solver::automatic::Automatic;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::recorder::StepView;
use fe_solver::secant::SecantAnderson;
use fe_tests::conditions::hold;
use fe_tests::delamination::{
    H, SHEAR_STRENGTH, arms, dcb, delamination, enf, falling, graded, least, notched, turned,
    under_force, upper_turn,
};
use fe_tests::follow::{Path, follow, steps};
use fe_tests::mesh::nodes_where;
use fe_tests::solve::run;

/// Displacement (mm) and load (N) of every step.
fn drive(
    model: &Model,
    conditions: Conditions,
    driver: &mut dyn Driver,
    [step, end]: [f64; 2],
) -> Vec<[f64; 2]> {
    let control = StepControl {
        criterion: 1e-4,
        shortest: step / 1024.0,
        ..StepControl::new(step, end)
    };
    let mut path = Vec::new();
    let record = |view: &StepView<'_>| path.push([view.lambda, view.load]);
    run(model, conditions, &control, driver, |_| {}, record).unwrap();
    path
}

/// Compares the load of every step with a displacement in `range` with theory; at least `least` steps lie there.
#[track_caller]
fn compare(
    what: &str,
    path: &[[f64; 2]],
    range: [f64; 2],
    least: usize,
    theory: impl Fn(f64) -> f64,
) {
    let mut worst = Worst::new(
        &format!("{what}: load against beam theory, relative error"),
        0.012,
    );
    let inside = |p: &&[f64; 2]| p[0] >= range[0] && p[0] <= range[1];
    let inside: Vec<_> = path.iter().filter(inside).collect();
    assert!(inside.len() >= least, "{inside:?}");
    for [w, load] in inside {
        worst.see(load / theory(*w) - 1.0, w);
    }
    worst.tell();
}

/// Load of the first of the formulas at the displacement of the second, a between `low` and `high` (mm).
fn beam_theory(w: f64, low: f64, high: f64, formulas: impl Fn(f64) -> [f64; 2]) -> f64 {
    let (mut low, mut high) = (low, high);
    for _ in 0..60 {
        let a = 0.5 * (low + high);
        if formulas(a)[1] < w {
            low = a;
        } else {
            high = a;
        }
    }
    formulas(low)[0]
}

/// Protects the closed forms that the others are held against. Target: the printed figures, within one unit of their last digit.
#[test]
fn formulas() {
    for (name, found, target, digit) in [
        ("DCB, a = 30", dcb(30.0), [64.807, 1.7282], 1e-3),
        ("DCB, a = 40", dcb(40.0), [48.606, 3.0724], 1e-3),
        ("DCB, a = 60", dcb(60.0), [32.404, 6.9128], 1e-3),
        ("ENF, a = 20", enf(20.0), [449.0, 1.8985], 0.1),
        ("ENF, a = 30", enf(30.0), [299.3, 1.5290], 0.1),
        ("ENF, a = 34.67", enf(34.67), [259.0, 1.4990], 0.1),
        ("ENF, a = 50", enf(50.0), [179.6, 1.7323], 0.1),
    ] {
        let what = format!("formula of {name}, load (N)");
        within(&what, found[0], target[0], digit);
        let what = format!("formula of {name}, displacement (mm)");
        within(&what, found[1], target[1], 1e-4);
    }
}

/// Target: the load over displacement of beam theory while the crack grows from 34 to 39 mm, within 1.2 %.
#[test]
fn double_cantilever_beam() {
    let x = graded(30.0, 45.0, 80.0);
    let model = arms(&x, |x| (x > 30.0).then(|| delamination(SHEAR_STRENGTH)));
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &[Dof::Uy], |_| true).unwrap();
    hold(&model, &mut conditions, &[Dof::Ux, Dof::Uz], |x| {
        x[0] == 80.0
    })
    .unwrap();
    for (z, share) in [(-0.5 * H, -0.5), (0.5 * H, 0.5)] {
        for node in nodes_where(model.mesh(), |x| x[0] == 0.0 && x[2] == z) {
            conditions.prescribe(&model, node, Dof::Uz, share).unwrap();
        }
    }
    let path = drive(
        &model,
        conditions,
        &mut SecantAnderson::default(),
        [0.1, 2.9],
    );
    let theory = |w| beam_theory(w, 30.0, 50.0, dcb);
    compare("STR-04: DCB", &path, [2.25, 2.9], 6, theory);
    curve("DCB", path);
}

/// Target: the load over displacement of beam theory while the crack grows from
/// 41 to 46 mm, within 1.2 %.
#[test]
fn end_notched_flexure() {
    let (model, mut conditions, loaded) = notched(38.0, SHEAR_STRENGTH);
    for node in loaded {
        conditions.prescribe(&model, node, Dof::Uz, -1.0).unwrap();
    }
    // Near the snap-back the crack passes weak instabilities, one an element, which the accelerated iteration
    // follows until it falls below the curve; Newton-Raphson stays on it.
    let mut driver = NewtonRaphson::new(NewtonSettings::default());
    let path = drive(&model, conditions, &mut driver, [0.05, 1.63]);
    let theory = |w| beam_theory(w, 34.67, 60.0, enf);
    compare("STR-04: ENF", &path, [1.55, 1.63], 3, theory);
}

/// Displacement and load of every so many points of a path: some hundred.
fn thinned(points: &[[f64; 2]]) -> impl Iterator<Item = [f64; 2]> {
    let every = points.len().div_ceil(100);
    points.iter().step_by(every).map(|[load, w]| [*w, *load])
}

/// Whether the force has fallen to that of a crack of 38 mm, or of 47 mm.
fn fallen_to(path: &Path, crack: f64) -> bool {
    let force = enf(crack)[0];
    falling(path)[0][0] > force && path.points.last().is_some_and(|p| p[0] < force)
}

/// STAB-21: notches of 30 and 40 mm, 0.6 and 0.8 of the half span, under a force. The shorter one still snaps back, to
/// 1.499 mm; beyond 0.6934 of the half span the displacement only grows. Nobody tells the driver. Targets: the displacement
/// turns back at 1.499 mm, within 0.6 %, or not at all; every point once the process zone is formed lies on the curve of
/// beam theory, within 1.2 %.
#[test]
fn longer_notches_snap_back_less_or_not_at_all() {
    let short: fn(&Path) -> bool = |path| fallen_to(path, 38.0);
    let long: fn(&Path) -> bool = |path| fallen_to(path, 47.0);
    for (notch, formed, arrived) in [(30.0, 33.0, short), (40.0, 43.0, long)] {
        let (model, conditions) = under_force(notch, SHEAR_STRENGTH);
        for step in [0.05, 0.1] {
            let driver = Automatic::new(NewtonSettings::default());
            let legs: Vec<(_, Box<dyn Driver>)> = vec![(steps(step, 1e-4), Box::new(driver))];
            let path = follow((&model, conditions.clone()), legs, arrived).unwrap();
            assert!(path.stopped.is_none(), "{notch} {step}: {:?}", path.stopped);
            let falling = falling(&path);
            let on: Vec<_> = falling.iter().filter(|p| p[0] < enf(formed)[0]).collect();
            assert!(on.len() >= 2, "{notch} {step}: {on:?}");
            let setup = format!("notch of {notch} mm, steps of {step}");
            let what = format!("displacement against beam theory, relative error, {setup}");
            let mut worst = Worst::new(&what, 0.012);
            for [load, w] in on {
                let a = enf(1.0)[0] / load;
                worst.see(w / enf(a)[1] - 1.0, load);
            }
            worst.tell();
            let backwards = falling.windows(2).any(|p| p[1][1] < p[0][1] - 1e-3);
            assert_eq!(backwards, notch == 30.0, "{notch} {step}: {falling:?}");
            if notch == 30.0 {
                let what = format!("displacement turns back (mm), {setup}");
                within_share(&what, least(falling), 1.499, 6e-3);
            }
            if step == 0.05 {
                curve(&format!("ENF, {notch} mm"), thinned(&path.points));
            }
        }
    }
}

/// STAB-21: a notch of 20 mm, 0.4 of the half span, under a force. The crack grows back and on again; nobody tells the driver.
/// Targets, at three lengths of the steps: the displacement turns back at 1.499 mm, within 0.6 %; every point from 300 N down lies on the
/// curve of beam theory, within 1.2 %.
#[test]
fn end_notched_flexure_snaps_back() {
    let (model, conditions) = under_force(20.0, SHEAR_STRENGTH);
    for step in [0.05, 0.1, 0.2] {
        let driver = Automatic::new(NewtonSettings::default());
        let legs: Vec<(_, Box<dyn Driver>)> = vec![(steps(step, 1e-4), Box::new(driver))];
        let path = follow((&model, conditions.clone()), legs, turned).unwrap();
        assert!(path.stopped.is_none(), "{step}: {:?}", path.stopped);
        let falling = falling(&path);
        let id = if step == 0.05 { "STR-04: " } else { "" };
        let setup = format!("notch of 20 mm, steps of {step}");
        let what = format!("{id}displacement turns back (mm), {setup}");
        within_share(&what, least(falling), 1.499, 6e-3);
        let what = format!("displacement against beam theory, relative error, {setup}");
        let mut worst = Worst::new(&what, 0.012);
        let on: Vec<_> = falling.iter().filter(|p| p[0] < 300.0).collect();
        assert!(on.len() >= 4 && on[0][0] > 240.0, "{step}: {on:?}");
        for [load, w] in on {
            let a = enf(1.0)[0] / load;
            worst.see(w / enf(a)[1] - 1.0, load);
        }
        worst.tell();
        if step == 0.05 {
            curve("ENF, 20 mm", thinned(&path.points));
        }
    }
}

/// STAB-21: why the displacement of the notch of 20 mm turns back before the 1.8985 mm of beam theory: the cohesive zone gives way
/// before the crack grows, the earlier the lower its shear strength. Targets: 1.622, 1.738 and 1.787 mm with 20, 40 and
/// 60 MPa, within 0.5 %, which is what was measured; the distance from beam theory falls from 15 % to 6 %. (With 120 MPa the
/// turn is at 1.887 mm; elements of 1 mm are too long then for the path to be followed on.)
#[test]
fn a_stronger_interface_turns_back_nearer_to_beam_theory() {
    let mut last = f64::INFINITY;
    for (strength, target) in [(20.0, 1.622), (SHEAR_STRENGTH, 1.738), (60.0, 1.787)] {
        let (model, conditions) = under_force(20.0, strength);
        let driver = Automatic::new(NewtonSettings::default());
        let legs: Vec<(_, Box<dyn Driver>)> = vec![(steps(0.1, 1e-4), Box::new(driver))];
        let path = follow((&model, conditions), legs, turned).unwrap();
        assert!(path.stopped.is_none(), "{strength}: {:?}", path.stopped);
        let found = upper_turn(&path);
        let what = format!("displacement turns back from (mm), {strength} MPa");
        within_share(&what, found, target, 5e-3);
        let miss = 1.0 - found / enf(20.0)[1];
        assert!(miss > 0.0 && miss < 0.75 * last, "{strength}: {miss}");
        last = miss;
    }
}
