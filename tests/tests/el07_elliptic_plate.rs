//! EL-07: thick elliptic plate under a pressure of 1 MPa on its upper face, E = 210 000 MPa, nu = 0.3.
//!
//! Source: NAFEMS, "The Standard NAFEMS Benchmarks" (1990), test LE10: stress yy at D = (2, 0, 0.6) m is -5.38 MPa. Values per
//! mesh: computed independently of this project; "extrapolated" from the 2 x 2 x 2 Gauss points.

use std::f64::consts::FRAC_PI_2;

use fe_core::dof::Dof;
use fe_core::model::{Conditions, Model};
use fe_core::shape::hex20;
use fe_core::testing::{curve, within, within_share};
use fe_elements::HexRule;
use fe_tests::conditions::{hold, push_faces};
use fe_tests::laws::elastic;
use fe_tests::mesh::{boxes, cells, hexahedra, lines, mapped};
use fe_tests::solve::solve;
use fe_tests::stress::ElasticCell;

/// Upper end of the inner edge in the plane y = 0 (mm).
const D: [f64; 3] = [2000.0, 0.0, 300.0];

/// Stress yy at D, of the strain there and extrapolated; cells along the ellipse, across, and through the thickness.
fn stress_at_d([along, across, through]: [usize; 3], rule: HexRule) -> [f64; 2] {
    let unit = |n| lines(0.0, 1.0, n);
    let flat = boxes(&unit(across), &unit(along), &lines(-300.0, 300.0, through)).unwrap();
    // Straight rays between the inner and the outer ellipse, half axes 2 and 1, 3.25 and 2.75 m.
    let mesh = mapped(&flat, |[s, t, z]| {
        let (sine, cosine) = if t == 1.0 {
            (1.0, 0.0)
        } else {
            (t * FRAC_PI_2).sin_cos()
        };
        [
            (2000.0 + 1250.0 * s) * cosine,
            (1000.0 + 1750.0 * s) * sine,
            z,
        ]
    })
    .unwrap();
    let law = elastic(210e3, 0.3).unwrap();
    let elements = hexahedra(&mesh, rule, &law).unwrap();
    let model = Model::new(mesh, elements).unwrap();
    let mut conditions = Conditions::new(&model);
    let rim = |x: [f64; 3]| ((x[0] / 3250.0).hypot(x[1] / 2750.0) - 1.0).abs() < 1e-9;
    hold(&model, &mut conditions, &[Dof::Ux], |x| {
        x[0] == 0.0 || rim(x)
    })
    .unwrap();
    hold(&model, &mut conditions, &[Dof::Uy], |x| {
        x[1] == 0.0 || rim(x)
    })
    .unwrap();
    hold(&model, &mut conditions, &[Dof::Uz], |x| {
        rim(x) && x[2] == 0.0
    })
    .unwrap();
    push_faces(&model, &mut conditions, |x| x[2] == 300.0, |normal| -normal).unwrap();
    let solution = solve(&model, conditions).unwrap();
    for (e, (_, coords)) in cells(model.mesh(), &model.mesh().blocks()[0]).enumerate() {
        if let Some(corner) = coords.iter().position(|&x| x == D) {
            let u = model.gather(e, &solution.displacement);
            let cell = ElasticCell {
                law: law.as_ref(),
                coords,
                u,
            };
            let xi = hex20::NODES[corner];
            return [
                cell.direct(xi).unwrap()[1],
                cell.extrapolated(xi).unwrap()[1],
            ];
        }
    }
    panic!("no cell at D");
}

/// Protects curved thick cells, supports and pressure. Targets: the values per mesh within 0.01 MPa, and -5.38 MPa within
/// 1 % on the finest mesh, extrapolated.
#[test]
fn stress_at_the_inner_edge() {
    let mut paths = [vec![], vec![]];
    for (mesh, full, reduced) in [
        ([3, 2, 2], [-5.18, -5.38], [-6.33, -5.28]),
        ([6, 4, 2], [-5.57, -5.51], [-5.49, -5.42]),
        ([12, 8, 4], [-5.52, -5.41], [-5.51, -5.39]),
    ] {
        for (rule, target) in [(HexRule::Full, full), (HexRule::Reduced, reduced)] {
            let found = stress_at_d(mesh, rule);
            let [a, b, c] = mesh;
            for k in 0..2 {
                let how = ["of the strain there", "extrapolated"][k];
                let what = format!("stress at D (MPa), {a} x {b} x {c}, {rule:?}, {how}");
                within(&what, found[k], target[k], 0.01);
            }
            if a == 12 {
                let what =
                    format!("EL-07: stress at D (MPa), {a} x {b} x {c}, {rule:?}, extrapolated");
                within_share(&what, found[1], -5.38, 0.01);
            }
            paths[usize::from(rule == HexRule::Reduced)].push([1.0 / a as f64, -found[1]]);
        }
    }
    for (path, points) in paths.into_iter().zip(["27 points", "8 points"]) {
        curve(&format!("LE10, {points}"), path);
    }
}
