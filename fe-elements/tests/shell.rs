//! Protects the layered shell: stiffness of a stack of plies, refusal of sections and cells that cannot be.

use std::f64::consts::FRAC_PI_6;
use std::sync::Arc;

use approx::assert_relative_eq;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::material::Operator;
use fe_core::shape::quad8;
use fe_elements::{Layer, QuadRule, Shell8, ShellSection};
use fe_materials::{Lamina, LaminaParameters};
use nalgebra::{Matrix3, Rotation3, Vector3};

const RULES: [QuadRule; 2] = [QuadRule::Reduced, QuadRule::Full];
const AREA: f64 = 40.0 * 30.0;

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

/// An unsymmetric stack: angle (degrees) and thickness (mm) from the bottom.
const STACK: [(f64, f64); 3] = [(30.0, 0.4), (-70.0, 0.7), (90.0, 0.2)];

fn section() -> ShellSection {
    let layer = |(angle_deg, thickness_mm)| Layer {
        thickness_mm,
        angle_deg,
        law: Arc::new(lamina()),
        shear_mpa: [5e3, 3e3],
    };
    ShellSection::new(STACK.map(layer).to_vec())
}

/// A rectangle of 40 mm x 30 mm in an oblique plane; axis 1 of the shell is 30 degrees off its side.
struct Plate {
    turn: Rotation3<f64>,
    coords: [[f64; 3]; 8],
}

impl Plate {
    fn new() -> Self {
        let turn = Rotation3::from_euler_angles(0.4, -0.7, 1.1);
        let coords =
            quad8::NODES.map(|[x, y]| (turn * Vector3::new(20.0 * x, 15.0 * y, 0.0)).into());
        Self { turn, coords }
    }

    fn shell(&self, rule: QuadRule) -> Shell8 {
        let axis = self.turn * Vector3::new(FRAC_PI_6.cos(), FRAC_PI_6.sin(), 0.3);
        let nodes = std::array::from_fn(|a| a);
        Shell8::new(nodes, &self.coords, &section(), rule, axis.into()).unwrap()
    }

    /// DOFs of displacements and rotations given in the axes of the shell.
    fn field(&self, field: impl Fn(f64, f64) -> [Vector3<f64>; 2]) -> Vec<f64> {
        let axes = self.turn * Rotation3::from_axis_angle(&Vector3::z_axis(), FRAC_PI_6);
        let motion = |x: &[f64; 3]| {
            let local = axes.inverse() * Vector3::from(*x);
            let [u, turn] = field(local.x, local.y).map(|v| axes * v);
            [u.x, u.y, u.z, turn.x, turn.y, turn.z]
        };
        self.coords.iter().flat_map(motion).collect()
    }
}

fn work(element: &Shell8, u: &[f64]) -> f64 {
    let mut force = vec![0.0; 48];
    let out = ElementSystem {
        force: &mut force,
        stiffness: &mut [],
    };
    let ctx = EvaluationContext::new(Operator::None);
    element.evaluate(u, &[], &mut [], &ctx, out).unwrap();
    force.iter().zip(u).map(|(f, u)| f * u).sum()
}

/// Strain transformation into axes at an angle.
fn transform(angle_deg: f64) -> Matrix3<f64> {
    let (s, c) = angle_deg.to_radians().sin_cos();
    let (cc, ss, cs) = (c * c, s * s, c * s);
    Matrix3::new(cc, ss, cs, ss, cc, -cs, -2.0 * cs, 2.0 * cs, cc - ss)
}

/// Membrane, coupling and bending stiffness A, B, D of the stack.
fn laminate() -> [Matrix3<f64>; 3] {
    let mut bottom = -0.5 * STACK.iter().map(|ply| ply.1).sum::<f64>();
    let mut abd = [Matrix3::zeros(); 3];
    for (angle, t) in STACK {
        let (top, m) = (bottom + t, transform(angle));
        let q = m.transpose() * lamina().stiffness() * m;
        abd[0] += q * t;
        abd[1] += q * (top * top - bottom * bottom) / 2.0;
        abd[2] += q * (top.powi(3) - bottom.powi(3)) / 3.0;
        bottom = top;
    }
    abd
}

/// Energy of constant membrane strain e and curvature k of an unsymmetric stack.
///
/// Source: R. M. Jones, "Mechanics of Composite Materials", 2nd ed. (1999), section 4.2.3: per area
/// (e.A e + 2 e.B k + k.D k)/2. Target: 1e-10.
#[test]
fn stack_has_the_stiffness_of_laminate_theory() {
    let [a, b, d] = laminate();
    let plate = Plate::new();
    let (e, k): (Vector3<f64>, Vector3<f64>) = (
        1e-3 * Vector3::new(1.0, -0.6, 0.7),
        1e-3 * Vector3::new(0.8, 1.1, -0.9),
    );
    for (e, k) in [(e, Vector3::zeros()), (Vector3::zeros(), k), (e, k)] {
        // theta_y,_x = k1, -theta_x,_y = k2, theta_y,_y - theta_x,_x = k12; no transverse shear: theta = (w,_y, -w,_x).
        let u = plate.field(|x, y| {
            let w = -0.5 * (k[0] * x * x + k[1] * y * y + k[2] * x * y);
            let in_plane = [e[0] * x + 0.5 * e[2] * y, e[1] * y + 0.5 * e[2] * x];
            [
                Vector3::new(in_plane[0], in_plane[1], w),
                Vector3::new(-k[1] * y - 0.5 * k[2] * x, k[0] * x + 0.5 * k[2] * y, 0.0),
            ]
        });
        let expected = AREA * (e.dot(&(a * e)) + 2.0 * e.dot(&(b * k)) + k.dot(&(d * k)));
        for rule in RULES {
            let shell = plate.shell(rule);
            assert_relative_eq!(work(&shell, &u), expected, max_relative = 1e-10);
            let energy = shell.free_energy(&u, &[]).unwrap().unwrap();
            assert_relative_eq!(2.0 * energy, expected, max_relative = 1e-10);
            let (mut volume, mut points) = (0.0, 0);
            let mut visit = |p: PointSample<'_>| {
                let z = plate.turn.inverse() * Vector3::from(p.position);
                let layer = points * STACK.len() / shell_points(rule);
                let target = transform(STACK[layer].0) * (e + z.z * k);
                assert!((Vector3::from_column_slice(p.strain) - target).amax() < 1e-14);
                volume += p.volume;
                points += 1;
            };
            shell.sample(&u, &[], &mut visit).unwrap();
            assert_eq!(points, shell_points(rule));
            assert_relative_eq!(volume, AREA * 1.3, max_relative = 1e-12);
        }
    }
}

/// Three layers of two levels of 4 or 9 points.
const fn shell_points(rule: QuadRule) -> usize {
    match rule {
        QuadRule::Reduced => 24,
        QuadRule::Full => 54,
    }
}

/// Energy of a uniform transverse shear strain: 5/6 sum t_k (G13 c_k^2 + G23 s_k^2) for shear along axis 1. Target: 1e-12.
#[test]
fn transverse_shear_follows_the_plies() {
    let plate = Plate::new();
    let g: f64 = STACK
        .iter()
        .map(|(angle, t)| {
            let (s, c) = angle.to_radians().sin_cos();
            t * (5e3 * c * c + 3e3 * s * s)
        })
        .sum();
    let u = plate.field(|x, _| [Vector3::new(0.0, 0.0, 2e-3 * x), Vector3::zeros()]);
    for rule in RULES {
        let expected = 5.0 / 6.0 * g * 4e-6 * AREA;
        assert_relative_eq!(work(&plate.shell(rule), &u), expected, max_relative = 1e-12);
    }
}

/// Energy of a uniform rotation about the normal of a plate at rest: c times the area, with c = 0.001 sum t (G13 + G23)/2.
/// Target: 1e-12.
#[test]
fn drilling_costs_the_stated_share() {
    let plate = Plate::new();
    let u = plate.field(|_, _| [Vector3::zeros(), Vector3::new(0.0, 0.0, 1e-2)]);
    for rule in RULES {
        let expected = 1e-3 * 1.3 * 4e3 * 1e-4 * AREA;
        assert_relative_eq!(work(&plate.shell(rule), &u), expected, max_relative = 1e-12);
    }
}

/// Sections, axes and cells that cannot be, by the quantity.
#[test]
fn impossible_shells_are_refused() {
    let flat = quad8::NODES.map(|[x, y]| [10.0 * x, 10.0 * y, 0.0]);
    let build = |section: &ShellSection, coords: &[[f64; 3]; 8], axis| {
        Shell8::new(
            std::array::from_fn(|a| a),
            coords,
            section,
            QuadRule::Reduced,
            axis,
        )
    };
    let along = [1.0, 0.0, 0.0];
    build(&section(), &flat, along).unwrap();
    let change = |change: &dyn Fn(&mut ShellSection)| {
        let mut changed = section();
        change(&mut changed);
        changed
    };
    for (quantity, bad) in [
        ("number of layers", change(&|s| s.layers.clear())),
        (
            "thickness_mm of layer 1",
            change(&|s| s.layers[1].thickness_mm = 0.0),
        ),
        (
            "shear_mpa of layer 2",
            change(&|s| s.layers[2].shear_mpa[1] = f64::NAN),
        ),
        (
            "angle_deg of layer 0",
            change(&|s| s.layers[0].angle_deg = f64::NAN),
        ),
        ("points_per_layer", change(&|s| s.points_per_layer = 1)),
        ("points_per_layer", change(&|s| s.points_per_layer = 5)),
        ("shear_correction", change(&|s| s.shear_correction = 0.0)),
        ("drilling", change(&|s| s.drilling = 0.0)),
    ] {
        match build(&bad, &flat, along).unwrap_err() {
            ElementError::Input { what, .. } => assert_eq!(what, quantity),
            other => panic!("{quantity}: {other}"),
        }
    }
    let upright = build(&section(), &flat, [0.0, 0.0, 1.0]).unwrap_err();
    assert!(upright.to_string().contains("axis 1"), "{upright}");
    // A stack thicker than the radius of its surface turns inside out.
    let thick = change(&|s| s.layers[0].thickness_mm = 120.0);
    let bent = quad8::NODES.map(|[x, y]| {
        let (s, c) = (0.5 * y).sin_cos();
        [10.0 * x, 20.0 * s, 20.0 * c]
    });
    build(&section(), &bent, along).unwrap();
    let refused = build(&thick, &bent, along).err();
    assert!(
        matches!(refused, Some(ElementError::Jacobian { .. })),
        "{refused:?}"
    );
}
