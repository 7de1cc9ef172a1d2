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
    /// the peak in a band of width h = `band_width` (mm).
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
mod tests {
    //! Protects the curve, its plastic strain and the closed inverse.
    use approx::assert_relative_eq;

    use super::*;

    fn curve(fck: f64) -> CompressionCurve {
        let p = ConcreteScalars::from_characteristic(fck).unwrap();
        CompressionCurve::model_code(&p).unwrap()
    }

    /// Benchmark MAT-05: fib Model Code 2010, stress at 0.5, 1, 1.5 and 3 permille. Target: printed digits.
    #[test]
    fn model_code_stresses() {
        for (fck, young, k, targets) in [
            (20.0, 30303.0, 2.273, [12.74, 21.20, 26.09, 24.30]),
            (30.0, 33551.0, 2.031, [14.88, 26.02, 33.49, 34.62]),
        ] {
            let p = ConcreteScalars::from_characteristic(fck).unwrap();
            assert!((p.young_mpa - young).abs() < 0.6);
            assert!((p.plasticity_number() - k).abs() < 6e-4);
            let curve = curve(fck);
            for (strain, target) in [0.5e-3, 1e-3, 1.5e-3, 3e-3].into_iter().zip(targets) {
                assert!((curve.at(strain / p.eps_c1).stress - target).abs() < 6e-3);
            }
        }
    }

    #[test]
    fn peak_and_plateau() {
        let p = ConcreteScalars::from_characteristic(27.5).unwrap();
        let curve = curve(27.5);
        let peak = curve.at(1.0);
        assert_relative_eq!(peak.stress, p.fcm_mpa, max_relative = 1e-14);
        assert!(peak.stress_slope.abs() < 1e-11);
        assert_relative_eq!(peak.kappa, curve.peak_kappa(), max_relative = 1e-13);
        let end = p.eps_c_lim / p.eps_c1;
        assert_relative_eq!(curve.at(5.0).stress, curve.at(end).stress);
        assert_eq!((curve.crushing(1.0), curve.crushing(5.0)), (0.0, 1.0));
    }

    /// Inverse and slopes on every branch of both endings, from 1e-9 to 20 times the peak strain.
    #[test]
    fn inverse_and_slopes() {
        for fck in [12.0, 27.5, 50.0] {
            let code = curve(fck);
            for curve in [
                code,
                code.regularised(35.0, 50.0),
                code.regularised(35.0, 1000.0),
            ] {
                assert_eq!(curve.eta(0.0), 0.0);
                for i in 0..400 {
                    let eta = 10.0_f64.powf(-9.0 + 10.3 * f64::from(i) / 400.0);
                    let point = curve.at(eta);
                    assert_relative_eq!(curve.eta(point.kappa), eta, max_relative = 1e-11);
                    let d = 1e-6 * eta;
                    let (a, b) = (curve.at(eta + d), curve.at(eta - d));
                    let slope = (a.stress - b.stress) / (2.0 * d);
                    let scale = curve.strength();
                    assert!((slope - point.stress_slope).abs() < 1e-6 * scale / eta.min(1.0));
                    let slope = (a.kappa - b.kappa) / (2.0 * d);
                    assert_relative_eq!(slope, point.kappa_slope, max_relative = 1e-5);
                }
            }
        }
    }

    /// The regularised branch dissipates G_c/h up to its zero: integral of the parabola.
    #[test]
    fn regularised_branch_dissipates_the_crushing_energy() {
        let (gc, h) = (35.0, 50.0);
        let curve = curve(27.5).regularised(gc, h);
        let n = 20_000;
        let width = 1.5 * gc / (h * curve.strength()) * 0.98_f64.sqrt();
        let step = width / f64::from(n);
        let area: f64 = (0..n)
            .map(|i| {
                curve
                    .at(1.0 + step * (f64::from(i) + 0.5) / curve.peak_strain())
                    .stress
                    * step
            })
            .sum();
        // Integral up to the residual stress: 3/2 a - a^3/2 of G_c/h with a^2 = 0.98.
        let a = 0.98_f64.sqrt();
        assert_relative_eq!(
            area,
            gc / h * (1.5 * a - 0.5 * a.powi(3)),
            max_relative = 1e-8
        );
    }

    #[test]
    fn impossible_curves_are_refused() {
        let good = ConcreteScalars::from_characteristic(27.5).unwrap();
        for bad in [
            ConcreteScalars {
                eps_c1: 1e-3,
                ..good
            },
            ConcreteScalars {
                eps_c_lim: 2e-3,
                ..good
            },
            ConcreteScalars {
                eps_c_lim: 5e-3,
                ..good
            },
            ConcreteScalars {
                young_mpa: f64::NAN,
                ..good
            },
            ConcreteScalars {
                fcm_mpa: -1.0,
                ..good
            },
        ] {
            assert!(CompressionCurve::model_code(&bad).is_err(), "{bad:?}");
        }
    }
}
