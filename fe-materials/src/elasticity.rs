//! Isotropic elasticity shared by the plastic laws.

use fe_core::material::MaterialError;
use fe_core::voigt::isotropic;
use nalgebra::{Matrix3, Matrix6, Vector6};

use crate::limits::{out_of_range, positive};

/// Isotropic elastic constants and the 6 x 6 matrix D of engineering shear strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Elasticity {
    /// Young's modulus E (MPa).
    pub(crate) young: f64,
    /// Bulk modulus K (MPa).
    pub(crate) bulk: f64,
    /// Shear modulus G (MPa).
    pub(crate) shear: f64,
    /// Stiffness D (MPa).
    pub(crate) stiffness: Matrix6<f64>,
}

impl Elasticity {
    pub(crate) fn new(law: &'static str, young: f64, poisson: f64) -> Result<Self, MaterialError> {
        positive(law, "young_mpa", young, "MPa")?;
        if !(0.0..0.5).contains(&poisson) {
            let remedy = "steel has about 0.3, concrete about 0.2";
            return Err(out_of_range(
                law, "poisson", poisson, "-", "[0, 0.5)", remedy,
            ));
        }
        Ok(Self {
            young,
            bulk: young / (3.0 * (1.0 - 2.0 * poisson)),
            shear: young / (2.0 * (1.0 + poisson)),
            stiffness: isotropic(young, poisson),
        })
    }

    /// Stress (MPa) of an elastic Voigt strain.
    pub(crate) fn stress(&self, strain: &Vector6<f64>) -> Vector6<f64> {
        let volumetric = strain[0] + strain[1] + strain[2];
        let pressure = (self.bulk - 2.0 / 3.0 * self.shear) * volumetric;
        Vector6::from_fn(|i, _| {
            if i < 3 {
                pressure + 2.0 * self.shear * strain[i]
            } else {
                self.shear * strain[i]
            }
        })
    }

    /// Strain of a Voigt stress (MPa).
    pub(crate) fn strain(&self, stress: &Vector6<f64>) -> Vector6<f64> {
        let mean = (stress[0] + stress[1] + stress[2]) / 3.0;
        Vector6::from_fn(|i, _| {
            if i < 3 {
                mean / (3.0 * self.bulk) + (stress[i] - mean) / (2.0 * self.shear)
            } else {
                stress[i] / self.shear
            }
        })
    }

    /// Compliance of the principal strains, 3 x 3 (1/MPa).
    pub(crate) fn principal_compliance(&self) -> Matrix3<f64> {
        let shear = 0.5 / self.shear;
        let volume = (1.0 / (3.0 * self.bulk) - shear) / 3.0;
        Matrix3::repeat(volume) + Matrix3::identity() * shear
    }

    /// Energy density 1/2 eps : D : eps (MPa) of an elastic Voigt strain.
    pub(crate) fn energy(&self, strain: &Vector6<f64>) -> f64 {
        0.5 * self.stress(strain).dot(strain)
    }
}
