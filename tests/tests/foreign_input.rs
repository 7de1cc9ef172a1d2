//! Protects users of the solver from input that does not fit: one error that names it, no panic and no endless run.

use fe_core::dof::Dof;
use fe_core::element::EvaluationContext;
use fe_core::kinematics::{Kinematics, Solid};
use fe_core::material::{Material, MaterialError, Operator, PointContext, Response, StateVar};
use fe_core::model::{Conditions, Model, ModelError};
use fe_core::state::StateStore;
use fe_elements::HexRule;
use fe_materials::Elastic;
use fe_solver::automatic::Automatic;
use fe_solver::control::StepControl;
use fe_solver::driver::{Driver, Means};
use fe_solver::error::SolverError;
use fe_solver::explicit::{Explicit, ExplicitSettings};
use fe_solver::implex::Implex;
use fe_solver::journal::Entry;
use fe_solver::newton::{NewtonRaphson, NewtonSettings, Refactor};
use fe_solver::path::{ArcLength, Dissipation, FreeDisplacement, Mode, PathConstraint};
use fe_solver::recorder::Silent;
use fe_solver::secant::SecantAnderson;
use fe_solver::stage::Stage;
use fe_solver::viscous::Viscous;
use fe_tests::conditions::hold;
use fe_tests::journal::Journal;
use fe_tests::mesh::{boxes, hexahedra, lines, nodes_where};
use std::sync::Arc;

/// A row of cubes, held on the left.
fn held(cubes: usize, law: &Arc<dyn Material<Solid>>) -> (Model, Conditions) {
    let (end, side) = (cubes as f64, [0.0, 1.0]);
    let mesh = boxes(&lines(0.0, end, cubes), &side, &side).unwrap();
    let elements = hexahedra(&mesh, HexRule::Full, law).unwrap();
    let model = Model::new(mesh, elements).unwrap();
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &Dof::DISPLACEMENTS, |x| {
        x[0] == 0.0
    })
    .unwrap();
    (model, conditions)
}

/// A row of cubes, held on the left and pulled on the right.
fn row(cubes: usize) -> (Model, Conditions) {
    let law: Arc<dyn Material<_>> = Arc::new(Elastic::new(100.0, 0.0).unwrap());
    let (model, mut conditions) = held(cubes, &law);
    let end = cubes as f64;
    for node in nodes_where(model.mesh(), |x| x == [end, 0.0, 0.0]) {
        conditions
            .add_reference(&model, node, Dof::Ux, 1.0)
            .unwrap();
    }
    (model, conditions)
}

#[test]
fn what_belongs_to_another_model_is_refused() {
    let ((model, conditions), (other, foreign)) = (row(1), row(2));
    let zero = |model: &Model| vec![0.0; model.dofs().len()];
    let mut state = StateStore::new(model.elements());
    for (conditions, start, wrong) in [
        (conditions.clone(), zero(&other), "displacement"),
        (conditions.clone(), Vec::new(), "displacement"),
        (foreign, zero(&model), "conditions"),
    ] {
        let refused = Stage::new(&model, conditions, &mut state, start).err();
        assert!(
            matches!(refused, Some(SolverError::Mismatch { what, .. }) if what == wrong),
            "{wrong}: {refused:?}"
        );
    }
}

/// Before the first evaluation there are no forces; an evaluation of another model is none.
#[test]
fn a_stage_answers_before_anything_is_evaluated() {
    let (model, conditions) = row(1);
    let mut state = StateStore::new(model.elements());
    let zero = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, zero).unwrap();
    let free = stage.assembler().free().len();
    assert_eq!((stage.reaction(0), stage.load()), (0.0, 0.0));
    assert_eq!(stage.measure(&vec![0.0; free]).relative, 0.0);
    assert_eq!(stage.reference_load().iter().sum::<f64>(), 1.0);
    let refused = stage.residual(&[0.0], 0.0, &EvaluationContext::new(Operator::None));
    assert!(matches!(refused, Err(SolverError::Mismatch { .. })));
}

/// What a [`Broken`] law gives instead of a number beyond a strain of 1e-2.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Nan {
    Stress,
    Operator,
}

/// Elasticity that ends in no number.
#[derive(Debug)]
struct Broken(Elastic, Nan);

impl Material<Solid> for Broken {
    fn name(&self) -> &'static str {
        "broken"
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
        let mut response: Response<Solid> = self.0.update(strain, committed, trial, ctx)?;
        if strain[0] > 1e-2 {
            match self.1 {
                Nan::Stress => response.stress.fill(f64::NAN),
                Nan::Operator => response.tangent.fill(f64::NAN),
            }
        }
        Ok(response)
    }
}

/// Every driver ends with an error before the strain at which the law breaks, and names the place.
#[test]
fn a_law_that_gives_no_number_ends_a_run() {
    let newton = NewtonSettings::default();
    for nan in [Nan::Stress, Nan::Operator] {
        let drivers: [Box<dyn Driver>; 6] = [
            Box::new(NewtonRaphson::new(newton)),
            Box::new(SecantAnderson::default()),
            Box::new(Automatic::new(newton)),
            Box::new(Viscous::new(1e-3, newton).unwrap()),
            Box::new(Implex),
            Box::new(Explicit::default()),
        ];
        for mut driver in drivers {
            let law: Arc<dyn Material<_>> =
                Arc::new(Broken(Elastic::new(100.0, 0.0).unwrap(), nan));
            let (model, mut conditions) = held(2, &law);
            for node in nodes_where(model.mesh(), |x| x[0] == 2.0) {
                conditions.prescribe(&model, node, Dof::Ux, 1.0).unwrap();
            }
            let mut state = StateStore::new(model.elements());
            let zero = vec![0.0; model.dofs().len()];
            let mut stage = Stage::new(&model, conditions, &mut state, zero).unwrap();
            let control = StepControl::new(0.003, 0.1);
            let end = control.run(&mut stage, driver.as_mut(), &mut Silent);
            let message = end.unwrap_err().to_string();
            assert!(message.contains("node "), "{}: {message}", driver.name());
            assert!(stage.lambda() < 0.025, "{}", stage.lambda());
        }
    }
}

/// Journals of another model or spoilt ones are refused, whatever is wrong; under forces too, of which no reaction is the load.
#[test]
fn a_spoilt_journal_is_refused() {
    let (model, conditions) = row(1);
    let stiffer: Arc<dyn Material<_>> = Arc::new(Elastic::new(101.0, 0.0).unwrap());
    let (stiffer, _) = held(1, &stiffer);
    let on = |model: &Model, earlier: Option<Entry>| {
        let mut state = StateStore::new(model.elements());
        let zero = vec![0.0; model.dofs().len()];
        let mut stage = Stage::new(model, conditions.clone(), &mut state, zero).unwrap();
        let mut driver = NewtonRaphson::new(NewtonSettings::default());
        let mut journal = Journal::after(earlier, |_| {});
        let end = StepControl::new(1.0, 1.0).run(&mut stage, &mut driver, &mut journal);
        (end, journal.kept.pop())
    };
    let run = |earlier| on(&model, earlier);
    let entry = run(None).1.unwrap();
    assert!(run(Some(entry.clone())).0.is_ok());
    let foreign = on(&stiffer, Some(entry.clone())).0;
    assert!(matches!(foreign, Err(SolverError::Journal { .. })));
    let spoilt: [fn(&mut Entry); 5] = [
        |e| e.attempt.lambda = 0.5,
        |e| e.taken = f64::NAN,
        |e| e.length = -1.0,
        |e| {
            e.attempt.displacement.pop();
        },
        |e| {
            e.attempt.means = Some(Means {
                internal: vec![0.0],
                kinetic: 0.0,
            });
        },
    ];
    for (i, spoil) in spoilt.iter().enumerate() {
        let mut entry = entry.clone();
        spoil(&mut entry);
        let end = run(Some(entry)).0;
        assert!(
            matches!(
                end,
                Err(SolverError::Journal { .. } | SolverError::Mismatch { .. })
            ),
            "{i}: {end:?}"
        );
    }
}

#[test]
fn conditions_of_another_model_take_nothing() {
    let ((model, mut conditions), (other, _)) = (row(1), row(2));
    let last = other.mesh().nodes().len() - 1;
    for refused in [
        conditions.add_reference(&other, last, Dof::Ux, 1.0),
        conditions.add_dead(&other, last, Dof::Ux, 1.0),
        conditions.prescribe(&other, last, Dof::Ux, 1.0),
    ] {
        assert!(
            matches!(refused, Err(ModelError::ForeignConditions { .. })),
            "{refused:?}"
        );
    }
    conditions.add_reference(&model, 0, Dof::Ux, 1.0).unwrap();
}

#[test]
fn a_path_that_is_not_of_the_stage_is_refused() {
    let (model, conditions) = row(1);
    let run = |settings: NewtonSettings, constraint: Box<dyn PathConstraint>| {
        let mut state = StateStore::new(model.elements());
        let start = vec![0.0; model.dofs().len()];
        let mut stage = Stage::new(&model, conditions.clone(), &mut state, start).unwrap();
        let mut driver = NewtonRaphson::with_constraint(settings, constraint);
        let control = StepControl::new(0.5, 1.0);
        control.run(&mut stage, &mut driver, &mut Silent)
    };
    let settings = NewtonSettings::default();
    let far = run(settings, Box::new(FreeDisplacement::new(99_999)));
    assert!(matches!(far, Err(SolverError::Setting { .. })), "{far:?}");
    let short = run(settings, Box::new(Mode::new(vec![1.0]).unwrap()));
    assert!(
        matches!(short, Err(SolverError::Mismatch { what: "mode", .. })),
        "{short:?}"
    );
    let blind = NewtonSettings {
        operator: Operator::None,
        ..settings
    };
    let blind = run(blind, Box::new(FreeDisplacement::new(0)));
    assert!(
        matches!(blind, Err(SolverError::Setting { .. })),
        "{blind:?}"
    );
}

#[test]
fn a_path_that_no_setting_can_follow_is_refused() {
    let (model, conditions) = row(1);
    let rest = NewtonSettings::default();
    let drivers = [
        NewtonRaphson::with_constraint(rest, Box::new(ArcLength::spherical(f64::NAN))),
        NewtonRaphson::with_constraint(rest, Box::new(Dissipation::default())),
        NewtonRaphson::new(NewtonSettings {
            max_iterations: 0,
            ..rest
        }),
        NewtonRaphson::new(NewtonSettings {
            refactor: Refactor::Below(f64::NAN),
            ..rest
        }),
    ];
    for mut driver in drivers {
        let mut state = StateStore::new(model.elements());
        let zero = vec![0.0; model.dofs().len()];
        let mut stage = Stage::new(&model, conditions.clone(), &mut state, zero).unwrap();
        let control = StepControl::new(0.1, 1.0);
        let refused = control.run(&mut stage, &mut driver, &mut Silent).err();
        assert!(
            matches!(refused, Some(SolverError::Setting { .. })),
            "{refused:?}"
        );
    }
}

#[test]
fn a_motion_that_would_not_end_or_blow_up_is_refused() {
    let good = ExplicitSettings::default();
    assert!(Explicit::new(good).is_ok());
    for (wrong, settings) in [
        (
            "periods",
            ExplicitSettings {
                periods: f64::NAN,
                ..good
            },
        ),
        (
            "periods",
            ExplicitSettings {
                periods: 1e18,
                ..good
            },
        ),
        (
            "time_step",
            ExplicitSettings {
                time_step: 1e-18,
                ..good
            },
        ),
        (
            "damping",
            ExplicitSettings {
                damping: -0.1,
                ..good
            },
        ),
        (
            "time_step",
            ExplicitSettings {
                time_step: -1.0,
                ..good
            },
        ),
        (
            "time_step",
            ExplicitSettings {
                time_step: 2.5,
                ..good
            },
        ),
        ("ramp", ExplicitSettings { ramp: 0.0, ..good }),
    ] {
        let refused = Explicit::new(settings).err();
        assert!(
            matches!(refused, Some(SolverError::Setting { what, .. }) if what == wrong),
            "{wrong}: {refused:?}"
        );
    }
}
