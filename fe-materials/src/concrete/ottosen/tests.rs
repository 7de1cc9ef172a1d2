//! Protects the calibration, value and derivatives of the surface.

use approx::assert_relative_eq;
use fe_core::testing::{Worst, curve, within};
use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};
use proptest::prelude::*;

use super::{Calibration, Ottosen};
use crate::concrete::ConcreteScalars;

fn of_fck(fck: f64) -> Ottosen {
    let p = ConcreteScalars::from_characteristic(fck).unwrap();
    Ottosen::new(&Calibration::model_code(p.fcm_mpa, p.fctm_mpa)).unwrap()
}

/// The points of benchmark MAT-02: ft = k fc, fb = 1.16 fc, and xi = -5 fc, rho = 4 fc on the compressive
/// meridian (xi = I1/sqrt3, rho = sqrt(2 J2)).
fn textbook(k: f64) -> Ottosen {
    let root3 = 3.0_f64.sqrt();
    Ottosen::new(&Calibration {
        compression: 1.0,
        tension: k,
        biaxial: 1.16,
        octahedral_normal: -5.0 / root3,
        octahedral_shear: 4.0 / root3,
    })
    .unwrap()
}

/// Target: F = fc at the four calibration points to 1e-10, for the four concretes of the beams.
#[test]
fn the_four_calibration_points_lie_on_the_surface() {
    let mut worst = Worst::new(
        "MAT-02: calibration points on the surface, relative error",
        1e-10,
    );
    for fck in [19.3, 27.5, 20.5, 50.0] {
        let p = ConcreteScalars::from_characteristic(fck).unwrap();
        let points = Calibration::model_code(p.fcm_mpa, p.fctm_mpa);
        let surface = Ottosen::new(&points).unwrap();
        // Compressive meridian: axial stress below the lateral ones by d, tau_oct = sqrt2/3 d.
        let d = 3.0 / std::f64::consts::SQRT_2 * points.octahedral_shear;
        let x = points.octahedral_normal;
        for s in [
            Vector3::new(-points.compression, 0.0, 0.0),
            Vector3::new(points.tension, 0.0, 0.0),
            Vector3::new(-points.biaxial, -points.biaxial, 0.0),
            Vector3::new(x + d / 3.0, x + d / 3.0, x - 2.0 * d / 3.0),
        ] {
            let f = surface.principal_effective_stress(&s);
            worst.see(f / p.fcm_mpa - 1.0, (fck, s));
        }
    }
    worst.tell();
}

/// Source: table of fib Model Code 2010 parameters, evaluated independently. Target: the printed digits.
#[test]
fn model_code_calibration_gives_the_tabulated_coefficients() {
    let table = [
        (
            19.3,
            [1.099480, 4.065177, 8.138360, 14.814752, 14.838778, 0.985459],
        ),
        (
            27.5,
            [1.681313, 4.246344, 8.116228, 15.066757, 15.081781, 0.991046],
        ),
        (
            20.5,
            [1.177519, 4.086080, 8.129507, 14.836651, 14.859361, 0.986274],
        ),
        (
            50.0,
            [3.431913, 4.865124, 8.177277, 16.107190, 16.107823, 0.999646],
        ),
    ];
    let shear = [153.528, 150.108, 152.874, 151.675];
    let mut worst = Worst::new(
        "coefficients of four concretes against the table, error",
        6e-7,
    );
    for ((fck, expected), tau) in table.into_iter().zip(shear) {
        let p = ConcreteScalars::from_characteristic(fck).unwrap();
        let points = Calibration::model_code(p.fcm_mpa, p.fctm_mpa);
        assert!((points.octahedral_shear - tau).abs() < 6e-4);
        let s = Ottosen::new(&points).unwrap();
        let found = [
            s.alpha(),
            s.beta(),
            s.lambda_c(),
            s.lambda_t(),
            s.c1(),
            s.c2(),
        ];
        for (i, (value, target)) in found.into_iter().zip(expected).enumerate() {
            worst.see(value - target, (fck, i));
        }
    }
    worst.tell();
}

/// Source: Ottosen (1977), table 1, as benchmark MAT-02. Target: the printed digits.
#[test]
fn general_calibration_gives_the_published_parameters() {
    for (k, expected) in [
        (0.08, [1.8074, 4.0962, 14.4861, 0.9914]),
        (0.10, [1.2758, 3.1962, 11.7368, 0.9801]),
        (0.12, [0.9218, 2.5969, 9.9110, 0.9647]),
    ] {
        let s = textbook(k);
        let found = [
            ("a", s.alpha()),
            ("b", s.beta()),
            ("K1", s.c1()),
            ("K2", s.c2()),
        ];
        for ((name, value), target) in found.into_iter().zip(expected) {
            let id = if k == 0.10 { "MAT-02: " } else { "" };
            within(&format!("{id}{name}, ft = {k} fc"), value, target, 6e-5);
        }
    }
}

/// Benchmark MAT-01/02: size of the deviatoric section at t = 0, 30, 60 degrees, hydrostatic apex, and the
/// two-branch form of lambda.
#[test]
fn lambda_and_apex_agree_with_the_two_branch_form() {
    let s = textbook(0.10);
    for (degrees, target) in [(0.0_f64, 11.711), (30.0, 10.164), (60.0, 6.532)] {
        let cos3t = (3.0 * degrees.to_radians()).cos();
        let what = format!("MAT-01: lambda at {degrees} degrees");
        within(&what, s.lambda(cos3t), target, 6e-4);
    }
    let apex = 1.0 / (3.0 * s.beta());
    within("MAT-01: hydrostatic apex over fc", apex, 0.1043, 6e-5);
    assert_relative_eq!(s.principal_effective_stress(&Vector3::repeat(apex)), 1.0);
    let mut worst = Worst::new("lambda against its two branches, relative error", 1e-13);
    for i in -10..=10 {
        let c = f64::from(i) / 10.0;
        let branch = if c >= 0.0 {
            (s.c2() * c).acos() / 3.0
        } else {
            std::f64::consts::FRAC_PI_3 - (-s.c2() * c).acos() / 3.0
        };
        worst.see(s.lambda(c) / (s.c1() * branch.cos()) - 1.0, c);
    }
    worst.tell();
}

/// Source: benchmark MAT-03 (biaxial envelope of Kupfer 1969 and confinement of Richart 1928, as given by
/// this surface). Target: the printed digits.
#[test]
fn biaxial_and_confined_strengths() {
    let s = textbook(0.10);
    let mut points = Vec::new();
    for (ratio, target) in [
        (0.0, 1.000),
        (0.25, 1.352),
        (0.5, 1.376),
        (0.75, 1.295),
        (1.0, 1.160),
    ] {
        let f = s.principal_effective_stress(&Vector3::new(-1.0, -ratio, 0.0));
        let what = format!("MAT-03: strength over fc, stress ratio {ratio}");
        within(&what, 1.0 / f, target, 6e-4);
        points.push([-target, -ratio * target]);
    }
    curve("envelope targets", points);
    let directions = (0..=180).map(|i| (f64::from(2 * i).to_radians()).sin_cos());
    let envelope = directions.map(|(sine, cosine)| {
        let f = s.principal_effective_stress(&Vector3::new(cosine, sine, 0.0));
        [cosine / f, sine / f]
    });
    curve("envelope", envelope);
    for (pressure, target) in [(0.1, 1.67), (0.2, 2.23), (0.5, 3.58), (1.0, 5.36)] {
        let (mut low, mut high) = (pressure, 20.0);
        for _ in 0..60 {
            let axial = 0.5 * (low + high);
            let f = s.principal_effective_stress(&Vector3::new(-axial, -pressure, -pressure));
            if f < 1.0 { low = axial } else { high = axial }
        }
        let what = format!("MAT-03: strength over fc, lateral pressure {pressure} fc");
        within(&what, low, target, 6e-3);
    }
}

/// Protects against silently accepting a surface that is not closed and convex.
#[test]
fn impossible_calibrations_are_refused() {
    let near_limit = |fck: f64| {
        let p = ConcreteScalars::from_characteristic(fck).unwrap();
        Ottosen::new(&Calibration::model_code(p.fcm_mpa, p.fctm_mpa))
    };
    assert!(near_limit(55.0).is_ok());
    let message = near_limit(55.2).unwrap_err().to_string();
    assert!(
        message.contains("lambda_c/lambda_t") && message.contains("55.1"),
        "{message}"
    );
    let good = Calibration::model_code(30.0, 2.5);
    for bad in [
        Calibration {
            compression: f64::NAN,
            ..good
        },
        Calibration {
            compression: -30.0,
            ..good
        },
        Calibration {
            tension: 0.0,
            ..good
        },
        Calibration {
            tension: 31.0,
            ..good
        },
        Calibration {
            biaxial: f64::INFINITY,
            ..good
        },
        Calibration {
            octahedral_normal: 240.0,
            ..good
        },
        Calibration {
            octahedral_shear: 0.0,
            ..good
        },
        Calibration {
            octahedral_shear: 1e4,
            ..good
        },
        Calibration {
            octahedral_shear: 10.0,
            ..good
        },
    ] {
        assert!(Ottosen::new(&bad).is_err(), "{bad:?}");
    }
}

/// Protects the kinks: hydrostatic compression, tension, zero.
#[test]
fn hydrostatic_states() {
    let s = of_fck(27.5);
    let hydrostatic = |p: f64| Vector6::new(p, p, p, 0.0, 0.0, 0.0);
    let (f, g) = s.gradient(&hydrostatic(-1000.0));
    assert_eq!((f, g), (0.0, Vector6::zeros()));
    let (f, g) = s.gradient(&hydrostatic(2.0));
    assert_relative_eq!(f, 6.0 * s.beta());
    assert_relative_eq!(g, hydrostatic(s.beta()));
    assert_eq!(s.effective_stress(&Vector6::zeros()), 0.0);
    // Close to the axis the value must not cancel: F ~ alpha J2/(-beta I1).
    let f = s.principal_effective_stress(&Vector3::new(-1000.0, -1000.0, -1000.001));
    let expected = s.alpha() * 1e-6 / 3.0 / (3000.0 * s.beta());
    assert_relative_eq!(f, expected, max_relative = 1e-4);
}

fn stress() -> impl Strategy<Value = Vector6<f64>> {
    (prop::array::uniform6(-1.0..1.0_f64), -1.0..2.0_f64)
        .prop_map(|(s, size)| Vector6::from(s) * 30.0 * 10.0_f64.powf(size))
}

/// Principal stresses, half of them on or beside a meridian.
fn principal_stress() -> impl Strategy<Value = Vector3<f64>> {
    (
        prop::array::uniform3(-100.0..30.0_f64),
        0..4_u8,
        -9.0..-1.0_f64,
    )
        .prop_map(|(s, kind, gap)| {
            let near = s[0] * (1.0 + 10.0_f64.powf(gap));
            match kind {
                0 => Vector3::new(s[0], near, s[2]),
                1 => Vector3::new(s[0], s[0], s[2]),
                _ => Vector3::from(s),
            }
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// F(k sigma) = k F(sigma) and sigma . dF = F.
    #[test]
    fn homogeneous_of_degree_one(s in stress(), k in 0.01..100.0_f64) {
        let surface = of_fck(27.5);
        let (f, g) = surface.gradient(&s);
        prop_assert!((surface.effective_stress(&(s * k)) - k * f).abs() <= 1e-12 * k * f);
        prop_assert!((g.dot(&s) - f).abs() <= 1e-11 * (g.norm() * s.norm()).max(f));
    }

    /// The bound hides no stress that reaches the limit, not even one at it.
    #[test]
    fn reaches_what_it_is_worth(s in stress(), share in prop::sample::select(vec![0.5, 0.999, 1.0, 1.001, 2.0])) {
        let surface = of_fck(27.5);
        let f = surface.effective_stress(&s);
        prop_assert_eq!(surface.reaches(&s, share * f), f >= share * f);
    }

    /// The gradient of a Voigt stress against central differences, relative 1e-6.
    #[test]
    fn gradient_against_differences(s in stress()) {
        let surface = of_fck(27.5);
        let (_, g) = surface.gradient(&s);
        let step = 1e-5 * s.norm();
        for i in 0..6 {
            let mut d = Vector6::zeros();
            d[i] = step;
            let slope = (surface.effective_stress(&(s + d)) - surface.effective_stress(&(s - d)))
                / (2.0 * step);
            prop_assert!((slope - g[i]).abs() <= 1e-6 * g.norm().max(1.0), "{i}: {slope} {}", g[i]);
        }
    }

    /// Value, gradient and Hessian in the principal axes, on and beside the meridians.
    #[test]
    fn principal_derivatives_against_differences(s in principal_stress(), fck in 15.0..50.0_f64) {
        let surface = of_fck(fck);
        let spread = s.max() - s.min();
        prop_assume!(spread > 1e-2 * s.amax());
        let (f, g, h) = surface.principal_derivatives(&s);
        prop_assert_eq!(f, surface.principal_effective_stress(&s));
        let voigt = Vector6::new(s[0], s[1], s[2], 0.0, 0.0, 0.0);
        let general = surface.gradient(&voigt).1;
        prop_assert!((general.fixed_rows::<3>(0) - g).norm() <= 1e-10 * g.norm().max(1.0));
        let step = 1e-6 * spread;
        let slopes = Matrix3::from_fn(|i, j| {
            let mut d = Vector3::zeros();
            d[j] = step;
            let ahead = surface.principal_derivatives(&(s + d)).1[i];
            (ahead - surface.principal_derivatives(&(s - d)).1[i]) / (2.0 * step)
        });
        prop_assert!((slopes - h).norm() <= 1e-4 * h.norm() , "{slopes} {h}");
    }

    /// Subadditive, hence convex for a homogeneous function; concretes over the whole admitted range.
    #[test]
    fn convex(a in stress(), b in stress(), fck in 12.0..55.0_f64) {
        let surface = of_fck(fck);
        let (fa, fb) = (surface.effective_stress(&a), surface.effective_stress(&b));
        prop_assert!(surface.effective_stress(&(a + b)) <= (fa + fb) * (1.0 + 1e-10));
    }

    /// The value does not depend on the axes.
    #[test]
    fn isotropic(s in stress(), axis in prop::array::uniform3(-3.0..3.0_f64)) {
        let surface = of_fck(27.5);
        let r = Rotation3::from_scaled_axis(Vector3::from(axis)).into_inner();
        let rotated = fe_core::voigt::stress_voigt(
            &(r * fe_core::voigt::stress_tensor(&s) * r.transpose()),
        );
        let f = surface.effective_stress(&s);
        prop_assert!((surface.effective_stress(&rotated) - f).abs() <= 1e-11 * f.max(s.norm()));
    }
}
