//! Uniaxial envelopes of the fixed-crack law, as secant moduli of a history variable.

use fe_core::material::MaterialError;

use super::FixedCrackParameters;

/// Softening branches fall no steeper than this many times the elastic slope.
const STEEPEST: f64 = 5.0;

/// Share of the compressive strength that crushed concrete keeps (Nakamura and Higai 2001 use 0.1
/// to 0.2; assumed 0.1).
pub(super) const RESIDUAL_COMPRESSION: f64 = 0.1;

/// Tension softening of one axis from e_cr = ft/E on, regularised by the crack band h (Bazant and Oh 1983): the area
/// under the curve, rise included, is G_F/h.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum TensionSoftening {
    /// sigma = ft (e_u - k)/(e_u - e_cr), e_u = 2 G_F/(ft h).
    Linear,
    /// sigma = ft exp(-(k - e_cr)/e_f), e_f = G_F/(ft h) - e_cr/2.
    #[default]
    Exponential,
}

/// Softening with the numbers of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tension {
    shape: TensionSoftening,
    strength: f64,
    young: f64,
    cracking: f64,
    /// e_u - e_cr or e_f: strength over slope at the start.
    reach: f64,
}

impl Tension {
    pub(super) fn new(
        p: &FixedCrackParameters,
        strength: f64,
        band_width: f64,
    ) -> Result<Self, MaterialError> {
        let cracking = strength / p.young_mpa;
        // (area under the softening branch)/(strength reach), reach/cracking at the steepest.
        let share = match p.tension_softening {
            TensionSoftening::Linear => 0.5,
            TensionSoftening::Exponential => 1.0,
        };
        let reach = (p.fracture_energy / (strength * band_width) - 0.5 * cracking) / share;
        let least = cracking / STEEPEST;
        if reach < least {
            return Err(MaterialError::BandTooWide {
                law: super::NAME,
                band_width,
                limit: p.fracture_energy / (strength * (share * least + 0.5 * cracking)),
                reason: "tension softening would snap back",
            });
        }
        Ok(Self {
            shape: p.tension_softening,
            strength,
            young: p.young_mpa,
            cracking,
            reach,
        })
    }

    /// Stress of the softening branch and its slope.
    fn softening(&self, k: f64) -> (f64, f64) {
        let x = (k - self.cracking) / self.reach;
        match self.shape {
            TensionSoftening::Linear if x >= 1.0 => (0.0, 0.0),
            TensionSoftening::Linear => (self.strength * (1.0 - x), -self.strength / self.reach),
            TensionSoftening::Exponential => {
                let stress = self.strength * (-x).exp();
                (stress, -stress / self.reach)
            }
        }
    }

    /// Secant modulus of the envelope at a history strain k >= 0 and its derivative with respect to k.
    pub(super) fn secant(&self, k: f64) -> (f64, f64) {
        if k <= self.cracking {
            return (self.young, 0.0);
        }
        let (stress, slope) = self.softening(k);
        (stress / k, (slope - stress / k) / k)
    }
}

/// Compression of one axis: the curve of fib Model Code 2010, 5.1-26, up to the peak,
/// sigma = fcm (K n - n^2)/(1 + (K - 2) n) with n = k/eps_c1 and K = E eps_c1/fcm, then a line to the
/// residual stress over 2 G_c/(fcm h).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Compression {
    strength: f64,
    peak: f64,
    plasticity: f64,
    descent: f64,
    young: f64,
}

impl Compression {
    pub(super) fn new(p: &FixedCrackParameters, band_width: f64) -> Result<Self, MaterialError> {
        let descent = 2.0 * p.crushing_energy / (p.fcm_mpa * band_width);
        let elastic = (1.0 - RESIDUAL_COMPRESSION) * p.fcm_mpa / p.young_mpa;
        if descent < elastic {
            return Err(MaterialError::BandTooWide {
                law: super::NAME,
                band_width,
                limit: 2.0 * p.crushing_energy / (p.fcm_mpa * elastic),
                reason: "compression softening would snap back",
            });
        }
        Ok(Self {
            strength: p.fcm_mpa,
            peak: p.eps_c1,
            plasticity: p.young_mpa * p.eps_c1 / p.fcm_mpa,
            descent,
            young: p.young_mpa,
        })
    }

    /// Stress magnitude and its slope at a compressive strain k >= 0.
    fn envelope(&self, k: f64) -> (f64, f64) {
        let n = k / self.peak;
        if n <= 1.0 {
            let c = self.plasticity;
            let bottom = 1.0 + (c - 2.0) * n;
            let stress = self.strength * (c * n - n * n) / bottom;
            let slope = self.strength / self.peak
                * ((c - 2.0 * n) * bottom - (c * n - n * n) * (c - 2.0))
                / (bottom * bottom);
            return (stress, slope);
        }
        let share = (k - self.peak) / self.descent;
        if share >= 1.0 {
            (RESIDUAL_COMPRESSION * self.strength, 0.0)
        } else {
            let drop = 1.0 - RESIDUAL_COMPRESSION;
            (
                self.strength * (1.0 - drop * share),
                -self.strength * drop / self.descent,
            )
        }
    }

    /// Secant modulus of the envelope at a history strain k >= 0 and its derivative with respect to k.
    pub(super) fn secant(&self, k: f64) -> (f64, f64) {
        if k <= 0.0 {
            return (self.young, 0.0);
        }
        let (stress, slope) = self.envelope(k);
        let secant = stress / k;
        // The difference of two nearly equal slopes is lost to rounding near the origin.
        let slope = if k <= 1e-12 {
            0.0
        } else {
            (slope - secant) / k
        };
        (secant, slope)
    }

    /// Consumed share of the descending branch.
    pub(super) fn crushing(&self, k: f64) -> f64 {
        ((k - self.peak) / self.descent).clamp(0.0, 1.0)
    }
}
