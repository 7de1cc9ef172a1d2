//! Parameters of the reference law.

use fe_core::material::MaterialError;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::LAW;
use crate::concrete::ConcreteScalars;
use crate::limits::{out_of_range, positive};

/// Largest |n . v| of a crack that counts as vertical: the crack plane within 15 degrees of the vertical.
const VERTICAL_LIMIT: f64 = 0.258_819_045_102_520_76;

/// Which cracks of a region keep tension stiffening (rule of Titello for reinforced concrete beams).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum TensionStiffening {
    /// Stirrups cross the region: every crack.
    Stirrups,
    /// No stirrups: only cracks whose plane lies within 15 degrees of the given vertical direction, which
    /// the longitudinal bars cross. Any length but zero.
    VerticalCracks([f64; 3]),
    /// No reinforcement: no crack.
    None,
}

impl TensionStiffening {
    /// Whether a crack with the unit normal n keeps tension stiffening.
    pub(super) fn serves(&self, normal: &Vector3<f64>) -> bool {
        match self {
            Self::Stirrups => true,
            Self::VerticalCracks(vertical) => {
                let vertical = Vector3::from(*vertical);
                normal.dot(&vertical).abs() <= VERTICAL_LIMIT * vertical.norm()
            }
            Self::None => false,
        }
    }
}

/// Shear retention factor b of an open crack as a function of the strain e normal to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum ShearRetention {
    /// b = 1 up to e = 0.01, then max(b_min, 1 - sqrt(e/0.005)), which is b_min: the reference as printed.
    #[default]
    Threshold,
    /// b = max(b_min, 1 - sqrt(e/0.005)) from e = 0 on (Hinton 1988).
    Hinton,
}

/// Strain normal to a crack below which [`ShearRetention::Threshold`] keeps the full shear stiffness (-).
const THRESHOLD: f64 = 0.01;

/// Strain at which the square-root law of shear retention vanishes (-).
const LOOSE: f64 = 0.005;

/// Smallest strain at which the slope of the square-root law, infinite at zero, is taken (-).
const LEAST_STRAIN: f64 = 1e-8;

impl ShearRetention {
    /// Factor b >= `floor` and its slope at a strain e normal to a crack.
    pub(super) fn factor(self, e: f64, floor: f64) -> (f64, f64) {
        let whole = match self {
            Self::Threshold => THRESHOLD,
            Self::Hinton => 0.0,
        };
        let root = 1.0 - (e.max(0.0) / LOOSE).sqrt();
        if e <= whole {
            (1.0, 0.0)
        } else if root > floor {
            (root, -0.5 / (LOOSE * e.max(LEAST_STRAIN)).sqrt())
        } else {
            (floor, 0.0)
        }
    }
}

/// Parameters of [`Reference`](super::Reference); N, mm, MPa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceParameters {
    /// Mean properties of the concrete; the fracture energy is not used.
    pub concrete: ConcreteScalars,
    /// Cracks that keep tension stiffening.
    pub stiffening: TensionStiffening,
    /// Stress after cracking over the tensile strength, a_ts (-).
    pub stiffening_share: f64,
    /// Strain at which the stiffening ends, eps_ctu (-).
    pub stiffening_end: f64,
    /// Shear retention of open cracks.
    pub retention: ShearRetention,
    /// Least shear retention factor b_min (-).
    pub shear_floor: f64,
}

impl ReferenceParameters {
    /// The reference's own choices: a_ts = 0.6, eps_ctu = 0.01, retention as printed; b_min = 0.01
    /// (assumed).
    pub const fn new(concrete: ConcreteScalars, stiffening: TensionStiffening) -> Self {
        Self {
            concrete,
            stiffening,
            stiffening_share: 0.6,
            stiffening_end: 0.01,
            retention: ShearRetention::Threshold,
            shear_floor: 0.01,
        }
    }

    pub(super) fn check(&self) -> Result<(), MaterialError> {
        positive(LAW, "stiffening_end", self.stiffening_end, "-")?;
        for (parameter, value) in [
            ("stiffening_share", self.stiffening_share),
            ("shear_floor", self.shear_floor),
        ] {
            if !(value > 0.0 && value <= 1.0) {
                let remedy = "give a share of the uncracked value";
                return Err(out_of_range(LAW, parameter, value, "-", "(0, 1]", remedy));
            }
        }
        if let TensionStiffening::VerticalCracks(vertical) = self.stiffening {
            positive(
                LAW,
                "length of vertical",
                Vector3::from(vertical).norm(),
                "-",
            )?;
        }
        Ok(())
    }
}
