//! STAB-19: a block of non-associated plasticity: the tangent is unsymmetric, and iterations converge quadratically with it.

use std::sync::Arc;

use fe_core::assembly::{Assembled, Assembler};
use fe_core::dof::Dof;
use fe_core::element::EvaluationContext;
use fe_core::kinematics::Solid;
use fe_core::material::{Material, Operator};
use fe_core::model::{Conditions, Model};
use fe_core::sparsity::{MatrixValues, Sparsity};
use fe_core::state::StateStore;
use fe_elements::HexRule;
use fe_materials::concrete::{ConcreteScalars, Isochoric};
use fe_solver::automatic::Automatic;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use nalgebra::{DMatrix, Vector3};

use crate::conditions::{hold, push_faces};
use crate::mesh::{boxes, hexahedra, lines};
use crate::solve::run;
use crate::stability::{Case, Failure, Figure, Method, Scenario};

/// A block of 4 x 2 x 1 cells of 50 mm, pressed on its end and sheared; load factor 1 is 0.6 of the strength.
fn block() -> Result<(Model, Conditions), Failure> {
    let concrete = ConcreteScalars::from_characteristic(30.0)?;
    let law: Arc<dyn Material<Solid>> = Arc::new(Isochoric::new(&concrete)?);
    let [x, y, z] = [(200.0, 4), (100.0, 2), (50.0, 1)].map(|(end, n)| lines(0.0, end, n));
    let mesh = boxes(&x, &y, &z)?;
    let elements = hexahedra(&mesh, HexRule::Full, &law)?;
    let model = Model::new(mesh, elements)?;
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &Dof::DISPLACEMENTS, |x| {
        x[0] == 0.0
    })?;
    let traction = 0.6 * concrete.fcm_mpa * Vector3::new(-1.0, 0.05, 0.0);
    push_faces(&model, &mut conditions, |x| x[0] == 200.0, |_| traction)?;
    Ok((model, conditions))
}

/// How unsymmetric a tangent is: |K - K^T|/|K|, in Frobenius norms.
fn unsymmetry(pattern: &Sparsity, tangent: &MatrixValues) -> f64 {
    let n = pattern.len();
    let mut dense = DMatrix::zeros(n, n);
    for (&value, (i, j)) in &tangent.to_csc(pattern) {
        dense[(i, j)] = value;
    }
    (&dense - dense.transpose()).norm() / dense.norm()
}

/// What the steps of a driver were like.
#[derive(Debug, Clone, Copy)]
struct Found {
    /// Least order of convergence at the end of the steps that took four iterations or more.
    order: f64,
    /// Largest [`unsymmetry`] of the tangent at the end of a step.
    unsymmetry: f64,
}

fn find(driver: &mut dyn Driver, step: f64) -> Result<Found, Failure> {
    let (model, conditions) = block()?;
    let control = StepControl {
        criterion: 1e-10,
        ..StepControl::new(step, 4.0 * step)
    };
    let mut steps: Vec<Vec<f64>> = Vec::new();
    let mut assembler = Assembler::new(&model, &conditions)?;
    let mut before = StateStore::new(model.elements());
    let mut out = Assembled::default();
    let mut largest = 0.0_f64;
    let mut failed = None;
    run(
        &model,
        conditions,
        &control,
        driver,
        |record| {
            if steps.len() < record.step {
                steps.push(Vec::new());
            }
            if let Some(step) = steps.last_mut() {
                step.push(record.residual);
            }
        },
        |view| {
            let (u, ctx) = (
                view.stage.displacement(),
                EvaluationContext::new(Operator::Tangent),
            );
            match assembler.evaluate(&model, u, &mut before, &ctx, &mut out) {
                Ok(()) => largest = largest.max(unsymmetry(assembler.pattern(), &out.matrix)),
                Err(error) => failed = Some(error),
            }
            before = view.stage.state().clone();
        },
    )?;
    if let Some(error) = failed {
        return Err(error.into());
    }
    // The last residual may be rounding, then it is the one before that tells.
    let order = |r: &Vec<f64>| {
        let order = |r: &[f64]| (r[2] / r[1]).ln() / (r[1] / r[0]).ln();
        let last = r[r.len() - 4..].windows(3);
        last.map(order).fold(f64::NEG_INFINITY, f64::max)
    };
    let long = steps.iter().filter(|r| r.len() >= 4);
    Ok(Found {
        order: long.map(order).fold(f64::INFINITY, f64::min),
        unsymmetry: largest,
    })
}

fn case(method: Method) -> Option<Result<Case, Failure>> {
    let settings = NewtonSettings::default();
    let (mut driver, step): (Box<dyn Driver>, _) = match method {
        Method::Automatic => (Box::new(Automatic::new(settings)), 0.05),
        Method::Load => (Box::new(NewtonRaphson::new(settings)), 0.25),
        _ => return None,
    };
    Some(find(driver.as_mut(), step).map(|found| {
        let order = if found.order.is_finite() {
            found.order
        } else {
            0.0
        };
        let name = "norm of K - K^T over that of K";
        let unsymmetry = Figure::at_least(name, found.unsymmetry, 0.15);
        Case::checked(vec![
            Figure::at_least("order of convergence", order, 1.8),
            unsymmetry.measured("to be reported"),
        ])
    }))
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-19",
    title: "unsymmetric tangent of non-associated plasticity: quadratic convergence",
    remark: "The automatic driver controls the loaded displacement, in four steps of 0.05 mm, up to a load factor of 1.25; \
             Newton-Raphson controls the load, in four steps of a quarter, up to 1. They cannot take the same steps, and the two rows \
             do not compare the methods.",
    coarse: &[],
    run: |method, _| case(method),
};
