//! Time of factorisation and solution on a cantilever of 60 x 4 x 1 hexahedra with 8 points; one thread.

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use fe_core::assembly::{Assembled, Assembler};
use fe_core::dof::Dof;
use fe_core::element::{Element, EvaluationContext};
use fe_core::grid::GridBuilder;
use fe_core::material::Operator;
use fe_core::model::{Conditions, Model};
use fe_core::sparsity::MatrixValues;
use fe_core::state::StateStore;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::Elastic;
use fe_solver::linear::{DirectSolver, LinearSolver};

fn lines(end: f64, n: usize) -> Vec<f64> {
    (0..=n).map(|i| end * i as f64 / n as f64).collect()
}

fn cantilever() -> (Model, Conditions) {
    let mut grid = GridBuilder::new();
    grid.add_box("beam", &lines(3050.0, 60), &lines(305.0, 4), &[0.0, 75.0]);
    let mesh = grid.finish().expect("a mesh");
    let law = Arc::new(Elastic::new(30_000.0, 0.2).expect("a law"));
    let cells = mesh.blocks()[0].cells();
    let elements = cells.map(|cell| {
        let nodes = std::array::from_fn(|a| cell[a]);
        let coords = nodes.map(|n| mesh.nodes()[n]);
        let (rule, band) = (HexRule::Reduced, BandWidth::CubeRoot);
        let element = Hex20::new(nodes, &coords, rule, law.clone(), band);
        Box::new(element.expect("a cell")) as Box<dyn Element>
    });
    let elements = elements.collect();
    let model = Model::new(mesh, elements).unwrap();
    let mut conditions = Conditions::new(&model);
    for (node, x) in model.mesh().nodes().iter().enumerate() {
        if x[0] == 0.0 {
            for dof in Dof::DISPLACEMENTS {
                conditions.fix(&model, node, dof).expect("a DOF");
            }
        }
    }
    (model, conditions)
}

fn linear(c: &mut Criterion) {
    let (model, conditions) = cantilever();
    let mut assembler = Assembler::new(&model, &conditions).unwrap();
    let mut state = StateStore::new(model.elements());
    let mut out = Assembled::default();
    let rest = vec![0.0; model.dofs().len()];
    let ctx = EvaluationContext::new(Operator::Tangent);
    assembler
        .evaluate(&model, &rest, &mut state, &ctx, &mut out)
        .expect("a matrix");
    let mut group = c.benchmark_group("60x4x1");
    let pattern = assembler.pattern().clone();
    let definite = out.matrix.clone();
    let mut indefinite = definite.clone();
    for &diagonal in &pattern.col_ptr()[..pattern.len()] {
        indefinite.lower[diagonal] *= 0.9;
    }
    let unsymmetric = MatrixValues {
        upper: definite.lower.iter().map(|v| 0.999 * v).collect(),
        ..definite.clone()
    };
    let load: Vec<f64> = (0..pattern.len()).map(|i| (i as f64).sin()).collect();
    for (what, values) in [
        ("L L^T", &definite),
        ("L B L^T", &indefinite),
        ("L U", &unsymmetric),
    ] {
        let mut solver = DirectSolver::default();
        solver.analyze(&pattern).expect("an analysis");
        let inertia = solver.factorize(values).expect("a factor");
        assert_eq!(inertia.negative > 0, what == "L B L^T", "{inertia:?}");
        group.bench_function(format!("{what} factorisation"), |b| {
            b.iter(|| solver.factorize(black_box(values)));
        });
        let mut x = load.clone();
        group.bench_function(format!("{what} solution"), |b| {
            b.iter(|| {
                x.copy_from_slice(&load);
                solver.solve_in_place(&mut x)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, linear);
criterion_main!(benches);
