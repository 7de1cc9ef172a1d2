//! EL-04: slender cantilevers of six hexahedra, straight (6 x 0.2 x 0.1) and curved (radii 4.12 and 4.32, a quarter
//! circle, 0.1 thick), and of twelve or more, twisted, under a unit force at the tip.
//!
//! Source of the beams and of the theoretical tip displacements: R. H. MacNeal and R. L. Harder, "A proposed standard
//! set of problems to test finite element accuracy", Finite Elements in Analysis and Design 1 (1985) 3-20. Source of the
//! ratios to theory: computed independently of this project, to three digits; those of the twisted beam are this project's.

use std::f64::consts::FRAC_PI_2;

use fe_core::dof::Dof;
use fe_core::mesh::Mesh;
use fe_core::model::{Conditions, Model};
use fe_core::testing::{counted, within};
use fe_elements::HexRule;
use fe_solver::error::SolverError;
use fe_tests::conditions::{hold, push_faces};
use fe_tests::dense::DenseModel;
use fe_tests::laws::elastic;
use fe_tests::mesh::{boxes, hexahedra, lines, mapped, nodes_where, quadratic};
use fe_tests::solve::solve;
use nalgebra::Vector3;

const CELLS: usize = 6;

/// Straight beam along x; interior cell faces lean by `lean` mm to alternating sides.
fn straight(lean: f64) -> Mesh {
    let mut corners = Vec::new();
    let mut cells = Vec::new();
    for i in 0..=CELLS {
        let offset = match i {
            0 | CELLS => 0.0,
            _ if i % 2 == 1 => lean,
            _ => -lean,
        };
        for [y, z] in [[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.0, 0.1]] {
            corners.push([i as f64 + if y == 0.0 { offset } else { -offset }, y, z]);
        }
        if i > 0 {
            let (a, b) = (4 * (i - 1), 4 * i);
            cells.push([a, b, b + 1, a + 1, a + 3, b + 3, b + 2, a + 2]);
        }
    }
    quadratic(&corners, &cells).unwrap()
}

/// Quarter circle from the root in the plane x = 0 to the tip in the plane y = 0.
fn curved() -> Mesh {
    let flat = boxes(&lines(0.0, 1.0, CELLS), &[4.12, 4.32], &[0.0, 0.1]).unwrap();
    mapped(&flat, |[s, r, z]| {
        let (sine, cosine) = if s == 1.0 {
            (1.0, 0.0)
        } else {
            (s * FRAC_PI_2).sin_cos()
        };
        [r * sine, r * cosine, z]
    })
    .unwrap()
}

/// Along x, the section turned by a quarter from the root, where its width lies in y, to the tip, where it lies in z.
fn twisted(cells: usize) -> Mesh {
    let section = [[-0.55, 0.55], [-0.16, 0.16]];
    let flat = boxes(&lines(0.0, 12.0, cells), &section[0], &section[1]).unwrap();
    mapped(&flat, |[x, y, z]| {
        let (sine, cosine) = (x / 12.0 * FRAC_PI_2).sin_cos();
        [x, y * cosine - z * sine, y * sine + z * cosine]
    })
    .unwrap()
}

fn model(mesh: Mesh, poisson: f64, rule: HexRule) -> Model {
    of_stiffness(1e7, mesh, poisson, rule)
}

fn of_stiffness(young: f64, mesh: Mesh, poisson: f64, rule: HexRule) -> Model {
    let elements = hexahedra(&mesh, rule, &elastic(young, poisson).unwrap()).unwrap();
    Model::new(mesh, elements).unwrap()
}

/// Mean displacement of the tip along the unit force, with the root (`plane` x = 0) clamped.
fn tip(model: &Model, tip: impl Fn([f64; 3]) -> bool + Copy, direction: [f64; 3]) -> f64 {
    tip_of_section(0.2 * 0.1, model, tip, direction)
}

/// The same of a section of another area.
fn tip_of_section(
    area: f64,
    model: &Model,
    tip: impl Fn([f64; 3]) -> bool + Copy,
    direction: [f64; 3],
) -> f64 {
    let mut conditions = Conditions::new(model);
    hold(model, &mut conditions, &Dof::DISPLACEMENTS, |x| x[0] == 0.0).unwrap();
    let traction = Vector3::from(direction) / area;
    push_faces(model, &mut conditions, tip, |_| traction).unwrap();
    let u = DenseModel::new(model, &conditions)
        .unwrap()
        .solve(&conditions);
    let nodes = nodes_where(model.mesh(), tip);
    let along = |&n: &usize| -> f64 {
        let dofs = Dof::DISPLACEMENTS.into_iter().zip(direction);
        dofs.map(|(dof, d)| d * u[model.dof(n, dof).unwrap()]).sum()
    };
    nodes.iter().map(along).sum::<f64>() / nodes.len() as f64
}

/// Protects against locking in slender and trapezoidal cells. Targets: extension 3e-5, in-plane 0.1081, out-of-plane
/// 0.4321 times the ratios below.
#[test]
fn straight_beams() {
    for (lean, rule, ratios) in [
        (0.0, HexRule::Full, [0.994, 0.970, 0.961]),
        (0.0, HexRule::Reduced, [0.999, 0.984, 0.972]),
        (0.1, HexRule::Full, [0.994, 0.886, 0.920]),
        (0.1, HexRule::Reduced, [0.999, 0.964, 0.965]),
    ] {
        let model = model(straight(lean), 0.3, rule);
        for (k, theory) in [3e-5, 0.1081, 0.4321].into_iter().enumerate() {
            let mut direction = [0.0; 3];
            direction[k] = 1.0;
            let ratio = tip(&model, |x| x[0] == 6.0, direction) / theory;
            let cells = if lean == 0.0 {
                "straight"
            } else {
                "trapezoidal"
            };
            let load = ["extension", "in-plane", "out-of-plane"][k];
            within(
                &format!("EL-04: {cells}, {load}, {rule:?}, over theory"),
                ratio,
                ratios[k],
                1e-3,
            );
        }
    }
}

/// Protects curved edges. Targets: in-plane 0.08734, out-of-plane 0.5022 times the ratios below.
#[test]
fn curved_beams() {
    for (rule, in_plane, out_of_plane) in [
        (HexRule::Full, 0.875, 0.930),
        (HexRule::Reduced, 1.006, 0.943),
    ] {
        let model = model(curved(), 0.25, rule);
        let end = |x: [f64; 3]| x[1] == 0.0;
        let ratio = tip(&model, end, [1.0, 0.0, 0.0]) / 0.08734;
        within(
            &format!("EL-04: curved, in-plane, {rule:?}, over theory"),
            ratio,
            in_plane,
            1e-3,
        );
        let ratio = tip(&model, end, [0.0, 0.0, 1.0]) / 0.5022;
        within(
            &format!("EL-04: curved, out-of-plane, {rule:?}, over theory"),
            ratio,
            out_of_plane,
            1e-3,
        );
    }
}

/// Protects warped cells: 12 x 1.1 x 0.32, E = 29e6, Poisson's ratio 0.22, twisted by 90 degrees. Targets: force along the width of the
/// tip (in-plane) 0.005424, across (out-of-plane) 0.001754. In 12 cells within 1.2 %, and the ratios that were measured within
/// 0.001; in 24 cells within 0.5 %. The catalogue has ratios of another program only, 1.017 in plane and 1.052 out of
/// plane with hexahedra of 20 nodes, for a mesh it does not state: they lie on the other side of theory.
#[test]
fn twisted_beams() {
    let theory = [0.005_424, 0.001_754];
    for (cells, rule, ratios) in [
        (12, HexRule::Full, [0.9894, 0.9945]),
        (12, HexRule::Reduced, [0.9936, 0.9976]),
        (24, HexRule::Full, [0.9955, 0.9976]),
        (24, HexRule::Reduced, [0.9984, 0.9983]),
    ] {
        let model = of_stiffness(29e6, twisted(cells), 0.22, rule);
        let end = |x: [f64; 3]| x[0] == 12.0;
        let allowed = if cells == 12 { 0.012 } else { 0.005 };
        for (k, load) in ["in-plane", "out-of-plane"].into_iter().enumerate() {
            let direction = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]][k];
            let ratio = tip_of_section(1.1 * 0.32, &model, end, direction) / theory[k];
            assert!((ratio - 1.0).abs() < allowed, "{cells} {rule:?}: {ratio}");
            let id = if cells == 12 { "EL-04: " } else { "" };
            let what = format!("{id}twisted, {cells} cells, {load}, {rule:?}, over theory");
            within(&what, ratio, ratios[k], 1e-3);
        }
    }
}

/// The straight beam with 8 points has mechanisms although its tip displacement looks right: the solver refuses it.
#[test]
fn the_mechanisms_of_the_straight_beam_are_reported() {
    let model = model(straight(0.0), 0.3, HexRule::Reduced);
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &Dof::DISPLACEMENTS, |x| {
        x[0] == 0.0
    })
    .unwrap();
    let found = DenseModel::new(&model, &conditions).unwrap().mechanisms();
    counted("mechanisms of the straight beam, Reduced", found, CELLS);
    let refused = solve(&model, conditions);
    assert!(
        matches!(refused, Err(SolverError::Singular { .. })),
        "{refused:?}"
    );
}
