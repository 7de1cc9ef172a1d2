//! Fixed orthotropic cracks with tension stiffening over a fixed strain: the published model of the beams (Soares 2022).
//!
//! Its text is taken with these corrections: c1 of the surface (3.20) has its factor of 4 and holds for
//! lambda_c/lambda_t <= 1/2; the modulus (3.27) has its factor Eci and the exponent of the Model Code; the derivatives of the
//! surface (3.36 to 3.41) are those of one order of shears and one Lode angle; tension stiffening (3.42) begins at alpha
//! fctm; shear retention (3.46), negative beyond 0.005 where the text begins it at 0.01, stays at its floor from there
//! ([`ShearRetention`]).

mod cracked;
mod parameters;
mod state;

#[cfg(test)]
mod tests;

use fe_core::kinematics::Solid;
use fe_core::material::{Material, MaterialError, PointContext, PointReport, Response, StateVar};
use fe_core::voigt::strain_transform;
use nalgebra::Vector6;

pub use parameters::{ReferenceParameters, ShearRetention, TensionStiffening};

use super::elastic_bound::{absolute_sum, surely_elastic};
use super::{CompressionCurve, Isochoric};
use crate::limits::{finite, relaxes};
use state::{STATE_VARS, State};

const LAW: &str = "reference concrete";

/// Smallest modulus of the secant operator, relative to Eci: keeps the operator positive definite where a
/// crack carries nothing. It does not enter the stress.
const OPERATOR_FLOOR: f64 = 1e-4;

/// The published law of the beams: Ottosen plasticity in compression, fixed orthotropic cracks in tension.
///
/// **Uncracked** the point follows [`Isochoric`]. A crack opens when the returned stress reaches the
/// Ottosen surface, F(sigma) >= fcm, with sigma_1 >= fctm/2 (CEB Bulletin 156); with sigma_1 < fctm/2, or
/// at the peak of the compression curve, the point is only marked as crushed.
///
/// **Cracked**, the principal axes of that stress are frozen, Poisson's ratio is zero, and with the plastic
/// strain at cracking, e_i = eps_i - eps_p,i, each axis follows
///
/// $$ \sigma_i = \begin{cases}
/// E_{ci} e_i & e_i \ge 0, \text{ no crack; it opens at } f_{ctm} \cr
/// S(r_i) e_i & e_i \ge 0, \text{ crack}, r_i = \max e_i \cr
/// \max(E_{ci} e_i, -\bar s(\kappa_i)) & e_i < 0, \text{ crack closed or none}
/// \end{cases} $$
///
/// with the secant S r = min(Eci r, a_ts fctm (1 - r/eps_ctu)), not below zero, of the tension stiffening:
/// unloading goes to the origin. It is zero for cracks that [`TensionStiffening`] does not serve.
/// Compressive yield moves eps_p,i and kappa_i along the curve sbar of [`CompressionCurve`], their sum
/// being constant. The shear stresses are
///
/// $$ \tau_{ij} = \min(b_i, b_j) G_0 (\gamma_{ij} - \gamma_{p,ij}), $$
///
/// b from [`ShearRetention`] with the current e_i, and 1 for an axis without an open crack.
///
/// # Caveats
///
/// The law reproduces published results; it is not objective. The tension stiffening dissipates an energy
/// proportional to the size of the element whatever the fracture energy, the crack-band width is not used,
/// and shear stress on a crack grows without bound up to e = 0.01 with [`ShearRetention::Threshold`]. The
/// stress jumps when a crack opens, and the shear stiffness returns when it closes: no free energy is
/// promised. Where two principal stresses coincide at onset, the axes in their plane are arbitrary.
///
/// The growth of r_i in a step is scaled by the relaxation of the context; plastic strain is not.
///
/// Sources: Soares, dissertation, Universidade Federal do Rio Grande do Sul (2022), section 3.1.2; E. Hinton, "Numerical Methods and Software for Dynamic Analysis of Plates and Shells" (1988);
/// CEB Bulletin 156 (1983); surface and curve as in [`Isochoric`].
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    p: ReferenceParameters,
    uncracked: Isochoric,
    shear_modulus: f64,
}

impl Reference {
    /// A law with the given parameters.
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`].
    pub fn new(p: &ReferenceParameters) -> Result<Self, MaterialError> {
        p.check()?;
        Ok(Self {
            p: *p,
            uncracked: Isochoric::new(&p.concrete)?,
            shear_modulus: p.concrete.shear_modulus(),
        })
    }

    /// The parameters.
    pub const fn parameters(&self) -> &ReferenceParameters {
        &self.p
    }

    const fn young(&self) -> f64 {
        self.p.concrete.young_mpa
    }

    const fn strength(&self) -> f64 {
        self.p.concrete.fctm_mpa
    }

    const fn curve(&self) -> &CompressionCurve {
        self.uncracked.curve()
    }

    /// Stress of a point without a crack, or `None` if one opens; updates the state.
    fn uncracked(
        &self,
        strain: &Vector6<f64>,
        state: &mut State,
        ctx: &PointContext,
    ) -> Result<Option<Response<Solid>>, MaterialError> {
        let stress = self.uncracked.trial_stress(strain, &state.plastic);
        // F <= fcm/fctm times the sum: below fctm the surface is not reached.
        let (kappa, curve) = (state.plastic.kappa, self.curve());
        if absolute_sum(&stress) < self.strength() && surely_elastic(&stress, kappa, curve) {
            return Ok(Some(self.uncracked.elastic_response(stress)));
        }
        let answer = self
            .uncracked
            .respond(&stress, &state.plastic, curve, ctx.operator)?;
        let surface = self.uncracked.surface();
        let reached = surface.principal_effective_stress(&answer.principal) >= surface.strength();
        if reached && answer.principal[0] >= 0.5 * self.strength() {
            // What flows in the step in which it cracks is left to the axes of the crack, whatever iterates it takes.
            state.crack(answer.axes, state.plastic);
            return Ok(None);
        }
        state.plastic = answer.state;
        state.crushed |= reached || answer.state.kappa >= self.curve().peak_kappa();
        Ok(Some(Response {
            stress: answer.stress,
            tangent: answer.tangent,
        }))
    }
}

impl Material<Solid> for Reference {
    fn name(&self) -> &'static str {
        LAW
    }

    fn state_vars(&self) -> &[StateVar] {
        &STATE_VARS
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
        let mut state = State::read(committed);
        let intact = if state.is_cracked() {
            None
        } else {
            self.uncracked(strain, &mut state, ctx)?
        };
        let response = intact.unwrap_or_else(|| self.cracked(strain, &mut state, ctx));
        state.write(trial);
        Ok(response)
    }

    fn unsymmetric_tangent(&self) -> bool {
        true
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        let (found, mut kept) = (State::read(trial), State::read(base));
        let new = (0..kept.cracked.len()).any(|i| found.cracked[i] && !kept.cracked[i]);
        if found.is_cracked() && !kept.is_cracked() {
            // The axes stay, what has flowed or crushed on the way to them has not been accepted.
            kept.crack(found.axes, kept.plastic);
        }
        kept.cracked = std::array::from_fn(|i| kept.cracked[i] || found.cracked[i]);
        kept.write(base);
        new
    }

    fn report(&self, strain: &Vector6<f64>, state: &[f64]) -> PointReport {
        let state = State::read(state);
        let crushing = |kappa: f64| self.curve().crushing(self.curve().eta(kappa));
        if !state.is_cracked() {
            return state.plastic.report(self.curve());
        }
        let t = strain_transform(&state.axes);
        let total = t * strain;
        let mut plastic = t * state.plastic.strain;
        let mut report = PointReport::default();
        for i in 0..3 {
            plastic[i] += state.plastic.kappa - state.kappa[i];
            report.crushing = report.crushing.max(crushing(state.kappa[i]));
            // The strain of the crack is what its stress leaves of the strain.
            let share = 1.0 - self.stiffening_secant(i, &state).0 / self.young();
            let crack_strain = share * (total[i] - plastic[i]);
            if state.cracked[i] && crack_strain > report.crack_strain {
                report.crack_strain = crack_strain;
                report.crack_normal = state.axes.column(i).into_owned().into();
            }
        }
        let back = strain_transform(&state.axes.transpose());
        report.plastic_strain = (back * plastic).into();
        report
    }
}
