//! Protects parameters as text: names with units, defaults, refusal of unknown fields.

use fe_contact::case::BondCase;
use fe_contact::envelope::{
    BilinearEnergy, BilinearSlips, Bond, Confinement, ExponentialParameters, LuJoint,
    ModelCodeParameters,
};
use fe_contact::{BondSettings, MixedModeParameters, Normal};
use fe_core::material::PointContext;
use nalgebra::Vector3;

#[test]
fn parameters_are_read_from_text() {
    let settings: BondSettings = ron::from_str("(normal: Unilateral)").unwrap();
    assert_eq!(settings.normal, Normal::Unilateral);
    assert_eq!(
        (settings.normal_over_initial, settings.residual),
        (10.0, 1e-6)
    );
    assert_eq!(
        ron::from_str::<BondSettings>("()").unwrap(),
        BondSettings::default()
    );

    let joint: LuJoint = ron::from_str("(ft_mpa: 2.2, width_ratio: 0.5)").unwrap();
    assert_eq!(joint.width_factor(), 1.0);
    let ribbed: ModelCodeParameters =
        ron::from_str("(fcm_mpa: 36, rib_spacing_mm: 8, bond: Good)").unwrap();
    assert_eq!(
        (ribbed.bond, ribbed.confinement),
        (Bond::Good, Confinement::PullOut)
    );
    let delamination: MixedModeParameters = ron::from_str(
        "(stiffness_mpa_per_mm: 1e4, normal_strength_mpa: 80, shear_strength_mpa: 100, \
         mode_1_energy_n_per_mm: 0.969, mode_2_energy_n_per_mm: 1.719, exponent: 2.284)",
    )
    .unwrap();
    assert_eq!(delamination.residual, 1e-6);
    let slips = "(strength_mpa: 3, peak_slip_mm: 0.05, final_slip_mm: 0.2)";
    assert!(ron::from_str::<BilinearSlips>(slips).is_ok());
    let energy = "(strength_mpa: 3, stiffness_mpa_per_mm: 77, fracture_energy_n_per_mm: 0.3)";
    assert!(ron::from_str::<BilinearEnergy>(energy).is_ok());
    let smooth = "(strength_mpa: 3, fracture_energy_n_per_mm: 0.3)";
    assert!(ron::from_str::<ExponentialParameters>(smooth).is_ok());
}

#[test]
fn unknown_and_missing_fields_are_refused() {
    assert!(ron::from_str::<LuJoint>("(ft: 2.2, width_ratio: 0.5)").is_err());
    assert!(ron::from_str::<LuJoint>("(ft_mpa: 2.2)").is_err());
    assert!(ron::from_str::<BondSettings>("(normal: Glued)").is_err());
    assert!(ron::from_str::<BondSettings>("(stiffness: 1)").is_err());
}

/// A law as text, which is the same when it is written down and read again.
fn read(text: &str) -> BondCase {
    let case = ron::from_str(text).unwrap();
    assert_eq!(ron::from_str(&ron::to_string(&case).unwrap()), Ok(case));
    case
}

/// Every law and curve can be given as text, and is built with what the text says: the largest stress up to a slip of 1.2 mm is
/// the strength, of Lu's curves 1.5 ft at a width factor of 1, of the Model Code 2.5 sqrt(fcm).
#[test]
fn laws_are_built_from_text() {
    let lu = "joint: (ft_mpa: 2.2, width_ratio: 0.5)";
    let bilinear = "strength_mpa: 3.3, peak_slip_mm: 0.05, final_slip_mm: 0.3";
    let energy = "strength_mpa: 3.3, stiffness_mpa_per_mm: 66, fracture_energy_n_per_mm: 0.5";
    let smooth = "strength_mpa: 3.3, fracture_energy_n_per_mm: 0.5";
    let bar = "fcm_mpa: 36, rib_spacing_mm: 8, bond: Good";
    for (curve, strength) in [
        (format!("Bilinear(parameters: ({bilinear}))"), 3.3),
        (format!("BilinearEnergy(parameters: ({energy}))"), 3.3),
        (format!("Exponential(parameters: ({smooth}))"), 3.3),
        (format!("ModelCode(parameters: ({bar}))"), 15.0),
        (format!("LuBilinear({lu})"), 3.3),
        (format!("LuSimplified({lu})"), 3.3),
        (format!("LuPrecise({lu}, stiffness_mpa_per_mm: 330)"), 3.3),
    ] {
        let text = format!("SlipDamage(curve: {curve}, settings: (normal: Unilateral))");
        let law = read(&text).build().unwrap();
        assert!(law.unsymmetric_tangent(), "{text}");
        let start = vec![0.0; law.state_len()];
        let stress = |i: u32| {
            let jump = Vector3::new(1e-4 * f64::from(i), 0.0, 0.0);
            let ctx = PointContext::new(0.0);
            law.update(&jump, &start, &mut start.clone(), &ctx)
                .unwrap()
                .stress[0]
        };
        let largest = (0..12_000).map(stress).fold(0.0, f64::max);
        assert!((largest / strength - 1.0).abs() < 1e-4, "{text}: {largest}");
    }
    let delamination = "MixedMode(parameters: (stiffness_mpa_per_mm: 1e5, normal_strength_mpa: 30, \
                        shear_strength_mpa: 60, mode_1_energy_n_per_mm: 0.3, \
                        mode_2_energy_n_per_mm: 0.7, exponent: 2))";
    assert!(read(delamination).build().is_ok());
    let impossible = "SlipDamage(curve: LuBilinear(joint: (ft_mpa: 2.2, width_ratio: 1.5)))";
    let refused = ron::from_str::<BondCase>(impossible).unwrap().build();
    assert!(refused.unwrap_err().to_string().contains("width_ratio"));
}
