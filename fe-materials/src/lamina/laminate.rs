//! A stack of plies as one membrane.

use fe_core::kinematics::PlaneStress;
use fe_core::material::{Material, MaterialError, PointContext, PointReport, Response, StateVar};
use nalgebra::{Matrix3, Vector3};

use super::Lamina;
use crate::limits::{finite, out_of_range, positive};

const LAW: &str = "laminate";

/// One ply of a [`Laminate`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ply {
    /// The sheet.
    pub lamina: Lamina,
    /// Angle from axis 1 of the laminate to the fibres, towards axis 2 (degrees).
    pub angle_deg: f64,
    /// Thickness (mm).
    pub thickness_mm: f64,
}

/// Perfectly bonded plies that share their membrane strain; the bending of the stack is neglected.
///
/// The stress is the mean over the thickness t = sum t_k,
///
/// $$ \sigma = \frac{1}{t} \sum_k t_k T_k^T Q_k T_k \varepsilon, $$
///
/// T_k being the strain transformation into the axes of the fibres of ply k: the membrane stiffness A/t
/// of classical laminate theory. The utilisation is the largest of the plies.
///
/// Source: R. M. Jones, "Mechanics of Composite Materials", 2nd ed. (1999), section 4.2.
#[derive(Debug, Clone, PartialEq)]
pub struct Laminate {
    plies: Vec<Ply>,
    stiffness: Matrix3<f64>,
}

impl Laminate {
    /// A stack of plies.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] if there is no ply, a thickness is not positive, or an angle is not a
    /// number.
    pub fn new(plies: Vec<Ply>) -> Result<Self, MaterialError> {
        let mut total = 0.0;
        let mut stiffness = Matrix3::zeros();
        for ply in &plies {
            positive(LAW, "thickness_mm", ply.thickness_mm, "mm")?;
            if !ply.angle_deg.is_finite() {
                return Err(out_of_range(
                    LAW,
                    "angle_deg",
                    ply.angle_deg,
                    "degrees",
                    "(-inf, inf)",
                    "give the direction of the fibres",
                ));
            }
            let t = transform(ply.angle_deg);
            stiffness += t.transpose() * ply.lamina.stiffness() * t * ply.thickness_mm;
            total += ply.thickness_mm;
        }
        if plies.is_empty() {
            let remedy = "give at least one ply";
            return Err(out_of_range(LAW, "plies", 0.0, "-", "[1, inf)", remedy));
        }
        Ok(Self {
            plies,
            stiffness: stiffness / total,
        })
    }

    /// The plies.
    pub fn plies(&self) -> &[Ply] {
        &self.plies
    }

    /// Stress along the fibres of each ply (MPa) at a membrane strain in the axes of the laminate.
    pub fn fibre_stresses(&self, strain: &Vector3<f64>) -> impl Iterator<Item = f64> {
        self.plies
            .iter()
            .map(move |ply| (ply.lamina.stiffness() * (transform(ply.angle_deg) * strain))[0])
    }

    /// What the fibres carry along axis 2 per length along axis 1 (N/mm) at a membrane strain in the axes of the laminate:
    /// the sum of t_k sigma_k sin^2(angle_k) over the plies of fibre stress sigma_k. What holds the fibres together is not
    /// counted. Round a beam whose axis is axis 1, this is the tension that a strip takes from a shear crack.
    pub fn fibre_force_along_2(&self, strain: &Vector3<f64>) -> f64 {
        let share = |ply: &Ply| ply.thickness_mm * ply.angle_deg.to_radians().sin().powi(2);
        let shares = self.plies.iter().map(share);
        self.fibre_stresses(strain)
            .zip(shares)
            .map(|(stress, share)| stress * share)
            .sum()
    }

    /// Mean stress (MPa) per strain along an angle (degrees) from axis 1, all other strains being zero.
    pub fn stiffness_along(&self, angle_deg: f64) -> f64 {
        let (s, c) = angle_deg.to_radians().sin_cos();
        let along = Vector3::new(c * c, s * s, 2.0 * s * c);
        along.dot(&(self.stiffness * along))
    }

    /// Thickness t of the stack (mm).
    pub fn thickness_mm(&self) -> f64 {
        self.plies.iter().map(|ply| ply.thickness_mm).sum()
    }
}

/// Strain transformation into axes at an angle.
fn transform(angle_deg: f64) -> Matrix3<f64> {
    let (s, c) = angle_deg.to_radians().sin_cos();
    Matrix3::new(
        c * c,
        s * s,
        c * s,
        s * s,
        c * c,
        -c * s,
        -2.0 * c * s,
        2.0 * c * s,
        c * c - s * s,
    )
}

impl Material<PlaneStress> for Laminate {
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
        let utilisation = |ply: &Ply| ply.lamina.utilisation(&(transform(ply.angle_deg) * strain));
        PointReport {
            utilisation: self.plies.iter().map(utilisation).fold(0.0, f64::max),
            ..PointReport::default()
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the rotation of plies and their average.
    use approx::assert_relative_eq;
    use fe_core::testing::{MaterialCheck, check_material};

    use super::super::tests::SHEET;
    use super::*;

    fn stack(angles: &[f64]) -> Laminate {
        let lamina = Lamina::new(&SHEET).unwrap();
        let ply = |&angle_deg| Ply {
            lamina,
            angle_deg,
            thickness_mm: 0.165,
        };
        Laminate::new(angles.iter().map(ply).collect()).unwrap()
    }

    #[test]
    fn conforms() {
        check_material(&stack(&[90.0, 0.0, 30.0]), &MaterialCheck::new(1e-2)).unwrap();
    }

    /// Source: classical laminate theory. A 90/0 stack is balanced: (Q11 + Q22)/2 along both axes, and the
    /// 0 ply decides its utilisation in tension along 1. Target: rounding.
    #[test]
    fn cross_ply() {
        let law = stack(&[90.0, 0.0]);
        let q = *Lamina::new(&SHEET).unwrap().stiffness();
        let mean = 0.5 * (q[(0, 0)] + q[(1, 1)]);
        assert_relative_eq!(law.stiffness[(0, 0)], mean, max_relative = 1e-14);
        assert_relative_eq!(law.stiffness[(1, 1)], mean, max_relative = 1e-14);
        assert_relative_eq!(law.stiffness[(0, 1)], q[(0, 1)], max_relative = 1e-12);
        assert_relative_eq!(law.stiffness[(2, 2)], q[(2, 2)], max_relative = 1e-12);
        assert_relative_eq!(law.thickness_mm(), 0.33);
        let strain = Vector3::new(5e-3, 0.0, 0.0);
        let expected = q[(0, 0)] * 5e-3 / SHEET.strength_mpa;
        assert_relative_eq!(
            law.report(&strain, &[]).utilisation,
            expected,
            max_relative = 1e-14
        );
        let stresses: Vec<f64> = law.fibre_stresses(&strain).collect();
        assert_relative_eq!(stresses[0], q[(0, 1)] * 5e-3, max_relative = 1e-9);
        assert_relative_eq!(stresses[1], q[(0, 0)] * 5e-3, max_relative = 1e-14);
    }

    /// A strain that stretches all fibres alike, 5 per mille in every direction: those at 90 degrees count in full along axis 2,
    /// those at 45 by half, those along axis 1 not at all.
    #[test]
    fn fibres_carry_by_their_angle() {
        let law = stack(&[90.0, 45.0, 0.0]);
        let strain = Vector3::new(5e-3, 5e-3, 0.0);
        let ply = 0.165 * law.fibre_stresses(&strain).next().unwrap();
        assert_relative_eq!(
            law.fibre_force_along_2(&strain),
            1.5 * ply,
            max_relative = 1e-12
        );
    }

    /// Plies at 0, 45, 90 and 135 degrees are isotropic in the plane: A66 = (A11 - A12)/2, no coupling.
    #[test]
    fn four_directions_are_isotropic_in_the_plane() {
        let a = stack(&[0.0, 45.0, 90.0, 135.0]).stiffness;
        assert_relative_eq!(
            a[(2, 2)],
            0.5 * (a[(0, 0)] - a[(0, 1)]),
            max_relative = 1e-12
        );
        assert!(a[(0, 2)].abs() < 1e-10 * a[(0, 0)]);
    }

    #[test]
    fn impossible_stacks_are_refused() {
        let lamina = Lamina::new(&SHEET).unwrap();
        let ply = |angle_deg, thickness_mm| Ply {
            lamina,
            angle_deg,
            thickness_mm,
        };
        for plies in [vec![], vec![ply(0.0, 0.0)], vec![ply(f64::NAN, 0.1)]] {
            assert!(Laminate::new(plies).is_err());
        }
    }
}
