//! Protects the curve, its plastic strain and the closed inverse.
use approx::assert_relative_eq;
use fe_core::testing::{curve as tell_curve, within};

use super::*;

fn curve(fck: f64) -> CompressionCurve {
    let p = ConcreteScalars::from_characteristic(fck).unwrap();
    CompressionCurve::model_code(&p).unwrap()
}

/// Benchmark MAT-05: fib Model Code 2010, stress at 0.5, 1, 1.5 and 3 permille. Target: printed digits.
#[test]
fn model_code_stresses() {
    for (fck, young, k, targets) in [
        (20.0, 30303.0, 2.273, [12.74, 21.20, 26.09, 24.30]),
        (30.0, 33551.0, 2.031, [14.88, 26.02, 33.49, 34.62]),
    ] {
        let p = ConcreteScalars::from_characteristic(fck).unwrap();
        within(
            &format!("MAT-05: E_ci (MPa), fck = {fck}"),
            p.young_mpa,
            young,
            0.6,
        );
        within(
            &format!("MAT-05: k, fck = {fck}"),
            p.plasticity_number(),
            k,
            6e-4,
        );
        let stress = |strain: f64| curve(fck).at(strain / p.eps_c1).stress;
        let strains = [0.5e-3, 1e-3, 1.5e-3, 3e-3];
        for (strain, target) in strains.into_iter().zip(targets) {
            let what = format!(
                "MAT-05: stress at {} permille (MPa), fck = {fck}",
                1e3 * strain
            );
            within(&what, stress(strain), target, 6e-3);
        }
        let points = (0..=70).map(|i| 0.05 * f64::from(i));
        let points = points.map(|permille| [permille, stress(1e-3 * permille)]);
        tell_curve(&format!("compression, fck = {fck}"), points);
        let points = strains.map(|strain| 1e3 * strain).into_iter().zip(targets);
        tell_curve(
            &format!("compression targets, fck = {fck}"),
            points.map(<[f64; 2]>::from),
        );
    }
}

#[test]
fn peak_and_plateau() {
    let p = ConcreteScalars::from_characteristic(27.5).unwrap();
    let curve = curve(27.5);
    let peak = curve.at(1.0);
    assert_relative_eq!(peak.stress, p.fcm_mpa, max_relative = 1e-14);
    assert!(peak.stress_slope.abs() < 1e-11);
    assert_relative_eq!(peak.kappa, curve.peak_kappa(), max_relative = 1e-13);
    let end = p.eps_c_lim / p.eps_c1;
    assert_relative_eq!(curve.at(5.0).stress, curve.at(end).stress);
    assert_eq!((curve.crushing(1.0), curve.crushing(5.0)), (0.0, 1.0));
}

/// Inverse and slopes on every branch of both endings, from 1e-9 to 20 times the peak strain.
#[test]
fn inverse_and_slopes() {
    for fck in [12.0, 27.5, 50.0] {
        let code = curve(fck);
        for curve in [
            code,
            code.regularised(35.0, 50.0),
            code.regularised(35.0, 1000.0),
        ] {
            assert_eq!(curve.eta(0.0), 0.0);
            for i in 0..400 {
                let eta = 10.0_f64.powf(-9.0 + 10.3 * f64::from(i) / 400.0);
                let point = curve.at(eta);
                assert_relative_eq!(curve.eta(point.kappa), eta, max_relative = 1e-11);
                let d = 1e-6 * eta;
                let (a, b) = (curve.at(eta + d), curve.at(eta - d));
                let slope = (a.stress - b.stress) / (2.0 * d);
                let scale = curve.strength();
                assert!((slope - point.stress_slope).abs() < 1e-6 * scale / eta.min(1.0));
                let slope = (a.kappa - b.kappa) / (2.0 * d);
                assert_relative_eq!(slope, point.kappa_slope, max_relative = 1e-5);
            }
        }
    }
}

/// The regularised branch dissipates G_c/h up to its zero: integral of the parabola.
#[test]
fn regularised_branch_dissipates_the_crushing_energy() {
    let (gc, h) = (35.0, 50.0);
    let curve = curve(27.5).regularised(gc, h);
    let n = 20_000;
    let width = 1.5 * gc / (h * curve.strength()) * 0.98_f64.sqrt();
    let step = width / f64::from(n);
    let area: f64 = (0..n)
        .map(|i| {
            curve
                .at(1.0 + step * (f64::from(i) + 0.5) / curve.peak_strain())
                .stress
                * step
        })
        .sum();
    // Integral up to the residual stress: 3/2 a - a^3/2 of G_c/h with a^2 = 0.98.
    let a = 0.98_f64.sqrt();
    assert_relative_eq!(
        area,
        gc / h * (1.5 * a - 0.5 * a.powi(3)),
        max_relative = 1e-8
    );
}

#[test]
fn impossible_curves_are_refused() {
    let good = ConcreteScalars::from_characteristic(27.5).unwrap();
    for bad in [
        ConcreteScalars {
            eps_c1: 1e-3,
            ..good
        },
        ConcreteScalars {
            eps_c_lim: 2e-3,
            ..good
        },
        ConcreteScalars {
            eps_c_lim: 5e-3,
            ..good
        },
        ConcreteScalars {
            young_mpa: f64::NAN,
            ..good
        },
        ConcreteScalars {
            fcm_mpa: -1.0,
            ..good
        },
    ] {
        assert!(CompressionCurve::model_code(&bad).is_err(), "{bad:?}");
    }
}
