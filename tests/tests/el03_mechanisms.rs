//! EL-02, EL-03: modes without energy, and what the solver says of them.
//!
//! Source: eigenvalues computed independently of this project. A hexahedron with 2 x 2 x 2 points has six mechanisms
//! beside its rigid-body modes. In a mesh they survive in columns of one by one cells only: n + 1 of them in a free
//! column of n cells, n when an end is clamped, none with a roller plane along a side.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::{PlaneStress, Solid};
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_core::testing::{counted, within, within_share};
use fe_elements::{HexRule, QuadRule};
use fe_materials::Elastic;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_solver::error::SolverError;
use fe_tests::conditions::hold;
use fe_tests::dense::DenseModel;
use fe_tests::hourglass::energy_of_a_mechanism;
use fe_tests::laws::elastic;
use fe_tests::mesh::{
    boxes, hexahedra, lines, mapped, membranes, oblique, quadrilaterals, sheets, surface,
};
use fe_tests::shell::{isotropic, shells};
use fe_tests::solve::solve;

fn block(cells: [usize; 3], size: [f64; 3], rule: HexRule) -> Model {
    let [x, y, z] = std::array::from_fn(|k| lines(0.0, size[k], cells[k]));
    let mesh = boxes(&x, &y, &z).unwrap();
    let elements = hexahedra(&mesh, rule, &elastic(30_000.0, 0.2).unwrap()).unwrap();
    Model::new(mesh, elements).unwrap()
}

/// Cells of 50 mm.
fn cubes(cells: [usize; 3], rule: HexRule) -> Model {
    block(cells, cells.map(|n| 50.0 * n as f64), rule)
}

/// The plane where coordinate `axis` is zero.
fn plane(axis: usize) -> impl Fn([f64; 3]) -> bool {
    move |x| x[axis] == 0.0
}

fn clamped(model: &Model) -> Conditions {
    let mut conditions = Conditions::new(model);
    hold(model, &mut conditions, &Dof::DISPLACEMENTS, plane(0)).unwrap();
    conditions
}

fn zeros(model: &Model, conditions: &Conditions) -> usize {
    DenseModel::new(model, conditions).unwrap().mechanisms()
}

/// EL-02: 6 zeros with 27 points, 12 with 8.
#[test]
fn one_hexahedron() {
    for (rule, expected) in [
        (HexRule::Full, 6),
        (HexRule::Irons, 6),
        (HexRule::Reduced, 12),
    ] {
        let model = cubes([1, 1, 1], rule);
        let found = zeros(&model, &Conditions::new(&model));
        counted(
            &format!("EL-02: zeros of a hexahedron, {rule:?}"),
            found,
            expected,
        );
    }
}

/// EL-02: 3 zeros with 9 points, 4 with 4, in its plane.
#[test]
fn one_quadrilateral() {
    for (rule, expected) in [(QuadRule::Full, 3), (QuadRule::Reduced, 4)] {
        let law: Arc<dyn Material<PlaneStress>> = Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
        let mesh = quadrilaterals(1, |x, y| [50.0 * x, 50.0 * y]).unwrap();
        let elements = sheets(&mesh, 1.0, rule, &law).unwrap();
        let model = Model::new(mesh, elements).unwrap();
        let found = zeros(&model, &Conditions::new(&model));
        counted(
            &format!("EL-02: zeros of a quadrilateral, {rule:?}"),
            found,
            expected,
        );
    }
}

/// EL-02: a membrane in space, oblique to all axes, has these modes and the 8 displacements out of its plane: 11 zeros
/// with 9 points, 12 with 4.
#[test]
fn one_membrane() {
    for (rule, expected) in [(QuadRule::Full, 11), (QuadRule::Reduced, 12)] {
        let law: Arc<dyn Material<PlaneStress>> = Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
        let mesh = quadrilaterals(1, |x, y| [50.0 * x, 50.0 * y + 7.0 * x * y]).unwrap();
        let mesh = mapped(&mesh, oblique).unwrap();
        let elements = membranes(&mesh, 1.0, rule, [1.0, 0.0, 0.0], &law).unwrap();
        let model = Model::new(mesh, elements).unwrap();
        let found = zeros(&model, &Conditions::new(&model));
        counted(
            &format!("EL-02: zeros of a membrane in space, {rule:?}"),
            found,
            expected,
        );
    }
}

/// Shells, flat and curved: with 9 points the six rigid-body modes and no other; with 4 points one more in a single
/// element, two if it is flat, none in two elements or more.
#[test]
fn shells_have_six_rigid_body_modes() {
    for bend in [0.0, 3.0] {
        for (rule, alone) in [
            (QuadRule::Full, 6),
            (QuadRule::Reduced, if bend == 0.0 { 8 } else { 7 }),
        ] {
            for (cells, expected) in [([1, 1], alone), ([2, 1], 6), ([4, 1], 6), ([2, 2], 6)] {
                let map = |x, y| [50.0 * x, 40.0 * y + 6.0 * x * y, bend * x * (x - 2.0 * y)];
                let mesh = surface(cells, map).unwrap();
                let section = isotropic(30_000.0, 0.2, 10.0);
                let elements = shells(&mesh, &section, rule, [1.0, 0.0, 0.0]).unwrap();
                let model = Model::new(mesh, elements).unwrap();
                let found = zeros(&model, &Conditions::new(&model));
                let shape = if bend == 0.0 { "flat" } else { "curved" };
                let [a, b] = cells;
                counted(
                    &format!("zeros of {a} x {b} {shape} shells, {rule:?}"),
                    found,
                    expected,
                );
            }
        }
    }
}

/// EL-03, columns of n = 2, 4, 8 cells: 6 + n + 1 zeros free, n clamped, none on a roller plane; with 27 points 6, 0, 0.
#[test]
fn columns_keep_their_mechanisms() {
    for n in [2, 4, 8] {
        for (rule, free, held) in [
            (HexRule::Reduced, 7 + n, n),
            (HexRule::Irons, 6, 0),
            (HexRule::Full, 6, 0),
        ] {
            let model = cubes([n, 1, 1], rule);
            let mut conditions = clamped(&model);
            // The catalogue's row is of the reduced rule, one end clamped.
            let id = if rule == HexRule::Reduced {
                "EL-03: "
            } else {
                ""
            };
            let found = zeros(&model, &Conditions::new(&model));
            counted(
                &format!("zeros of a free column of {n}, {rule:?}"),
                found,
                free,
            );
            let found = zeros(&model, &conditions);
            counted(
                &format!("{id}zeros of a clamped column of {n}, {rule:?}"),
                found,
                held,
            );
            hold(&model, &mut conditions, &[Dof::Uz], plane(2)).unwrap();
            let found = zeros(&model, &conditions);
            counted(
                &format!("zeros of a column of {n} on a plane, {rule:?}"),
                found,
                0,
            );
        }
    }
}

/// EL-03, sheets and blocks: no mechanism with either rule.
#[test]
fn sheets_and_blocks_have_none() {
    for cells in [[2, 2, 1], [4, 4, 1], [2, 2, 2], [3, 3, 3]] {
        for rule in [HexRule::Reduced, HexRule::Full] {
            let model = cubes(cells, rule);
            let ([a, b, c], found) = (cells, zeros(&model, &Conditions::new(&model)));
            counted(
                &format!("zeros of {a} x {b} x {c} free cells, {rule:?}"),
                found,
                6,
            );
        }
    }
}

/// The solver refuses a clamped column with mechanisms, and names a node and a DOF that take part in them.
#[test]
fn a_column_with_mechanisms_is_refused_by_node_and_dof() {
    for n in [1, 2, 4, 8] {
        let model = cubes([n, 1, 1], HexRule::Reduced);
        let conditions = clamped(&model);
        let dense = DenseModel::new(&model, &conditions).unwrap();
        match solve(&model, conditions) {
            Err(SolverError::Singular {
                node,
                dof,
                position,
                ..
            }) => {
                let index = model.dof(node, dof).unwrap();
                let row = dense.free.iter().position(|&d| d == index).unwrap();
                assert!(dense.freedom(row) > 1e-3, "{dof} of node {node} is held");
                assert_eq!(position, model.mesh().nodes()[node]);
            }
            other => panic!("{n} cells: {other:?}"),
        }
    }
}

/// EL-03c: with 8 points only the neighbours hold the mechanism, so its energy falls in proportion to their stiffness;
/// with 27 points and with 14, the default, the column keeps its own share. (The published energies, 0.719 of the residual stiffness
/// and 0.963 falling to 0.099, 0.103 of it, belong to a mode and a mesh that are not given: the shares are what was measured.)
#[test]
fn cracked_neighbours_release_the_mechanism_of_a_column() {
    let ratio = |rule| {
        energy_of_a_mechanism(rule, 1e-6).unwrap() / energy_of_a_mechanism(rule, 1.0).unwrap()
    };
    let reduced = ratio(HexRule::Reduced);
    within(
        "EL-03c: energy over residual stiffness, Reduced",
        reduced / 1e-6,
        1.0,
        1e-6,
    );
    for (rule, left) in [(HexRule::Full, 0.0618), (HexRule::Irons, 0.0519)] {
        let what = format!("EL-03c: energy that is left, {rule:?}");
        within_share(&what, ratio(rule), left, 0.01);
    }
}

/// A floating model is refused with the DOF that is free, however fine the mesh; the same model held is solved.
#[test]
fn a_floating_beam_is_refused_by_node_and_dof() {
    for cells in [[60, 4, 1], [176, 4, 1]] {
        let model = block(cells, [3050.0, 305.0, 75.0], HexRule::Reduced);
        let mut conditions = Conditions::new(&model);
        hold(&model, &mut conditions, &[Dof::Uy], plane(1)).unwrap();
        hold(&model, &mut conditions, &[Dof::Uz], plane(2)).unwrap();
        let error = solve(&model, conditions.clone()).unwrap_err();
        assert!(
            matches!(error, SolverError::Singular { dof: Dof::Ux, .. }),
            "{error}"
        );
        let message = error.to_string();
        assert!(message.contains("ux of node") && message.contains("add a support"));
        hold(&model, &mut conditions, &[Dof::Ux], plane(0)).unwrap();
        solve(&model, conditions).unwrap();
    }
}

/// So is a block on a hinge whose law has an unsymmetric tangent, which another factorisation serves.
#[test]
fn a_hinged_block_of_an_unsymmetric_law_is_refused() {
    let concrete = FixedCrackParameters::from_strength(38.0, 2.9, 33_000.0);
    let law: Arc<dyn Material<Solid>> = Arc::new(FixedCrack::new(concrete, None).unwrap());
    let line = lines(0.0, 500.0, 5);
    let mesh = boxes(&line, &line, &line).unwrap();
    let elements = hexahedra(&mesh, HexRule::Full, &law).unwrap();
    let model = Model::new(mesh, elements).unwrap();
    let mut conditions = Conditions::new(&model);
    let hinge = |x: [f64; 3]| x[0] == 0.0 && x[1] == 0.0;
    hold(&model, &mut conditions, &[Dof::Uz], plane(2)).unwrap();
    hold(&model, &mut conditions, &[Dof::Ux, Dof::Uy], hinge).unwrap();
    let refused = solve(&model, conditions);
    assert!(
        matches!(refused, Err(SolverError::Singular { .. })),
        "{refused:?}"
    );
}
