//! Bare beam of von Mises material: E = 30 000 MPa, nu = 0.2, sy = 15 MPa, plastic modulus 20 MPa, 60 x 4 x 1 cells with
//! 8 points, deflection of 10 mm in 50 increments.
//!
//! Source: the same model solved with CalculiX 2.20 (69 929.08 N) and FElupe 11.3 (69 929.1 N). The 20 MPa are the
//! plastic modulus dq/dkappa: read as the slope in total strain they give 69 929.51 N.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::testing::{Worst, within};
use fe_elements::HexRule;
use fe_materials::VonMises;
use fe_solver::control::StepControl;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_tests::beam::bare_beam;
use fe_tests::solve::run;

/// Protects stress return, consistent tangent and full Newton-Raphson together. Targets: 69 929.08 N within 0.1 N; every
/// increment in one attempt; the last two iterations of an increment, where no point changes between elastic and
/// plastic any more, bring a relative residual r below 20 r^2, down to rounding.
#[test]
fn load_at_ten_millimetres_with_quadratic_convergence() {
    let law: Arc<dyn Material<Solid>> = Arc::new(VonMises::new(30_000.0, 0.2, 15.0, 20.0).unwrap());
    let beam = bare_beam([60, 4, 1], HexRule::Reduced, &law).unwrap();
    let control = StepControl {
        criterion: 1e-8,
        ..StepControl::new(0.2, 10.0)
    };
    let mut newton = NewtonRaphson::new(NewtonSettings::default());
    let mut residuals = vec![Vec::new(); 50];
    let solution = run(
        &beam.model,
        beam.conditions,
        &control,
        &mut newton,
        |record| residuals[record.step - 1].push(record.residual),
        |view| assert_eq!(view.attempts, 1, "step {}", view.step),
    );
    let load = solution
        .unwrap()
        .reaction(&beam.model, &beam.supports, Dof::Uy);
    within("load at 10 mm (N)", load, 69_929.08, 0.1);
    let mut worst = Worst::new("residual over max(20 r^2, 1e-11) of the one before", 1.0);
    let mut seen = 0;
    for history in &residuals {
        for pair in history.windows(2).rev().take(2) {
            let bound = 20.0 * pair[0] * pair[0];
            worst.see(pair[1] / bound.max(1e-11), history);
            seen += 1;
        }
    }
    worst.tell();
    assert!(seen > 50, "too few iterations to judge: {seen}");
}
