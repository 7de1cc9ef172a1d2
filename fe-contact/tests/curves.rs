//! Protects the curves of bond stress: parameters of the source, peak, area, derivative, secant that never grows.
//!
//! Sources: Lu, Teng, Ye and Jiang (2005); Yuan, Teng, Seracino, Wu and Yao (2004); Ortiz and Pandolfi (1999). Targets:
//! the values computed from them for five concretes, to the digits given; area G_f to 1e-12 for piecewise linear
//! curves, to 1e-9 by quadrature for the others.

use fe_contact::envelope::{
    Bilinear, BilinearEnergy, BilinearSlips, Bond, Confinement, Exponential, ExponentialParameters,
    LuJoint, ModelCode, ModelCodeParameters,
};
use fe_contact::{Envelope, PullOut};
use fe_core::material::MaterialError;
use fe_core::shape::quadrature::gauss_legendre;

const MEMBRANE: f64 = 228_000.0 * 0.165;

/// Mean strengths and what follows from them: tau_max, s0, s_f, G_f, P_u/b_f, L_e at 97 %.
const CONCRETES: [(f64, [f64; 6]); 5] = [
    (27.3, [3.1659, 0.04116, 0.18190, 0.28794, 147.19, 72.70]),
    (35.5, [3.6579, 0.04755, 0.16923, 0.30950, 152.60, 67.20]),
    (35.5, [3.6579, 0.04755, 0.16923, 0.30950, 152.60, 67.20]),
    (28.5, [3.2417, 0.04214, 0.17976, 0.29136, 148.06, 71.75]),
    (58.0, [4.7917, 0.06229, 0.14785, 0.35424, 163.26, 58.67]),
];

/// Half a unit of the last digit of a target.
fn assert_digits(found: f64, target: f64) {
    let text = target.to_string();
    let digits = text.split_once('.').map_or(0, |(_, d)| d.len());
    let unit = 0.1_f64.powf(digits as f64);
    assert!(
        (found - target).abs() <= 0.51 * unit,
        "{found} for {target}"
    );
}

#[test]
fn concretes_of_the_beams() {
    for (fcm, targets) in CONCRETES {
        let bond = LuJoint::from_cylinder_strength(fcm, 1.0)
            .bilinear()
            .unwrap();
        let strip = PullOut::new(bond, MEMBRANE).unwrap();
        let found = [
            bond.strength(),
            bond.peak_slip(),
            bond.final_slip(),
            bond.energy(),
            strip.ultimate(),
            strip.effective_length(0.97),
        ];
        for (f, t) in found.into_iter().zip(targets) {
            assert_digits(f, t);
        }
        assert_digits(bond.stiffness(), 76.92);
    }
    let bond = LuJoint::from_cylinder_strength(35.5, 1.0)
        .bilinear()
        .unwrap();
    assert_digits(
        PullOut::new(bond, MEMBRANE).unwrap().effective_length(0.99),
        80.0,
    );
}

/// The strip of the closed form: f_t = 2.2 MPa, half as wide as the concrete.
#[test]
fn closed_form_of_a_strip() {
    let joint = LuJoint {
        ft_mpa: 2.2,
        width_ratio: 0.5,
    };
    let strip = PullOut::new(joint.bilinear().unwrap(), MEMBRANE).unwrap();
    assert_digits(strip.lambda()[0], 0.045219);
    assert_digits(strip.lambda()[1], 0.019363);
    assert_digits(strip.effective_length(0.97), 84.14);
    assert_digits(50.0 * strip.ultimate(), 9269.9);
    for (length, elastic, peak, at) in [
        (50.0, 3570.5, 7064.7, 0.13943),
        (400.0, 3648.9, 9269.9, 0.27687),
    ] {
        assert_digits(50.0 * strip.elastic_limit(length), elastic);
        let (_, force, displacement) = strip.peak(length);
        assert_digits(50.0 * force, peak);
        assert_digits(displacement, at);
    }
}

fn joints() -> [LuJoint; 3] {
    [(2.2, 0.5), (3.27, 1.0), (1.8, 0.1)].map(|(ft_mpa, width_ratio)| LuJoint {
        ft_mpa,
        width_ratio,
    })
}

fn curves() -> Vec<Box<dyn Envelope>> {
    let mut curves: Vec<Box<dyn Envelope>> = Vec::new();
    for joint in joints() {
        curves.push(Box::new(joint.bilinear().unwrap()));
        curves.push(Box::new(joint.simplified().unwrap()));
        curves.push(Box::new(joint.precise(160.0).unwrap()));
    }
    let energy = BilinearEnergy {
        strength_mpa: 4.0,
        stiffness_mpa_per_mm: 500.0,
        fracture_energy_n_per_mm: 0.3,
    };
    curves.push(Box::new(Bilinear::from_energy(&energy).unwrap()));
    let exponential = ExponentialParameters {
        strength_mpa: 4.0,
        fracture_energy_n_per_mm: 0.3,
    };
    curves.push(Box::new(Exponential::new(&exponential).unwrap()));
    for bond in [Bond::Good, Bond::Other] {
        for confinement in [
            Confinement::PullOut,
            Confinement::Stirrups,
            Confinement::None,
        ] {
            curves.push(Box::new(ribbed(bond, confinement)));
        }
    }
    curves
}

fn ribbed(bond: Bond, confinement: Confinement) -> ModelCode {
    ModelCode::new(&ModelCodeParameters {
        fcm_mpa: 36.0,
        rib_spacing_mm: 8.0,
        bond,
        confinement,
    })
    .unwrap()
}

/// A strength in Pa splits the bond within the chord at the beginning of the curve: it is refused.
#[test]
fn a_strength_in_another_unit_is_refused() {
    for fcm_mpa in [30e3, 30e6, f64::NAN, 0.0] {
        let refused = ModelCode::new(&ModelCodeParameters {
            fcm_mpa,
            rib_spacing_mm: 8.0,
            bond: Bond::Good,
            confinement: Confinement::None,
        });
        assert!(refused.unwrap_err().to_string().contains("fcm_mpa"));
    }
}

/// fib Model Code 2010, table 6.1-1, with f_cm = 36 MPa and ribs 8 mm apart.
#[test]
fn bond_of_ribbed_bars() {
    let root = (36.0_f64 / 25.0).powf(0.25);
    for (bond, confinement, strength, s2, s3, residual) in [
        (Bond::Good, Confinement::PullOut, 15.0, 2.0, 8.0, 6.0),
        (Bond::Other, Confinement::PullOut, 7.5, 3.6, 8.0, 3.0),
        (
            Bond::Good,
            Confinement::Stirrups,
            8.0 * root,
            f64::NAN,
            4.0,
            3.2 * root,
        ),
        (
            Bond::Good,
            Confinement::None,
            7.0 * root,
            f64::NAN,
            f64::NAN,
            0.0,
        ),
        (
            Bond::Other,
            Confinement::None,
            5.0 * root,
            f64::NAN,
            f64::NAN,
            0.0,
        ),
    ] {
        let curve = ribbed(bond, confinement);
        let name = format!("{bond:?} {confinement:?}");
        assert!((curve.strength() - strength).abs() < 1e-12, "{name}");
        assert!((curve.residual() - residual).abs() < 1e-12, "{name}");
        let [s1, second, third] = curve.slips();
        let full = ribbed(bond, Confinement::PullOut);
        let rising = full.strength() * (s1 / full.slips()[0]).powf(0.4);
        assert!((rising - strength).abs() < 1e-12, "{name}");
        assert!(
            (second - if s2.is_nan() { s1 } else { s2 }).abs() < 1e-12,
            "{name}"
        );
        assert!(
            (third - if s3.is_nan() { 1.2 * s1 } else { s3 }).abs() < 1e-12,
            "{name}"
        );
        assert!(
            (curve.stress(5.0 * third) - residual).abs() < 1e-12,
            "{name}"
        );
        assert_eq!(curve.energy().is_finite(), residual == 0.0, "{name}");
    }
    let rising = ribbed(Bond::Good, Confinement::PullOut);
    for (slip, stress) in [(0.1, 15.0 * 0.1_f64.powf(0.4)), (1.5, 15.0), (5.0, 10.5)] {
        assert!((rising.stress(slip) - stress).abs() < 1e-12);
    }
}

/// Area by 4-point Gauss rules on intervals that grow from the origin and end at the kinks.
fn area(curve: &dyn Envelope) -> f64 {
    let s0 = curve.peak_slip();
    let mut ends: Vec<f64> = (0..200).map(|i| 1e-2 * s0 * f64::from(i) / 200.0).collect();
    ends.extend((0..=400).map(|i| s0 * (0.01 + 0.99 * f64::from(i) / 400.0)));
    ends.extend((1..=2000).map(|i| s0 + (curve.final_slip() - s0) * f64::from(i) / 2000.0));
    ends.extend((1..=6000).map(|i| curve.final_slip() * (1.0 + f64::from(i) / 1000.0)));
    // Where the elastic start of ribbed bars ends.
    ends.extend([0.01, 0.018]);
    ends.sort_by(f64::total_cmp);
    ends.windows(2)
        .map(|w| {
            let (middle, half) = (0.5 * (w[0] + w[1]), 0.5 * (w[1] - w[0]));
            gauss_legendre(4)
                .iter()
                .map(|(x, weight)| weight * half * curve.stress(middle + half * x))
                .sum::<f64>()
        })
        .sum()
}

#[test]
fn the_area_is_the_fracture_energy() {
    for curve in curves().iter().filter(|c| c.energy().is_finite()) {
        let relative = area(curve.as_ref()) / curve.energy() - 1.0;
        assert!(relative.abs() < 1e-9, "{}: {relative:e}", curve.name());
    }
    for joint in joints() {
        let bond = joint.bilinear().unwrap();
        let (s0, sf) = (bond.peak_slip(), bond.final_slip());
        let trapezia =
            0.5 * bond.stress(s0) * s0 + 0.5 * (bond.stress(s0) + bond.stress(sf)) * (sf - s0);
        assert!((trapezia / joint.energy() - 1.0).abs() < 1e-12);
        assert!((bond.energy() / joint.energy() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn curves_have_the_peak_and_the_start_they_state() {
    for curve in curves() {
        let (s0, name) = (curve.peak_slip(), curve.name());
        assert!(
            (curve.stress(s0) / curve.strength() - 1.0).abs() < 1e-12,
            "{name}"
        );
        let at = |share: f64| curve.stress(share * curve.final_slip());
        assert!((1..400).all(|i| at(f64::from(i) / 400.0) < curve.strength() * (1.0 + 1e-12)));
        assert!(
            (curve.secant(1e-12 * s0).0 / curve.stiffness() - 1.0).abs() < 1e-6,
            "{name}"
        );
        assert_eq!(curve.secant(0.0).0, curve.stiffness(), "{name}");
        if curve.energy().is_infinite() {
            continue;
        }
        let end = curve.stress(curve.final_slip()) / curve.strength();
        assert!(
            end.abs() < 1e-12 || (end - 0.01).abs() < 1e-9,
            "{name}: {end}"
        );
    }
}

#[test]
fn the_secant_never_grows_and_its_derivative_is_right() {
    for curve in curves() {
        let (s0, sf) = (curve.peak_slip(), curve.final_slip());
        let mut last = f64::INFINITY;
        for i in 0..2000 {
            let slip = 1.2 * sf * (f64::from(i) + 0.37) / 2000.0;
            let (secant, slope) = curve.secant(slip);
            assert!(secant <= last && slope <= 0.0, "{} at {slip}", curve.name());
            last = secant;
            let h = 1e-6 * s0;
            if [0.01 * s0, s0, sf]
                .iter()
                .any(|kink| (slip - kink).abs() < 2.0 * h)
            {
                continue;
            }
            let difference = (curve.secant(slip + h).0 - curve.secant(slip - h).0) / (2.0 * h);
            let scale = curve.stiffness() / s0;
            assert!(
                (difference - slope).abs() < 1e-6 * scale,
                "{} at {slip}",
                curve.name()
            );
        }
    }
}

/// A softer start than the source assumes gives the precise model the s0 it adds, and stiff adhesive leads to the
/// simplified one.
#[test]
fn the_precise_curve_tends_to_the_simplified_one() {
    let joint = joints()[0];
    let (precise, simplified) = (joint.precise(1e7).unwrap(), joint.simplified().unwrap());
    assert!((precise.peak_slip() / simplified.peak_slip() - 1.0).abs() < 1e-4);
    for share in [0.05, 0.3, 0.9, 1.5, 4.0] {
        let slip = share * simplified.peak_slip();
        let ratio = precise.stress(slip) / simplified.stress(slip);
        assert!((ratio - 1.0).abs() < 1e-3, "{share}: {ratio}");
    }
    let soft = joint.precise(100.0).unwrap();
    assert!((soft.peak_slip() - joint.peak_slip() - joint.strength() / 100.0).abs() < 1e-15);
}

#[test]
fn impossible_parameters_are_refused() {
    let refused = |result: Result<Bilinear, MaterialError>, name| match result {
        Err(MaterialError::Parameter { parameter, .. }) => assert_eq!(parameter, name),
        other => panic!("{other:?}"),
    };
    let slips = BilinearSlips {
        strength_mpa: 3.0,
        peak_slip_mm: 0.05,
        final_slip_mm: 0.04,
    };
    refused(Bilinear::from_slips(&slips), "final_slip_mm");
    let energy = BilinearEnergy {
        strength_mpa: 4.0,
        stiffness_mpa_per_mm: 50.0,
        fracture_energy_n_per_mm: 0.16,
    };
    refused(Bilinear::from_energy(&energy), "fracture_energy_n_per_mm");
    let joint = |ft_mpa, width_ratio| {
        LuJoint {
            ft_mpa,
            width_ratio,
        }
        .bilinear()
    };
    refused(joint(-2.0, 0.5), "ft_mpa");
    refused(joint(2.0, 1.1), "width_ratio");
    refused(joint(2.0, f64::NAN), "width_ratio");
}
