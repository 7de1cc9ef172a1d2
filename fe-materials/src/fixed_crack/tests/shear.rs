//! Protects what carries shear across a crack, and what it never regains.

use fe_core::material::{Material, Operator, PointContext};
use nalgebra::Vector6;

use super::{Point, WIDTH, axial, build, law, parameters};
use crate::fixed_crack::curves::RESIDUAL_COMPRESSION;
use crate::fixed_crack::{CRACK_SPACING_MM, FixedCrackParameters, ShearTransfer};

/// Interlock on an open crack: slip stiffness of Walraven (1981) in series with the sound concrete, up to the strength
/// of Vecchio and Collins (1986). The history of the opening governs: a crack that closes keeps its strength.
#[test]
fn interlock_follows_its_stiffness_up_to_its_strength() {
    let p = parameters();
    let opening = 0.3;
    let e = opening / WIDTH + p.ft_mpa / p.young_mpa;
    let sheared = |gamma: f64| Vector6::new(e, 0.0, 0.0, gamma, 0.0, 0.0);
    let k = 1.8 * opening.powf(-0.8) + (0.234 * opening.powf(-0.707) - 0.2) * 1.2 * p.fcm_mpa;
    let g0 = p.young_mpa / 2.0 / (1.0 + p.poisson);
    let strength = 0.18 * p.fcm_mpa.sqrt() / (0.31 + 24.0 * opening / 35.0);
    let mut point = Point::new(law(0.2));
    point.stress(axial(e));
    let low = point.stress(sheared(1e-4))[3];
    assert!((low - 1e-4 / (1.0 / g0 + 1.0 / (k * WIDTH))).abs() < 1e-9 * low);
    let high = point.stress(sheared(2e-2))[3];
    assert!((high - strength).abs() < 1e-9, "{high} {strength}");
    let closed = point.stress(Vector6::new(-1e-5, 0.0, 0.0, 2e-2, 0.0, 0.0))[3];
    assert!((closed - strength).abs() < 1e-9);
    let mut without = Point::new(build(FixedCrackParameters {
        shear_transfer: ShearTransfer::Damage,
        ..p
    }));
    without.stress(axial(e));
    assert!(without.stress(sheared(2e-2))[3] < 0.3 * strength);
}

/// The faces of a crack that has hardly opened, w = 1e-4 mm, carry no more than 0.18 sqrt(fcm)/(0.31 + 24 w/(a + 16)) in
/// any direction, though they are bridged; without the limit the shear would be 30 MPa.
#[test]
fn a_narrow_crack_carries_no_more_shear_than_its_faces() {
    let p = parameters();
    let opening = 1e-4;
    let e = opening / WIDTH + p.ft_mpa / p.young_mpa;
    let strength = 0.18 * p.fcm_mpa.sqrt() / (0.31 + 24.0 * opening / 35.0);
    let mut point = Point::new(build(FixedCrackParameters {
        fixing_share: 1.0,
        ..p
    }));
    point.stress(axial(e));
    let s = point.stress(Vector6::new(e, 0.0, 0.0, 2e-3, 0.0, -1.5e-3));
    assert!((s[3].hypot(s[5]) - strength).abs() < 1e-9, "{s:?}");
    assert!((s[3] / s[5] + 2.0 / 1.5).abs() < 1e-9);
}

/// What is crushed along a crack holds its faces no better than itself, Ec(kc)/E, though their interlock at w = 0.05 mm would
/// carry a hundred times that.
#[test]
fn crushed_concrete_does_not_interlock() {
    let p = parameters();
    let e = 0.05 / WIDTH + p.ft_mpa / p.young_mpa;
    let (crushing, gamma) = (0.05, 1e-3);
    let mut point = Point::new(law(0.2));
    point.stress(axial(e));
    let crushed = Vector6::new(e, -crushing, 0.0, gamma, 0.0, 0.0);
    let share = RESIDUAL_COMPRESSION * p.fcm_mpa / (crushing * p.young_mpa);
    let elastic = p.young_mpa / 2.0 / (1.0 + p.poisson) * gamma;
    let shear = point.stress(crushed)[3];
    assert!((shear / (share * elastic) - 1.0).abs() < 1e-9, "{shear}");
}

/// Bands narrower than the spacing of cracks share one: at the same strains their interlock is the same. A wider band holds a
/// crack of its own, which opens more and carries less.
#[test]
fn narrow_bands_share_a_crack() {
    let shear = |width: f64| {
        let law = law(0.2);
        let mut before = vec![0.0; law.state_len()];
        law.init_state(&mut before);
        let mut after = before.clone();
        let ctx = PointContext::new(width).with_operator(Operator::None);
        for strain in [axial(0.02), Vector6::new(0.02, 0.0, 0.0, 0.02, 0.0, 0.0)] {
            let stress = law
                .update(&strain, &before, &mut after, &ctx)
                .unwrap()
                .stress;
            if strain[3] > 0.0 {
                return stress[3];
            }
            before.copy_from_slice(&after);
        }
        f64::NAN
    };
    let narrow = shear(20.0);
    assert!(
        (shear(40.0) - narrow).abs() < 1e-9 && narrow > 0.1,
        "{narrow}"
    );
    assert!(
        shear(CRACK_SPACING_MM) >= narrow - 1e-9 && shear(2.0 * CRACK_SPACING_MM) < 0.7 * narrow
    );
}

/// Vecchio and Collins (1986): pressure p across a crack adds 1.64 p - 0.82 p^2/v_m to the strength of its faces. What has
/// slipped under less pressure is not regained under more.
#[test]
fn pressure_holds_the_faces_of_a_crack() {
    let p = parameters();
    let opening = 0.3;
    let e = opening / WIDTH + p.ft_mpa / p.young_mpa;
    let full = p.fcm_mpa.sqrt() / (0.31 + 24.0 * opening / 35.0);
    let mut point = Point::new(law(0.2));
    point.stress(axial(e));
    let pressed = Vector6::new(-1.5e-4, 0.0, 0.0, 2e-2, 0.0, 0.0);
    let s = point.stress(pressed);
    let strength = 0.18 * full - 1.64 * s[0] - 0.82 * s[0] * s[0] / full;
    assert!(s[0] < -4.0 && (s[3] - strength).abs() < 1e-9, "{s:?}");
    let free = Vector6::new(0.0, 0.0, 0.0, 2e-2, 0.0, 0.0);
    let slipped = point.stress(free)[3];
    assert!((slipped - 0.18 * full).abs() < 1e-9);
    assert!((point.stress(pressed)[3] - slipped).abs() < 1e-9);
}

/// With a shear factor from the current secant a closing crack would regain its shear stiffness with the
/// shear strain standing: a jump of G0 gamma = 27 MPa here.
#[test]
fn a_closing_crack_keeps_its_shear_factor() {
    let mut point = Point::new(law(0.2));
    point.stress(axial(1.5e-3));
    let sheared = |e: f64| Vector6::new(e, 0.0, 0.0, 2e-3, 0.0, 0.0);
    let open = point.stress(sheared(1.5e-3))[3];
    let before = point.energy(&sheared(1.5e-3));
    let closed = point.stress(sheared(-1e-5))[3];
    let after = point.energy(&sheared(-1e-5));
    assert!(open > 0.0);
    assert!((closed - open).abs() < 1e-12);
    assert!(after <= before, "{after} {before}");
}
