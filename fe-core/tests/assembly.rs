//! Protects assembly: the same bits for any number of threads, and the same matrix as a dense sum of
//! element matrices, symmetric or not, under supports and prescribed displacements.

mod common;

use std::sync::Arc;

use common::{Brick, Damage, Flaw, Truss};
use fe_core::assembly::{Assembled, Assembler};
use fe_core::check;
use fe_core::dof::Dof;
use fe_core::element::{Element, ElementSystem, EvaluationContext};
use fe_core::grid::GridBuilder;
use fe_core::material::Operator;
use fe_core::mesh::Mesh;
use fe_core::model::{Conditions, Model, ModelError};
use fe_core::output::{bar_grid, cell_grid, interface_grid};
use fe_core::state::StateStore;
use nalgebra::{DMatrix, DVector};

/// A truss between all pairs of corners of each cell of a grid; `flaw(i)` for the i-th.
fn lattice(cells: [u32; 3], flaw: impl Fn(usize) -> Flaw) -> Model {
    lattice_of(Flaw::None, cells, flaw)
}

fn lattice_of(law: Flaw, cells: [u32; 3], flaw: impl Fn(usize) -> Flaw) -> Model {
    let lines = cells.map(|n| (0..=n).map(|i| 10.0 * f64::from(i)).collect::<Vec<_>>());
    let mut grid = GridBuilder::new();
    grid.add_box("lattice", &lines[0], &lines[1], &lines[2]);
    let mesh: Mesh = grid.finish().unwrap();
    let law = Arc::new(Damage(law));
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    for cell in mesh.blocks()[0].cells() {
        for a in 0..8 {
            for b in a + 1..8 {
                let ends = [cell[a], cell[b]];
                let kind = flaw(elements.len());
                elements.push(Box::new(Truss::new(ends, mesh.nodes(), law.clone(), kind)));
            }
        }
    }
    Model::new(mesh, elements).unwrap()
}

/// Holds the end x = 0, pulls one DOF of the node with the largest number.
fn conditions(model: &Model) -> Conditions {
    let mut conditions = Conditions::new(model);
    for i in 0..model.dofs().len() {
        let (node, dof) = model.dofs().owner(i);
        if model.mesh().nodes()[node][0] == 0.0 {
            conditions.fix(model, node, dof).unwrap();
        }
    }
    let (last, _) = model.dofs().owner(model.dofs().len() - 1);
    conditions.prescribe(model, last, Dof::Uy, -2.0).unwrap();
    conditions
}

fn displacement(model: &Model) -> Vec<f64> {
    (0..model.dofs().len())
        .map(|i| 5e-3 * (1.7 * i as f64).sin())
        .collect()
}

/// Mixed symmetric and unsymmetric elements, more than ten batches of them.
fn mixed() -> Model {
    lattice([8, 2, 2], |i| {
        if i % 3 == 0 {
            Flaw::Unsymmetric
        } else {
            Flaw::None
        }
    })
}

#[test]
fn results_are_bit_identical_for_one_and_two_threads() {
    let model = mixed();
    let u = displacement(&model);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let mut assembler = Assembler::new(&model, &conditions(&model)).unwrap();
            let mut state = StateStore::new(model.elements());
            let mut out = Assembled::default();
            let ctx = EvaluationContext::new(Operator::Tangent);
            assembler
                .evaluate(&model, &u, &mut state, &ctx, &mut out)
                .unwrap();
            (out, state)
        })
    };
    assert!(model.elements().len() > 800);
    let first = run(1);
    assert!(first.0.matrix.lower.iter().all(|v| v.is_finite()));
    assert_eq!(first, run(2));
}

/// Sum of the full element matrices and of the element forces over all DOFs.
fn dense(model: &Model, u: &[f64], operator: Operator) -> (DMatrix<f64>, DVector<f64>) {
    let n = model.dofs().len();
    let (mut matrix, mut force) = (DMatrix::zeros(n, n), DVector::zeros(n));
    let state = StateStore::new(model.elements());
    for (e, element) in model.elements().iter().enumerate() {
        let dofs = model.dofs().element_dofs(element.as_ref());
        let m = dofs.len();
        let (mut f, mut k) = (vec![0.0; m], vec![0.0; m * m]);
        let mut trial = state.committed(e).to_vec();
        let out = ElementSystem {
            force: &mut f,
            stiffness: &mut k,
        };
        element
            .evaluate(
                &model.gather(e, u),
                state.committed(e),
                &mut trial,
                &EvaluationContext::new(operator),
                out,
            )
            .unwrap();
        let full = element.unsymmetric() && operator == Operator::Tangent;
        for i in 0..m {
            force[dofs[i] as usize] += f[i];
            for j in 0..m {
                let entry = if full || i <= j {
                    k[i * m + j]
                } else {
                    k[j * m + i]
                };
                matrix[(dofs[i] as usize, dofs[j] as usize)] += entry;
            }
        }
    }
    (matrix, force)
}

fn agrees_with_dense(model: &Model, ctx: EvaluationContext, symmetric: bool) {
    let (u, conditions) = (displacement(model), conditions(model));
    let (mut matrix, force) = dense(model, &u, ctx.operator);
    if ctx.symmetric_part {
        matrix = 0.5 * (&matrix + matrix.transpose());
    }
    let mut assembler = Assembler::new(model, &conditions).unwrap();
    let mut state = StateStore::new(model.elements());
    let mut out = Assembled::default();
    // Twice: buffers that are used again must not remember.
    for _ in 0..2 {
        assembler
            .evaluate(model, &u, &mut state, &ctx, &mut out)
            .unwrap();
    }
    assert_eq!(out.matrix.is_symmetric(), symmetric);
    let scale = matrix.amax();
    let assembled = out.matrix.to_csc(assembler.pattern()).to_dense();
    let free = assembler.free();
    for (i, &a) in free.iter().enumerate() {
        for (j, &b) in free.iter().enumerate() {
            let expected = matrix[(a as usize, b as usize)];
            assert!(
                (assembled[[i, j]] - expected).abs() < 1e-12 * scale,
                "{i} {j}"
            );
        }
    }
    let mut y = vec![0.0; free.len()];
    let x: Vec<f64> = (0..free.len()).map(|i| (i as f64).cos()).collect();
    out.matrix.multiply(assembler.pattern(), &x, &mut y);
    let rate = DVector::from_column_slice(assembler.rate());
    assert!(rate.amax() == 2.0);
    let coupling = &matrix * rate;
    for (i, &a) in free.iter().enumerate() {
        let row: f64 = (0..free.len())
            .map(|j| matrix[(a as usize, free[j] as usize)] * x[j])
            .sum();
        assert!((y[i] - row).abs() < 1e-11 * scale);
        assert!((out.coupling[i] - coupling[a as usize]).abs() < 1e-12 * scale);
    }
    for (given, expected) in out.internal.iter().zip(force.iter()) {
        assert!((given - expected).abs() < 1e-12 * force.amax());
    }
}

#[test]
fn a_symmetric_model_agrees_with_a_dense_sum() {
    let tangent = EvaluationContext::new(Operator::Tangent);
    agrees_with_dense(&lattice([2, 1, 1], |_| Flaw::None), tangent, true);
}

#[test]
fn an_unsymmetric_model_agrees_with_a_dense_sum() {
    agrees_with_dense(
        &lattice([2, 1, 1], |_| Flaw::Unsymmetric),
        EvaluationContext::new(Operator::Tangent),
        false,
    );
}

#[test]
fn a_mixed_model_agrees_with_a_dense_sum() {
    let model = lattice([3, 2, 1], |i| {
        if i % 2 == 0 {
            Flaw::Unsymmetric
        } else {
            Flaw::None
        }
    });
    let tangent = EvaluationContext::new(Operator::Tangent);
    agrees_with_dense(&model, tangent, false);
    let part = EvaluationContext {
        symmetric_part: true,
        ..tangent
    };
    agrees_with_dense(&model, part, true);
    // The secant operator is symmetric whatever the tangent is.
    agrees_with_dense(&model, EvaluationContext::new(Operator::Secant), true);
}

#[test]
fn forces_alone_leave_the_matrix_alone_and_equal_those_with_it() {
    let model = mixed();
    let u = displacement(&model);
    let mut assembler = Assembler::new(&model, &conditions(&model)).unwrap();
    let mut state = StateStore::new(model.elements());
    let mut with = Assembled::default();
    let tangent = EvaluationContext::new(Operator::Tangent);
    assembler
        .evaluate(&model, &u, &mut state, &tangent, &mut with)
        .unwrap();
    let mut without = with.clone();
    let none = EvaluationContext::new(Operator::None);
    assembler
        .evaluate(&model, &u, &mut state, &none, &mut without)
        .unwrap();
    assert_eq!(with, without);
}

#[test]
fn an_element_that_fails_is_named_with_its_place() {
    let model = lattice_of(Flaw::Refuses, [1, 1, 1], |_| Flaw::None);
    let mut assembler = Assembler::new(&model, &Conditions::new(&model)).unwrap();
    let mut state = StateStore::new(model.elements());
    let ctx = EvaluationContext::new(Operator::None);
    let error = assembler
        .evaluate(
            &model,
            &displacement(&model),
            &mut state,
            &ctx,
            &mut Assembled::default(),
        )
        .unwrap_err();
    assert!(matches!(error, ModelError::Element { element: 0, .. }) && error.is_recoverable());
    assert!(
        error
            .to_string()
            .starts_with("element 0 (first node 0 at [0.0, 0.0, 0.0] mm)"),
        "{error}"
    );
}

/// What belongs to another model is refused by name instead of read beyond its end: conditions, displacements, states with
/// other elements, with longer or shorter histories, and the numbering itself.
#[test]
fn what_belongs_to_another_model_is_refused() {
    let (model, other) = (mixed(), lattice([1, 1, 1], |_| Flaw::None));
    for (a, b) in [(&model, &other), (&other, &model)] {
        assert!(matches!(
            Assembler::new(a, &Conditions::new(b)),
            Err(ModelError::ForeignConditions { .. })
        ));
        let refused = |u: &Model, state: &Model, numbered: &Model| {
            let mut assembler = Assembler::new(numbered, &conditions(numbered)).unwrap();
            let mut state = StateStore::new(state.elements());
            let ctx = EvaluationContext::new(Operator::Tangent);
            let mut out = Assembled::default();
            match assembler.evaluate(a, &displacement(u), &mut state, &ctx, &mut out) {
                Err(ModelError::Foreign { what, .. }) => what,
                other => panic!("{other:?}"),
            }
        };
        assert_eq!(refused(b, a, a), "displacements");
        assert_eq!(refused(a, b, a), "elements with a state");
        assert_eq!(refused(a, a, b), "numbered DOFs");
        let foreign = check::held(a, &Conditions::new(b));
        assert!(matches!(foreign, Err(ModelError::ForeignConditions { .. })));
        let mut visit = |_: fe_core::element::PointSample<'_>| {};
        let (u, state) = (displacement(a), StateStore::new(a.elements()));
        a.sample(0, &u, &state, &mut visit).unwrap();
        for (u, state) in [
            (displacement(b), StateStore::new(a.elements())),
            (displacement(a), StateStore::new(b.elements())),
        ] {
            for foreign in [
                a.sample(0, &u, &state, &mut visit),
                cell_grid(a, &u, &state).map(drop),
                bar_grid(a, &u, &state).map(drop),
                interface_grid(a, &u, &state).map(drop),
            ] {
                assert!(matches!(foreign, Err(ModelError::Foreign { .. })));
            }
        }
    }
    // As many elements, none of which has a history.
    let bricks = other.elements().iter().map(|_| {
        let brick: Box<dyn Element> = Box::new(Brick::new(&[0; 20], &[[0.0; 3]; 20]));
        brick
    });
    let mut state = StateStore::new(&bricks.collect::<Vec<_>>());
    let mut assembler = Assembler::new(&other, &conditions(&other)).unwrap();
    let (u, ctx) = (displacement(&other), EvaluationContext::new(Operator::None));
    let refused = assembler.evaluate(&other, &u, &mut state, &ctx, &mut Assembled::default());
    assert!(matches!(
        refused,
        Err(ModelError::Foreign {
            found: 0,
            expected: 2,
            ..
        })
    ));
}
