//! The bilinear curve.

use fe_core::material::MaterialError;
use serde::{Deserialize, Serialize};

use super::Envelope;
use crate::limits::{out_of_range, positive};

const LAW: &str = "bilinear bond";

/// Linear rise to tau_max at s0, linear fall to zero at s_f:
///
/// tau = tau_max s/s0 for s <= s0, tau_max (s_f - s)/(s_f - s0) for s0 < s < s_f, then 0;
/// G_f = tau_max s_f/2, K0 = tau_max/s0.
///
/// In terms of damage, tau = (1 - d) K0 s with d = s_f (s - s0)/(s (s_f - s0)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bilinear {
    strength: f64,
    s0: f64,
    sf: f64,
}

/// Parameters of a [`Bilinear`] curve by its slips.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BilinearSlips {
    /// Largest stress tau_max (MPa).
    pub strength_mpa: f64,
    /// Slip at tau_max (mm).
    pub peak_slip_mm: f64,
    /// Slip at which the stress ends (mm).
    pub final_slip_mm: f64,
}

/// Parameters of a [`Bilinear`] curve by its stiffness and fracture energy.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BilinearEnergy {
    /// Largest stress tau_max (MPa).
    pub strength_mpa: f64,
    /// Initial stiffness K0 (MPa/mm); the slip at tau_max is tau_max/K0.
    pub stiffness_mpa_per_mm: f64,
    /// Fracture energy G_f (N/mm).
    pub fracture_energy_n_per_mm: f64,
}

impl Bilinear {
    /// The curve with the given slips.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] unless all are positive and s_f > s0.
    pub fn from_slips(p: &BilinearSlips) -> Result<Self, MaterialError> {
        positive(
            LAW,
            &[
                ("strength_mpa", p.strength_mpa, "MPa"),
                ("peak_slip_mm", p.peak_slip_mm, "mm"),
                ("final_slip_mm", p.final_slip_mm, "mm"),
            ],
        )?;
        if p.final_slip_mm <= p.peak_slip_mm {
            return Err(out_of_range(
                LAW,
                "final_slip_mm",
                p.final_slip_mm,
                "mm",
                format!("({}, inf)", p.peak_slip_mm),
                "the stress must end after its peak; raise it or lower peak_slip_mm",
            ));
        }
        Ok(Self {
            strength: p.strength_mpa,
            s0: p.peak_slip_mm,
            sf: p.final_slip_mm,
        })
    }

    /// The curve with the given stiffness and energy: s0 = tau_max/K0, s_f = 2 G_f/tau_max.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] unless all are positive and G_f > tau_max s0/2.
    pub fn from_energy(p: &BilinearEnergy) -> Result<Self, MaterialError> {
        positive(
            LAW,
            &[
                ("strength_mpa", p.strength_mpa, "MPa"),
                ("stiffness_mpa_per_mm", p.stiffness_mpa_per_mm, "MPa/mm"),
                (
                    "fracture_energy_n_per_mm",
                    p.fracture_energy_n_per_mm,
                    "N/mm",
                ),
            ],
        )?;
        let s0 = p.strength_mpa / p.stiffness_mpa_per_mm;
        let least = 0.5 * p.strength_mpa * s0;
        if p.fracture_energy_n_per_mm <= least {
            return Err(out_of_range(
                LAW,
                "fracture_energy_n_per_mm",
                p.fracture_energy_n_per_mm,
                "N/mm",
                format!("({least}, inf), more than tau_max^2/(2 K0)"),
                "the rising branch alone takes that much; raise the energy or the stiffness",
            ));
        }
        Ok(Self {
            strength: p.strength_mpa,
            s0,
            sf: 2.0 * p.fracture_energy_n_per_mm / p.strength_mpa,
        })
    }
}

impl Envelope for Bilinear {
    fn name(&self) -> &'static str {
        LAW
    }

    fn stiffness(&self) -> f64 {
        self.strength / self.s0
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
        0.5 * self.strength * self.sf
    }

    fn secant(&self, slip: f64) -> (f64, f64) {
        if slip <= self.s0 {
            return (self.stiffness(), 0.0);
        }
        if slip >= self.sf {
            return (0.0, 0.0);
        }
        let slope = self.strength / (self.sf - self.s0);
        let secant = slope * (self.sf - slip) / slip;
        (secant, -slope * self.sf / (slip * slip))
    }
}
