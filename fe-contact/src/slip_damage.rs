//! Scalar damage on the slip: the engine of the bond-slip laws.

use std::sync::Arc;

use fe_core::kinematics::Interface;
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use nalgebra::{Matrix3, Vector2, Vector3};

use crate::envelope::Envelope;
use crate::limits::{finite, positive, relaxes};
use crate::normal::{BondSettings, Normal};

/// Least 1 - d of the secant operator; does not enter the stress.
const OPERATOR_FLOOR: f64 = 1e-4;

const STATE_VARS: [StateVar; 2] = [
    StateVar::scalar("slip_max", "mm"),
    StateVar::scalar("damage", "-"),
];

/// Bond with scalar damage that grows with the largest slip, and secant unloading through the origin.
///
/// With the slip s = (s_1, s_2), kappa = max |s| over the history and the curve tau_env of an
/// [`Envelope`] of initial stiffness K0,
///
/// $$ \tau = (1 - d) K_0 s, \qquad 1 - d(\kappa) = \max\Bigl(r,
/// \frac{\tau_\mathrm{env}(\kappa)}{K_0 \kappa}\Bigr), $$
///
/// with the residual r of [`BondSettings`]; along the normal see [`Normal`]. A slip in any direction of the
/// interface counts alike.
///
/// The growth of kappa in a step is scaled by the relaxation a of the context (backward Euler of
/// kappa' = <|s| - kappa>/t, a = dt/(t + dt) for a viscosity time t).
///
/// - Tangent: the derivative of the above, falling on the softening branch.
/// - Secant: diagonal, with 1 - d not below 1e-4.
/// - Free energy psi = (1 - d) K0 |s|^2/2 + energy along the normal (N/mm): it falls with growing damage at
///   a fixed jump, so no path creates energy.
/// - Report: utilisation |tau|/tau_max.
///
/// State: `slip_max` = kappa (mm), `damage` = d (-).
#[derive(Debug, Clone)]
pub struct SlipDamage {
    envelope: Arc<dyn Envelope>,
    settings: BondSettings,
    /// K0 of the envelope and K_n (MPa/mm).
    stiffness: f64,
    normal: f64,
}

impl SlipDamage {
    /// A law with the given curve.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] for settings out of range, or an initial stiffness of the curve that is not positive.
    pub fn new(envelope: impl Envelope, settings: BondSettings) -> Result<Self, MaterialError> {
        settings.check(envelope.name())?;
        let stiffness = envelope.stiffness();
        positive(
            envelope.name(),
            &[("stiffness of the curve", stiffness, "MPa/mm")],
        )?;
        Ok(Self {
            envelope: Arc::new(envelope),
            settings,
            stiffness,
            normal: settings.normal_over_initial * stiffness,
        })
    }

    /// The curve: tau_max, s0, s_f, G_f, K0.
    pub fn envelope(&self) -> &dyn Envelope {
        self.envelope.as_ref()
    }

    /// The settings.
    pub const fn settings(&self) -> &BondSettings {
        &self.settings
    }

    /// Largest slip kappa (mm) of a state of this law.
    ///
    /// # Panics
    ///
    /// For a state that is shorter.
    pub const fn slip_max(state: &[f64]) -> f64 {
        state[0]
    }

    /// Damage d (-) of a state of this law.
    ///
    /// # Panics
    ///
    /// For a state that is shorter.
    pub const fn damage(state: &[f64]) -> f64 {
        state[1]
    }

    /// Whether the bond of a point is lost: kappa >= s_f.
    ///
    /// # Panics
    ///
    /// For a state that is shorter than one of this law.
    pub fn is_debonded(&self, state: &[f64]) -> bool {
        Self::slip_max(state) >= self.envelope.final_slip()
    }

    /// Whether the point has passed the peak of the curve: kappa > s0.
    ///
    /// # Panics
    ///
    /// For a state that is shorter than one of this law.
    pub fn is_softening(&self, state: &[f64]) -> bool {
        Self::slip_max(state) > self.envelope.peak_slip()
    }

    /// 1 - d at the largest slip `kappa` (mm), and its derivative (1/mm).
    fn integrity(&self, kappa: f64) -> (f64, f64) {
        let (secant, slope) = self.envelope.secant(kappa);
        let (integrity, slope) = (secant / self.stiffness, slope / self.stiffness);
        if integrity < self.settings.residual {
            (self.settings.residual, 0.0)
        } else {
            (integrity, slope)
        }
    }

    /// Factor on K_n at an opening (mm).
    fn closed(&self, opening: f64, integrity: f64) -> f64 {
        match self.settings.normal {
            Normal::Unilateral if opening > 0.0 => integrity,
            _ => 1.0,
        }
    }
}

impl Material<Interface> for SlipDamage {
    fn name(&self) -> &'static str {
        self.envelope.name()
    }

    fn state_vars(&self) -> &[StateVar] {
        &STATE_VARS
    }

    fn update(
        &self,
        jump: &Vector3<f64>,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Interface>, MaterialError> {
        finite(self.name(), jump)?;
        relaxes(self.name(), ctx.relaxation)?;
        let slip = Vector2::new(jump[0], jump[1]);
        let (size, opening) = (slip.norm(), jump[2]);
        let before = Self::slip_max(committed);
        let kappa = before + ctx.relaxation * (size - before).max(0.0);
        let (integrity, fall) = self.integrity(kappa);
        trial[0] = kappa;
        trial[1] = 1.0 - integrity;
        let shear = integrity * self.stiffness;
        let closed = self.closed(opening, integrity);
        let stress = Vector3::new(
            shear * slip[0],
            shear * slip[1],
            closed * self.normal * opening,
        );
        let mut tangent = Matrix3::zeros();
        if ctx.operator == Operator::Secant {
            let integrity = integrity.max(OPERATOR_FLOOR);
            let shear = integrity * self.stiffness;
            let normal = self.closed(opening, integrity) * self.normal;
            tangent.set_diagonal(&Vector3::new(shear, shear, normal));
        } else {
            tangent.set_diagonal(&Vector3::new(shear, shear, closed * self.normal));
            if size > before {
                // d(1-d)/ds = fall a s/|s|.
                let gradient = slip * (fall * ctx.relaxation / size);
                for i in 0..2 {
                    for j in 0..2 {
                        tangent[(i, j)] += self.stiffness * slip[i] * gradient[j];
                    }
                    if self.settings.normal == Normal::Unilateral && opening > 0.0 {
                        tangent[(2, i)] += self.normal * opening * gradient[i];
                    }
                }
            }
        }
        Ok(Response { stress, tangent })
    }

    fn unsymmetric_tangent(&self) -> bool {
        self.settings.normal == Normal::Unilateral
    }

    fn free_energy(&self, jump: &Vector3<f64>, state: &[f64], _: &PointContext) -> Option<f64> {
        let (integrity, _) = self.integrity(Self::slip_max(state));
        let shear = integrity * self.stiffness * (jump[0] * jump[0] + jump[1] * jump[1]);
        let normal = self.closed(jump[2], integrity) * self.normal * jump[2] * jump[2];
        Some(0.5 * (shear + normal))
    }

    fn report(&self, jump: &Vector3<f64>, state: &[f64]) -> PointReport {
        let (integrity, _) = self.integrity(Self::slip_max(state));
        let stress = integrity * self.stiffness * jump[0].hypot(jump[1]);
        PointReport {
            utilisation: stress / self.envelope.strength(),
            ..PointReport::default()
        }
    }
}
