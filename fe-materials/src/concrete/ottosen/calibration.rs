//! Calibration of the Ottosen surface to four strengths.

use fe_core::material::MaterialError;

use super::Ottosen;
use crate::limits::{out_of_range, positive};

const LAW: &str = "Ottosen surface";

/// The four points that fix the surface; MPa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Calibration {
    /// Uniaxial compressive strength fc (MPa), positive.
    pub compression: f64,
    /// Uniaxial tensile strength ft (MPa).
    pub tension: f64,
    /// Equibiaxial compressive strength fb (MPa), positive.
    pub biaxial: f64,
    /// Octahedral normal stress I1/3 (MPa) of a point on the compressive meridian, negative.
    pub octahedral_normal: f64,
    /// Octahedral shear stress sqrt(2 J2/3) (MPa) of that point, positive.
    pub octahedral_shear: f64,
}

impl Calibration {
    /// The points of fib Model Code 2010, 5.1.6.2, for mean strengths fcm and fctm (MPa):
    /// fb = (1.2 - fcm/1000) fcm, and on the compressive meridian the octahedral stresses -240 and
    /// 185 - 180 q + 260 q^2 - 84 q^3, q = fcm/100 (5.1-14 to 5.1-16).
    pub fn model_code(fcm_mpa: f64, fctm_mpa: f64) -> Self {
        let q = fcm_mpa / 100.0;
        Self {
            compression: fcm_mpa,
            tension: fctm_mpa,
            biaxial: (1.2 - fcm_mpa / 1000.0) * fcm_mpa,
            octahedral_normal: -240.0,
            octahedral_shear: 185.0 + q * (-180.0 + q * (260.0 - 84.0 * q)),
        }
    }

    fn check(&self) -> Result<(), MaterialError> {
        positive(LAW, "compression", self.compression, "MPa")?;
        positive(LAW, "tension", self.tension, "MPa")?;
        positive(LAW, "biaxial", self.biaxial, "MPa")?;
        positive(LAW, "octahedral_shear", self.octahedral_shear, "MPa")?;
        if self.tension >= self.compression {
            return Err(out_of_range(
                LAW,
                "tension",
                self.tension,
                "MPa",
                format!("(0, {}), the compressive strength", self.compression),
                "give tensile and compressive strength in MPa",
            ));
        }
        if !(self.octahedral_normal.is_finite() && self.octahedral_normal < 0.0) {
            return Err(out_of_range(
                LAW,
                "octahedral_normal",
                self.octahedral_normal,
                "MPa",
                "(-inf, 0)",
                "give a triaxial compression test, compression negative",
            ));
        }
        Ok(())
    }
}

impl Ottosen {
    /// The surface through four points.
    ///
    /// With K = ft/fc, b = fb/fc and the octahedral x, y over fc, the four conditions
    ///
    /// - tension: alpha K^2/3 + lambda_t K/sqrt3 + beta K = 1,
    /// - equibiaxial: alpha b^2/3 + lambda_t b/sqrt3 - 2 beta b = 1,
    /// - compression: alpha/3 + lambda_c/sqrt3 - beta = 1,
    /// - meridian: 3/2 alpha y^2 + sqrt(3/2) lambda_c y + 3 beta x = 1
    ///
    /// are linear in alpha, beta, lambda_c and lambda_t; then
    /// c2 = cos(3 arctan[(2 lambda_c/lambda_t - 1)/sqrt3]), c1 = lambda_c/cos[pi/3 - (1/3) arccos c2].
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] if a strength is impossible, or if the points give no closed convex
    /// surface: alpha <= 0, beta <= 0, or lambda_c/lambda_t outside (1/2, 1]. At 1/2 the deviatoric section
    /// is a triangle; with the points of [`Calibration::model_code`] this is fck = 55.1 MPa.
    pub fn new(points: &Calibration) -> Result<Self, MaterialError> {
        points.check()?;
        let strength = points.compression;
        let k = points.tension / strength;
        let b = points.biaxial / strength;
        let (x, y) = (
            points.octahedral_normal / strength,
            points.octahedral_shear / strength,
        );
        // Tension and equibiaxial: beta = offset + slope alpha; the other two eliminate lambda_c.
        let (offset, slope) = ((b - k) / (3.0 * k * b), (b - k) / 9.0);
        let root2 = std::f64::consts::SQRT_2;
        let axial = 3.0 * (y / root2 + x);
        let alpha =
            (1.0 - 3.0 * y / root2 - offset * axial) / (1.5 * y * y - y / root2 + slope * axial);
        let beta = offset + slope * alpha;
        let root3 = 3.0_f64.sqrt();
        let lambda_c = root3 * (1.0 + beta - alpha / 3.0);
        let lambda_t = root3 * (1.0 / k - beta - alpha * k / 3.0);
        for (parameter, value) in [("alpha", alpha), ("beta", beta), ("lambda_c", lambda_c)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(out_of_range(
                    LAW,
                    parameter,
                    value,
                    "-",
                    "(0, inf)",
                    "the four strengths contradict one another: the meridians would not be convex",
                ));
            }
        }
        let ratio = lambda_c / lambda_t;
        if !(ratio > 0.5 && ratio <= 1.0) {
            return Err(out_of_range(
                LAW,
                "lambda_c/lambda_t",
                ratio,
                "-",
                "(0.5, 1]",
                "the deviatoric section would not be convex; raise the tensile strength relative to the \
                 compressive one (Model Code concretes: use fck below 55.1 MPa)",
            ));
        }
        let c2 = (3.0 * ((2.0 * ratio - 1.0) / root3).atan()).cos();
        let c1 = lambda_c / (std::f64::consts::FRAC_PI_3 - c2.acos() / 3.0).cos();
        Ok(Self {
            strength,
            alpha,
            beta,
            lambda_c,
            lambda_t,
            c1,
            c2,
        })
    }
}
