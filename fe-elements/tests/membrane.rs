//! Protects the membrane in space: constant strain on a distorted oblique cell, fibres along the right direction of the
//! structure, refusal of axes and cells that cannot be.

use std::sync::Arc;

use approx::assert_relative_eq;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::kinematics::PlaneStress;
use fe_core::material::{Material, Operator};
use fe_core::shape::quad8;
use fe_elements::{Membrane8, Quad8, QuadRule};
use fe_materials::{Elastic, Lamina, LaminaParameters, Laminate, Ply};
use nalgebra::{Matrix3, Rotation3, Vector3};

const RULES: [QuadRule; 2] = [QuadRule::Reduced, QuadRule::Full];

fn lamina() -> Lamina {
    Lamina::new(&LaminaParameters {
        young_1_mpa: 228e3,
        young_2_mpa: 10e3,
        shear_mpa: 5e3,
        poisson_12: 0.3,
        strength_mpa: 3790.0,
    })
    .unwrap()
}

fn build(
    coords: &[[f64; 3]; 8],
    rule: QuadRule,
    axis: [f64; 3],
    law: Arc<dyn Material<PlaneStress>>,
) -> Result<Membrane8, ElementError> {
    Membrane8::new(std::array::from_fn(|a| a), coords, 0.5, rule, axis, law)
}

/// Displacements u = H x of the nodes.
fn linear_field(coords: &[[f64; 3]; 8], h: &Matrix3<f64>) -> Vec<f64> {
    let u = coords.iter().map(|x| h * Vector3::from(*x));
    u.flat_map(|u| [u.x, u.y, u.z]).collect()
}

/// Twice the energy (N mm) of displacements: u . f(u).
fn work(element: &Membrane8, u: &[f64]) -> f64 {
    let mut force = vec![0.0; 24];
    let out = ElementSystem {
        force: &mut force,
        stiffness: &mut [],
    };
    let ctx = EvaluationContext::new(Operator::None);
    element.evaluate(u, &[], &mut [], &ctx, out).unwrap();
    force.iter().zip(u).map(|(f, u)| f * u).sum()
}

/// Patch test of one cell with curved edges in an oblique plane: any linear field of displacements in space gives the
/// strain e_a . sym(H) e_b in the material axes at every point. Target: 1e-12 relative.
#[test]
fn a_linear_field_gives_its_strain_in_material_axes() {
    let turn = Rotation3::from_euler_angles(0.4, -0.7, 1.1);
    let place =
        |[x, y]: [f64; 2]| turn * Vector3::new(40.0 * x + 5.0 * x * y, 30.0 * y + 4.0 * x * x, 0.0);
    let coords = quad8::NODES.map(|xi| place(xi).into());
    let h = 1e-3 * Matrix3::new(1.0, 0.4, -0.3, 0.7, -0.8, 0.2, 0.5, 0.9, 0.6);
    let u = linear_field(&coords, &h);
    let normal = turn * Vector3::z();
    let axis = Vector3::new(1.0, 0.5, -2.0);
    let first = (axis - axis.dot(&normal) * normal).normalize();
    let second = normal.cross(&first);
    let e = 0.5 * (h + h.transpose());
    let expected = [
        first.dot(&(e * first)),
        second.dot(&(e * second)),
        2.0 * first.dot(&(e * second)),
    ];
    for rule in RULES {
        let element = build(&coords, rule, axis.into(), Arc::new(lamina())).unwrap();
        let mut points = 0;
        let mut area = 0.0;
        let mut visit = |p: fe_core::element::PointSample<'_>| {
            for (found, target) in p.strain.iter().zip(expected) {
                assert!((found - target).abs() < 1e-12 * h.amax());
            }
            assert!(normal.dot(&Vector3::from(p.position)).abs() < 1e-12);
            points += 1;
            area += p.volume / 0.5;
        };
        element.sample(&u, &[], &mut visit).unwrap();
        assert_eq!(points, if rule == QuadRule::Full { 9 } else { 4 });
        // |J| = (40 + 5 y)(30) - (5 x)(8 x) over the square.
        assert_relative_eq!(area, 4800.0 - 160.0 / 3.0, max_relative = 1e-12);
    }
}

/// One ply of 0.5 mm at `angle_deg` on a square of 20 mm with corner at the origin, spanned by `along` and `across`:
/// stiffness of a stretch by the strain 1 in the direction `stretch`, the strain across it held (MPa).
fn stiffness(sides: [[f64; 3]; 2], axis: [f64; 3], angle_deg: f64, stretch: [f64; 3]) -> f64 {
    let [along, across] = sides.map(Vector3::from);
    let coords =
        quad8::NODES.map(|[x, y]| (10.0 * ((1.0 + x) * along + (1.0 + y) * across)).into());
    let ply = Ply {
        lamina: lamina(),
        angle_deg,
        thickness_mm: 0.5,
    };
    let law = Arc::new(Laminate::new(vec![ply]).unwrap());
    let element = build(&coords, QuadRule::Reduced, axis, law).unwrap();
    let s = Vector3::from(stretch).normalize();
    work(&element, &linear_field(&coords, &(s * s.transpose()))) / (400.0 * 0.5)
}

/// A vertical side face of a beam along x (normal -z and +z, axis 1 along the beam) and its soffit (normal -y, axis 1
/// across the beam): plies at 0, 90 and 45 degrees are stiff along their fibres and soft across.
///
/// Source: fibre angles count from axis 1 towards axis 2 = n x axis 1. Target: Q11 along the fibres, Q22 across, of
/// the sheet; rounding.
#[test]
fn fibres_lie_where_the_angle_says() {
    let q = *lamina().stiffness();
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let front = [x, y]; // normal z, axis 2 = y
    let back = [y, x]; // normal -z, axis 2 = -y
    let soffit = [x, z]; // normal -y, axis 1 = z gives axis 2 = -y x z = -x
    let cases = [
        (front, x, 0.0, x, y),
        (front, x, 90.0, y, x),
        (front, x, 45.0, [1.0, 1.0, 0.0], [1.0, -1.0, 0.0]),
        (back, x, 90.0, y, x),
        (back, x, 45.0, [1.0, -1.0, 0.0], [1.0, 1.0, 0.0]),
        (soffit, z, 0.0, z, x),
        (soffit, z, 90.0, x, z),
        (soffit, z, 45.0, [-1.0, 0.0, 1.0], [1.0, 0.0, 1.0]),
        (soffit, [1.0, 5.0, 0.0], 0.0, x, z),
    ];
    for (sides, axis, angle, fibres, across) in cases {
        let found = [fibres, across].map(|s| stiffness(sides, axis, angle, s));
        assert_relative_eq!(found[0], q[(0, 0)], max_relative = 1e-12);
        assert_relative_eq!(found[1], q[(1, 1)], max_relative = 1e-12);
    }
}

/// A cylindrical cell of radius R = 100 mm, length 40 mm and opening angle 0.4: a widening w of the radius stretches the
/// hoop by w/R. Targets: mean hoop strain of 9 points within 1e-3 (the cell is no exact cylinder), none along the axis.
#[test]
fn a_curved_cell_stretches_around() {
    let coords = quad8::NODES.map(|[x, y]| {
        let (s, c) = (0.2 * y).sin_cos();
        [20.0 * x, 100.0 * s, 100.0 * c]
    });
    let element = build(&coords, QuadRule::Full, [1.0, 0.0, 0.0], Arc::new(lamina())).unwrap();
    let u: Vec<f64> = coords
        .iter()
        .flat_map(|x| [0.0, 1e-3 * x[1], 1e-3 * x[2]])
        .collect();
    let (mut hoop, mut volume) = (0.0, 0.0);
    let mut visit = |p: fe_core::element::PointSample<'_>| {
        assert!(p.strain[0].abs() < 1e-15 && p.strain[2].abs() < 1e-15);
        hoop += p.strain[1] * p.volume;
        volume += p.volume;
    };
    element.sample(&u, &[], &mut visit).unwrap();
    assert_relative_eq!(hoop / volume, 1e-3, max_relative = 1e-3);
    assert_relative_eq!(volume, 0.5 * 40.0 * 40.0, max_relative = 1e-3);
}

/// An axis 1 normal to the surface, no axis, a folded cell, a thickness of zero.
#[test]
fn impossible_membranes_are_refused() {
    let flat = quad8::NODES.map(|[x, y]| [10.0 * x, 10.0 * y, 0.0]);
    let law = || Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
    for axis in [
        [0.0, 0.0, 1.0],
        [0.01, 0.0, -1.0],
        [0.0; 3],
        [f64::NAN, 0.0, 0.0],
    ] {
        let error = build(&flat, QuadRule::Full, axis, law()).unwrap_err();
        assert!(matches!(error, ElementError::Input { .. }), "{error}");
        assert!(error.to_string().contains("axis 1"), "{error}");
    }
    build(&flat, QuadRule::Full, [0.02, 0.0, -1.0], law()).unwrap();
    let mut folded = flat;
    folded[2] = [-30.0, -30.0, 0.0];
    let refused = build(&folded, QuadRule::Full, [1.0, 0.0, 0.0], law());
    assert!(matches!(refused, Err(ElementError::Jacobian { .. })));
    let axis = [1.0, 0.0, 0.0];
    let nodes = std::array::from_fn(|a| a);
    let thin = Membrane8::new(nodes, &flat, 0.0, QuadRule::Full, axis, law());
    assert!(matches!(thin, Err(ElementError::Input { .. })));
}

/// Two corners of one edge exchanged are refused whatever the rule sees, in space and in the plane.
#[test]
fn exchanged_corners_are_refused() {
    for a in 0..4 {
        let mut flat = quad8::NODES.map(|[x, y]| [30.0 * x, 20.0 * y]);
        flat.swap(a, (a + 1) % 4);
        let folded = |error| matches!(error, ElementError::Jacobian { .. });
        for rule in RULES {
            let coords = flat.map(|[x, y]| [x, y, 0.0]);
            let membrane = build(&coords, rule, [1.0, 0.0, 0.0], Arc::new(lamina()));
            assert!(folded(membrane.unwrap_err()), "{a} {rule:?}");
            let nodes = std::array::from_fn(|n| n);
            let plane = Quad8::new(nodes, &flat, 0.5, rule, Arc::new(lamina()));
            assert!(folded(plane.unwrap_err()), "{a} {rule:?}");
        }
    }
}
