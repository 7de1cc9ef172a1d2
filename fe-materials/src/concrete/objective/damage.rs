//! Tensile damage of a crack band with exponential softening.

use fe_core::material::MaterialError;

use super::LAW;
use crate::limits::out_of_range;

/// Damage d(kt) of uniaxial tension: with eps0 = ft/E and eps_f = G_F/(h ft) + eps0/2,
///
/// d = 0 for kt <= eps0, else 1 - (eps0/kt) exp[-(kt - eps0)/(eps_f - eps0)].
///
/// The area under the curve is G_F/h: ft eps0/2 before the peak and ft (eps_f - eps0) after it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Softening {
    onset: f64,
    /// eps_f - eps0.
    decay: f64,
}

impl Softening {
    /// The curve for a band of width h (mm); eps_f > eps0 needs h < 2 E G_F/ft^2.
    pub(super) fn new(
        young: f64,
        strength: f64,
        fracture_energy: f64,
        band_width: f64,
    ) -> Result<Self, MaterialError> {
        let limit = 2.0 * young * fracture_energy / (strength * strength);
        if !(band_width > 0.0 && band_width.is_finite()) {
            let remedy = "give the size of the element";
            return Err(out_of_range(
                LAW,
                "band_width",
                band_width,
                "mm",
                "(0, inf)",
                remedy,
            ));
        }
        if band_width >= limit {
            return Err(MaterialError::BandTooWide {
                law: LAW,
                band_width,
                limit,
                reason: "tension softening would snap back",
            });
        }
        let onset = strength / young;
        Ok(Self {
            onset,
            decay: fracture_energy / (band_width * strength) - 0.5 * onset,
        })
    }

    /// d and dd/dkt.
    pub(super) fn damage(&self, kt: f64) -> (f64, f64) {
        if kt <= self.onset {
            return (0.0, 0.0);
        }
        let intact = self.onset / kt * (-(kt - self.onset) / self.decay).exp();
        (1.0 - intact, intact * (1.0 / kt + 1.0 / self.decay))
    }
}
