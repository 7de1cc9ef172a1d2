//! SH-02: thin curved shells.
//!
//! Source: R. H. MacNeal and R. L. Harder, "A proposed standard set of problems to test finite element accuracy", Finite
//! Elements in Analysis and Design 1 (1985) 3-20: Scordelis-Lo roof, deflection of the middle of the free edge 0.3024;
//! hemisphere with a hole of 18 degrees, displacement under the force 0.094. Pinched cylinder with end diaphragms,
//! displacement under the force 1.8248e-5: T. Belytschko et al., "Stress projection for membrane and shear locking in shell
//! finite elements", Comput. Methods Appl. Mech. Eng. 51 (1985) 221-258.

use fe_core::dof::Dof::{Rx, Ry, Rz, Ux, Uy, Uz};
use fe_core::mesh::NodeId;
use fe_core::model::{Conditions, Model};
use fe_core::testing::{Worst, between, curve, within_share};
use fe_elements::{QuadRule, ShellSection};
use fe_tests::mesh::{nodes_where, surface};
use fe_tests::shell::{hold_where, isotropic, push_area, shells};
use fe_tests::solve::solve_to;

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-6
}

fn node_at(model: &Model, place: [f64; 3]) -> NodeId {
    nodes_where(model.mesh(), |x| (0..3).all(|k| near(x[k], place[k])))[0]
}

fn model(
    n: usize,
    section: &ShellSection,
    rule: QuadRule,
    axis: [f64; 3],
    map: impl Fn(f64, f64) -> [f64; 3],
) -> Model {
    let mesh = surface([n, n], map).unwrap();
    let elements = shells(&mesh, section, rule, axis).unwrap();
    Model::new(mesh, elements).unwrap()
}

/// A cylinder along x from the middle x = 0, generator at `angle` (radians, 0 to `opening`) from the z axis.
fn cylinder(radius: f64, half: f64, opening: f64) -> impl Fn(f64, f64) -> [f64; 3] {
    move |s, t| {
        let (sine, cosine) = (opening * t).sin_cos();
        [half * s, radius * sine, radius * cosine]
    }
}

/// A quarter of the roof: radius 25, length 50, opening 80 degrees, thickness 0.25, E = 4.32e8, nu = 0, 90 per area.
fn scordelis_lo(n: usize, rule: QuadRule, drilling: f64) -> f64 {
    let opening = 40.0_f64.to_radians();
    let section = ShellSection {
        drilling,
        ..isotropic(4.32e8, 0.0, 0.25)
    };
    let map = cylinder(25.0, 25.0, opening);
    let edge = map(0.0, 1.0);
    let model = model(n, &section, rule, [1.0, 0.0, 0.0], map);
    let mut conditions = Conditions::new(&model);
    hold_where(&model, &mut conditions, |x, dof| {
        (near(x[0], 25.0) && matches!(dof, Uy | Uz))
            || (near(x[0], 0.0) && matches!(dof, Ux | Ry | Rz))
            || (near(x[1], 0.0) && matches!(dof, Uy | Rx | Rz))
    })
    .unwrap();
    push_area(&model, &mut conditions, [0.0, 0.0, -90.0]).unwrap();
    let solution = solve_to(1e-6, &model, conditions).unwrap();
    -solution.at(&model, node_at(&model, edge), Uz) / 0.3024
}

/// A quarter of the hemisphere: radius 10, thickness 0.04, E = 6.825e7, nu = 0.3, forces of 2 at four points of the
/// equator, alternating in sense; half of each on the quarter.
fn hemisphere(n: usize, rule: QuadRule, drilling: f64) -> f64 {
    let section = ShellSection {
        drilling,
        ..isotropic(6.825e7, 0.3, 0.04)
    };
    let model = model(n, &section, rule, [0.0, 0.0, 1.0], |s, t| {
        let (sine, cosine) = (s * 90.0_f64.to_radians()).sin_cos();
        let (height, radius) = (t * 72.0_f64.to_radians()).sin_cos();
        [10.0 * cosine * radius, 10.0 * sine * radius, 10.0 * height]
    });
    let [a, b] = [[10.0, 0.0, 0.0], [0.0, 10.0, 0.0]].map(|x| node_at(&model, x));
    let mut conditions = Conditions::new(&model);
    hold_where(&model, &mut conditions, |x, dof| {
        (near(x[1], 0.0) && matches!(dof, Uy | Rx | Rz))
            || (near(x[0], 0.0) && matches!(dof, Ux | Ry | Rz))
    })
    .unwrap();
    conditions.fix(&model, a, Uz).unwrap();
    conditions.add_reference(&model, a, Ux, 1.0).unwrap();
    conditions.add_reference(&model, b, Uy, -1.0).unwrap();
    let solution = solve_to(1e-6, &model, conditions).unwrap();
    solution.at(&model, a, Ux) / 0.094
}

/// An eighth of the cylinder: radius 300, length 600, thickness 3, E = 3e6, nu = 0.3, two opposite unit forces; ends held
/// in their plane.
fn pinched_cylinder(n: usize, rule: QuadRule, drilling: f64) -> f64 {
    let section = ShellSection {
        drilling,
        ..isotropic(3e6, 0.3, 3.0)
    };
    let map = cylinder(300.0, 300.0, std::f64::consts::FRAC_PI_2);
    let model = model(n, &section, rule, [1.0, 0.0, 0.0], map);
    let mut conditions = Conditions::new(&model);
    hold_where(&model, &mut conditions, |x, dof| {
        (near(x[0], 300.0) && matches!(dof, Uy | Uz))
            || (near(x[0], 0.0) && matches!(dof, Ux | Ry | Rz))
            || (near(x[1], 0.0) && matches!(dof, Uy | Rx | Rz))
            || (near(x[2], 0.0) && matches!(dof, Uz | Rx | Ry))
    })
    .unwrap();
    let top = node_at(&model, [0.0, 0.0, 300.0]);
    conditions.add_reference(&model, top, Uz, -0.25).unwrap();
    let solution = solve_to(1e-6, &model, conditions).unwrap();
    -solution.at(&model, top, Uz) / 1.8248e-5
}

/// Ratio to the target with n x n elements.
type Case = fn(usize, QuadRule, f64) -> f64;

/// Elements per side and allowed share by which the displacement may miss its target.
type Tolerances = [(usize, f64)];

#[track_caller]
fn assert_meets(name: &str, case: Case, rule: QuadRule, tolerances: &Tolerances) {
    let mut path = Vec::new();
    for &(n, tolerance) in tolerances {
        let id = if n == 16 { "SH-02: " } else { "" };
        let ratio = case(n, rule, 1e-3);
        let what = format!("{id}{name} over the target, {n} x {n}, {rule:?}");
        within_share(&what, ratio, 1.0, tolerance);
        path.push([1.0 / n as f64, ratio]);
    }
    curve(name, path);
}

/// Protects against membrane and shear locking, with 2 x 2 points. Targets: roof within 1 % from 2 x 2 elements on, 0.3 %
/// from 4 x 4 on; hemisphere and cylinder within 1 % from 8 x 8 on (16 % and 5 % with 4 x 4).
#[test]
fn reduced_integration_meets_the_targets() {
    let rule = QuadRule::Reduced;
    assert_meets(
        "roof",
        scordelis_lo,
        rule,
        &[(2, 0.01), (4, 3e-3), (8, 3e-3), (16, 3e-3)],
    );
    let tolerances = [(4, 0.16), (8, 0.01), (16, 0.01)];
    assert_meets("hemisphere", hemisphere, rule, &tolerances);
    let tolerances = [(4, 0.05), (8, 0.01), (16, 0.01)];
    assert_meets("cylinder", pinched_cylinder, rule, &tolerances);
}

/// With 3 x 3 points thin curved shells lock on coarse meshes; the displacements tend to the targets all the same: roof
/// within 1 %, cylinder within 2 %, hemisphere within 16 % with 16 x 16 elements, each closer than with 8 x 8.
#[test]
fn full_integration_converges_from_below() {
    let cases: [(&str, Case, f64); 3] = [
        ("roof", scordelis_lo, 0.01),
        ("cylinder", pinched_cylinder, 0.02),
        ("hemisphere", hemisphere, 0.16),
    ];
    for (name, case, tolerance) in cases {
        let [coarse, fine] = [8, 16].map(|n| case(n, QuadRule::Full, 1e-3));
        assert!(coarse < fine, "{coarse:.4}, {fine:.4}");
        let what = format!("{name} over the target, 16 x 16, Full");
        between(&what, fine, [1.0 - tolerance, 1.0]);
    }
}

/// The stiffness against drilling decides nothing: from 1e-5 to 1e-2 of the shear stiffness the displacements of 8 x 8
/// elements stay within 0.1 %.
#[test]
fn drilling_stiffness_does_not_matter() {
    let mut worst = Worst::new("change from 1e-5 to 1e-2 of the shear stiffness", 1e-3);
    for case in [scordelis_lo, hemisphere, pinched_cylinder] {
        let [soft, stiff] = [1e-5, 1e-2].map(|drilling| case(8, QuadRule::Reduced, drilling));
        worst.see(stiff / soft - 1.0, (soft, stiff));
    }
    worst.tell();
}
