//! The bond of ribbed bars after fib Model Code 2010.

use fe_core::material::MaterialError;
use serde::{Deserialize, Serialize};

use super::Envelope;
use crate::limits::{out_of_range, positive};

const LAW: &str = "bond of the Model Code";

/// Slip of the elastic start, relative to s1.
const START: f64 = 0.01;

/// Bond conditions of a bar in the form (fib Model Code 2010, 6.1.3.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Bond {
    /// Good bond conditions.
    Good,
    /// All other bond conditions.
    Other,
}

/// What ends the bond.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Confinement {
    /// Pull-out: cover and confinement keep the concrete from splitting.
    #[default]
    PullOut,
    /// Splitting with stirrups.
    Stirrups,
    /// Splitting without confinement.
    None,
}

/// Parameters of [`ModelCode`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelCodeParameters {
    /// Mean cylinder strength of the concrete f_cm (MPa).
    pub fcm_mpa: f64,
    /// Clear distance between the ribs c_clear (mm).
    pub rib_spacing_mm: f64,
    /// Bond conditions.
    pub bond: Bond,
    /// What ends the bond.
    #[serde(default)]
    pub confinement: Confinement,
}

/// Local bond stress over slip of ribbed bars:
///
/// | slip | tau |
/// |---|---|
/// | up to s1 | tau_bmax (s/s1)^0.4 |
/// | to s2 | tau_max |
/// | to s3 | linear to tau_bf |
/// | beyond | tau_bf |
///
/// | | tau_bmax | s1 | s2 | s3 | tau_bf |
/// |---|---|---|---|---|---|
/// | pull-out, good | 2.5 sqrt(f_cm) | 1.0 | 2.0 | c_clear | 0.4 tau_bmax |
/// | pull-out, other | 1.25 sqrt(f_cm) | 1.8 | 3.6 | c_clear | 0.4 tau_bmax |
///
/// Splitting cuts the rising branch of pull-out at tau_bu,split = 7.0 (5.0) (f_cm/25)^0.25 without confinement, 8.0 (5.5)
/// (f_cm/25)^0.25 with stirrups, for good (other) bond, at the slip s1 where the branch reaches it; then s2 = s1 and the
/// stress falls to zero at 1.2 s1 without confinement, to 0.4 tau_bu,split at 0.5 c_clear with stirrups.
///
/// The initial stiffness of the power is infinite; up to 0.01 of the s1 of pull-out its chord stands for it,
/// K0 = 15.8 tau_bmax/s1.
///
/// Unloading is that of [`SlipDamage`](crate::SlipDamage), through the origin; the steeper unloading with friction of
/// the Model Code is not modelled, nor is the decay of bond under repeated reversals.
///
/// Source: fib Model Code for Concrete Structures 2010, 6.1.1.1, equations 6.1-1 to 6.1-4 and table 6.1-1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelCode {
    /// tau_bmax and s1 of the rising branch.
    rising: [f64; 2],
    strength: f64,
    /// s1, s2 and s3.
    slips: [f64; 3],
    residual: f64,
}

const ALPHA: f64 = 0.4;

impl ModelCode {
    /// The curve of a bar.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] unless the numbers are positive, s3 lies beyond s2, and splitting beyond the chord at the
    /// beginning.
    pub fn new(p: &ModelCodeParameters) -> Result<Self, MaterialError> {
        positive(
            LAW,
            &[
                ("fcm_mpa", p.fcm_mpa, "MPa"),
                ("rib_spacing_mm", p.rib_spacing_mm, "mm"),
            ],
        )?;
        let (factor, s1, no_confinement, stirrups) = match p.bond {
            Bond::Good => (2.5, 1.0, 7.0, 8.0),
            Bond::Other => (1.25, 1.8, 5.0, 5.5),
        };
        let rising = [factor * p.fcm_mpa.sqrt(), s1];
        let splitting = |at_25: f64| {
            let strength = (at_25 * (p.fcm_mpa / 25.0).powf(0.25)).min(rising[0]);
            (strength, s1 * (strength / rising[0]).powf(1.0 / ALPHA))
        };
        let (strength, slips, residual) = match p.confinement {
            Confinement::PullOut => {
                let strength = rising[0];
                (strength, [s1, 2.0 * s1, p.rib_spacing_mm], 0.4 * strength)
            }
            Confinement::Stirrups => {
                let (strength, at) = splitting(stirrups);
                (strength, [at, at, 0.5 * p.rib_spacing_mm], 0.4 * strength)
            }
            Confinement::None => {
                let (strength, at) = splitting(no_confinement);
                (strength, [at, at, 1.2 * at], 0.0)
            }
        };
        if slips[0] <= START * rising[1] {
            return Err(out_of_range(
                LAW,
                "fcm_mpa",
                p.fcm_mpa,
                "MPa",
                format!(
                    "strengths at which the bond splits beyond a slip of {} mm",
                    START * rising[1]
                ),
                "give the cylinder strength of a concrete in MPa",
            ));
        }
        if slips[2] <= slips[1] {
            return Err(out_of_range(
                LAW,
                "rib_spacing_mm",
                p.rib_spacing_mm,
                "mm",
                format!(
                    "spacings that put the end of softening beyond {:.3} mm",
                    slips[1]
                ),
                "give the clear distance between the ribs, about half the diameter of the bar",
            ));
        }
        Ok(Self {
            rising,
            strength,
            slips,
            residual,
        })
    }

    /// Stress tau_bf (MPa) that remains at any slip.
    pub const fn residual(&self) -> f64 {
        self.residual
    }

    /// Slips s1, s2, s3 (mm).
    pub const fn slips(&self) -> [f64; 3] {
        self.slips
    }

    /// Stress and slope (MPa/mm) beyond the elastic start.
    fn curve(&self, slip: f64) -> (f64, f64) {
        let [s1, s2, s3] = self.slips;
        if slip <= s1 {
            let stress = self.rising[0] * (slip / self.rising[1]).powf(ALPHA);
            (stress, ALPHA * stress / slip)
        } else if slip <= s2 {
            (self.strength, 0.0)
        } else if slip <= s3 {
            let slope = (self.residual - self.strength) / (s3 - s2);
            (self.strength + slope * (slip - s2), slope)
        } else {
            (self.residual, 0.0)
        }
    }
}

impl Envelope for ModelCode {
    fn name(&self) -> &'static str {
        LAW
    }

    fn stiffness(&self) -> f64 {
        self.rising[0] / self.rising[1] * START.powf(ALPHA - 1.0)
    }

    fn strength(&self) -> f64 {
        self.strength
    }

    fn peak_slip(&self) -> f64 {
        self.slips[0]
    }

    fn final_slip(&self) -> f64 {
        self.slips[2]
    }

    fn energy(&self) -> f64 {
        if self.residual > 0.0 {
            return f64::INFINITY;
        }
        let [s1, s2, s3] = self.slips;
        let start = START * self.rising[1];
        let rising =
            |slip: f64| self.rising[0] * slip * (slip / self.rising[1]).powf(ALPHA) / (1.0 + ALPHA);
        let chord = 0.5 * self.stiffness() * start * start;
        chord + rising(s1) - rising(start) + self.strength * (0.5 * (s2 + s3) - s1)
    }

    fn secant(&self, slip: f64) -> (f64, f64) {
        if slip <= START * self.rising[1] {
            return (self.stiffness(), 0.0);
        }
        let (stress, slope) = self.curve(slip);
        (stress / slip, (slope - stress / slip) / slip)
    }
}
