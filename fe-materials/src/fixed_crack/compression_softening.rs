//! Compression softening: concrete between cracks is weaker than a cylinder.

use fe_core::material::MaterialError;

use super::out_of_range;

/// Distance of cracks (mm) where none is given: the grid of the wires in the panels whose average strains gave the law
/// (Vecchio and Collins 1982), between which they cracked (assumed).
pub const CRACK_SPACING_MM: f64 = 50.0;

/// How cracks across a compressed axis weaken it.
#[derive(Debug, Clone, Copy, PartialEq, serde::Deserialize)]
pub enum CompressionSoftening {
    /// Not at all.
    None,
    /// The whole compression curve is scaled by
    ///
    /// beta = 1/(1 + 0.27 (e_lat/eps_c1 - 0.37)) <= 1,  e_lat = h/s sqrt(kt_j^2 + kt_k^2),
    ///
    /// kt_j and kt_k being the largest tensile strains ever of the two axes across (Vecchio and Collins 1993, strength
    /// reduction without their factor for high strengths; as in the guidelines of Rijkswaterstaat, RTD 1016, 2017, which
    /// stop it at 0.4: here it is not stopped). The strain of the law is an average over cracks at a spacing s. In a crack band of
    /// width h it is that of one crack, which opens by w = h kt: w/s does not depend on the size of the elements.
    VecchioCollins {
        /// Distance of cracks s (mm).
        crack_spacing_mm: f64,
    },
}

impl Default for CompressionSoftening {
    fn default() -> Self {
        Self::VecchioCollins {
            crack_spacing_mm: CRACK_SPACING_MM,
        }
    }
}

/// beta = 1/(1 + SLOPE (e_lat/eps_c1 - START)).
const SLOPE: f64 = 0.27;
/// Lateral strain over eps_c1 from which concrete is weakened.
const START: f64 = 0.37;

impl CompressionSoftening {
    pub(super) fn check(self) -> Result<(), MaterialError> {
        match self {
            Self::VecchioCollins {
                crack_spacing_mm: s,
            } if !(s.is_finite() && s > 0.0) => {
                Err(out_of_range("crack_spacing_mm", s, "mm", "(0, inf)"))
            }
            _ => Ok(()),
        }
    }

    /// Factor beta on the compression curve of axis `i` and its derivatives with respect to the histories kt, in a crack
    /// band of the given width (mm); `eps_c1` is the strain at the compressive strength.
    pub(super) fn factor(
        self,
        kt: &[f64; 3],
        i: usize,
        eps_c1: f64,
        band_width: f64,
    ) -> (f64, [f64; 3]) {
        let mut slopes = [0.0; 3];
        let Self::VecchioCollins { crack_spacing_mm } = self else {
            return (1.0, slopes);
        };
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let largest = kt[j].hypot(kt[k]);
        let unit = band_width / (crack_spacing_mm * eps_c1);
        let excess = unit * largest - START;
        if excess <= 0.0 {
            return (1.0, slopes);
        }
        let factor = 1.0 / (1.0 + SLOPE * excess);
        for across in [j, k] {
            slopes[across] = -factor * factor * SLOPE * unit * kt[across] / largest;
        }
        (factor, slopes)
    }
}
