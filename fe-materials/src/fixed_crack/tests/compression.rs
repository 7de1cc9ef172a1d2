//! Protects the curve in compression, what cracks take from it and what pressure from the sides adds.

use fe_core::material::Material;
use nalgebra::Vector6;

use super::{Point, WIDTH, axial, build, law, parameters};
use crate::fixed_crack::{CompressionSoftening, Confinement, FixedCrackParameters};

/// Vecchio and Collins (1993): a strut crossed by cracks at a spacing s that open by w carries
/// fcm/(1 + 0.27 (w/(s eps_c1) - 0.37)); over a band narrower than s the strain is the average.
#[test]
fn cracks_weaken_the_strut_they_cross() {
    let p = parameters();
    let across = 0.01;
    let law = CompressionSoftening::VecchioCollins;
    let excess = |average: f64| 0.27 * (average / p.eps_c1 - 0.37);
    let weakened = |average: f64| 1.0 / (1.0 + excess(average));
    let slipping = CompressionSoftening::VecchioCollinsSlip;
    for (compression_softening, crack_spacing_mm, share) in [
        (CompressionSoftening::None, WIDTH, 1.0),
        (law, WIDTH, weakened(across)),
        (law, 0.4 * WIDTH, weakened(2.5 * across)),
        (law, 2.0 * WIDTH, weakened(across)),
        (slipping, WIDTH, 1.0 / (1.0 + 0.55 * excess(across))),
    ] {
        let mut point = Point::new(build(FixedCrackParameters {
            compression_softening,
            crack_spacing_mm,
            ..p
        }));
        // The axis out of the plane keeps its strain at onset, which counts as lateral too.
        point.stress(axial(across));
        let strut = Vector6::new(across, -p.eps_c1, 0.0, 0.0, 0.0, 0.0);
        let found = -point.stress(strut)[1] / p.fcm_mpa;
        assert!((found - share).abs() < 1e-4, "{found} {share}");
    }
}

/// fib Model Code 2010, 5.1-26: the curve in compression, peak -fcm at -eps_c1; crushing then is counted.
#[test]
fn compression_follows_the_model_code_to_its_peak() {
    let p = parameters();
    let k = p.young_mpa * p.eps_c1 / p.fcm_mpa;
    let mut point = Point::new(law(0.0));
    for i in 1..=20 {
        let n = f64::from(i) / 20.0;
        let s = point.stress(axial(-n * p.eps_c1))[0];
        let expected = -p.fcm_mpa * (k * n - n * n) / (1.0 + (k - 2.0) * n);
        assert!((s - expected).abs() < 1e-10);
    }
    let report = |point: &Point, e: f64| point.law.report(&axial(e), &point.state);
    assert_eq!(report(&point, -p.eps_c1).crushing, 0.0);
    point.stress(axial(-4.0 * p.eps_c1));
    assert!(report(&point, -4.0 * p.eps_c1).crushing > 0.0);
}

/// Largest stress (MPa) along the first axis on a straight path of strains without Poisson's effect, and the stress on the second
/// there.
fn strength_along(direction: [f64; 3], confinement: Confinement) -> [f64; 2] {
    let mut point = Point::new(build(FixedCrackParameters {
        poisson: 0.0,
        confinement,
        ..parameters()
    }));
    let [x, y, z] = direction;
    let path = (1..400).map(|i| -1e-5 * f64::from(i) * Vector6::new(x, y, z, 0.0, 0.0, 0.0));
    let stresses = path.map(|strain| point.stress(strain));
    let most = stresses.fold(Vector6::zeros(), |a, b| if b[0] < a[0] { b } else { a });
    [-most[0], -most[1]]
}

/// Strength (MPa) under pressures in the ratio 1 : `ratio` that grow together on two axes, the third being free.
fn biaxial_strength(ratio: f64, confinement: Confinement) -> f64 {
    let p = FixedCrackParameters {
        confinement,
        ..parameters()
    };
    let mut point = Point::new(build(p));
    let mut strength = 0.0_f64;
    for i in 1..400 {
        // Equivalent uniaxial strains, which vanish with the stress.
        let [x, z] = [-1e-5 * f64::from(i), 0.0];
        let strain = |y: f64| {
            let [a, b, c] =
                [[x, y, z], [y, z, x], [z, x, y]].map(|[e, f, g]| e - p.poisson * (f + g));
            Vector6::new(a, b, c, 0.0, 0.0, 0.0)
        };
        let (mut less, mut more) = (0.0, x);
        for _ in 0..50 {
            let y = f64::midpoint(less, more);
            let stress = point.clone().stress(strain(y));
            if stress[1] > ratio * stress[0] {
                less = y;
            } else {
                more = y;
            }
        }
        let stress = point.stress(strain(if ratio == 1.0 { x } else { less }));
        assert!((stress[1] - ratio * stress[0]).abs() < 1e-6 && stress[2].abs() < 1e-6);
        strength = strength.max(-stress[0]);
    }
    strength
}

/// Source: the ratios of stress of Kupfer, Hilsdorf and Ruesch (1969), 1:0, 1:0.5 and 1:1, at which they found 1, 1.27 and 1.16 fcm.
/// Target: without confinement the default law gives fcm whatever the ratio, to 0.1 %; with Vecchio's theirs, to 1 % where both axes
/// are pressed, as the pressure itself comes from a curve.
#[test]
fn two_axes_have_the_strength_of_one_unless_confined() {
    for (ratio, confined) in [(0.0, 1.0), (0.5, 1.27), (1.0, 1.16)] {
        let [plain, vecchio] = [Confinement::None, Confinement::Vecchio]
            .map(|confinement| biaxial_strength(ratio, confinement) / parameters().fcm_mpa);
        assert!((plain - 1.0).abs() < 1e-3, "{ratio}: {plain}");
        let tolerance = if ratio == 0.0 { 1e-3 } else { 0.01 };
        assert!(
            (vecchio / confined - 1.0).abs() < tolerance,
            "{ratio}: {vecchio}"
        );
    }
}

/// Source: Richart, Brandtzaeg and Brown (1928): fcm + 4.1 p along one axis under a pressure p on the others. Target: up to 10 % less,
/// as the pressure counts as if nothing confined it; fcm without confinement.
#[test]
fn concrete_that_is_pressed_from_all_sides_is_stronger() {
    let fcm = parameters().fcm_mpa;
    let [strength, pressure] = strength_along([1.0, 0.1, 0.1], Confinement::Vecchio);
    assert!(pressure > 0.1 * fcm, "{pressure}");
    let expected = fcm + 4.1 * pressure;
    assert!(
        (0.9..1.0).contains(&(strength / expected)),
        "{strength}, {expected}"
    );
    let [plain, _] = strength_along([1.0, 0.1, 0.1], Confinement::None);
    assert!((plain / fcm - 1.0).abs() < 1e-3, "{plain}");
}

/// Pressure that comes after the compression changes nothing of the stress along it, and takes nothing away when it goes: it slows
/// the history down and is no spring.
#[test]
fn confinement_slows_the_history_down() {
    let mut point = Point::new(build(FixedCrackParameters {
        poisson: 0.0,
        confinement: Confinement::Vecchio,
        ..parameters()
    }));
    let strain = |x: f64, y: f64| Vector6::new(-x, -y, 0.0, 0.0, 0.0, 0.0);
    let peak = parameters().eps_c1;
    let alone = point.stress(strain(peak, 0.0))[0];
    let pressed = point.stress(strain(peak, 0.3 * peak))[0];
    assert_eq!(alone, pressed);
    let further = point.stress(strain(1.2 * peak, 0.3 * peak))[0];
    assert!(further < 1.1 * alone, "{further}, {alone}");
    let released = point.stress(strain(1.2 * peak, 0.0))[0];
    assert!((released / alone - 1.0).abs() < 0.05, "{released}, {alone}");
}

/// Work (N mm/mm3) of going from corner to corner in straight lines, from zero, at every corner; strains along the axes in per
/// mille.
fn works(point: &mut Point, corners: &[[f64; 3]]) -> Vec<f64> {
    let (mut work, mut strain, mut stress) = (0.0, Vector6::zeros(), Vector6::zeros());
    let mut at = Vec::new();
    for &[x, y, z] in corners {
        let from = strain;
        let to = 1e-3 * Vector6::new(x, y, z, 0.0, 0.0, 0.0);
        for i in 1..=200 {
            let next = from + (to - from) * (f64::from(i) / 200.0);
            let found = point.stress(next);
            work += 0.5 * (stress + found).dot(&(next - strain));
            (strain, stress) = (next, found);
        }
        at.push(work);
    }
    at
}

/// What the documentation says the sound law gives away: 4 % of the work of loading with every round of a loop, as much taken the
/// other way round, and, at the onset, no more than ft^2/(2E) beyond what loading took.
#[test]
fn energy_of_loops_and_of_the_onset() {
    let (along, wide, end) = ([0.0, -2.0, 0.0], [0.3, -2.5, 0.3], [0.0; 3]);
    for (corners, gives) in [([along, wide, end], 1.0), ([wide, along, end], -1.0)] {
        let mut point = Point::new(law(0.2));
        // The histories have grown once all corners have been seen.
        let work = works(&mut point, &corners.repeat(2));
        assert_eq!(point.state[0], 0.0);
        let loading = work.iter().copied().fold(0.0, f64::max);
        let round = (work[2] - work[5]) / loading;
        assert!((gives * round - 0.037).abs() < 0.005, "{round}");
    }
    let p = parameters();
    let unit = p.ft_mpa * p.ft_mpa / (2.0 * p.young_mpa);
    let mut point = Point::new(law(0.2));
    let mut most = 0.0_f64;
    for size in (0..200).map(|i| 0.001 * f64::from(i)) {
        point.state.fill(0.0);
        let work = works(&mut point, &[[size, 0.7 * size, -2.5 * size], end])[1];
        if point.state[0] > 0.0 {
            most = most.max(-work / unit);
        }
    }
    assert!((0.9..1.1).contains(&most), "{most}");
}

/// Two principal strains that pass one another: the stresses of the two axes change places.
#[test]
fn histories_go_by_rank() {
    let mut point = Point::new(law(0.2));
    point.stress(1e-3 * Vector6::new(-1.0, -3.0, -4.0, 0.0, 0.0, 0.0));
    let [before, after] = [1e-9, -1e-9].map(|d| {
        let strain = 1e-3 * Vector6::new(-1.0, -1.5 + d, -1.5 - d, 0.0, 0.0, 0.0);
        point.clone().stress(strain)
    });
    assert!((before[1] / before[2] - 1.0).abs() > 0.1);
    let apart = (before[1] - after[2]).abs() + (before[2] - after[1]).abs();
    assert!(apart < 1e-6 * before.amax(), "{before}, {after}");
}
