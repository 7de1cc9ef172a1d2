//! Concrete of a case.

use fe_core::material::MaterialError;
use serde::{Deserialize, Serialize};

use super::CaseError;
use crate::concrete::ConcreteScalars;

/// A concrete by its cylinder strength, from which [`ConcreteScalars`] follow; a property that is given
/// replaces the derived one, and is refused where the law makes no use of it. Exactly one of the two strengths.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ConcreteCase {
    /// Characteristic strength fck (MPa).
    pub fck_mpa: Option<f64>,
    /// Mean strength fcm (MPa).
    pub fcm_mpa: Option<f64>,
    /// Mean tensile strength (MPa).
    pub fctm_mpa: Option<f64>,
    /// Young's modulus (MPa).
    pub young_mpa: Option<f64>,
    /// Poisson's ratio (-).
    pub poisson: Option<f64>,
    /// Strain at the compressive strength, positive (-).
    pub eps_c1: Option<f64>,
    /// Strain at which the compression curve ends, positive (-); without use in [`FixedCrack`](crate::fixed_crack::FixedCrack)
    /// and [`Objective`](crate::concrete::Objective), whose curves end by the crushing energy.
    pub eps_c_lim: Option<f64>,
    /// Fracture energy (N/mm); without use in laws that have no crack band: [`Associated`](crate::concrete::Associated),
    /// [`Isochoric`](crate::concrete::Isochoric) and [`Reference`](crate::concrete::Reference).
    pub fracture_energy_n_per_mm: Option<f64>,
}

/// A property that some laws make no use of.
#[derive(Debug, Clone, Copy)]
pub(super) enum Property {
    LimitStrain,
    FractureEnergy,
}

/// More than the toughest fibre concrete takes (N/mm, assumed): beyond it, the unit is another.
const LARGEST_FRACTURE_ENERGY: f64 = 50.0;

impl ConcreteCase {
    /// The properties for a law of the given name that makes no use of one of them.
    ///
    /// # Errors
    ///
    /// [`CaseError::Unused`] where that one is given, otherwise as [`Self::build`].
    pub(super) fn build_for(
        &self,
        law: &'static str,
        without: Property,
    ) -> Result<ConcreteScalars, CaseError> {
        let (property, given) = match without {
            Property::LimitStrain => ("eps_c_lim", self.eps_c_lim),
            Property::FractureEnergy => ("fracture_energy_n_per_mm", self.fracture_energy_n_per_mm),
        };
        match given {
            Some(_) => Err(CaseError::Unused { law, property }),
            None => self.build(),
        }
    }

    /// The properties.
    ///
    /// # Errors
    ///
    /// [`CaseError::Strength`], or [`CaseError::Law`] for a strength outside the tables.
    pub fn build(&self) -> Result<ConcreteScalars, CaseError> {
        let derived = match (self.fck_mpa, self.fcm_mpa) {
            (Some(fck), None) => ConcreteScalars::from_characteristic(fck)?,
            (None, Some(fcm)) => ConcreteScalars::from_mean(fcm)?,
            (fck, _) => {
                let given = if fck.is_some() { 2 } else { 0 };
                return Err(CaseError::Strength { given });
            }
        };
        if let Some(value) = self.fracture_energy_n_per_mm
            && value > LARGEST_FRACTURE_ENERGY
        {
            return Err(CaseError::Law(MaterialError::Parameter {
                law: "concrete",
                parameter: "fracture_energy_n_per_mm",
                value,
                unit: "N/mm",
                allowed: format!("(0, {LARGEST_FRACTURE_ENERGY}]"),
                remedy: "give it in N/mm: 140 N/m are 0.14".into(),
            }));
        }
        Ok(ConcreteScalars {
            fcm_mpa: derived.fcm_mpa,
            fctm_mpa: self.fctm_mpa.unwrap_or(derived.fctm_mpa),
            young_mpa: self.young_mpa.unwrap_or(derived.young_mpa),
            poisson: self.poisson.unwrap_or(derived.poisson),
            eps_c1: self.eps_c1.unwrap_or(derived.eps_c1),
            eps_c_lim: self.eps_c_lim.unwrap_or(derived.eps_c_lim),
            fracture_energy: self
                .fracture_energy_n_per_mm
                .unwrap_or(derived.fracture_energy),
        })
    }
}
