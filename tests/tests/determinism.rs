//! The same nonlinear beam solved by one and by two threads.
//!
//! Source: the promise that results do not depend on the number of threads. Target: displacements, reactions and histories
//! equal to the last bit.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_elements::HexRule;
use fe_materials::VonMises;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_solver::control::{OnFailure, StepControl};
use fe_solver::driver::Driver;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::secant::{SecantAnderson, SecantSettings};
use fe_tests::beam::bare_beam;
use fe_tests::solve::run;

/// Bits of everything that an analysis leaves; `elastic` is the load (N) per millimetre of the elastic beam, which
/// the softer one must stay well below.
fn bits<D: Driver + Send>(
    threads: usize,
    law: &Arc<dyn Material<Solid>>,
    mut driver: D,
    deflection: f64,
    elastic: f64,
) -> Vec<u64> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| {
        let beam = bare_beam([32, 3, 1], HexRule::Reduced, law).unwrap();
        let control = StepControl {
            on_failure: OnFailure::Flag,
            ..StepControl::new(deflection / 4.0, deflection)
        };
        let solution = run(
            &beam.model,
            beam.conditions,
            &control,
            &mut driver,
            |_| {},
            |_| {},
        );
        let solution = solution.unwrap();
        let load = solution.reaction(&beam.model, &beam.supports, Dof::Uy);
        assert!(load < 0.95 * elastic * deflection, "{load}");
        let all = solution.displacement.iter().chain(&solution.reactions);
        all.chain(solution.state.all_committed())
            .map(|x| x.to_bits())
            .collect()
    })
}

/// Newton-Raphson on von Mises plasticity; the beam yields.
#[test]
fn plastic_beam() {
    let law: Arc<dyn Material<Solid>> = Arc::new(VonMises::new(30_000.0, 0.2, 15.0, 20.0).unwrap());
    let run = |threads| {
        let driver = NewtonRaphson::new(NewtonSettings::default());
        bits(threads, &law, driver, 2.0, 38_062.0)
    };
    assert!(run(1) == run(2));
}

/// The secant driver on the fixed-crack law; the beam cracks.
#[test]
fn cracking_beam() {
    let concrete = FixedCrackParameters::from_strength(38.0, 2.9, 33_000.0);
    let law: Arc<dyn Material<Solid>> = Arc::new(FixedCrack::new(concrete, None).unwrap());
    let run = |threads| {
        let driver = SecantAnderson::new(SecantSettings::default());
        bits(threads, &law, driver, 0.3, 41_868.0)
    };
    assert!(run(1) == run(2));
}
