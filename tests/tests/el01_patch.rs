//! EL-01: patch test of seven distorted hexahedra in a unit cube, E = 1e6, nu = 0.25.
//!
//! Source: R. H. MacNeal and R. L. Harder, "A proposed standard set of problems to test finite element accuracy", Finite
//! Elements in Analysis and Design 1 (1985) 3-20.

use fe_core::dof::Dof;
use fe_core::model::{Conditions, Model};
use fe_core::testing::Worst;
use fe_elements::HexRule;
use fe_tests::laws::elastic;
use fe_tests::mesh::{hexahedra, quadratic};
use fe_tests::solve::solve;

/// Corners of the inner cell.
const INNER: [[f64; 3]; 8] = [
    [0.249, 0.342, 0.192],
    [0.826, 0.288, 0.288],
    [0.850, 0.649, 0.263],
    [0.273, 0.750, 0.230],
    [0.320, 0.186, 0.643],
    [0.677, 0.305, 0.683],
    [0.788, 0.693, 0.644],
    [0.165, 0.745, 0.702],
];

/// Corners of the cube, in the same order.
const OUTER: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];

/// Inner cell, then one between each of its faces and the cube; corners 8 to 15 are those of the cube.
const CELLS: [[usize; 8]; 7] = [
    [0, 1, 2, 3, 4, 5, 6, 7],
    [8, 9, 10, 11, 0, 1, 2, 3],
    [4, 5, 6, 7, 12, 13, 14, 15],
    [8, 9, 1, 0, 12, 13, 5, 4],
    [3, 2, 10, 11, 7, 6, 14, 15],
    [8, 0, 3, 11, 12, 4, 7, 15],
    [1, 9, 10, 2, 5, 13, 14, 6],
];

fn exact([x, y, z]: [f64; 3]) -> [f64; 3] {
    [2.0 * x + y + z, x + 2.0 * y + z, x + y + 2.0 * z].map(|c| 0.5e-3 * c)
}

/// Protects node order, Jacobian and quadrature: a linear field prescribed on the surface holds inside. Targets:
/// displacements within 1e-10 relative; direct stresses 2000 MPa, shear stresses 400 MPa.
#[test]
fn a_linear_field_is_reproduced() {
    let mut moved = Worst::new("EL-01: displacements, relative error", 1e-10);
    let mut stressed = Worst::new(
        "EL-01: stresses against 2000 and 400 MPa, relative error",
        1e-10,
    );
    for rule in [HexRule::Reduced, HexRule::Irons, HexRule::Full] {
        let mesh = quadratic(&[INNER, OUTER].concat(), &CELLS).unwrap();
        let elements = hexahedra(&mesh, rule, &elastic(1e6, 0.25).unwrap()).unwrap();
        let model = Model::new(mesh, elements).unwrap();
        let mut conditions = Conditions::new(&model);
        for (node, &x) in model.mesh().nodes().iter().enumerate() {
            if x.iter().any(|&c| c == 0.0 || c == 1.0) {
                for (dof, u) in Dof::DISPLACEMENTS.into_iter().zip(exact(x)) {
                    conditions.prescribe(&model, node, dof, u).unwrap();
                }
            }
        }
        let solution = solve(&model, conditions).unwrap();
        for (node, &x) in model.mesh().nodes().iter().enumerate() {
            for (dof, u) in Dof::DISPLACEMENTS.into_iter().zip(exact(x)) {
                moved.see(
                    (solution.at(&model, node, dof) - u) / 2e-3,
                    (rule, node, dof),
                );
            }
        }
        for (e, element) in model.elements().iter().enumerate() {
            let u = model.gather(e, &solution.displacement);
            let mut check = |point: fe_core::element::PointSample<'_>| {
                for (i, stress) in point.stress.iter().enumerate() {
                    let target = if i < 3 { 2000.0 } else { 400.0 };
                    stressed.see((stress - target) / 2000.0, (rule, e, i));
                }
            };
            element.sample(&u, &[], &mut check).unwrap();
        }
    }
    moved.tell();
    stressed.tell();
}
