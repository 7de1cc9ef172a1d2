//! STAB-19: a block of non-associated plasticity: the tangent is unsymmetric, and iterations converge quadratically with it.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_elements::HexRule;
use fe_materials::concrete::{ConcreteScalars, Isochoric};
use fe_solver::automatic::Automatic;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use nalgebra::Vector3;

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

/// Least order of convergence of the last three residuals of the steps that took four iterations or more.
fn order(driver: &mut dyn Driver, step: f64) -> Result<f64, Failure> {
    let (model, conditions) = block()?;
    let control = StepControl {
        criterion: 1e-10,
        ..StepControl::new(step, 4.0 * step)
    };
    let mut steps: Vec<Vec<f64>> = Vec::new();
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
        |_| {},
    )?;
    let order = |r: &Vec<f64>| {
        let n = r.len();
        let [a, b, c] = [r[n - 3], r[n - 2], r[n - 1]].map(f64::ln);
        (c - b) / (b - a)
    };
    // Below, rounding.
    for residuals in &mut steps {
        residuals.retain(|r| *r > 1e-12);
    }
    let long = steps.iter().filter(|r| r.len() >= 4);
    Ok(long.map(order).fold(f64::INFINITY, f64::min))
}

fn case(method: Method) -> Option<Result<Case, Failure>> {
    let settings = NewtonSettings::default();
    let (mut driver, step): (Box<dyn Driver>, _) = match method {
        Method::Automatic => (Box::new(Automatic::new(settings)), 0.05),
        Method::Load => (Box::new(NewtonRaphson::new(settings)), 0.25),
        _ => return None,
    };
    let found = order(driver.as_mut(), step);
    Some(found.map(|order| {
        let bounded = if order.is_finite() { order } else { 0.0 };
        Case::checked(vec![Figure::at_least("order of convergence", bounded, 1.8)])
    }))
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-19",
    title: "unsymmetric tangent of non-associated plasticity: quadratic convergence",
    coarse: &[],
    run: |method, _| case(method),
};
