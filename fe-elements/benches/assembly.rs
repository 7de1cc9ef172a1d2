//! Time to assemble a beam of 60 x 4 x 1 hexahedra (2 x 2 x 2 points) on one thread, with a law whose
//! tangent is a constant: what elements and assembly cost without the law.

mod common;

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use fe_core::assembly::{Assembled, Assembler};
use fe_core::dof::Dof;
use fe_core::element::{Element, EvaluationContext};
use fe_core::grid::GridBuilder;
use fe_core::material::Operator;
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_elements::{BandWidth, Hex20, HexRule};

use common::Linear;

/// Lines of `n` equal cells of `length` mm.
fn lines(n: u32, length: f64) -> Vec<f64> {
    (0..=n)
        .map(|i| length * f64::from(i) / f64::from(n))
        .collect()
}

fn beam(unsymmetric: bool) -> Model {
    let mut grid = GridBuilder::new();
    grid.add_box(
        "beam",
        &lines(60, 3000.0),
        &lines(4, 300.0),
        &lines(1, 75.0),
    );
    let mesh = grid.finish().expect("a valid mesh");
    let law = Arc::new(Linear::new(unsymmetric));
    let elements = mesh.blocks()[0]
        .cells()
        .map(|cell| {
            let nodes: [usize; 20] = cell.try_into().expect("20 nodes");
            let coords = nodes.map(|n| mesh.nodes()[n]);
            let law = Arc::clone(&law);
            let hex = Hex20::new(nodes, &coords, HexRule::Reduced, law, BandWidth::CubeRoot);
            Box::new(hex.expect("a valid cell")) as Box<dyn Element>
        })
        .collect();
    Model::new(mesh, elements).unwrap()
}

/// Clamped at one end, pushed down at the other.
fn conditions(model: &Model) -> Conditions {
    let mut conditions = Conditions::new(model);
    for (node, x) in model.mesh().nodes().iter().enumerate() {
        for dof in Dof::DISPLACEMENTS {
            if x[0] == 0.0 {
                conditions.fix(model, node, dof).expect("a DOF of the beam");
            }
        }
        if x[0] == 3000.0 {
            conditions
                .prescribe(model, node, Dof::Uy, -1.0)
                .expect("a DOF of the beam");
        }
    }
    conditions
}

fn assembly(c: &mut Criterion) {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a pool of one thread");
    let mut group = c.benchmark_group("beam of 60 x 4 x 1 hex20");
    for (what, operator, unsymmetric) in [
        ("symmetric stiffness", Operator::Tangent, false),
        ("unsymmetric stiffness", Operator::Tangent, true),
        ("force only", Operator::None, false),
    ] {
        let model = beam(unsymmetric);
        let mut assembler = Assembler::new(&model, &conditions(&model)).unwrap();
        let mut state = StateStore::new(model.elements());
        let mut out = Assembled::default();
        let u: Vec<f64> = (0..model.dofs().len())
            .map(|i| 1e-3 * (i as f64).sin())
            .collect();
        let ctx = EvaluationContext::new(operator);
        group.bench_function(what, |b| {
            b.iter(|| {
                pool.install(|| {
                    assembler.evaluate(&model, black_box(&u), &mut state, &ctx, &mut out)
                })
            });
        });
    }
    let model = beam(false);
    let conditions = conditions(&model);
    group.bench_function("pattern and scatter map", |b| {
        b.iter(|| pool.install(|| Assembler::new(&model, &conditions).unwrap()));
    });
    group.finish();
}

criterion_group!(benches, assembly);
criterion_main!(benches);
