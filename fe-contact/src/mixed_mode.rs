//! Delamination in opening and shear together.

use fe_core::kinematics::Interface;
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::limits::{finite, out_of_range, positive, relaxes};

const LAW: &str = "mixed-mode delamination";

/// Least 1 - d of the secant operator; does not enter the stress.
const OPERATOR_FLOOR: f64 = 1e-4;

const STATE_VARS: [StateVar; 1] = [StateVar::scalar("damage", "-")];

/// Parameters of [`MixedMode`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MixedModeParameters {
    /// Initial stiffness K of every component (MPa/mm).
    pub stiffness_mpa_per_mm: f64,
    /// Strength in opening, mode I (MPa).
    pub normal_strength_mpa: f64,
    /// Strength in shear, mode II (MPa).
    pub shear_strength_mpa: f64,
    /// Fracture energy of mode I, G_Ic (N/mm).
    pub mode_1_energy_n_per_mm: f64,
    /// Fracture energy of mode II, G_IIc (N/mm).
    pub mode_2_energy_n_per_mm: f64,
    /// Exponent eta of the criterion (-), at least 1.
    pub exponent: f64,
    /// Least 1 - d (-) in stress and operator, see [`BondSettings`](crate::BondSettings).
    #[serde(default = "residual")]
    pub residual: f64,
}

/// Default of [`MixedModeParameters::residual`].
const fn residual() -> f64 {
    1e-6
}

/// Bilinear law in the effective jump delta = sqrt(max(n, 0)^2 + |s|^2), n being the opening and s the slip.
///
/// With the share of shear b = |s|^2/delta^2 and the jumps at onset of the pure modes, n_0 = t_n/K and
/// s_0 = t_s/K:
///
/// $$ \delta_0 = \Bigl(\frac{1-b}{n_0^2} + \frac{b}{s_0^2}\Bigr)^{-1/2}, \qquad
/// G_c = G_{Ic} + (G_{IIc} - G_{Ic}) b^\eta, \qquad \delta_f = \frac{2 G_c}{K \delta_0}, $$
///
/// d* = delta_f (delta - delta_0)/(delta (delta_f - delta_0)) between delta_0 and delta_f, and the damage d is the
/// largest d* of the history. t = (1 - d) K (s, n) in opening; in contact the normal keeps K.
///
/// The damage itself is the history, not the largest jump: with a mode that changes on the way, a law that
/// remembers the jump can heal. Its growth in a step is scaled by the relaxation of the context.
///
/// Sources: onset by the quadratic criterion and effective jump, P. P. Camanho and C. G. Davila,
/// NASA/TM-2002-211737 (2002); G_c, M. L. Benzeggagh and M. Kenane, Composites Science and Technology 56 (1996)
/// 439-449.
#[derive(Debug, Clone, PartialEq)]
pub struct MixedMode {
    p: MixedModeParameters,
    /// Jumps at the onset of pure opening and pure shear (mm).
    onset: [f64; 2],
}

/// Jumps at the onset and the end of softening for a share of shear b, with their derivatives to b.
struct Branch {
    onset: f64,
    onset_slope: f64,
    end: f64,
    end_slope: f64,
}

impl MixedMode {
    /// A law with the given parameters.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] for values out of range, or fracture energies that the rising branch would
    /// use up in some mode.
    pub fn new(p: MixedModeParameters) -> Result<Self, MaterialError> {
        positive(
            LAW,
            &[
                ("stiffness_mpa_per_mm", p.stiffness_mpa_per_mm, "MPa/mm"),
                ("normal_strength_mpa", p.normal_strength_mpa, "MPa"),
                ("shear_strength_mpa", p.shear_strength_mpa, "MPa"),
                ("mode_1_energy_n_per_mm", p.mode_1_energy_n_per_mm, "N/mm"),
                ("mode_2_energy_n_per_mm", p.mode_2_energy_n_per_mm, "N/mm"),
            ],
        )?;
        let refuse = |parameter, value, allowed: &str, remedy: &str| {
            Err(out_of_range(LAW, parameter, value, "-", allowed, remedy))
        };
        if !(p.exponent.is_finite() && p.exponent >= 1.0) {
            let remedy = "usual values lie between 1 and 3";
            return refuse("exponent", p.exponent, "[1, inf)", remedy);
        }
        if !(p.residual >= 0.0 && p.residual <= 1e-2) {
            let remedy = "give a small share of stiffness, 1e-6 for instance";
            return refuse("residual", p.residual, "[0, 0.01]", remedy);
        }
        let onset =
            [p.normal_strength_mpa, p.shear_strength_mpa].map(|t| t / p.stiffness_mpa_per_mm);
        let law = Self { p, onset };
        for share in (0..=100).map(|i| f64::from(i) / 100.0) {
            let branch = law.branch(share);
            let softening = branch.end - branch.onset;
            if softening.is_nan() || softening <= 0.0 {
                return Err(out_of_range(
                    LAW,
                    "stiffness_mpa_per_mm",
                    p.stiffness_mpa_per_mm,
                    "MPa/mm",
                    format!(
                        "values that leave a softening branch; at a share of shear of {share:.2} the onset at \
                         {:.4e} mm lies beyond the end at {:.4e} mm",
                        branch.onset, branch.end
                    ),
                    "raise the stiffness or the fracture energies, or lower the strengths",
                ));
            }
        }
        Ok(law)
    }

    /// The parameters.
    pub const fn parameters(&self) -> &MixedModeParameters {
        &self.p
    }

    /// Fracture energy (N/mm) at a constant share of shear b in [0, 1].
    pub fn energy(&self, share: f64) -> f64 {
        let (one, two) = (self.p.mode_1_energy_n_per_mm, self.p.mode_2_energy_n_per_mm);
        one + (two - one) * share.powf(self.p.exponent)
    }

    /// Effective jumps (mm) at the onset and the end of softening at a share of shear b in [0, 1].
    pub fn jumps(&self, share: f64) -> (f64, f64) {
        let branch = self.branch(share);
        (branch.onset, branch.end)
    }

    /// Damage d (-) of a state of this law.
    ///
    /// # Panics
    ///
    /// For a state that is shorter.
    pub const fn damage(state: &[f64]) -> f64 {
        state[0]
    }

    /// Whether the bond of a point is lost: d = 1.
    ///
    /// # Panics
    ///
    /// For a state that is shorter than one of this law.
    pub fn is_debonded(&self, state: &[f64]) -> bool {
        Self::damage(state) >= 1.0
    }

    fn branch(&self, share: f64) -> Branch {
        let [normal, shear] = self.onset.map(|d| d.powi(-2));
        let onset = ((1.0 - share) * normal + share * shear).powf(-0.5);
        let onset_slope = -0.5 * onset.powi(3) * (shear - normal);
        let unit = 2.0 / (self.p.stiffness_mpa_per_mm * onset);
        let end = unit * self.energy(share);
        let eta = self.p.exponent;
        let energy_slope = (self.p.mode_2_energy_n_per_mm - self.p.mode_1_energy_n_per_mm)
            * eta
            * share.powf(eta - 1.0);
        Branch {
            onset,
            onset_slope,
            end,
            end_slope: unit * energy_slope - end / onset * onset_slope,
        }
    }

    /// d* and its gradient (1/mm) with respect to the jump.
    fn driving(&self, jump: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let open = Vector3::new(jump[0], jump[1], jump[2].max(0.0));
        let delta = open.norm();
        if delta == 0.0 {
            return (0.0, Vector3::zeros());
        }
        let direction = open / delta;
        let normal = direction[2] * direction[2];
        let share = (1.0 - normal).max(0.0);
        let Branch {
            onset: p,
            onset_slope,
            end: q,
            end_slope,
        } = self.branch(share);
        if delta <= p {
            return (0.0, Vector3::zeros());
        }
        if delta >= q {
            return (1.0, Vector3::zeros());
        }
        let length = q - p;
        let damage = q * (delta - p) / (delta * length);
        let by_delta = q * p / (delta * delta * length);
        let by_share = (q * (delta - q) * onset_slope - p * (delta - p) * end_slope)
            / (delta * length * length);
        // db/ds_i = 2 m_i m_n^2/delta, db/dn = -2 b m_n/delta, m being the direction.
        let share_gradient = Vector3::new(
            direction[0] * normal,
            direction[1] * normal,
            -share * direction[2],
        ) * (2.0 / delta);
        (damage, direction * by_delta + share_gradient * by_share)
    }

    /// 1 - d, not below `floor`, per component: closed faces keep their stiffness along the normal.
    fn factors(damage: f64, floor: f64, opening: f64) -> Vector3<f64> {
        let integrity = (1.0 - damage).max(floor);
        let normal = if opening > 0.0 { integrity } else { 1.0 };
        Vector3::new(integrity, integrity, normal)
    }
}

impl Material<Interface> for MixedMode {
    fn name(&self) -> &'static str {
        LAW
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
        finite(LAW, jump)?;
        relaxes(LAW, ctx.relaxation)?;
        let k = self.p.stiffness_mpa_per_mm;
        let before = Self::damage(committed);
        let (driving, gradient) = self.driving(jump);
        let damage = before + ctx.relaxation * (driving - before).max(0.0);
        trial[0] = damage;
        let factors = Self::factors(damage, self.p.residual, jump[2]);
        let stress = k * jump.component_mul(&factors);
        let tangent = if ctx.operator == Operator::Secant {
            let floor = OPERATOR_FLOOR.max(self.p.residual);
            Matrix3::from_diagonal(&(k * Self::factors(damage, floor, jump[2])))
        } else {
            let mut tangent = Matrix3::from_diagonal(&(k * factors));
            if driving > before && 1.0 - damage > self.p.residual {
                let open = Vector3::new(jump[0], jump[1], jump[2].max(0.0));
                tangent -= open * gradient.transpose() * (k * ctx.relaxation);
            }
            tangent
        };
        Ok(Response { stress, tangent })
    }

    fn unsymmetric_tangent(&self) -> bool {
        true
    }

    fn free_energy(&self, jump: &Vector3<f64>, state: &[f64], _: &PointContext) -> Option<f64> {
        let factors = Self::factors(Self::damage(state), self.p.residual, jump[2]);
        let k = self.p.stiffness_mpa_per_mm;
        Some(0.5 * k * jump.component_mul(&factors).dot(jump))
    }

    fn report(&self, jump: &Vector3<f64>, state: &[f64]) -> PointReport {
        let factors = Self::factors(Self::damage(state), self.p.residual, jump[2]);
        let stress = self.p.stiffness_mpa_per_mm * jump.component_mul(&factors);
        let shear = stress[0].hypot(stress[1]) / self.p.shear_strength_mpa;
        let normal = stress[2].max(0.0) / self.p.normal_strength_mpa;
        PointReport {
            utilisation: shear.hypot(normal),
            ..PointReport::default()
        }
    }
}
