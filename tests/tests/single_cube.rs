//! One hexahedron of 10 mm, fck = 30 MPa, under uniaxial compression to 0.0035 and uniaxial tension to 0.002.
//!
//! Source: the uniaxial curves of the laws in closed form: fib Model Code 2010, 5.1-26 (compression), crack-band softening with
//! G_F = 0.073 fcm^0.18 (tension). Target: within 1e-6 of the strength at every step.

use fe_tests::cube::{cases, curve};

/// Protects law, element and driver together on the path that everybody draws first.
#[test]
fn uniaxial_curves() {
    for case in cases().unwrap() {
        let path = curve(&case.law, -3.5e-3, 35).unwrap();
        assert!(path.len() > 35, "{}: {} steps", case.name, path.len());
        for [strain, stress] in path {
            let exact = -case.crushing.stress(-strain);
            assert!(
                (stress - exact).abs() < 1e-6 * 38.0,
                "{} {strain}: {stress} {exact}",
                case.name
            );
        }
        let Some(softening) = case.tension else {
            continue;
        };
        let path = curve(&case.law, 2e-3, 40).unwrap();
        assert!(path.len() > 40, "{}: {} steps", case.name, path.len());
        for [strain, stress] in path {
            let exact = softening.stress(strain);
            assert!(
                (stress - exact).abs() < 1e-6 * 2.9,
                "{} {strain}: {stress} {exact}",
                case.name
            );
        }
    }
}
