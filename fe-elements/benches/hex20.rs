//! Time of one 20-node hexahedron with a law whose 6 x 6 tangent is a constant: what the element itself costs.

mod common;

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use fe_core::element::{Element, ElementSystem, EvaluationContext};
use fe_core::material::Operator;
use fe_core::shape::hex20::NODES;
use fe_elements::{BandWidth, Hex20, HexRule};

use common::Linear;

/// A distorted cell of 50 mm.
fn element(rule: HexRule, unsymmetric: bool) -> Hex20 {
    let coords = NODES.map(|[x, y, z]| [25.0 * x + 2.0 * y * z, 25.0 * y + x, 25.0 * z - x * y]);
    let law = Arc::new(Linear::new(unsymmetric));
    let nodes = std::array::from_fn(|i| i);
    Hex20::new(nodes, &coords, rule, law, BandWidth::CubeRoot).expect("a valid cell")
}

fn hex20(c: &mut Criterion) {
    let (committed, mut trial) = ([0.0; 27 * 18], [0.0; 27 * 18]);
    let u: Vec<f64> = (0..60).map(|i| 1e-3 * f64::from(i).sin()).collect();
    let mut force = vec![0.0; 60];
    let mut stiffness = vec![0.0; 3600];
    let mut group = c.benchmark_group("hex20");
    for (rule, points) in [(HexRule::Reduced, 8), (HexRule::Full, 27)] {
        for (what, operator, unsymmetric) in [
            ("symmetric stiffness", Operator::Tangent, false),
            ("unsymmetric stiffness", Operator::Tangent, true),
            ("force only", Operator::None, false),
        ] {
            let element = element(rule, unsymmetric);
            let ctx = EvaluationContext::new(operator);
            group.bench_function(format!("{what}, {points} points"), |b| {
                b.iter(|| {
                    let out = ElementSystem {
                        force: &mut force,
                        stiffness: if operator == Operator::None {
                            &mut []
                        } else {
                            &mut stiffness
                        },
                    };
                    element.evaluate(black_box(&u), &committed, &mut trial, &ctx, out)
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, hex20);
criterion_main!(benches);
