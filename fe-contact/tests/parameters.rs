//! Protects parameters as text: names with units, defaults, refusal of unknown fields.

use fe_contact::envelope::{
    BilinearEnergy, BilinearSlips, Bond, Confinement, ExponentialParameters, LuJoint,
    ModelCodeParameters,
};
use fe_contact::{BondSettings, MixedModeParameters, Normal};

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
