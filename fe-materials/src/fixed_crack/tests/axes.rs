//! Protects the directions of cracks: what turns, and what is fixed when.

use fe_core::material::{Material, PointContext};
use nalgebra::Vector6;

use super::{Point, WIDTH, axial, build, law, parameters};
use crate::fixed_crack::{Confinement, FixedCrackParameters};

/// Shear in the plane of a crack opens a second one at 45 degrees to the first axes, at ft, which the stress there
/// never exceeds. Axes fixed by the first crack alone would carry any shear in its plane.
#[test]
fn a_second_crack_finds_its_own_direction() {
    let p = parameters();
    let mut point = Point::new(law(0.2));
    point.stress(axial(1e-3));
    let mut largest = 0.0_f64;
    for i in 1..=400 {
        let shear = 1e-5 * f64::from(i);
        let s = point.stress(Vector6::new(1e-3, 0.0, 0.0, 0.0, shear, 0.0));
        let half = (0.25 * (s[1] - s[2]).powi(2) + s[4] * s[4]).sqrt();
        largest = largest.max(0.5 * (s[1] + s[2]) + half);
    }
    assert!((largest / p.ft_mpa - 1.0).abs() < 0.02, "{largest}");
    let axes = &point.state[1..10];
    assert!((axes[4].abs() - 0.5_f64.sqrt()).abs() < 1e-9, "{axes:?}");
}

/// As long as a crack bridges more than the fixing share, stress and strain stay coaxial, however the strain turns; then its axes
/// stay, and shear builds up across it.
#[test]
fn axes_follow_until_the_fixing_share_is_left() {
    let p = FixedCrackParameters {
        poisson: 0.0,
        fixing_share: 0.5,
        ..parameters()
    };
    let mut point = Point::new(build(p));
    let turned = |e: f64, angle: f64| {
        let (sin, cos) = angle.sin_cos();
        Vector6::new(
            e * cos * cos,
            e * sin * sin,
            0.0,
            2.0 * e * sin * cos,
            0.0,
            0.0,
        )
    };
    let onset = p.ft_mpa / p.young_mpa;
    let mut fixed = None;
    for i in 0..=200 {
        let angle = 0.004 * f64::from(i);
        let e = onset * (1.0 + 0.05 * f64::from(i));
        let s = point.stress(turned(e, angle));
        let along = 0.5 * (s[0] + s[1])
            + 0.5 * (s[0] - s[1]) * (2.0 * angle).cos()
            + s[3] * (2.0 * angle).sin();
        let across = 0.5 * (s[1] - s[0]) * (2.0 * angle).sin() + s[3] * (2.0 * angle).cos();
        let normal = point.state[2].atan2(point.state[1]);
        if fixed.is_none() && along < 0.5 * p.ft_mpa {
            fixed = Some(normal);
        }
        match fixed {
            None => assert!(across.abs() < 1e-9 * p.ft_mpa, "{i}: {across}"),
            Some(axis) => assert!((normal - axis).abs() < 1e-12, "{i}: {normal} {axis}"),
        }
    }
    let axis = fixed.unwrap().tan().atan();
    assert!(axis > 0.05 && axis < 0.75, "{axis}");
}

/// Axes are fixed where the stress along the crack comes to exceed the one across it, although the crack still bridges enough.
#[test]
fn axes_are_fixed_where_the_order_of_stresses_would_turn() {
    let p = FixedCrackParameters {
        poisson: 0.0,
        fixing_share: 0.5,
        ..parameters()
    };
    let onset = p.ft_mpa / p.young_mpa;
    for (along, fixed) in [(0.2, false), (0.95, true)] {
        let mut point = Point::new(build(p));
        point.stress(onset * Vector6::new(1.01, 0.0, 0.0, 0.0, 0.0, 0.0));
        let open = point.stress(onset * Vector6::new(2.0, 0.0, 0.0, 0.0, 0.0, 0.0));
        assert!(
            open[0] > 0.5 * p.ft_mpa && open[0] < 0.95 * p.ft_mpa,
            "{open}"
        );
        point.stress(onset * Vector6::new(2.0, along, 0.0, 0.0, 0.0, 0.0));
        let s = point.stress(onset * Vector6::new(2.0, along, 0.0, 0.1, 0.0, 0.0));
        assert_eq!(point.state[2] == 0.0, fixed, "{along}");
        // Fixed cracks resist shear by the elastic modulus for a start, others as far as stresses differ.
        let coaxial = 0.05 * (s[0] - s[1]) / (2.0 - along);
        assert_eq!((s[3] / coaxial - 1.0).abs() < 1e-6, !fixed, "{along}");
    }
}

/// Where the plane of a crack is compressed alike all around, the modulus that turns its axes is the limit of the one nearby: half
/// the secant, though the history grows with one of the strains only.
#[test]
fn equal_strains_turn_with_the_modulus_of_their_neighbours() {
    for confinement in [Confinement::None, Confinement::Vecchio] {
        let mut point = Point::new(build(FixedCrackParameters {
            confinement,
            ..parameters()
        }));
        point.stress(axial(3e-4));
        let at = |gamma| Vector6::new(3e-4, -1e-3, -1e-3, 0.0, gamma, 0.0);
        let mut trial = vec![0.0; point.state.len()];
        let ctx = PointContext::new(WIDTH);
        let answer = point
            .law
            .update(&at(0.0), &point.state, &mut trial, &ctx)
            .unwrap();
        let [up, down] = [1e-9, -1e-9].map(|gamma| point.clone().stress(at(gamma))[4]);
        let (given, difference) = (answer.tangent[(4, 4)], (up - down) / 2e-9);
        assert!(
            (given / difference - 1.0).abs() < 1e-6,
            "{given}, {difference}"
        );
        assert!((given / (-500.0 * answer.stress[1]) - 1.0).abs() < 1e-9);
    }
}
