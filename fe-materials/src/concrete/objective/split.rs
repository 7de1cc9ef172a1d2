//! The effective stress with its tensile part damaged.

use fe_core::voigt::{SHEAR_PAIRS, strain_transform, stress_transform, stress_voigt};
use nalgebra::{Matrix3, Matrix6, RowVector6, Vector3, Vector6};

use crate::concrete::isochoric::PlasticReturn;
use crate::concrete::spectral::{from_principal, spin_quotients};

/// Smallest share of the stiffness that the secant operator keeps across a crack. It does not enter the
/// stress.
const OPERATOR_FLOOR: f64 = 1e-4;

/// sigma = (1 - d) pos(sb) + neg(sb) in the principal axes of sb.
pub(super) struct Split<'a> {
    effective: &'a PlasticReturn,
    /// Share of the effective principal stress that each axis carries: 1 - d in tension, 1 in compression.
    shares: Vector3<f64>,
}

impl<'a> Split<'a> {
    pub(super) fn new(effective: &'a PlasticReturn, damage: f64) -> Self {
        let shares = effective
            .principal
            .map(|s| if s > 0.0 { 1.0 - damage } else { 1.0 });
        Self { effective, shares }
    }

    fn principal(&self) -> Vector3<f64> {
        self.effective.principal.component_mul(&self.shares)
    }

    pub(super) fn stress(&self) -> Vector6<f64> {
        let axes = &self.effective.axes;
        stress_voigt(&(axes * Matrix3::from_diagonal(&self.principal()) * axes.transpose()))
    }

    /// Consistent tangent, `growth` being the derivatives of d with respect to the principal values of sb:
    ///
    /// dsigma = [dpos/dsb (1 - d) + dneg/dsb] dsb - pos(sb) dd.
    pub(super) fn tangent(&self, growth: &Vector3<f64>) -> Matrix6<f64> {
        let PlasticReturn {
            principal,
            axes,
            tangent,
            ..
        } = self.effective;
        // Rows: change of the components of sb in its axes.
        let mut local = stress_transform(axes) * tangent;
        let mut d_damage = RowVector6::zeros();
        for i in 0..3 {
            d_damage += local.row(i) * growth[i];
        }
        let shares = Matrix3::from_diagonal(&self.shares);
        let spin = spin_quotients(principal, &self.principal(), &shares);
        for i in 0..3 {
            let row = local.row(i) * self.shares[i] - d_damage * principal[i].max(0.0);
            local.set_row(i, &row);
            let row = local.row(3 + i) * spin[i];
            local.set_row(3 + i, &row);
        }
        strain_transform(axes).tr_mul(&local)
    }

    /// W D W with W = diag(sqrt(share)): symmetric positive definite, exact in uniaxial tension.
    pub(super) fn secant(&self, stiffness: &Matrix6<f64>) -> Matrix6<f64> {
        let w = self.shares.map(|share| share.max(OPERATOR_FLOOR).sqrt());
        let normal = Matrix3::from_fn(|i, j| w[i] * w[j] * stiffness[(i, j)]);
        let shear = SHEAR_PAIRS.map(|(i, j)| w[i] * w[j] * stiffness[(3, 3)]);
        from_principal(&self.effective.axes, &normal, shear)
    }
}
