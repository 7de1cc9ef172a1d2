//! Laws made for a test, and short ways to the usual ones.

use std::sync::Arc;

use fe_core::kinematics::{Axial, Kinematics, PlaneStress, Solid};
use fe_core::material::{Material, MaterialError, Operator, PointContext, Response, StateVar};
use fe_materials::Elastic;
use nalgebra::{Matrix3, Matrix6, Vector1, Vector3, Vector6};

/// Isotropic elasticity as elements take it.
///
/// # Errors
///
/// [`MaterialError::Parameter`].
pub fn elastic(young_mpa: f64, poisson: f64) -> Result<Arc<dyn Material<Solid>>, MaterialError> {
    Ok(Arc::new(Elastic::new(young_mpa, poisson)?))
}

/// Stress D e of any D, symmetric or not; states no energy.
#[derive(Debug, Clone, Copy)]
pub struct Linear(pub Matrix6<f64>);

impl Material<Solid> for Linear {
    fn name(&self) -> &'static str {
        "linear"
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn unsymmetric_tangent(&self) -> bool {
        self.0 != self.0.transpose()
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        _committed: &[f64],
        _trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        Ok(Response {
            stress: self.0 * strain,
            tangent: self.0,
        })
    }
}

/// A tendon without stiffness: the same stress at every strain.
#[derive(Debug, Clone, Copy)]
pub struct Tendon {
    /// Stress (MPa).
    pub stress_mpa: f64,
}

impl Material<Axial> for Tendon {
    fn name(&self) -> &'static str {
        "tendon"
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        _strain: &Vector1<f64>,
        _committed: &[f64],
        _trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<Axial>, MaterialError> {
        Ok(Response {
            stress: Vector1::new(self.stress_mpa),
            tangent: Axial::zero_tangent(),
        })
    }
}

/// A bar whose damage softens it along a straight line, and that unloads to the origin; without compression of its own.
#[derive(Debug, Clone, Copy)]
pub struct Softening {
    /// Young's modulus (MPa).
    pub young_mpa: f64,
    /// Tensile strength (MPa).
    pub strength_mpa: f64,
    /// Strain from which on it carries nothing (-).
    pub broken: f64,
}

impl Material<Axial> for Softening {
    fn name(&self) -> &'static str {
        "softening bar"
    }

    fn state_vars(&self) -> &[StateVar] {
        const VARS: [StateVar; 1] = [StateVar::scalar("largest_strain", "-")];
        &VARS
    }

    fn update(
        &self,
        strain: &Vector1<f64>,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Axial>, MaterialError> {
        let e = strain[0];
        let grows = e > committed[0];
        let largest = e.max(committed[0]);
        trial[0] = largest;
        let onset = self.strength_mpa / self.young_mpa;
        let slope = -self.strength_mpa / (self.broken - onset);
        let (secant, tangent) = if largest <= onset {
            (self.young_mpa, self.young_mpa)
        } else if largest < self.broken {
            (slope * (largest - self.broken) / largest, slope)
        } else {
            (0.0, 0.0)
        };
        let tangent = if grows && ctx.operator == Operator::Tangent {
            tangent
        } else {
            secant
        };
        Ok(Response {
            stress: Vector1::new(secant * e),
            tangent: Vector1::new(tangent),
        })
    }
}

/// Concrete of a section that stays plane: uncoupled normal stresses, a given curve along x, elastic across, and
/// a shear modulus that is large enough to keep plane sections plane.
#[derive(Debug, Clone, Copy)]
pub struct Uniaxial {
    /// Stress along x.
    pub curve: Curve,
    /// Young's modulus across (MPa).
    pub young_mpa: f64,
    /// Shear modulus (MPa).
    pub shear_mpa: f64,
}

/// Stress over strain of a uniaxial law.
#[derive(Debug, Clone, Copy)]
pub enum Curve {
    /// E e until the strength is exceeded for the first time, then nothing for good.
    Brittle {
        /// Tensile strength (MPa).
        strength_mpa: f64,
    },
    /// fc (1 - (1 - |e|/e1)^2) in compression up to e1, then fc; nothing in tension.
    ParabolaRectangle {
        /// Compressive strength fc (MPa).
        strength_mpa: f64,
        /// Strain e1, positive (-).
        peak_strain: f64,
    },
}

impl Curve {
    /// Stress (MPa), slope (MPa) and whether the material is cracked now.
    fn at(self, strain: f64, young: f64, cracked: bool) -> (f64, f64, bool) {
        match self {
            Self::Brittle { strength_mpa } => {
                let cracked = cracked || young * strain > strength_mpa;
                let slope = if cracked { 0.0 } else { young };
                (slope * strain, slope, cracked)
            }
            Self::ParabolaRectangle {
                strength_mpa,
                peak_strain,
            } => {
                let rest = (1.0 + strain.min(0.0) / peak_strain).max(0.0);
                let slope = if strain < 0.0 {
                    2.0 * strength_mpa * rest / peak_strain
                } else {
                    0.0
                };
                (strength_mpa * (rest * rest - 1.0), slope, false)
            }
        }
    }
}

impl Material<Solid> for Uniaxial {
    fn name(&self) -> &'static str {
        "uniaxial"
    }

    fn state_vars(&self) -> &[StateVar] {
        const { &[StateVar::scalar("cracked", "-")] }
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        committed: &[f64],
        trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        let (stress, slope, cracked) = self.curve.at(strain[0], self.young_mpa, committed[0] > 0.5);
        trial[0] = f64::from(u8::from(cracked));
        let (e, g) = (self.young_mpa, self.shear_mpa);
        let tangent = Matrix6::from_diagonal(&Vector6::new(slope, e, e, g, g, g));
        let mut total = tangent * strain;
        total[0] = stress;
        Ok(Response {
            stress: total,
            tangent,
        })
    }
}

/// A sheet with isotropic damage: stress (1 - d) D e, d = r/(r + r0), r the largest sqrt(e . D e) so far.
#[derive(Debug, Clone, Copy)]
pub struct DamagedSheet {
    /// Elastic stiffness D (MPa).
    pub stiffness: Matrix3<f64>,
    /// r0 (sqrt MPa).
    pub resistance: f64,
}

impl DamagedSheet {
    fn integrity(&self, largest: f64) -> f64 {
        self.resistance / (largest + self.resistance)
    }
}

impl Material<PlaneStress> for DamagedSheet {
    fn name(&self) -> &'static str {
        "damaged sheet"
    }

    fn state_vars(&self) -> &[StateVar] {
        const { &[StateVar::scalar("largest", "sqrt MPa")] }
    }

    fn update(
        &self,
        strain: &Vector3<f64>,
        committed: &[f64],
        trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<PlaneStress>, MaterialError> {
        let elastic = self.stiffness * strain;
        let now = elastic.dot(strain).sqrt();
        trial[0] = now.max(committed[0]);
        let integrity = self.integrity(trial[0]);
        let mut tangent = integrity * self.stiffness;
        if now > committed[0] {
            let slope = integrity / ((now + self.resistance) * now);
            tangent -= slope * elastic * elastic.transpose();
        }
        Ok(Response {
            stress: integrity * elastic,
            tangent,
        })
    }

    fn free_energy(&self, strain: &Vector3<f64>, state: &[f64], _: &PointContext) -> Option<f64> {
        Some(0.5 * self.integrity(state[0]) * strain.dot(&(self.stiffness * strain)))
    }
}
