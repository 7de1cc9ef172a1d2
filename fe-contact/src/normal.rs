//! What a bond law does along the normal, and against singular matrices.

use fe_core::material::MaterialError;
use serde::{Deserialize, Serialize};

use crate::limits::{out_of_range, positive};

/// Behaviour along the normal of the interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Normal {
    /// sigma_n = K_n n, open or closed, whatever the damage: the faces stay together.
    #[default]
    Bonded,
    /// sigma_n = (1 - d) K_n n open, K_n n closed: what has debonded opens freely and bears again under
    /// pressure. Couples opening and slip: the consistent tangent is unsymmetric.
    Unilateral,
}

/// Settings that every bond law on the slip shares.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct BondSettings {
    /// Behaviour along the normal.
    pub normal: Normal,
    /// Stiffness K_n along the normal over the initial stiffness K0 of the slip (-).
    pub normal_over_initial: f64,
    /// Least 1 - d (-), in stress and operator alike: a strip that has come off entirely keeps this share of
    /// its stiffness, so that the matrix stays regular.
    pub residual: f64,
}

impl Default for BondSettings {
    /// Bonded normal of 10 K0, residual of 1e-6.
    fn default() -> Self {
        Self {
            normal: Normal::Bonded,
            normal_over_initial: 10.0,
            residual: 1e-6,
        }
    }
}

impl BondSettings {
    pub(crate) fn check(&self, law: &'static str) -> Result<(), MaterialError> {
        positive(
            law,
            &[("normal_over_initial", self.normal_over_initial, "-")],
        )?;
        if self.residual >= 0.0 && self.residual <= 1e-2 {
            return Ok(());
        }
        Err(out_of_range(
            law,
            "residual",
            self.residual,
            "-",
            "[0, 0.01]",
            "give the small share of stiffness that keeps a loose strip in place, 1e-6 for instance",
        ))
    }
}
