//! The bond of externally bonded sheets after Lu, Teng, Ye and Jiang.

use fe_core::material::MaterialError;
use serde::{Deserialize, Serialize};

use super::{Bilinear, BilinearSlips, Envelope, LOST};
use crate::limits::{out_of_range, positive};

const JOINT: &str = "bond of Lu et al.";
const SIMPLIFIED: &str = "simplified bond of Lu et al.";
const PRECISE: &str = "precise bond of Lu et al.";

/// A sheet bonded to concrete, as the three bond-slip models of Lu et al. see it; MPa and mm throughout.
///
/// beta_w = sqrt((2.25 - b_f/b_c)/(1.25 + b_f/b_c)), tau_max = 1.5 beta_w f_t,
/// s0 = 0.0195 beta_w f_t, G_f = 0.308 beta_w^2 sqrt(f_t).
///
/// G_f holds for adhesives of usual stiffness, G_a/t_a >= 2.5 GPa/mm.
///
/// Source: X. Z. Lu, J. G. Teng, L. P. Ye and J. J. Jiang, "Bond-slip models for FRP sheets/plates bonded to
/// concrete", Engineering Structures 27 (2005) 920-937.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LuJoint {
    /// Tensile strength of the concrete f_t (MPa).
    pub ft_mpa: f64,
    /// Width of the sheet over that of the concrete it is bonded to, b_f/b_c (-).
    pub width_ratio: f64,
}

impl LuJoint {
    /// A joint on concrete of mean cylinder strength `fcm_mpa` (MPa):
    /// f_cu = fcm/0.76, f_t = 0.395 f_cu^0.55.
    pub fn from_cylinder_strength(fcm_mpa: f64, width_ratio: f64) -> Self {
        Self {
            ft_mpa: 0.395 * (fcm_mpa / 0.76).powf(0.55),
            width_ratio,
        }
    }

    /// Width factor beta_w (-).
    pub fn width_factor(&self) -> f64 {
        ((2.25 - self.width_ratio) / (1.25 + self.width_ratio)).sqrt()
    }

    /// Largest stress tau_max (MPa).
    pub fn strength(&self) -> f64 {
        1.5 * self.width_factor() * self.ft_mpa
    }

    /// Slip s0 at tau_max (mm), without the elastic part that the precise model adds.
    pub fn peak_slip(&self) -> f64 {
        0.0195 * self.width_factor() * self.ft_mpa
    }

    /// Fracture energy G_f (N/mm).
    pub fn energy(&self) -> f64 {
        0.308 * self.width_factor().powi(2) * self.ft_mpa.sqrt()
    }

    /// Bilinear model: s_f = 2 G_f/tau_max, K0 = tau_max/s0 = 76.92 MPa/mm for every joint.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`].
    pub fn bilinear(&self) -> Result<Bilinear, MaterialError> {
        self.check()?;
        Bilinear::from_slips(&BilinearSlips {
            strength_mpa: self.strength(),
            peak_slip_mm: self.peak_slip(),
            final_slip_mm: 2.0 * self.energy() / self.strength(),
        })
    }

    /// Simplified model.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`].
    pub fn simplified(&self) -> Result<LuSimplified, MaterialError> {
        self.check()?;
        let s0 = self.peak_slip();
        // Area up to s0, the triangle of the elastic start included.
        let rising = self.strength() * s0 * (2.0 / 3.0 - START.powf(1.5) / 6.0);
        let tail = Tail::new(SIMPLIFIED, self, s0, rising)?;
        Ok(LuSimplified { tail })
    }

    /// Precise model with the initial stiffness K0 = K_a K_c/(K_a + K_c) (MPa/mm) of adhesive, K_a = G_a/t_a,
    /// and concrete, K_c = G_c/t_c with t_c = 5 mm.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`].
    pub fn precise(&self, stiffness_mpa_per_mm: f64) -> Result<LuPrecise, MaterialError> {
        self.check()?;
        positive(
            PRECISE,
            &[("stiffness_mpa_per_mm", stiffness_mpa_per_mm, "MPa/mm")],
        )?;
        let elastic = self.strength() / stiffness_mpa_per_mm;
        let s0 = self.peak_slip() + elastic;
        let a = (s0 - elastic) / s0;
        let b = elastic / (2.0 * (s0 - elastic));
        let rising = self.strength()
            * s0
            * (2.0 * a / 3.0 * ((1.0 + b * b * a) / a).powf(1.5) - b - 2.0 / 3.0 * a * b.powi(3));
        let tail = Tail::new(PRECISE, self, s0, rising)?;
        Ok(LuPrecise {
            tail,
            stiffness: stiffness_mpa_per_mm,
            a,
            b,
        })
    }

    fn check(&self) -> Result<(), MaterialError> {
        positive(JOINT, &[("ft_mpa", self.ft_mpa, "MPa")])?;
        if self.width_ratio > 0.0 && self.width_ratio <= 1.0 {
            return Ok(());
        }
        Err(out_of_range(
            JOINT,
            "width_ratio",
            self.width_ratio,
            "-",
            "(0, 1]",
            "the sheet is at most as wide as the concrete",
        ))
    }
}

/// Falling branch tau = tau_max exp(-alpha (s/s0 - 1)) for s > s0.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Tail {
    strength: f64,
    s0: f64,
    energy: f64,
    alpha: f64,
}

impl Tail {
    /// The branch that makes up the energy of the joint beyond that of the rising branch (N/mm).
    fn new(
        law: &'static str,
        joint: &LuJoint,
        s0: f64,
        rising: f64,
    ) -> Result<Self, MaterialError> {
        let (strength, energy) = (joint.strength(), joint.energy());
        if energy <= rising {
            return Err(out_of_range(
                law,
                "ft_mpa",
                joint.ft_mpa,
                "MPa",
                "strengths whose rising branch takes less than the fracture energy",
                "lower the strength or raise the initial stiffness",
            ));
        }
        Ok(Self {
            strength,
            s0,
            energy,
            alpha: strength * s0 / (energy - rising),
        })
    }

    fn secant(&self, slip: f64) -> (f64, f64) {
        let stress = self.strength * (-self.alpha * (slip / self.s0 - 1.0)).exp();
        let slope = -stress * self.alpha / self.s0;
        (stress / slip, (slope - stress / slip) / slip)
    }

    fn final_slip(&self) -> f64 {
        self.s0 * (1.0 - LOST.ln() / self.alpha)
    }
}

/// Slip of the elastic start of [`LuSimplified`], relative to s0.
const START: f64 = 0.01;

/// Simplified model of Lu et al.: tau = tau_max sqrt(s/s0) up to s0, then
/// tau_max exp(-alpha (s/s0 - 1)).
///
/// The initial stiffness of the square root is infinite; up to s = 0.01 s0 its chord stands for it here,
/// K0 = 10 tau_max/s0. alpha = 1/(G_f/(tau_max s0) - 2/3) of the source is corrected for the area lost by
/// that, 1/6000 of tau_max s0, so that the area is G_f.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LuSimplified {
    tail: Tail,
}

impl Envelope for LuSimplified {
    fn name(&self) -> &'static str {
        SIMPLIFIED
    }

    fn stiffness(&self) -> f64 {
        self.tail.strength / (self.tail.s0 * START.sqrt())
    }

    fn strength(&self) -> f64 {
        self.tail.strength
    }

    fn peak_slip(&self) -> f64 {
        self.tail.s0
    }

    fn final_slip(&self) -> f64 {
        self.tail.final_slip()
    }

    fn energy(&self) -> f64 {
        self.tail.energy
    }

    fn secant(&self, slip: f64) -> (f64, f64) {
        let Tail { strength, s0, .. } = self.tail;
        if slip <= START * s0 {
            (self.stiffness(), 0.0)
        } else if slip <= s0 {
            let secant = strength / (slip * s0).sqrt();
            (secant, -0.5 * secant / slip)
        } else {
            self.tail.secant(slip)
        }
    }
}

/// Precise model of Lu et al.: with s_e = tau_max/K0, s0 = 0.0195 beta_w f_t + s_e, A = (s0 - s_e)/s0 and
/// B = s_e/(2(s0 - s_e)),
///
/// tau = tau_max (sqrt(s/(s0 A) + B^2) - B) up to s0, then tau_max exp(-alpha (s/s0 - 1)) with
/// alpha = tau_max s0/(G_f - G_f^a), G_f^a being the area up to s0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LuPrecise {
    tail: Tail,
    stiffness: f64,
    a: f64,
    b: f64,
}

impl Envelope for LuPrecise {
    fn name(&self) -> &'static str {
        PRECISE
    }

    fn stiffness(&self) -> f64 {
        self.stiffness
    }

    fn strength(&self) -> f64 {
        self.tail.strength
    }

    fn peak_slip(&self) -> f64 {
        self.tail.s0
    }

    fn final_slip(&self) -> f64 {
        self.tail.final_slip()
    }

    fn energy(&self) -> f64 {
        self.tail.energy
    }

    fn secant(&self, slip: f64) -> (f64, f64) {
        if slip > self.tail.s0 {
            return self.tail.secant(slip);
        }
        // sqrt(x + B^2) - B = x/(sqrt(x + B^2) + B), without cancellation near zero.
        let scale = self.tail.s0 * self.a;
        let root = (slip / scale + self.b * self.b).sqrt();
        let secant = self.tail.strength / (scale * (root + self.b));
        (secant, -0.5 * secant / (scale * root * (root + self.b)))
    }
}
