//! EL-02, EL-03: modes without energy, and what the solver says of them.
//!
//! Source: eigenvalues computed independently of this project. A hexahedron with 2 x 2 x 2 points has six mechanisms
//! beside its rigid-body modes. In a mesh they survive in columns of one by one cells only: n + 1 of them in a free
//! column of n cells, n when an end is clamped, none with a roller plane along a side.

use fe_core::dof::Dof;
use fe_core::model::{Conditions, Model};
use fe_elements::HexRule;
use fe_solver::error::SolverError;
use fe_tests::dense::{mechanisms, stiffness};
use fe_tests::laws::elastic;
use fe_tests::mesh::{boxes, hexahedra, lines, nodes_where};
use fe_tests::solve::solve;
use nalgebra::DMatrix;

fn block(cells: [usize; 3], size: [f64; 3], rule: HexRule) -> Model {
    let [x, y, z] = std::array::from_fn(|k| lines(0.0, size[k], cells[k]));
    let mesh = boxes(&x, &y, &z).unwrap();
    let elements = hexahedra(&mesh, rule, &elastic(30_000.0, 0.2).unwrap()).unwrap();
    Model::new(mesh, elements)
}

/// Cells of 50 mm.
fn cubes(cells: [usize; 3], rule: HexRule) -> Model {
    block(cells, cells.map(|n| 50.0 * n as f64), rule)
}

/// Holds a displacement in the plane where coordinate `axis` is zero.
fn hold(model: &Model, conditions: &mut Conditions, axis: usize, dof: Dof) {
    for n in nodes_where(model.mesh(), |x| x[axis] == 0.0) {
        conditions.fix(model, n, dof).unwrap();
    }
}

fn clamped(model: &Model) -> Conditions {
    let mut conditions = Conditions::new(model);
    for dof in Dof::DISPLACEMENTS {
        hold(model, &mut conditions, 0, dof);
    }
    conditions
}

fn modes(model: &Model, conditions: &Conditions) -> DMatrix<f64> {
    mechanisms(stiffness(model, conditions).unwrap())
}

/// EL-02: 6 zeros with 27 points, 12 with 8.
#[test]
fn one_hexahedron() {
    for (rule, zeros) in [(HexRule::Full, 6), (HexRule::Reduced, 12)] {
        let model = cubes([1, 1, 1], rule);
        assert_eq!(modes(&model, &Conditions::new(&model)).ncols(), zeros);
    }
}

/// EL-03, columns of n = 2, 4, 8 cells: 6 + n + 1 zeros free, n clamped, none on a roller plane; with 27 points 6, 0, 0.
#[test]
fn columns_keep_their_mechanisms() {
    for n in [2, 4, 8] {
        for (rule, free, held) in [(HexRule::Reduced, 7 + n, n), (HexRule::Full, 6, 0)] {
            let model = cubes([n, 1, 1], rule);
            let mut conditions = clamped(&model);
            assert_eq!(modes(&model, &Conditions::new(&model)).ncols(), free);
            assert_eq!(modes(&model, &conditions).ncols(), held);
            hold(&model, &mut conditions, 2, Dof::Uz);
            assert_eq!(modes(&model, &conditions).ncols(), 0);
        }
    }
}

/// EL-03, sheets and blocks: no mechanism with either rule.
#[test]
fn sheets_and_blocks_have_none() {
    for cells in [[2, 2, 1], [4, 4, 1], [2, 2, 2], [3, 3, 3]] {
        for rule in [HexRule::Reduced, HexRule::Full] {
            let model = cubes(cells, rule);
            assert_eq!(modes(&model, &Conditions::new(&model)).ncols(), 6);
        }
    }
}

/// The solver refuses a clamped column with mechanisms, and names a node and a DOF that take part in them.
#[test]
fn a_column_with_mechanisms_is_refused_by_node_and_dof() {
    for n in [1, 2, 4, 8] {
        let model = cubes([n, 1, 1], HexRule::Reduced);
        let conditions = clamped(&model);
        let modes = modes(&model, &conditions);
        let equations: Vec<usize> = (0..model.dofs().len())
            .filter(|d| !conditions.prescribed().contains_key(d))
            .collect();
        match solve(&model, conditions) {
            Err(SolverError::Singular {
                node,
                dof,
                position,
                ..
            }) => {
                let index = model.dof(node, dof).unwrap();
                let row = equations.iter().position(|&d| d == index).unwrap();
                assert!(modes.row(row).amax() > 1e-3, "{dof} of node {node} is held");
                assert_eq!(position, model.mesh().nodes()[node]);
            }
            other => panic!("{n} cells: {other:?}"),
        }
    }
}

/// A floating model is refused with the DOF that is free, however fine the mesh; the same model held is solved.
#[test]
fn a_floating_beam_is_refused_by_node_and_dof() {
    for cells in [[60, 4, 1], [176, 4, 1]] {
        let model = block(cells, [3050.0, 305.0, 75.0], HexRule::Reduced);
        let mut conditions = Conditions::new(&model);
        hold(&model, &mut conditions, 1, Dof::Uy);
        hold(&model, &mut conditions, 2, Dof::Uz);
        let error = solve(&model, conditions.clone()).unwrap_err();
        assert!(
            matches!(error, SolverError::Singular { dof: Dof::Ux, .. }),
            "{error}"
        );
        let message = error.to_string();
        assert!(message.contains("ux of node") && message.contains("add a support"));
        hold(&model, &mut conditions, 0, Dof::Ux);
        solve(&model, conditions).unwrap();
    }
}
