//! Uniaxial compression curve of concrete and the hardening law of the plasticity that follows from it.

use fe_core::material::MaterialError;

use super::ConcreteScalars;
use crate::limits::{out_of_range, positive};

const LAW: &str = "compression curve";

/// Share of the strength that crushed concrete keeps in the regularised branch (assumed; it only keeps
/// the stress from vanishing).
const RESIDUAL: f64 = 0.02;

/// Uniaxial compression curve sbar(eps) and its plastic strain kappa; magnitudes, compression positive.
///
/// With eta = eps/eps_c1 and k = Eci eps_c1/fcm (fib Model Code 2010, 5.1-26),
///
/// $$ \frac{\bar s}{f_{cm}} = \frac{k\eta - \eta^2}{1 + (k-2)\eta}, \qquad
/// \kappa = \varepsilon_{c1}\eta - \frac{\bar s}{E_{ci}}
///        = \varepsilon_{c1} \frac{(k-1)^2}{k} \frac{\eta^2}{1 + (k-2)\eta}. $$
///
/// The curve ends in one of two ways:
///
/// - [`CompressionCurve::model_code`]: up to eps_c,lim, afterwards the stress is constant (assumed; the
///   Code ends there);
/// - [`CompressionCurve::regularised`]: from the peak on, a parabola that dissipates the crushing energy
///   G_c in a band of width h, down to a residual stress of 2 %:
///   sbar = fcm (1 - ((eps - eps_c1)/w)^2), w = 1.5 G_c/(h fcm).
///
/// kappa grows strictly with eta on every branch, so that eta parametrises the curve; kappa does not near
/// the origin, where dsbar/dkappa is infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompressionCurve {
    strength: f64,
    young: f64,
    peak_strain: f64,
    plasticity: f64,
    end: End,
}

/// What follows the Model Code curve.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    /// Constant stress beyond eta = `start`.
    Plateau { start: f64 },
    /// Parabola of strain width `width` beyond eta = 1.
    Parabola { width: f64 },
}

/// One point of the curve; derivatives with respect to eta.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Stress sbar (MPa).
    pub stress: f64,
    /// dsbar/deta (MPa).
    pub stress_slope: f64,
    /// Plastic strain kappa (-).
    pub kappa: f64,
    /// dkappa/deta (-), positive for eta > 0.
    pub kappa_slope: f64,
}

impl CurvePoint {
    /// Hardening modulus H = dsbar/dkappa (MPa); infinite at the origin.
    pub fn hardening_modulus(&self) -> f64 {
        self.stress_slope / self.kappa_slope
    }
}

impl CompressionCurve {
    /// The curve of fib Model Code 2010 with a constant stress beyond eps_c,lim.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] if a property is not positive, if the peak does not lie beyond the
    /// elastic strain (k <= 1), or if eps_c,lim lies before the peak or beyond the zero of the curve,
    /// eta = k.
    pub fn model_code(p: &ConcreteScalars) -> Result<Self, MaterialError> {
        positive(LAW, "fcm_mpa", p.fcm_mpa, "MPa")?;
        positive(LAW, "young_mpa", p.young_mpa, "MPa")?;
        positive(LAW, "eps_c1", p.eps_c1, "-")?;
        let plasticity = p.plasticity_number();
        if plasticity <= 1.0 {
            return Err(out_of_range(
                LAW,
                "eps_c1",
                p.eps_c1,
                "-",
                format!("({:.6}, inf), beyond fcm/E", p.fcm_mpa / p.young_mpa),
                "raise eps_c1 or the modulus, or lower the strength",
            ));
        }
        let start = p.eps_c_lim / p.eps_c1;
        // The curve must be positive and finite up to its end: zero at eta = k, pole at 1/(2 - k).
        if !(start >= 1.0 && start < plasticity) {
            return Err(out_of_range(
                LAW,
                "eps_c_lim",
                p.eps_c_lim,
                "-",
                format!(
                    "[{:.6}, {:.6}), from eps_c1 to k eps_c1",
                    p.eps_c1,
                    p.eps_c1 * plasticity
                ),
                "end the curve where its stress is still positive",
            ));
        }
        Ok(Self {
            strength: p.fcm_mpa,
            young: p.young_mpa,
            peak_strain: p.eps_c1,
            plasticity,
            end: End::Plateau { start },
        })
    }

    /// The same curve up to its peak, then regularised: it dissipates `crushing_energy` G_c (N/mm) after
    /// the peak in a band of width h = `band_width` (mm). Both are positive; others give a curve that means nothing.
    #[must_use]
    pub fn regularised(&self, crushing_energy: f64, band_width: f64) -> Self {
        let width = 1.5 * crushing_energy / (band_width * self.strength);
        Self {
            end: End::Parabola { width },
            ..*self
        }
    }

    /// Strength fcm (MPa).
    pub const fn strength(&self) -> f64 {
        self.strength
    }

    /// Strain eps_c1 at the strength, positive (-).
    pub const fn peak_strain(&self) -> f64 {
        self.peak_strain
    }

    /// Plastic strain at the peak, kappa_p = eps_c1 - fcm/Eci (-).
    pub fn peak_kappa(&self) -> f64 {
        self.peak_strain - self.strength / self.young
    }

    /// The point at eta = eps/eps_c1 >= 0.
    pub fn at(&self, eta: f64) -> CurvePoint {
        match self.end {
            End::Plateau { start } if eta > start => self.constant(eta, self.rising(start).stress),
            End::Parabola { width } if eta > 1.0 => self.falling(eta, width),
            _ => self.rising(eta),
        }
    }

    /// eta at a plastic strain kappa >= 0: the closed inverse of kappa(eta).
    ///
    /// On the Model Code curve, with p = kappa/eps_c1 and s = sbar/fcm, s is the positive root of
    /// ((k-1)/k)^2 s^2 + ((k^2-2k+2)/k) p s - p (k-p) = 0, and eta = p + s/k.
    pub fn eta(&self, kappa: f64) -> f64 {
        let k = self.plasticity;
        match self.end {
            End::Plateau { start } if kappa > self.rising(start).kappa => {
                (kappa + self.rising(start).stress / self.young) / self.peak_strain
            }
            End::Parabola { width } if kappa > self.peak_kappa() => {
                let excess = kappa - self.peak_kappa();
                // kappa - kappa_p = z + fcm z^2/(E w^2) for z = eps - eps_c1.
                let bend = self.strength / (self.young * width * width);
                let z = 2.0 * excess / (1.0 + (1.0 + 4.0 * bend * excess).sqrt());
                if z <= floor_strain(width) {
                    1.0 + z / self.peak_strain
                } else {
                    (kappa + RESIDUAL * self.strength / self.young) / self.peak_strain
                }
            }
            _ => {
                let p = kappa / self.peak_strain;
                let a = ((k - 1.0) / k).powi(2);
                let b = k - 2.0 + 2.0 / k;
                let c = p * (k - p);
                let root = (b * b * p * p + 4.0 * a * c).sqrt();
                if root == 0.0 {
                    0.0
                } else {
                    p + 2.0 * c / (b * p + root) / k
                }
            }
        }
    }

    /// Consumed share of the fall from the peak to the residual stress: 0 up to the peak, 1 at the end.
    pub fn crushing(&self, eta: f64) -> f64 {
        if eta <= 1.0 {
            return 0.0;
        }
        let residual = match self.end {
            End::Plateau { start } => self.rising(start).stress,
            End::Parabola { .. } => RESIDUAL * self.strength,
        };
        let fall = self.strength - residual;
        if fall > 0.0 {
            ((self.strength - self.at(eta).stress) / fall).min(1.0)
        } else {
            1.0
        }
    }

    fn rising(&self, eta: f64) -> CurvePoint {
        let k = self.plasticity;
        let bottom = 1.0 + (k - 2.0) * eta;
        let (square, scale) = (bottom * bottom, self.peak_strain * (k - 1.0).powi(2) / k);
        CurvePoint {
            stress: self.strength * (k - eta) * eta / bottom,
            stress_slope: self.strength * (k - 2.0 * eta - (k - 2.0) * eta * eta) / square,
            kappa: scale * eta * eta / bottom,
            kappa_slope: scale * eta * (1.0 + bottom) / square,
        }
    }

    fn falling(&self, eta: f64, width: f64) -> CurvePoint {
        let z = self.peak_strain * (eta - 1.0);
        if z > floor_strain(width) {
            return self.constant(eta, RESIDUAL * self.strength);
        }
        let stress = self.strength * (1.0 - (z / width).powi(2));
        let stress_slope = -2.0 * self.strength * z / (width * width) * self.peak_strain;
        CurvePoint {
            stress,
            stress_slope,
            kappa: self.peak_strain * eta - stress / self.young,
            kappa_slope: self.peak_strain - stress_slope / self.young,
        }
    }

    fn constant(&self, eta: f64, stress: f64) -> CurvePoint {
        CurvePoint {
            stress,
            stress_slope: 0.0,
            kappa: self.peak_strain * eta - stress / self.young,
            kappa_slope: self.peak_strain,
        }
    }
}

/// Strain past the peak at which the parabola reaches the residual stress.
fn floor_strain(width: f64) -> f64 {
    width * (1.0 - RESIDUAL).sqrt()
}

#[cfg(test)]
mod tests;
