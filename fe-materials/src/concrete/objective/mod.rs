//! Plastic-damage law of concrete that is objective with respect to the mesh.

mod damage;
mod split;

use fe_core::kinematics::Solid;
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use fe_core::voigt::{principal, stress_tensor};
use nalgebra::{Matrix6, Vector3, Vector6};

use super::elastic_bound::{norm, surely_elastic};
use super::plastic_state::PlasticState;
use super::{CompressionCurve, ConcreteScalars, Isochoric};
use crate::limits::{finite, positive, relaxes};
use damage::Softening;
use split::Split;

const LAW: &str = "objective plastic damage";

/// G_c/G_F (Nakamura and Higai 2001).
const CRUSHING_RATIO: f64 = 250.0;

/// Smallest share of the tensile strength that lateral compression leaves (CEB Bulletin 156).
const LEAST_REDUCTION: f64 = 0.5;

/// Plasticity in compression and isotropic damage of the tensile part of the stress, with crack-band
/// regularisation of both.
///
/// 1. The **effective stress** sb is that of [`Isochoric`] plasticity; its curve falls beyond the peak along
///    [`CompressionCurve::regularised`] with G_c = 250 G_F and the crack-band width h of the point.
/// 2. **Damage.** With sb_1 >= sb_2 >= sb_3, x = min(1, max(0, -sb_3)/fcm) and
///    red = max(1/2, 1 - 0.15 x - 0.75 x^2), which fits the tension-compression meridian of the Ottosen
///    surface,
///
///    kt = max over the history of max(0, sb_1)/(E red), starting at eps0 = fctm/E,
///
///    d = 1 - (eps0/kt) exp[-(kt - eps0)/(eps_f - eps0)], eps_f = G_F/(h fctm) + eps0/2.
/// 3. **Stress** sigma = (1 - d) pos(sb) + neg(sb), pos and neg being the parts of sb with positive and
///    negative principal values.
///
/// Cracks rotate with the effective stress and close completely; without viscosity the largest principal stress
/// never exceeds fctm, so shear cannot lock. Uniaxial tension dissipates G_F/h exactly. h must stay below 2 E G_F/fctm^2.
///
/// The growth of kt in a step is scaled by [`PointContext::relaxation`].
///
/// **Consistent tangent**: the chain rule through the tangent of the plastic law, the derivative of the
/// spectral split and, in loading, dd/dkt. Unsymmetric. **Secant operator**: W D W in the axes of sb with
/// W = diag(sqrt(1 - d)) on tensile axes, symmetric positive definite.
///
/// **No free energy is offered**: ((1 - d) Q+ + Q-) D, with Q+ and Q- the projections on the two parts of sb,
/// is unsymmetric where the principal stresses have both signs and Poisson's ratio is not zero. Even at constant
/// damage the stress then has no potential, and a closed strain path can return energy.
///
/// Sources: split of the effective stress after R. Faria, J. Oliver and M. Cervera, Int. J. Solids Struct. 35
/// (1998) 1533-1558; crack band after Z. P. Bazant and B. H. Oh, Mater. Struct. 16 (1983) 155-177; crushing
/// energy after H. Nakamura and T. Higai, "Modeling of post-peak behavior of structural concrete" (2001).
#[derive(Debug, Clone, PartialEq)]
pub struct Objective {
    plastic: Isochoric,
    young: f64,
    strength: f64,
    fracture_energy: f64,
}

/// Internal variables, in the order of the state slice.
const STATE_VARS: [StateVar; 5] = [
    StateVar::vector("plastic_strain", "-", 6),
    StateVar::scalar("kappa", "-"),
    StateVar::scalar("kappa_t", "-"),
    StateVar::scalar("damage", "-"),
    StateVar::scalar("crushing", "-"),
];

/// Typed view of the internal variables.
#[derive(Debug, Clone, Copy, PartialEq)]
struct State {
    plastic: PlasticState,
    /// Largest equivalent tensile strain kt.
    kt: f64,
    /// d and the consumed share of the fall in compression: functions of the others and of h, kept for
    /// reports.
    damage: f64,
    crushing: f64,
}

impl State {
    fn read(s: &[f64]) -> Self {
        Self {
            plastic: PlasticState::read(s),
            kt: s[7],
            damage: s[8],
            crushing: s[9],
        }
    }

    fn write(&self, s: &mut [f64]) {
        self.plastic.write(s);
        s[7..10].copy_from_slice(&[self.kt, self.damage, self.crushing]);
    }
}

/// Equivalent tensile strain of an effective stress and its derivatives with respect to sb_1 and sb_3.
struct Drive {
    value: f64,
    first: f64,
    third: f64,
}

impl Objective {
    /// The law of a concrete.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`].
    pub fn new(p: &ConcreteScalars) -> Result<Self, MaterialError> {
        positive(LAW, "fracture_energy", p.fracture_energy, "N/mm")?;
        Ok(Self {
            // Beyond the peak the curve is that of the crushing energy: where that of the Model Code would end is of no account.
            plastic: Isochoric::new(&ConcreteScalars {
                eps_c_lim: p.eps_c1,
                ..*p
            })?,
            young: p.young_mpa,
            strength: p.fctm_mpa,
            fracture_energy: p.fracture_energy,
        })
    }

    /// Compression curve in a band of width h (mm).
    pub fn compression(&self, band_width: f64) -> CompressionCurve {
        let crushing_energy = CRUSHING_RATIO * self.fracture_energy;
        self.plastic
            .curve()
            .regularised(crushing_energy, band_width)
    }

    fn softening(&self, band_width: f64) -> Result<Softening, MaterialError> {
        Softening::new(self.young, self.strength, self.fracture_energy, band_width)
    }

    /// Whether a stress neither yields nor damages by bounds that need no principal stresses: the first and the
    /// third are at most the norm, and kt grows with both.
    fn stays_intact(&self, stress: &Vector6<f64>, state: &State, curve: &CompressionCurve) -> bool {
        let largest = norm(stress);
        state.damage == 0.0
            && self.drive(&Vector3::new(largest, 0.0, -largest)).value <= state.kt
            && surely_elastic(stress, state.plastic.kappa, curve)
    }

    fn drive(&self, effective: &Vector3<f64>) -> Drive {
        if effective[0] <= 0.0 {
            return Drive {
                value: 0.0,
                first: 0.0,
                third: 0.0,
            };
        }
        let fcm = self.plastic.surface().strength();
        let x = -effective[2] / fcm;
        let fitted = 1.0 - x.clamp(0.0, 1.0) * (0.15 + 0.75 * x.clamp(0.0, 1.0));
        let (reduction, slope) = if fitted <= LEAST_REDUCTION {
            (LEAST_REDUCTION, 0.0)
        } else if x > 0.0 {
            (fitted, (0.15 + 1.5 * x) / fcm)
        } else {
            (fitted, 0.0)
        };
        let first = 1.0 / (self.young * reduction);
        let value = effective[0] * first;
        Drive {
            value,
            first,
            third: -value / reduction * slope,
        }
    }
}

impl Material<Solid> for Objective {
    fn name(&self) -> &'static str {
        LAW
    }

    fn state_vars(&self) -> &[StateVar] {
        &STATE_VARS
    }

    fn init_state(&self, state: &mut [f64]) {
        state.fill(0.0);
        state[7] = self.strength / self.young;
    }

    fn admit(&self, ctx: &PointContext) -> Result<(), MaterialError> {
        self.softening(ctx.band_width).map(|_| ())
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        finite(LAW, strain)?;
        relaxes(LAW, ctx.relaxation)?;
        let softening = self.softening(ctx.band_width)?;
        let curve = self.compression(ctx.band_width);
        let mut state = State::read(committed);
        let stress = self.plastic.trial_stress(strain, &state.plastic);
        if self.stays_intact(&stress, &state, &curve) {
            trial.copy_from_slice(committed);
            return Ok(self.plastic.elastic_response(stress));
        }
        let effective = self
            .plastic
            .respond(&stress, &state.plastic, &curve, ctx.operator)?;
        let drive = self.drive(&effective.principal);
        let growth = drive.value - state.kt;
        state.kt += ctx.relaxation * growth.max(0.0);
        let (damage, slope) = softening.damage(state.kt);
        state.plastic = effective.state;
        state.damage = damage;
        state.crushing = curve.crushing(curve.eta(state.plastic.kappa));
        state.write(trial);
        if damage == 0.0 {
            return Ok(Response {
                stress: effective.stress,
                tangent: effective.tangent,
            });
        }
        let split = Split::new(&effective, damage);
        let tangent = match ctx.operator {
            Operator::None => Matrix6::zeros(),
            Operator::Secant => split.secant(&self.plastic.elastic().stiffness),
            Operator::Tangent => {
                let rate = if growth > 0.0 {
                    ctx.relaxation * slope
                } else {
                    0.0
                };
                split.tangent(&(Vector3::new(drive.first, 0.0, drive.third) * rate))
            }
        };
        Ok(Response {
            stress: split.stress(),
            tangent,
        })
    }

    fn unsymmetric_tangent(&self) -> bool {
        true
    }

    fn report(&self, strain: &Vector6<f64>, state: &[f64]) -> PointReport {
        let state = State::read(state);
        let elastic = self.plastic.elastic();
        let effective = elastic.stress(&(strain - state.plastic.strain));
        let (values, axes) = principal(&stress_tensor(&effective));
        let tensile = values.map(|s| s.max(0.0) * state.damage);
        let opening = elastic.principal_compliance() * tensile;
        let cracked = tensile[0] > 0.0;
        let normal = if cracked {
            axes.column(0).into()
        } else {
            Vector3::zeros()
        };
        PointReport {
            crack_strain: if cracked { opening[0] } else { 0.0 },
            crack_normal: normal.into(),
            plastic_strain: state.plastic.strain.into(),
            crushing: state.crushing,
            ..PointReport::default()
        }
    }
}

#[cfg(test)]
mod tests;
