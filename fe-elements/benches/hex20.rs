//! Time of one 20-node hexahedron with a law whose 6 x 6 tangent is a constant: what the element itself costs.

mod common;

use std::hint::black_box;
use std::sync::Arc;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use fe_core::element::{Element, ElementSystem, EvaluationContext};
use fe_core::followers::Followers;
use fe_core::grid::GridBuilder;
use fe_core::material::Operator;
use fe_core::shape::hex20::NODES;
use fe_elements::{BandWidth, Hex20, HexRule, UniformHex20};

use common::Linear;

/// A distorted cell of 50 mm.
fn element(rule: HexRule, unsymmetric: bool) -> Hex20 {
    let coords = NODES.map(|[x, y, z]| [25.0 * x + 2.0 * y * z, 25.0 * y + x, 25.0 * z - x * y]);
    let law = Arc::new(Linear::new(unsymmetric));
    let nodes = std::array::from_fn(|i| i);
    Hex20::new(nodes, &coords, rule, law, BandWidth::CubeRoot).expect("a valid cell")
}

/// A cell of 50 x 60 mm, uniform across its width.
fn uniform(unsymmetric: bool) -> UniformHex20 {
    let mut grid = GridBuilder::new();
    grid.add_box("cell", &[0.0, 50.0], &[0.0, 60.0], &[0.0, 75.0]);
    let mesh = grid.finish().expect("a valid mesh");
    let followers = Followers::uniform_across(&mesh, 0..mesh.nodes().len());
    let cells = mesh.blocks()[0].cells().next();
    let cell: [usize; 20] = cells.expect("a cell").try_into().expect("20 nodes");
    let coords = cell.map(|n| mesh.nodes()[n]);
    let law = Arc::new(Linear::new(unsymmetric));
    let rule = HexRule::Irons;
    UniformHex20::new(cell, &coords, &followers, rule, law, BandWidth::CubeRoot)
        .expect("a valid cell")
}

/// Stiffness and force, and force alone.
fn time(
    group: &mut BenchmarkGroup<'_, WallTime>,
    kind: &str,
    points: usize,
    element: impl Fn(bool) -> Box<dyn Element>,
) {
    for (what, operator, unsymmetric) in [
        ("symmetric stiffness", Operator::Tangent, false),
        ("unsymmetric stiffness", Operator::Tangent, true),
        ("force only", Operator::None, false),
    ] {
        let element = element(unsymmetric);
        let dofs = 3 * element.nodes().len();
        let u: Vec<f64> = (0..dofs).map(|i| 1e-3 * (i as f64).sin()).collect();
        let (committed, mut trial) = ([0.0; 27 * 18], [0.0; 27 * 18]);
        let mut force = vec![0.0; dofs];
        let size = if operator == Operator::None {
            0
        } else {
            dofs * dofs
        };
        let mut stiffness = vec![0.0; size];
        let ctx = EvaluationContext::new(operator);
        group.bench_function(format!("{kind}{what}, {points} points"), |b| {
            b.iter(|| {
                let out = ElementSystem {
                    force: &mut force,
                    stiffness: &mut stiffness,
                };
                element.evaluate(black_box(&u), &committed, &mut trial, &ctx, out)
            });
        });
    }
}

fn hex20(c: &mut Criterion) {
    let mut group = c.benchmark_group("hex20");
    for (rule, points) in [(HexRule::Reduced, 8), (HexRule::Full, 27)] {
        time(&mut group, "", points, |unsymmetric| {
            Box::new(element(rule, unsymmetric))
        });
    }
    time(&mut group, "uniform across, ", 9, |unsymmetric| {
        Box::new(uniform(unsymmetric))
    });
    group.finish();
}

criterion_group!(benches, hex20);
criterion_main!(benches);
