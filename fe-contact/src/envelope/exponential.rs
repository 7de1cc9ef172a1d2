//! The exponential curve.

use std::f64::consts::E;

use fe_core::material::MaterialError;
use serde::{Deserialize, Serialize};

use super::{Envelope, LOST};
use crate::limits::positive;

const LAW: &str = "exponential bond";

/// Smooth curve of two parameters:
///
/// tau = e tau_max (s/s0) exp(-s/s0), s0 = G_f/(e tau_max), K0 = e tau_max/s0.
///
/// Source: M. Ortiz and A. Pandolfi, Int. J. Numer. Meth. Engng 44 (1999) 1267-1282, loading branch; the
/// potential behind it goes back to Rose, Ferrante and Smith (1981).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exponential {
    strength: f64,
    s0: f64,
    sf: f64,
}

/// Parameters of an [`Exponential`] curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExponentialParameters {
    /// Largest stress tau_max (MPa).
    pub strength_mpa: f64,
    /// Fracture energy G_f (N/mm).
    pub fracture_energy_n_per_mm: f64,
}

impl Exponential {
    /// The curve with the given strength and energy.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] unless both are positive.
    pub fn new(p: &ExponentialParameters) -> Result<Self, MaterialError> {
        positive(
            LAW,
            &[
                ("strength_mpa", p.strength_mpa, "MPa"),
                (
                    "fracture_energy_n_per_mm",
                    p.fracture_energy_n_per_mm,
                    "N/mm",
                ),
            ],
        )?;
        let s0 = p.fracture_energy_n_per_mm / (E * p.strength_mpa);
        // x exp(1 - x) = LOST by fixed-point iteration x = 1 + ln(x/LOST), which contracts for x > 1.
        let lost = (0..60).fold(8.0, |x: f64, _| 1.0 + (x / LOST).ln());
        Ok(Self {
            strength: p.strength_mpa,
            s0,
            sf: lost * s0,
        })
    }
}

impl Envelope for Exponential {
    fn name(&self) -> &'static str {
        LAW
    }

    fn stiffness(&self) -> f64 {
        E * self.strength / self.s0
    }

    fn strength(&self) -> f64 {
        self.strength
    }

    fn peak_slip(&self) -> f64 {
        self.s0
    }

    fn final_slip(&self) -> f64 {
        self.sf
    }

    fn energy(&self) -> f64 {
        E * self.strength * self.s0
    }

    fn secant(&self, slip: f64) -> (f64, f64) {
        let secant = self.stiffness() * (-slip / self.s0).exp();
        (secant, -secant / self.s0)
    }
}
