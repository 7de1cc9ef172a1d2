//! Time of one whole iteration on the cracked bare beam, 60 x 4 x 1 hexahedra with 8 points: laws, elements, assembly,
//! factorisation, solution and the force evaluation that follows; one thread.

use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use fe_core::element::EvaluationContext;
use fe_core::kinematics::Solid;
use fe_core::material::{Material, Operator};
use fe_elements::HexRule;
use fe_materials::VonMises;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_solver::stage::Stage;
use fe_tests::beam::bare_beam;

fn newton(c: &mut Criterion) {
    let concrete = FixedCrackParameters::from_strength(38.0, 2.9, 33_000.0);
    let concrete = Arc::new(FixedCrack::new(concrete, None).expect("a law"));
    let metal = Arc::new(VonMises::new(30_000.0, 0.2, 15.0, 20.0).expect("a law"));
    let laws: [(&str, Arc<dyn Material<Solid>>, f64); 2] =
        [("concrete", concrete, 0.3), ("metal", metal, 2.0)];
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    let mut group = c.benchmark_group("iteration");
    for (name, law, deflection) in laws {
        let beam = bare_beam([60, 4, 1], HexRule::Reduced, &law).expect("a beam");
        let mut reached = beam.bent(deflection).expect("a path");
        let (u, state) = (reached.displacement, &mut reached.state);
        let mut stage =
            Stage::new(&beam.model, beam.conditions, state, u.clone()).expect("a stage");
        for (what, operator) in [("tangent", Operator::Tangent), ("secant", Operator::Secant)] {
            let [matrix, force] = [operator, Operator::None].map(EvaluationContext::new);
            group.bench_function(format!("{name}, {what} rebuilt"), |b| {
                one.install(|| {
                    b.iter(|| {
                        let mut residual = stage.residual(&u, 0.0, &matrix)?;
                        stage.factorise()?;
                        stage.solve(&mut residual)?;
                        stage.residual(&u, 0.0, &force)
                    });
                });
            });
        }
        let force = EvaluationContext::new(Operator::None);
        group.bench_function(format!("{name}, operator kept"), |b| {
            one.install(|| {
                b.iter(|| {
                    let mut residual = stage.residual(&u, 0.0, &force)?;
                    stage.solve(&mut residual).map(|()| residual)
                });
            });
        });
    }
    group.finish();
}

criterion_group!(benches, newton);
criterion_main!(benches);
