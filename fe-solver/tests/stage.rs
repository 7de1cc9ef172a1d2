//! Protects what a stage says when it is asked in the wrong order, or of another model.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::EvaluationContext;
use fe_core::grid::GridBuilder;
use fe_core::material::Operator;
use fe_core::model::{Conditions, Model};
use fe_core::shape::hex20;
use fe_core::state::StateStore;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::Elastic;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::implex::Implex;
use fe_solver::linear::LinearError;
use fe_solver::recorder::Silent;
use fe_solver::secant::SecantAnderson;
use fe_solver::stage::Stage;

/// An elastic cube of 2 mm, held at its first eight nodes.
fn cube() -> (Model, Conditions) {
    let mut grid = GridBuilder::new();
    grid.add_box("cube", &[0.0, 2.0], &[0.0, 2.0], &[0.0, 2.0]);
    let mesh = grid.finish().unwrap();
    let law = Arc::new(Elastic::new(30e3, 0.2).unwrap());
    let nodes = std::array::from_fn(|a| a);
    let (rule, band) = (HexRule::Full, BandWidth::CubeRoot);
    let cube = Hex20::new(nodes, &hex20::NODES, rule, law, band).unwrap();
    let model = Model::new(mesh, vec![Box::new(cube)]).unwrap();
    let mut conditions = Conditions::new(&model);
    for node in 0..8 {
        for dof in Dof::DISPLACEMENTS {
            conditions.fix(&model, node, dof).unwrap();
        }
    }
    (model, conditions)
}

/// Without a stiffness there is nothing to factorise: before any evaluation, after one of forces alone, and after one that
/// failed on the way.
#[test]
fn a_stiffness_is_to_be_evaluated_before_it_is_factorised() {
    let (model, conditions) = cube();
    let mut state = StateStore::new(model.elements());
    let rest = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, rest.clone()).unwrap();
    let refuses = |stage: &mut Stage<'_>| {
        for refused in [stage.factorise(), stage.renew()] {
            assert!(
                matches!(refused, Err(SolverError::NotEvaluated)),
                "{refused:?}"
            );
        }
    };
    let [force, tangent] = [Operator::None, Operator::Tangent].map(EvaluationContext::new);
    refuses(&mut stage);
    let mut rhs = stage.reference_load();
    assert!(matches!(
        stage.solve(&mut rhs),
        Err(SolverError::Linear(LinearError::NotFactorized))
    ));
    stage.residual(&rest, 0.0, &force).unwrap();
    refuses(&mut stage);
    stage.residual(&rest, 0.0, &tangent).unwrap();
    stage.factorise().unwrap();
    let bad = vec![f64::NAN; rest.len()];
    assert!(stage.residual(&bad, 0.0, &tangent).is_err());
    refuses(&mut stage);
    stage.residual(&rest, 0.0, &tangent).unwrap();
    stage.renew().unwrap();
    stage.solve(&mut rhs).unwrap();
}

/// An accepted step at an unchanged load factor, as that of a start recorded by hand, is nothing to extrapolate from: drivers that
/// predict along the last step solve as in a first one.
#[test]
fn a_step_that_leaves_the_load_factor_alone_is_not_extrapolated() {
    let (model, mut conditions) = cube();
    for node in 8..20 {
        conditions
            .add_reference(&model, node, Dof::Ux, 1.0)
            .unwrap();
    }
    let drivers: [Box<dyn Driver>; 2] = [Box::<SecantAnderson>::default(), Box::new(Implex)];
    for mut driver in drivers {
        let mut state = StateStore::new(model.elements());
        let rest = vec![0.0; model.dofs().len()];
        let mut stage = Stage::new(&model, conditions.clone(), &mut state, rest.clone()).unwrap();
        let force = EvaluationContext::new(Operator::None);
        stage.residual(&rest, 0.0, &force).unwrap();
        stage.weigh(&rest, 0.0).unwrap();
        stage.commit(rest, 0.0, false, None).unwrap();
        let control = StepControl::new(0.5, 1.0);
        let end = control.run(&mut stage, driver.as_mut(), &mut Silent);
        assert!(end.is_ok(), "{}: {end:?}", driver.name());
        assert_eq!(stage.counters().cutbacks, 0);
    }
}

/// Displacements of another model are not accepted.
#[test]
fn what_is_accepted_has_as_many_displacements_as_the_model() {
    let (model, conditions) = cube();
    let mut state = StateStore::new(model.elements());
    let rest = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, rest.clone()).unwrap();
    for n in [0, rest.len() - 1, rest.len() + 1] {
        let refused = stage.commit(vec![0.0; n], 1.0, false, None);
        assert!(matches!(refused, Err(SolverError::Mismatch { .. })));
        assert!(stage.work_conjugate_load(&vec![0.0; n], 1.0).is_finite());
    }
    assert_eq!((stage.lambda(), stage.displacement()), (0.0, &rest[..]));
}
