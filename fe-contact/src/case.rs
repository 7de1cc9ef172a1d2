//! A cohesive law as text, without viscosity: plain data for any format that serde reads.

use fe_core::kinematics::Interface;
use fe_core::material::{Material, MaterialError};
use serde::{Deserialize, Serialize};

use crate::envelope::{
    Bilinear, BilinearEnergy, BilinearSlips, Envelope, Exponential, ExponentialParameters, LuJoint,
    ModelCode, ModelCodeParameters,
};
use crate::{BondSettings, MixedMode, MixedModeParameters, SlipDamage};

/// A law of this crate with its parameters, but for [`Viscous`](crate::Viscous); units in the names of the fields.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum BondCase {
    /// [`SlipDamage`] after a curve.
    SlipDamage {
        /// Stress over slip.
        curve: CurveCase,
        /// Normal and residual.
        #[serde(default)]
        settings: BondSettings,
    },
    /// [`MixedMode`] delamination.
    MixedMode {
        /// Strengths and energies.
        parameters: MixedModeParameters,
    },
}

/// A curve of bond stress over slip.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum CurveCase {
    /// [`Bilinear::from_slips`].
    Bilinear {
        /// Strength and slips.
        parameters: BilinearSlips,
    },
    /// [`Bilinear::from_energy`].
    BilinearEnergy {
        /// Strength, stiffness and energy.
        parameters: BilinearEnergy,
    },
    /// [`Exponential`].
    Exponential {
        /// Strength and energy.
        parameters: ExponentialParameters,
    },
    /// [`ModelCode`] curve of ribbed bars.
    ModelCode {
        /// Concrete, ribs and confinement.
        parameters: ModelCodeParameters,
    },
    /// [`LuJoint::bilinear`].
    LuBilinear {
        /// The joint.
        joint: LuJoint,
    },
    /// [`LuJoint::simplified`].
    LuSimplified {
        /// The joint.
        joint: LuJoint,
    },
    /// [`LuJoint::precise`].
    LuPrecise {
        /// The joint.
        joint: LuJoint,
        /// Initial stiffness K0 (MPa/mm).
        stiffness_mpa_per_mm: f64,
    },
}

impl BondCase {
    /// The law.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`].
    pub fn build(&self) -> Result<Box<dyn Material<Interface>>, MaterialError> {
        let (curve, settings) = match self {
            Self::SlipDamage { curve, settings } => (curve, *settings),
            Self::MixedMode { parameters } => return Ok(Box::new(MixedMode::new(*parameters)?)),
        };
        match curve {
            CurveCase::Bilinear { parameters } => {
                slip_damage(Bilinear::from_slips(parameters)?, settings)
            }
            CurveCase::BilinearEnergy { parameters } => {
                slip_damage(Bilinear::from_energy(parameters)?, settings)
            }
            CurveCase::Exponential { parameters } => {
                slip_damage(Exponential::new(parameters)?, settings)
            }
            CurveCase::ModelCode { parameters } => {
                slip_damage(ModelCode::new(parameters)?, settings)
            }
            CurveCase::LuBilinear { joint } => slip_damage(joint.bilinear()?, settings),
            CurveCase::LuSimplified { joint } => slip_damage(joint.simplified()?, settings),
            CurveCase::LuPrecise {
                joint,
                stiffness_mpa_per_mm,
            } => slip_damage(joint.precise(*stiffness_mpa_per_mm)?, settings),
        }
    }
}

fn slip_damage(
    curve: impl Envelope,
    settings: BondSettings,
) -> Result<Box<dyn Material<Interface>>, MaterialError> {
    Ok(Box::new(SlipDamage::new(curve, settings)?))
}
