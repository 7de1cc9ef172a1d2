//! Protects the single-point driver: control of strain and stress, unstable branches, refusals.

mod common;

use common::{Damage, Elastic, Flaw, YOUNG};
use fe_core::material::PointContext;
use fe_core::point::{Control, PointDriver, PointError, PointSettings, Segment};
use nalgebra::Matrix6;

use Control::{Strain, Stress};

const CTX: PointContext = PointContext::new(10.0);

/// Hooke's law in a uniaxial stress state: sigma = E eps, lateral strain -nu eps.
#[test]
fn a_uniaxial_stress_state_shows_young_and_poisson() {
    let law = Elastic::isotropic(30e3, 0.2);
    let mut point = PointDriver::new(&law, CTX).unwrap();
    let mut controls = vec![Stress(0.0); 6];
    controls[0] = Strain(1e-3);
    point.run(&[Segment::new(controls, 4)]).unwrap();
    let rows = point.history().rows();
    assert_eq!(rows.len(), 5);
    for (k, row) in rows.iter().enumerate() {
        let e = 0.25e-3 * k as f64;
        assert!((row.stress[0] - 30e3 * e).abs() < 1e-9);
        assert!((row.strain[1] + 0.2 * e).abs() < 1e-15 && (row.strain[2] + 0.2 * e).abs() < 1e-15);
        assert!(row.stress[1..].iter().all(|s| s.abs() < 1e-9));
    }
}

/// Stress control follows the law up to its peak, reports the place where it ends, and keeps the rows.
#[test]
fn stress_control_ends_at_the_peak_and_keeps_what_it_reached() {
    let law = Damage(Flaw::None);
    let mut point = PointDriver::new(&law, CTX).unwrap();
    let failure = point
        .run(&[Segment::new(vec![Stress(4.0)], 8)])
        .unwrap_err();
    let PointError::NoConvergence {
        segment,
        step,
        component,
        residual,
        ..
    } = failure
    else {
        panic!("{failure}")
    };
    // The peak of the law is E e0 = 3 MPa, which step 6 reaches.
    assert_eq!((segment, step, component), (1, 7, "sig"));
    assert!(residual < 0.0);
    let rows = point.history().rows();
    assert_eq!(rows.len(), 7);
    assert!(
        (rows[6].stress[0] - 3.0).abs() < 1e-8,
        "{}",
        rows[6].stress[0]
    );
    // From there strain control goes on.
    point.run(&[Segment::new(vec![Strain(1e-3)], 5)]).unwrap();
    assert_eq!(point.history().rows().len(), 12);
}

/// The last sub-step before a failure is kept: the curve reaches within 1/256 of a step of the peak.
#[test]
fn a_coarse_step_is_halved_towards_the_peak() {
    let law = Damage(Flaw::None);
    let mut point = PointDriver::new(&law, CTX).unwrap();
    point
        .run(&[Segment::new(vec![Stress(5.0)], 1)])
        .unwrap_err();
    let rows = point.history().rows();
    assert_eq!(rows.len(), 2);
    assert!((rows[1].stress[0] - 3.0).abs() < 5.0 / 256.0 && rows[1].stress[0] <= 3.0);
}

/// Unloading to zero stress from the softening branch: secant unloading of a damage law.
#[test]
fn a_softened_point_unloads_to_the_origin_and_writes_its_path() {
    let law = Damage(Flaw::None);
    let mut point = PointDriver::new(&law, CTX).unwrap();
    let program = [
        Segment::new(vec![Strain(4e-4)], 8),
        Segment::new(vec![Stress(0.0)], 4),
    ];
    point.run(&program).unwrap();
    let history = point.history();
    assert_eq!(history.columns(), ["eps", "sig", "kappa", "last"]);
    let last = &history.rows()[12];
    assert!(last.strain[0].abs() < 1e-12 && (last.state[0] - 4e-4).abs() < 1e-15);
    let mut csv = Vec::new();
    history.write_csv(&mut csv).unwrap();
    let text = String::from_utf8(csv).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!((lines.len(), lines[0]), (14, "eps,sig,kappa,last"));
    let peak: Vec<f64> = lines[3].split(',').map(|c| c.parse().unwrap()).collect();
    assert_eq!(peak[1], YOUNG * 1e-4);
}

#[test]
fn impossible_programs_are_refused_before_anything_runs() {
    let law = Damage(Flaw::None);
    let mut point = PointDriver::new(&law, CTX).unwrap();
    let good = Segment::new(vec![Strain(1e-4)], 2);
    let cases = [
        (
            Segment::new(vec![Strain(0.0); 2], 1),
            "segment 2 prescribes 2 components",
        ),
        (
            Segment::new(vec![Strain(0.0)], 0),
            "segment 2 has steps = 0, outside [1, 1000000]",
        ),
        (
            Segment::new(vec![Stress(f64::NAN)], 1),
            "segment 2: the target of sig is NaN",
        ),
    ];
    for (bad, start) in cases {
        let failure = point.run(&[good.clone(), bad]).unwrap_err().to_string();
        assert!(failure.starts_with(start), "{failure}");
        assert_eq!(point.history().rows().len(), 1);
    }
}

/// Settings that no residual meets, or with which a failing step is halved for ever.
#[test]
fn settings_that_lead_nowhere_are_refused_by_name() {
    let law = Damage(Flaw::None);
    let good = PointSettings::default();
    for (wrong, settings) in [
        (
            "tolerance",
            PointSettings {
                tolerance: f64::NAN,
                ..good
            },
        ),
        (
            "halvings",
            PointSettings {
                halvings: usize::MAX,
                ..good
            },
        ),
        (
            "subdivisions",
            PointSettings {
                subdivisions: usize::MAX,
                ..good
            },
        ),
    ] {
        let mut point = PointDriver::new(&law, CTX).unwrap().with_settings(settings);
        let refused = point.run(&[Segment::new(vec![Strain(1e-4)], 1)]);
        assert!(matches!(refused, Err(PointError::Setting { what, .. }) if what == wrong));
    }
}

/// A stress that is no number is no answer, though nothing is to be iterated where all strains are given.
#[test]
fn a_stress_that_is_no_number_is_refused() {
    let law = Elastic::new(&Matrix6::repeat(f64::NAN));
    let mut point = PointDriver::new(&law, CTX).unwrap();
    let failure = point.run(&[Segment::new(vec![Strain(1e-4); 6], 1)]);
    assert!(
        matches!(failure, Err(PointError::NoConvergence { residual, .. }) if residual.is_nan())
    );
    assert_eq!(point.history().rows().len(), 1);
}
