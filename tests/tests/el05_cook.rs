//! EL-05: Cook's membrane, E = 1, nu = 1/3, thickness 1, unit shear force on the right edge; 8-node quadrilaterals
//! in the plane, and membranes in a plane oblique to all axes.
//!
//! Source: R. D. Cook, "Improved two-dimensional finite element", ASCE J. Struct. Div. 100 (1974) 1851-1863; deflection of
//! the middle of the right edge 23.96 in the limit. Values per mesh: computed independently of this project.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::PlaneStress;
use fe_core::material::Material;
use fe_core::mesh::{Mesh, NodeId};
use fe_core::model::{Conditions, Model};
use fe_core::testing::{Worst, curve, within};
use fe_elements::QuadRule;
use fe_materials::Elastic;
use fe_tests::dense::DenseModel;
use fe_tests::mesh::{mapped, membranes, oblique, quadrilaterals, sheets};
use fe_tests::solve::solve;

/// n x n cells of the membrane in the x-y plane.
fn mesh(n: usize) -> Mesh {
    quadrilaterals(n, |s, t| [48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s)]).unwrap()
}

fn law() -> Arc<dyn Material<PlaneStress>> {
    Arc::new(Elastic::new(1.0, 1.0 / 3.0).unwrap())
}

/// Left edge held, unit force along `up` on the right edge, in the DOFs `dofs`; and the node in the middle of the right
/// edge. `plane` is where the nodes are in the x-y plane.
fn conditions(
    model: &Model,
    n: usize,
    plane: &[[f64; 3]],
    dofs: &[Dof],
    up: [f64; 3],
) -> (Conditions, NodeId) {
    let mut conditions = Conditions::new(model);
    let step = 16.0 / (2 * n) as f64;
    let mut middle = 0;
    for (node, x) in plane.iter().enumerate() {
        if x[0] == 0.0 {
            for &dof in dofs {
                conditions.fix(model, node, dof).unwrap();
            }
        }
        if x[0] != 48.0 {
            continue;
        }
        // Consistent forces of a uniform traction on each edge: 1/6, 2/3, 1/6 of its share.
        let place = ((x[1] - 44.0) / step).round() as usize;
        let weight = match place {
            _ if place % 2 == 1 => 4.0,
            0 => 1.0,
            _ if place == 2 * n => 1.0,
            _ => 2.0,
        };
        for (&dof, up) in dofs.iter().zip(up) {
            let share = up * weight / (6 * n) as f64;
            conditions.add_reference(model, node, dof, share).unwrap();
        }
        if place == n {
            middle = node;
        }
    }
    (conditions, middle)
}

/// Deflection of the middle of the right edge with n x n elements.
fn deflection(n: usize, rule: QuadRule) -> f64 {
    let mesh = mesh(n);
    let plane = mesh.nodes().to_vec();
    let elements = sheets(&mesh, 1.0, rule, &law()).unwrap();
    let model = Model::new(mesh, elements).unwrap();
    let up = [0.0, 1.0, 0.0];
    let (conditions, middle) = conditions(&model, n, &plane, &[Dof::Ux, Dof::Uy], up);
    solve(&model, conditions)
        .unwrap()
        .at(&model, middle, Dof::Uy)
}

/// The same of membranes in an oblique plane, the displacements out of it, which cost nothing, left out.
fn deflection_in_space(n: usize, rule: QuadRule) -> f64 {
    let plane = mesh(n);
    let mesh = mapped(&plane, oblique).unwrap();
    let elements = membranes(&mesh, 1.0, rule, [1.0, 0.0, 0.0], &law()).unwrap();
    let model = Model::new(mesh, elements).unwrap();
    let up = oblique([0.0, 1.0, 0.0]);
    let (conditions, middle) = conditions(&model, n, plane.nodes(), &Dof::DISPLACEMENTS, up);
    let u = DenseModel::new(&model, &conditions)
        .unwrap()
        .solve(&conditions);
    let moved = Dof::DISPLACEMENTS.map(|dof| u[model.dof(middle, dof).unwrap()]);
    moved.iter().zip(up).map(|(u, up)| u * up).sum()
}

/// Protects the quadrilateral. Targets: 22.718, 23.708, 23.884, 23.955 (9 points) and 23.171, 23.726, 23.888, 23.957
/// (4 points) with 2, 4, 8, 32 elements per side, within 0.001 (0.0015 for the last digit rounded).
#[test]
fn deflection_converges_to_the_published_value() {
    let mut paths = [vec![], vec![]];
    for (n, full, reduced) in [
        (2, 22.718, 23.171),
        (4, 23.708, 23.726),
        (8, 23.884, 23.888),
        (32, 23.955, 23.957),
    ] {
        for (rule, target) in [(QuadRule::Full, full), (QuadRule::Reduced, reduced)] {
            let found = deflection(n, rule);
            within(
                &format!("deflection, {n} x {n}, {rule:?}"),
                found,
                target,
                1e-3,
            );
            paths[usize::from(rule == QuadRule::Reduced)].push([1.0 / n as f64, found]);
        }
    }
    for (path, points) in paths.into_iter().zip(["9 points", "4 points"]) {
        let [_, finest] = path[path.len() - 1];
        within(
            &format!("EL-05: deflection, 32 x 32, {points}"),
            finest,
            23.96,
            0.01,
        );
        curve(&format!("cook, {points}"), path);
    }
}

/// Protects the membrane in space: the deflection along the edge is that of the quadrilateral in the plane. Target: 1e-9
/// relative, with both rules.
#[test]
fn a_membrane_in_an_oblique_plane_deflects_as_much() {
    let mut worst = Worst::new("deflection over that in the plane, relative error", 1e-9);
    for n in [2, 4, 8] {
        for rule in [QuadRule::Full, QuadRule::Reduced] {
            let ratio = deflection_in_space(n, rule) / deflection(n, rule);
            worst.see(ratio - 1.0, (n, rule));
        }
    }
    worst.tell();
}
