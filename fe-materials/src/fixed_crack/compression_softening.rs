//! Compression softening: concrete between cracks is weaker than a cylinder.

/// How cracks across a compressed axis weaken it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize)]
pub enum CompressionSoftening {
    /// Not at all.
    None,
    /// The whole compression curve is scaled by
    ///
    /// beta = 1/(1 + 0.27 (e_lat/eps_c1 - 0.37)) <= 1,  e_lat = sqrt(kt_j^2 + kt_k^2),
    ///
    /// kt_j and kt_k being the largest tensile strains ever of the two axes across (Vecchio and Collins 1993, strength
    /// reduction without their factor for high strengths; as in the guidelines of Rijkswaterstaat, RTD 1016, 2017, which
    /// stop it at 0.4: here it is not stopped).
    #[default]
    VecchioCollins,
}

/// beta = 1/(1 + SLOPE (e_lat/eps_c1 - START)).
const SLOPE: f64 = 0.27;
/// Lateral strain over eps_c1 from which concrete is weakened.
const START: f64 = 0.37;

impl CompressionSoftening {
    /// Factor beta on the compression curve of axis `i` and its derivatives with respect to the histories kt.
    pub(super) fn factor(self, kt: &[f64; 3], i: usize, eps_c1: f64) -> (f64, [f64; 3]) {
        let mut slopes = [0.0; 3];
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let lateral = kt[j].hypot(kt[k]);
        let excess = lateral / eps_c1 - START;
        if self == Self::None || excess <= 0.0 {
            return (1.0, slopes);
        }
        let factor = 1.0 / (1.0 + SLOPE * excess);
        for across in [j, k] {
            slopes[across] = -factor * factor * SLOPE / eps_c1 * kt[across] / lateral;
        }
        (factor, slopes)
    }
}
