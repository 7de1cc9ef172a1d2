//! A cantilever of 6 x 1 x 1 hexahedra bent by a prescribed displacement at its tip, followed as a slow motion.
//!
//! Source: the static solution of the same model. Target: mean load of the last of twenty steps within 1 % of it, kinetic
//! energy below 1e-3 of the work, falling with the square of the rate; continued from a journal, the same to the last bit.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use fe_core::dof::Dof;
use fe_core::kinematics::{Kinematics, Solid};
use fe_core::material::{Material, MaterialError, Operator, PointContext, Response, StateVar};
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_elements::HexRule;
use fe_materials::Elastic;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::explicit::{Explicit, ExplicitSettings};
use fe_solver::journal::Entry;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::stage::Stage;
use fe_tests::journal::Journal;
use fe_tests::mesh::{boxes, hexahedra, lines, nodes_where};

/// What is looked at, step by step, with a journal.
#[derive(Default)]
struct Seen {
    kept: Vec<Entry>,
    loads: Vec<f64>,
    kinetic: Vec<Option<f64>>,
    residuals: Vec<f64>,
}

/// Elasticity whose tangent cannot be had once, the first time that anything is strained.
#[derive(Debug)]
struct FailsOnce(Elastic, AtomicBool);

impl Material<Solid> for FailsOnce {
    fn name(&self) -> &'static str {
        "fails once"
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        strain: &<Solid as Kinematics>::Vector,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        let strained = ctx.operator == Operator::Tangent && strain.amax() > 0.0;
        if strained && !self.1.swap(true, Ordering::Relaxed) {
            return Err(MaterialError::Return {
                law: "fails once",
                residual: 1.0,
                iterations: 1,
            });
        }
        self.0.update(strain, committed, trial, ctx)
    }
}

/// The whole way in twenty steps, shared by drivers that follow one another.
fn run(drivers: &mut [&mut dyn Driver], earlier: Vec<Entry>) -> Seen {
    let law: Arc<dyn Material<Solid>> = Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
    run_with(&law, 0.05, drivers, earlier)
}

/// The same with a law and a first step.
fn run_with(
    law: &Arc<dyn Material<Solid>>,
    step: f64,
    drivers: &mut [&mut dyn Driver],
    earlier: Vec<Entry>,
) -> Seen {
    let across = lines(0.0, 20.0, 1);
    let mesh = boxes(&lines(0.0, 120.0, 6), &across, &across).unwrap();
    let elements = hexahedra(&mesh, HexRule::Full, law).unwrap();
    let root = nodes_where(&mesh, |x| x[0] == 0.0);
    let tip = nodes_where(&mesh, |x| x[0] == 120.0 && x[1] == 20.0);
    let model = Model::new(mesh, elements).unwrap();
    let mut conditions = Conditions::new(&model);
    for node in root {
        for dof in Dof::DISPLACEMENTS {
            conditions.fix(&model, node, dof).unwrap();
        }
    }
    for node in tip {
        conditions.prescribe(&model, node, Dof::Uy, -1.0).unwrap();
    }
    let mut state = StateStore::new(model.elements());
    let zero = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, zero).unwrap();
    let mut seen = Seen::default();
    let mut journal = Journal::after(earlier, |view| {
        seen.loads.push(view.load);
        seen.kinetic.push(view.kinetic);
        seen.residuals.push(view.residual);
    });
    let control = StepControl::new(step, 1.0 / drivers.len() as f64);
    for driver in drivers {
        control.run(&mut stage, *driver, &mut journal).unwrap();
    }
    seen.kept = journal.kept;
    seen
}

fn moving(periods: f64) -> Explicit {
    Explicit::new(ExplicitSettings {
        periods,
        ..ExplicitSettings::default()
    })
    .unwrap()
}

fn newton() -> NewtonRaphson {
    NewtonRaphson::new(NewtonSettings::default())
}

#[test]
fn a_slow_motion_meets_the_static_path_and_says_how_far_it_is_from_it() {
    let exact = run(&mut [&mut newton()], Vec::new());
    assert!(exact.kinetic.iter().all(Option::is_none));
    let [slow, fast] = [20.0, 10.0].map(|periods| run(&mut [&mut moving(periods)], Vec::new()));
    // A mean over a step belongs to its middle.
    let middle = 0.5 * (exact.loads[18] + exact.loads[19]);
    let error = slow.loads[19] / middle - 1.0;
    assert!(error.abs() < 0.01, "{error}");
    let [a, b] = [&slow, &fast].map(|seen| seen.kinetic[19].unwrap());
    assert!(a < 1e-3 && (2.0..8.0).contains(&(b / a)), "{a} {b}");
    assert!(slow.residuals[19] > 1e-6, "unbalanced forces are told");
}

/// A motion takes over where statics have led, at rest, and arrives where they would.
#[test]
fn a_motion_begins_at_an_accepted_state() {
    let exact = run(&mut [&mut newton()], Vec::new());
    let seen = run(&mut [&mut newton(), &mut moving(20.0)], Vec::new());
    assert_eq!(seen.loads[..10], exact.loads[..10]);
    let middle = 0.5 * (exact.loads[18] + exact.loads[19]);
    let error = seen.loads[19] / middle - 1.0;
    assert!(error.abs() < 0.01, "{error}");
}

/// The motion of a step that is given up, here since its stability cannot be told, has not happened: what follows is the
/// motion in steps of half the length from the start.
#[test]
fn a_step_that_is_given_up_does_not_move_anything() {
    let elastic = || Elastic::new(30_000.0, 0.2).unwrap();
    let fails: Arc<dyn Material<Solid>> = Arc::new(FailsOnce(elastic(), AtomicBool::new(false)));
    let holds: Arc<dyn Material<Solid>> = Arc::new(elastic());
    let [given_up, at_once] = [(&fails, 0.05), (&holds, 0.025)]
        .map(|(law, step)| run_with(law, step, &mut [&mut moving(10.0)], Vec::new()));
    assert_eq!(
        (given_up.kept[0].attempts, at_once.kept[0].attempts),
        (2, 1)
    );
    assert_eq!(given_up.loads, at_once.loads);
    assert_eq!(given_up.residuals, at_once.residuals);
}

#[test]
fn a_motion_is_continued_to_the_last_bit() {
    let whole = run(&mut [&mut moving(10.0)], Vec::new());
    let first = whole.kept[..7].to_vec();
    let again = run(&mut [&mut moving(10.0)], first);
    assert_eq!(again.kept.len(), whole.kept.len() - 7);
    assert_eq!(again.loads, whole.loads);
    assert_eq!(again.kept, whole.kept[7..]);
}
