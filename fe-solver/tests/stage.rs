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
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::path::{Energies, FreeDisplacement, Opening};
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

/// Energies are weighed of an evaluation, and only of one that has not failed.
#[test]
fn forces_are_to_be_evaluated_before_they_are_weighed() {
    let (model, conditions) = cube();
    let mut state = StateStore::new(model.elements());
    let rest = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, rest.clone()).unwrap();
    let refuses = |stage: &mut Stage<'_>| {
        let weighed = stage.weigh(&rest, 0.0);
        assert!(
            matches!(weighed, Err(SolverError::NotEvaluated)),
            "{weighed:?}"
        );
    };
    let force = EvaluationContext::new(Operator::None);
    refuses(&mut stage);
    assert!(
        stage
            .residual(&vec![f64::NAN; rest.len()], 0.0, &force)
            .is_err()
    );
    refuses(&mut stage);
    stage.residual(&rest, 0.0, &force).unwrap();
    stage.weigh(&rest, 0.0).unwrap();
}

/// A load factor or a force that is no number is told, and so is a DOF that is not there.
#[test]
fn what_is_no_number_is_refused() {
    let (model, conditions) = cube();
    let mut state = StateStore::new(model.elements());
    let rest = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, rest.clone()).unwrap();
    let tangent = EvaluationContext::new(Operator::Tangent);
    for lambda in [f64::NAN, f64::INFINITY] {
        let refused = stage.residual(&rest, lambda, &tangent);
        assert!(
            matches!(refused, Err(SolverError::NoNumber { .. })),
            "{refused:?}"
        );
    }
    stage.residual(&rest, 0.0, &tangent).unwrap();
    stage.factorise().unwrap();
    let mut forces = stage.reference_load();
    forces[2] = f64::NAN;
    let refused = stage.solve(&mut forces);
    assert!(
        matches!(refused, Err(SolverError::NoNumber { .. })),
        "{refused:?}"
    );
    assert!(stage.describe(9999).contains("DOF 9999"));
    let short = Energies::to(&stage, &rest[1..], 1.0);
    assert!(
        matches!(short, Err(SolverError::Mismatch { .. })),
        "{short:?}"
    );
}

/// A displacement that the load makes fall is controlled in reverse: the load factor grows. Otherwise it falls.
#[test]
fn a_falling_displacement_is_controlled_in_reverse() {
    let (model, mut conditions) = cube();
    conditions.add_reference(&model, 10, Dof::Uy, -1.0).unwrap();
    let reached = |reversed: bool| {
        let mut state = StateStore::new(model.elements());
        let rest = vec![0.0; model.dofs().len()];
        let mut stage = Stage::new(&model, conditions.clone(), &mut state, rest).unwrap();
        let own = FreeDisplacement::of(&stage, 10, Dof::Uy).unwrap();
        let own = if reversed { own.reversed() } else { own };
        let mut newton = NewtonRaphson::with_constraint(NewtonSettings::default(), Box::new(own));
        let control = StepControl::new(1e-5, 1e-5);
        control.run(&mut stage, &mut newton, &mut Silent).unwrap();
        let moved = model.dof(10, Dof::Uy).unwrap();
        (stage.lambda(), stage.displacement()[moved])
    };
    let ((falling, down), (growing, up)) = (reached(true), reached(false));
    assert!((down + 1e-5).abs() < 1e-15 && (up - 1e-5).abs() < 1e-15);
    assert!(falling > 0.0 && (falling + growing).abs() < 1e-9 * falling);
}

/// Constraints of DOFs that are not free, or of one DOF twice, are refused.
#[test]
fn constraints_are_on_free_dofs() {
    let (model, conditions) = cube();
    let mut state = StateStore::new(model.elements());
    let rest = vec![0.0; model.dofs().len()];
    let stage = Stage::new(&model, conditions, &mut state, rest).unwrap();
    let [held, free] = [(0, Dof::Ux), (10, Dof::Ux)];
    for refused in [
        FreeDisplacement::of(&stage, held.0, held.1).err(),
        Opening::between(&stage, [held, free]).err(),
        Opening::between(&stage, [free, free]).err(),
    ] {
        assert!(
            matches!(refused, Some(SolverError::Setting { .. })),
            "{refused:?}"
        );
    }
    let nowhere = FreeDisplacement::of(&stage, 99, Dof::Ux);
    assert!(matches!(nowhere, Err(SolverError::Model(_))), "{nowhere:?}");
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
