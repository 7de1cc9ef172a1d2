//! The properties of the concrete fit one another.

use fe_core::material::MaterialError;
use fe_materials::concrete::{Calibration, ConcreteScalars, Ottosen};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};

use super::Checks;
use crate::bound;

impl Checks<'_> {
    /// The concrete is stiffer than the secant to its strength, of a strength for which the bond of sheets is known, and its
    /// surface of onset is convex.
    pub(super) fn concrete(&mut self) {
        let concrete = &self.specimen.concrete;
        let strength = concrete.reported_strength_mpa.get();
        // The bond reads it as the characteristic one.
        let known = ConcreteScalars::from_characteristic(strength).is_ok();
        if self.specimen.sheets.is_some() && !known {
            self.report(
                "concrete.reported_strength_mpa",
                format!("{strength} MPa, with sheets, whose bond counts with 8 MPa more; allowed: 16 to 60 MPa"),
                "leave the sheets out, or give a lower strength",
            );
        }
        let Ok(mean) = ConcreteScalars::from_mean(strength) else {
            return;
        };
        let young = concrete.young_mpa.get();
        let law = FixedCrackParameters::from_strength(mean.fcm_mpa, mean.fctm_mpa, young);
        if let Err(MaterialError::Parameter {
            parameter: "young_mpa",
            value,
            allowed,
            ..
        }) = FixedCrack::new(law, None)
        {
            self.report(
                "concrete.young_mpa",
                format!("{value} MPa is too soft for this strength; allowed: {allowed}"),
                "give the modulus at the origin, not a secant, or a lower strength",
            );
        }
        if let Some(tensile) = &concrete.reported_tensile_mpa {
            self.tensile(&mean, tensile.get());
        }
    }

    /// A convex surface runs through both strengths.
    fn tensile(&mut self, mean: &ConcreteScalars, value: f64) {
        let convex = |ft: f64| Ottosen::new(&Calibration::model_code(mean.fcm_mpa, ft)).is_ok();
        if convex(value) || !convex(mean.fctm_mpa) {
            return;
        }
        // The strength of the Code does.
        let allowed = bound::allowed(bound::last(mean.fctm_mpa, value, convex), value);
        self.report(
            "concrete.reported_tensile_mpa",
            format!(
                "{value} MPa does not go with the compressive strength; allowed: {allowed} MPa"
            ),
            format!(
                "leave it out for that of the Model Code, {:.2} MPa",
                mean.fctm_mpa
            ),
        );
    }
}
