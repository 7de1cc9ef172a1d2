//! Fibre sheets: one orthotropic ply, and stacks of plies.

mod laminate;

use fe_core::kinematics::PlaneStress;
use fe_core::material::{Material, MaterialError, PointContext, PointReport, Response, StateVar};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::limits::{finite, out_of_range, positive};

pub use laminate::{Laminate, Ply};

const LAW: &str = "lamina";

/// Parameters of a [`Lamina`]; axis 1 is the direction of the fibres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LaminaParameters {
    /// Young's modulus E1 along the fibres (MPa).
    pub young_1_mpa: f64,
    /// Young's modulus E2 across the fibres (MPa).
    pub young_2_mpa: f64,
    /// In-plane shear modulus G12 (MPa).
    pub shear_mpa: f64,
    /// Poisson's ratio nu12 (-): contraction along 2 under stress along 1.
    pub poisson_12: f64,
    /// Tensile strength along the fibres (MPa).
    pub strength_mpa: f64,
}

/// Linear elastic orthotropic sheet in plane stress, in the axes of its fibres.
///
/// With nu21 = nu12 E2/E1 and d = 1 - nu12 nu21:
///
/// $$ \sigma_1 = \frac{E_1}{d}(\varepsilon_1 + \nu_{21}\varepsilon_2), \qquad
/// \sigma_2 = \frac{E_2}{d}(\varepsilon_2 + \nu_{12}\varepsilon_1), \qquad
/// \tau_{12} = G_{12}\gamma_{12}. $$
///
/// The fibres do not break in the law; the utilisation of the report is sigma_1 over their tensile
/// strength (criterion of the largest stress along the fibres), 0 in compression.
///
/// Source: R. M. Jones, "Mechanics of Composite Materials", 2nd ed. (1999), sections 2.5 and 2.9.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lamina {
    stiffness: Matrix3<f64>,
    strength: f64,
}

impl Lamina {
    /// A sheet with the given parameters.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] unless moduli and strength are positive and the compliance is positive
    /// definite, nu12^2 < E1/E2.
    pub fn new(p: &LaminaParameters) -> Result<Self, MaterialError> {
        for (parameter, value) in [
            ("young_1_mpa", p.young_1_mpa),
            ("young_2_mpa", p.young_2_mpa),
            ("shear_mpa", p.shear_mpa),
            ("strength_mpa", p.strength_mpa),
        ] {
            positive(LAW, parameter, value, "MPa")?;
        }
        let limit = (p.young_1_mpa / p.young_2_mpa).sqrt();
        if !(p.poisson_12 > -limit && p.poisson_12 < limit) {
            return Err(out_of_range(
                LAW,
                "poisson_12",
                p.poisson_12,
                "-",
                format!("(-{limit:.6}, {limit:.6}), from nu12^2 < E1/E2"),
                "the sheet would give off energy; check which of the two ratios this is",
            ));
        }
        let poisson_21 = p.poisson_12 * p.young_2_mpa / p.young_1_mpa;
        let d = 1.0 - p.poisson_12 * poisson_21;
        let (direct_1, direct_2) = (p.young_1_mpa / d, p.young_2_mpa / d);
        let cross = p.poisson_12 * direct_2;
        Ok(Self {
            stiffness: Matrix3::new(
                direct_1,
                cross,
                0.0,
                cross,
                direct_2,
                0.0,
                0.0,
                0.0,
                p.shear_mpa,
            ),
            strength: p.strength_mpa,
        })
    }

    /// Stiffness in the axes of the fibres (MPa).
    pub const fn stiffness(&self) -> &Matrix3<f64> {
        &self.stiffness
    }

    /// Stress along the fibres over their strength, 0 in compression (-).
    pub fn utilisation(&self, strain: &Vector3<f64>) -> f64 {
        let share = self.stiffness.row(0).transpose().dot(strain) / self.strength;
        if share < 0.0 { 0.0 } else { share }
    }
}

impl Material<PlaneStress> for Lamina {
    fn name(&self) -> &'static str {
        LAW
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        strain: &Vector3<f64>,
        _committed: &[f64],
        _trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<PlaneStress>, MaterialError> {
        finite(LAW, strain)?;
        Ok(Response {
            stress: self.stiffness * strain,
            tangent: self.stiffness,
        })
    }

    fn free_energy(&self, strain: &Vector3<f64>, _: &[f64], _: &PointContext) -> Option<f64> {
        Some(0.5 * strain.dot(&(self.stiffness * strain)))
    }

    fn report(&self, strain: &Vector3<f64>, _: &[f64]) -> PointReport {
        PointReport {
            utilisation: self.utilisation(strain),
            ..PointReport::default()
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the stiffness and the rupture utilisation of fibre sheets.
    use approx::assert_relative_eq;
    use fe_core::testing::{MaterialCheck, check_material};

    use super::*;

    pub(super) const SHEET: LaminaParameters = LaminaParameters {
        young_1_mpa: 228e3,
        young_2_mpa: 10e3,
        shear_mpa: 5e3,
        poisson_12: 0.3,
        strength_mpa: 3790.0,
    };

    #[test]
    fn conforms() {
        let law = Lamina::new(&SHEET).unwrap();
        let report = check_material(&law, &MaterialCheck::new(1e-2)).unwrap();
        assert!(report.least_pivot > 0.0);
    }

    /// Source: definition of the engineering constants by the compliance. Target: rounding.
    #[test]
    fn uniaxial_stress_gives_the_engineering_constants() {
        let law = Lamina::new(&SHEET).unwrap();
        let compliance = law.stiffness().try_inverse().unwrap();
        assert_relative_eq!(compliance[(0, 0)], 1.0 / 228e3, max_relative = 1e-13);
        assert_relative_eq!(compliance[(1, 1)], 1.0 / 10e3, max_relative = 1e-13);
        assert_relative_eq!(compliance[(1, 0)], -0.3 / 228e3, max_relative = 1e-13);
        assert_relative_eq!(compliance[(2, 2)], 1.0 / 5e3, max_relative = 1e-13);
        let strain = compliance * Vector3::new(1895.0, 0.0, 0.0);
        assert_relative_eq!(
            law.report(&strain, &[]).utilisation,
            0.5,
            max_relative = 1e-13
        );
        assert_eq!(law.report(&-strain, &[]).utilisation, 0.0);
    }

    /// A compliance that is not positive definite, and swapped ratios (nu21 given as nu12), are refused.
    #[test]
    fn impossible_sheets_are_refused() {
        let bad = [
            LaminaParameters {
                young_2_mpa: 0.0,
                ..SHEET
            },
            LaminaParameters {
                strength_mpa: f64::NAN,
                ..SHEET
            },
            LaminaParameters {
                poisson_12: 4.8,
                ..SHEET
            },
            LaminaParameters {
                poisson_12: f64::NAN,
                ..SHEET
            },
        ];
        for p in bad {
            assert!(Lamina::new(&p).is_err(), "{p:?}");
        }
    }
}
