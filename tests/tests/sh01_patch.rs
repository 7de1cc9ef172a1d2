//! SH-01: patch tests of sheets in space: five distorted quadrilaterals in a rectangle of 0.24 x 0.12, thickness 0.001,
//! E = 1e6, nu = 0.25, in the x-y plane and in a plane oblique to all axes.
//!
//! Source: R. H. MacNeal and R. L. Harder, "A proposed standard set of problems to test finite element accuracy", Finite
//! Elements in Analysis and Design 1 (1985) 3-20, membrane and bending patch; the shear patch after K.-J. Bathe, "Finite
//! Element Procedures" (1996), section 5.4.2.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::PointSample;
use fe_core::kinematics::PlaneStress;
use fe_core::material::Material;
use fe_core::mesh::Mesh;
use fe_core::model::{Conditions, Model};
use fe_core::testing::Worst;
use fe_elements::QuadRule;
use fe_materials::Elastic;
use fe_tests::dense::{DenseModel, internal};
use fe_tests::mesh::{mapped, membranes, oblique, quadratic_sheet};
use fe_tests::shell::{RULES, isotropic, shells};
use fe_tests::solve::solve_to;

const CORNERS: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [0.24, 0.0, 0.0],
    [0.24, 0.12, 0.0],
    [0.0, 0.12, 0.0],
    [0.04, 0.02, 0.0],
    [0.18, 0.03, 0.0],
    [0.16, 0.08, 0.0],
    [0.08, 0.08, 0.0],
];

const CELLS: [[usize; 4]; 5] = [
    [0, 1, 5, 4],
    [1, 2, 6, 5],
    [2, 3, 7, 6],
    [3, 0, 4, 7],
    [4, 5, 6, 7],
];

/// Displacement and rotation of a node.
type Field = fn([f64; 3]) -> [[f64; 3]; 2];

fn membrane([x, y, _]: [f64; 3]) -> [[f64; 3]; 2] {
    [[1e-3 * (x + 0.5 * y), 1e-3 * (y + 0.5 * x), 0.0], [0.0; 3]]
}

/// w = 1e-3 (x^2 + x y + y^2)/2, theta = (w,_y, -w,_x).
fn bending([x, y, _]: [f64; 3]) -> [[f64; 3]; 2] {
    let w = 0.5e-3 * (x * x + x * y + y * y);
    [
        [0.0, 0.0, w],
        [1e-3 * (y + 0.5 * x), -1e-3 * (x + 0.5 * y), 0.0],
    ]
}

fn shear([x, y, _]: [f64; 3]) -> [[f64; 3]; 2] {
    [[0.0, 0.0, 1e-3 * (x - 2.0 * y)], [0.0; 3]]
}

fn plane(x: [f64; 3]) -> [f64; 3] {
    x
}

/// Plane meshes and the turn that takes them, and every vector on them, to their place.
const TURNS: [fn([f64; 3]) -> [f64; 3]; 2] = [plane, oblique];

fn patch() -> Mesh {
    quadratic_sheet(&CORNERS, &CELLS).unwrap()
}

/// Shells with the field on the outline (rotations on all nodes if `rotations`): worst error inside relative to the
/// largest of its kind on the outline, and all sampled points as (height, stresses).
fn shell_patch(
    field: Field,
    turn: fn([f64; 3]) -> [f64; 3],
    rule: QuadRule,
    rotations: bool,
) -> (f64, Vec<(f64, [f64; 3])>) {
    let flat = patch();
    let mesh = mapped(&flat, turn).unwrap();
    let axis = turn([1.0, 0.0, 0.0]);
    let elements = shells(&mesh, &isotropic(1e6, 0.25, 0.001), rule, axis).unwrap();
    let model = Model::new(mesh, elements).unwrap();
    let exact = |x: [f64; 3]| -> Vec<f64> { field(x).map(turn).concat() };
    let mut conditions = Conditions::new(&model);
    let mut scale = [0.0_f64; 2];
    for (node, &x) in flat.nodes().iter().enumerate() {
        let outline = x[0] == 0.0 || x[0] == 0.24 || x[1] == 0.0 || x[1] == 0.12;
        for (k, (dof, u)) in Dof::ALL.into_iter().zip(exact(x)).enumerate() {
            if outline || (rotations && k >= 3) {
                conditions.prescribe(&model, node, dof, u).unwrap();
            }
            scale[k / 3] = scale[k / 3].max(u.abs());
        }
    }
    let solution = solve_to(1e-8, &model, conditions).unwrap();
    let mut worst = 0.0_f64;
    for (node, &x) in flat.nodes().iter().enumerate() {
        for (k, (dof, u)) in Dof::ALL.into_iter().zip(exact(x)).enumerate() {
            // Where the field has no rotations: those of its gradient count.
            let scale = if scale[k / 3] == 0.0 {
                1e-3
            } else {
                scale[k / 3]
            };
            worst = worst.max((solution.at(&model, node, dof) - u).abs() / scale);
        }
    }
    let mut points = Vec::new();
    let normal = turn([0.0, 0.0, 1.0]);
    for (e, element) in model.elements().iter().enumerate() {
        let mut visit = |p: PointSample<'_>| {
            let z = (0..3).map(|k| normal[k] * p.position[k]).sum();
            points.push((z, [p.stress[0], p.stress[1], p.stress[2]]));
        };
        let u = model.gather(e, &solution.displacement);
        element.sample(&u, &[], &mut visit).unwrap();
    }
    (worst, points)
}

/// Targets: displacements and rotations within 1e-8; stresses 1333.33, 1333.33, 400 MPa within 1e-8 in the membrane
/// patch, and -z times that in the bending patch (0.6667 and 0.2 MPa at the surface).
#[test]
fn membrane_and_bending_patches_of_shells() {
    let mut moved = Worst::new("SH-01: displacements and rotations, relative error", 1e-8);
    let mut stressed = Worst::new("SH-01: stresses, relative error", 1e-8);
    for rule in RULES {
        for turn in TURNS {
            for (field, linear) in [(membrane as Field, 0.0), (bending, 1.0)] {
                let (worst, points) = shell_patch(field, turn, rule, false);
                moved.see(worst, (rule, linear));
                for (z, stress) in points {
                    let height = 1.0 - linear - linear * z;
                    let unit = if linear == 0.0 { 1.0 } else { 5e-4 };
                    for (s, target) in stress.iter().zip([4000.0 / 3.0, 4000.0 / 3.0, 400.0]) {
                        stressed.see((s - height * target) / (unit * target), (rule, linear));
                    }
                }
            }
        }
    }
    moved.tell();
    stressed.tell();
}

/// Rotations held at zero, a linear deflection on the outline. Target: linear inside, within 1e-8.
#[test]
fn shear_patch_of_shells() {
    let mut moved = Worst::new(
        "SH-01: deflections of the shear patch, relative error",
        1e-8,
    );
    for rule in RULES {
        for turn in TURNS {
            let (worst, _) = shell_patch(shear, turn, rule, true);
            moved.see(worst, rule);
        }
    }
    moved.tell();
}

/// The membrane patch of membranes, which do not resist the displacements out of their plane; those are left out. Target:
/// 1e-12 of the largest displacement.
#[test]
fn membrane_patch_of_membranes() {
    let mut moved = Worst::new("SH-01: displacements of membranes, relative error", 1e-12);
    let law: Arc<dyn Material<PlaneStress>> = Arc::new(Elastic::new(1e6, 0.25).unwrap());
    for rule in RULES {
        for turn in TURNS {
            let flat = patch();
            let mesh = mapped(&flat, turn).unwrap();
            let axis = turn([1.0, 0.0, 0.0]);
            let elements = membranes(&mesh, 0.001, rule, axis, &law).unwrap();
            let model = Model::new(mesh, elements).unwrap();
            // The exact field on the outline as a load: K u = 0 inside, split into known and unknown.
            let mut conditions = Conditions::new(&model);
            let mut known = vec![0.0; model.dofs().len()];
            for (node, &x) in flat.nodes().iter().enumerate() {
                if x[0] == 0.0 || x[0] == 0.24 || x[1] == 0.0 || x[1] == 0.12 {
                    let u = turn(membrane(x)[0]);
                    for (dof, u) in Dof::DISPLACEMENTS.into_iter().zip(u) {
                        conditions.fix(&model, node, dof).unwrap();
                        known[model.dof(node, dof).unwrap()] = u;
                    }
                }
            }
            let forces = internal(&model, &known).unwrap();
            for (node, _) in flat.nodes().iter().enumerate() {
                for dof in Dof::DISPLACEMENTS {
                    let d = model.dof(node, dof).unwrap();
                    conditions
                        .add_reference(&model, node, dof, -forces[d])
                        .unwrap();
                }
            }
            let inside = DenseModel::new(&model, &conditions)
                .unwrap()
                .solve(&conditions);
            for (node, &x) in flat.nodes().iter().enumerate() {
                for (dof, u) in Dof::DISPLACEMENTS.into_iter().zip(turn(membrane(x)[0])) {
                    let d = model.dof(node, dof).unwrap();
                    moved.see((known[d] + inside[d] - u) / 3e-4, (rule, node));
                }
            }
        }
    }
    moved.tell();
}
