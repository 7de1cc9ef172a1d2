//! Shear across open cracks.

use super::{FixedCrackParameters, out_of_range};
use fe_core::material::MaterialError;

/// What carries shear across cracks beside the bridges that tension softening counts.
#[derive(Debug, Clone, Copy, PartialEq, serde::Deserialize)]
pub enum ShearTransfer {
    /// Nothing: tau = b G0 gamma, b = max(b_min, min over the two axes of min(Et(kt), Ec(kc))/E), damage-based
    /// retention as in DIANA, made irreversible.
    Damage,
    /// The larger of that and the interlock of aggregate,
    ///
    /// |tau| = max(b G0 |gamma|, min(r G0 |gamma|, v)),
    ///
    /// at the opening w = h max(kt - ft/E) of the pair of axes. The faces slip by s = tau/k and the concrete between
    /// them shears, r = k h/(k h + G0), with the stiffness of Walraven (1981)
    ///
    /// k = 1.8 w^-0.80 + (0.234 w^-0.707 - 0.20) f_cc (MPa/mm), f_cc = 1.2 fcm (cubes),
    ///
    /// never more than the pair's min Ec(kc)/E; the strength is that of Vecchio and Collins (1986)
    ///
    /// v = 0.18 sqrt(fcm)/(0.31 + 24 w/(a + 16)) (MPa), a the largest aggregate (mm).
    Interlock {
        /// Largest aggregate a (mm).
        aggregate_mm: f64,
    },
}

/// Cube over cylinder strength (Eurocode 2, table 3.1: 1.2 to 1.25).
const CUBE: f64 = 1.2;

/// Interlock at one opening, with derivatives with respect to the opening.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interlock {
    /// Stiffness factor r (-) and dr/dw (1/mm).
    pub factor: (f64, f64),
    /// Strength v (MPa) and dv/dw (MPa/mm).
    pub strength: (f64, f64),
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

    /// Interlock at opening `w` (mm) over the band `h` (mm); `None` without it and without an opening.
    pub(super) fn interlock(
        self,
        p: &FixedCrackParameters,
        shear_modulus: f64,
        h: f64,
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
            let sum = stiffness * h + shear_modulus;
            (stiffness * h / sum, slope * h * shear_modulus / (sum * sum))
        } else {
            (0.0, 0.0)
        };
        let growth = 24.0 / (aggregate_mm + 16.0);
        let strength = 0.18 * p.fcm_mpa.sqrt() / (0.31 + growth * w);
        let strength = (strength, -strength * growth / (0.31 + growth * w));
        Some(Interlock { factor, strength })
    }
}

/// Free energy (MPa) of |tau| = max(b g, min(r g, v)), g = G0 |gamma|, at g.
pub(super) fn energy(b: f64, interlock: Option<(f64, f64)>, shear_modulus: f64, g: f64) -> f64 {
    let twice = match interlock {
        Some((r, v)) if r > b => {
            let (first, last) = (v / r, v / b);
            if g <= first {
                r * g * g
            } else {
                let flat = v * (2.0 * g.min(last) - first);
                flat + b * (g * g - last * last).max(0.0)
            }
        }
        _ => b * g * g,
    };
    0.5 * twice / shear_modulus
}
