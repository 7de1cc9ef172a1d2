//! Compression softening: concrete between cracks is weaker than a cylinder.

/// How cracks across a compressed axis weaken it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum CompressionSoftening {
    /// Not at all.
    None,
    /// The whole compression curve is scaled by
    ///
    /// beta = 1/(1 + C 0.27 (e_lat/eps_c1 - 0.37)) <= 1,  C = 1,  e_lat = l/s sqrt(kt_j^2 + kt_k^2),
    ///
    /// kt_j and kt_k being the largest tensile strains ever of the two axes across (Vecchio and Collins 1993, strength
    /// reduction without their factor for high strengths; as in the guidelines of Rijkswaterstaat, RTD 1016, 2017, which
    /// stop it at 0.4: here it is not stopped). The strain of the law is an average over cracks, which open by w = l kt
    /// ([`FixedCrackParameters::crack_reach`](super::FixedCrackParameters::crack_reach)) at a spacing s.
    #[default]
    VecchioCollins,
    /// The same with C = 0.55: for laws that count the slip of cracks, in whose tests the strain across held that of the slip
    /// too (Vecchio 2000; Wong, Vecchio and Trommels 2013, at second hand, for this form).
    VecchioCollinsSlip,
}

/// beta = 1/(1 + C SLOPE (e_lat/eps_c1 - START)).
const SLOPE: f64 = 0.27;
/// C where cracks slip.
const SLIP: f64 = 0.55;
/// Lateral strain over eps_c1 from which concrete is weakened.
const START: f64 = 0.37;

impl CompressionSoftening {
    /// Factor beta on the compression curve of axis `i` and its derivatives with respect to the histories kt; `unit` is
    /// l/(s eps_c1), eps_c1 being the strain at the compressive strength.
    pub(super) fn factor(self, kt: &[f64; 3], i: usize, unit: f64) -> (f64, [f64; 3]) {
        let mut slopes = [0.0; 3];
        let slope = match self {
            Self::None => return (1.0, slopes),
            Self::VecchioCollins => SLOPE,
            Self::VecchioCollinsSlip => SLIP * SLOPE,
        };
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let largest = kt[j].hypot(kt[k]);
        let excess = unit * largest - START;
        if excess <= 0.0 {
            return (1.0, slopes);
        }
        let factor = 1.0 / (1.0 + slope * excess);
        for across in [j, k] {
            slopes[across] = -factor * factor * slope * unit * kt[across] / largest;
        }
        (factor, slopes)
    }
}
