//! Shear across open cracks.

use super::{FixedCrackParameters, out_of_range};
use fe_core::material::MaterialError;

/// What carries shear across cracks beside the bridges that tension softening counts.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum ShearTransfer {
    /// Nothing: tau = b G0 gamma, b = max(b_min, min over the axes of Et(kt)/E and Ec(kc)/E), damage-based retention as in
    /// DIANA, made irreversible; without a limit on the stress.
    Damage,
    /// The larger of that and the interlock of aggregate, up to the strength of the faces,
    ///
    /// |tau| = min(max(b, r) G0 |gamma|, v),
    ///
    /// at the widest opening w = l max(kt - ft/E), l = max(h, s) being the
    /// [reach](FixedCrackParameters::crack_reach) of a crack. The faces slip by tau/k and the concrete between
    /// them shears, r = k l/(k l + G0), with the stiffness of Walraven (1981)
    ///
    /// k = 1.8 w^-0.80 + (0.234 w^-0.707 - 0.20) f_cc (MPa/mm), f_cc = 1.2 fcm (cubes),
    ///
    /// never more than the least Ec(kc)/E; the strength is that of Vecchio and Collins (1986), fitted to the tests of
    /// Walraven,
    ///
    /// v = 0.18 v_m + 1.64 p - 0.82 p^2/v_m,  v_m = sqrt(fcm)/(0.31 + 24 w/(a + 16)) (MPa),
    ///
    /// p being the pressure across the crack of that opening, up to v_m, and a the largest aggregate (mm). What has slipped
    /// unloads to the origin: the share tau/(G0 gamma) never grows again.
    Interlock {
        /// Largest aggregate a (mm).
        aggregate_mm: f64,
    },
}

/// Cube over cylinder strength (Eurocode 2, table 3.1: 1.2 to 1.25).
const CUBE: f64 = 1.2;

/// Interlock at one opening.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interlock {
    /// Stiffness factor r (-) and dr/dw (1/mm).
    pub factor: (f64, f64),
    /// v_m (MPa) and dv_m/dw (MPa/mm).
    full: (f64, f64),
}

/// Strength of the faces of a crack.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strength {
    /// v (MPa).
    pub value: f64,
    /// dv/dw (MPa/mm).
    pub by_opening: f64,
    /// dv/dp (-).
    pub by_pressure: f64,
}

impl Interlock {
    /// v = 0.18 v_m + 1.64 p - 0.82 p^2/v_m, where the pressure p (MPa) across the crack counts from 0 to v_m.
    pub(super) fn strength(&self, pressure: f64) -> Strength {
        let (full, slope) = self.full;
        let p = pressure.clamp(0.0, full);
        let held = p > 0.0 && pressure < full;
        let by_full = if pressure < full {
            0.18 + 0.82 * (p / full).powi(2)
        } else {
            1.0
        };
        Strength {
            value: 0.18 * full + 1.64 * p - 0.82 * p * p / full,
            by_opening: by_full * slope,
            by_pressure: if held { 1.64 * (1.0 - p / full) } else { 0.0 },
        }
    }
}

impl ShearTransfer {
    pub(super) fn check(self) -> Result<(), MaterialError> {
        match self {
            Self::Interlock { aggregate_mm }
                if !(aggregate_mm.is_finite() && aggregate_mm > 0.0) =>
            {
                Err(out_of_range("aggregate_mm", aggregate_mm, "mm", "(0, inf)"))
            }
            _ => Ok(()),
        }
    }

    /// Interlock at opening `w` (mm) of a crack of reach `l` (mm); `None` without it and without an opening.
    pub(super) fn interlock(
        self,
        p: &FixedCrackParameters,
        shear_modulus: f64,
        l: f64,
        w: f64,
    ) -> Option<Interlock> {
        let Self::Interlock { aggregate_mm } = self else {
            return None;
        };
        if w <= 0.0 {
            return None;
        }
        let log = w.ln();
        let (first, second) = (1.8 * (-0.80 * log).exp(), 0.234 * (-0.707 * log).exp());
        let cube = CUBE * p.fcm_mpa;
        let stiffness = first + (second - 0.20) * cube;
        let factor = if stiffness > 0.0 {
            let slope = (-0.80 * first - 0.707 * second * cube) / w;
            let sum = stiffness * l + shear_modulus;
            (stiffness * l / sum, slope * l * shear_modulus / (sum * sum))
        } else {
            (0.0, 0.0)
        };
        let growth = 24.0 / (aggregate_mm + 16.0);
        let bottom = 0.31 + growth * w;
        let full = p.fcm_mpa.sqrt() / bottom;
        let full = (full, -full * growth / bottom);
        Some(Interlock { factor, full })
    }
}
