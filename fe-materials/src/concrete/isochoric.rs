//! Isochoric plasticity of concrete in compression.

use fe_core::kinematics::Solid;
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use fe_core::voigt::{principal, strain_voigt, stress_tensor};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::elastic_bound::surely_elastic;
use super::plastic_state::{PLASTIC_VARS, PlasticState, RETURN_TOLERANCE, yield_limit};
use super::root::{bracketed_root, is_number};
use super::{Calibration, CompressionCurve, ConcreteScalars, Ottosen};
use crate::elasticity::Elasticity;
use crate::limits::finite;

const LAW: &str = "isochoric Ottosen plasticity";

/// Plasticity with the Ottosen surface on the compressive part of the stress and isochoric flow.
///
/// With neg(sigma), the stress whose positive principal values are set to zero, the effective stress F of
/// [`Ottosen`], the curve sbar(kappa) of [`CompressionCurve`], s the deviator and q = sqrt(3 J2):
///
/// - yield condition F(neg(sigma)) <= sbar(kappa): tension is elastic, left to a crack law;
/// - flow deps_p = dlam (3/2) s/q, dkappa = dlam.
///
/// Backward Euler keeps the mean stress p and the direction of the trial deviator,
/// sigma = p 1 + rho s_tr with rho = 1 - 3G dlam/q_tr, which leaves one equation
///
/// $$ F(\mathrm{neg}(p 1 + \rho s_{tr})) = \bar s(\kappa_n + \Delta\lambda), $$
///
/// solved for eta = eps/eps_c1 of the curve, where it has no infinite slope; rho from 1 to 0 brackets a
/// root, so the return cannot fail. There may be three: where a small pressure across, which strengthens, goes on the way, or
/// where the curve falls under high pressure. The stress then jumps where strains pass from one root to another. Consistent tangent, with N = dF(neg)/dsigma, H = dsbar/dkappa and
/// c = 3G dlam/q_tr:
///
/// $$ D_{ep} = M - \frac{3G}{q_{tr}}
///    \frac{s_{tr} \otimes (N : M)}{H + \frac{3G}{q_{tr}} N : s_{tr}}, \qquad
///    M = K 1 \otimes 1 + 2G\rho P_{dev} + \frac{3G c}{q_{tr}^2} s_{tr} \otimes s_{tr}, $$
///
/// unsymmetric. Uniaxial compression reproduces the curve exactly for any step size.
///
/// Isochoric flow replaces the associated rule because the dilatancy of the latter is four to five times
/// the axial plastic strain, and because clipping with associated flow is ill-posed under lateral
/// restraint. The secant operator is the elastic stiffness. The dissipation q dlam of a step is never
/// negative; the free energy is that of the elastic strain.
///
/// Sources: surface as in [`Ottosen`]; return mapping after J. C. Simo and T. J. R. Hughes, "Computational
/// Inelasticity" (1998), chapter 3.
#[derive(Debug, Clone, PartialEq)]
pub struct Isochoric {
    elastic: Elasticity,
    surface: Ottosen,
    curve: CompressionCurve,
}

/// A stress on or inside the yield surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlasticReturn {
    /// Stress (MPa).
    pub(crate) stress: Vector6<f64>,
    /// Principal stresses (MPa), descending.
    pub(crate) principal: Vector3<f64>,
    /// Principal axes, columns; the same for trial and returned stress.
    pub(crate) axes: Matrix3<f64>,
    /// New internal variables.
    pub(crate) state: PlasticState,
    /// Operator asked for (MPa).
    pub(crate) tangent: Matrix6<f64>,
}

impl Isochoric {
    /// The law of a concrete, with the surface of [`Calibration::model_code`] and the curve of
    /// [`CompressionCurve::model_code`].
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`].
    pub fn new(p: &ConcreteScalars) -> Result<Self, MaterialError> {
        Ok(Self {
            elastic: Elasticity::new(LAW, p.young_mpa, p.poisson)?,
            surface: Ottosen::new(&Calibration::model_code(p.fcm_mpa, p.fctm_mpa))?,
            curve: CompressionCurve::model_code(p)?,
        })
    }

    /// The surface of the effective stress.
    pub const fn surface(&self) -> &Ottosen {
        &self.surface
    }

    /// The uniaxial curve that drives the hardening.
    pub const fn curve(&self) -> &CompressionCurve {
        &self.curve
    }

    pub(crate) const fn elastic(&self) -> &Elasticity {
        &self.elastic
    }

    /// Answer to a trial stress that is elastic.
    pub(crate) const fn elastic_response(&self, stress: Vector6<f64>) -> Response<Solid> {
        Response {
            stress,
            tangent: self.elastic.stiffness,
        }
    }

    /// Stress (MPa) of a total strain if nothing yields.
    pub(crate) fn trial_stress(
        &self,
        strain: &Vector6<f64>,
        plastic: &PlasticState,
    ) -> Vector6<f64> {
        self.elastic.stress(&(strain - plastic.strain))
    }

    /// Stress, state and operator from a trial stress, hardening along `curve`.
    pub(crate) fn respond(
        &self,
        trial: &Vector6<f64>,
        committed: &PlasticState,
        curve: &CompressionCurve,
        operator: Operator,
    ) -> Result<PlasticReturn, MaterialError> {
        let (principal, axes) = principal(&stress_tensor(trial));
        let elastic = PlasticReturn {
            stress: *trial,
            principal,
            axes,
            state: *committed,
            tangent: self.elastic.stiffness,
        };
        if principal[2] >= 0.0 {
            return Ok(elastic);
        }
        let eta = curve.eta(committed.kappa);
        let limit = yield_limit(curve, eta);
        let effective = self
            .surface
            .principal_effective_stress(&negative(&principal));
        if effective <= limit {
            return Ok(elastic);
        }
        let flow = Flow::new(&elastic, self.elastic.shear);
        let last = curve.eta(committed.kappa + flow.full);
        let eta = bracketed_root((eta, last), eta, RETURN_TOLERANCE * effective, |eta| {
            let point = curve.at(eta);
            let rho = flow.rho(point.kappa - committed.kappa);
            let (f, gradient) = self.clipped_gradient(&flow.principal(rho));
            let slope = -gradient.dot(&flow.deviator) * point.kappa_slope / flow.full;
            Ok((f - point.stress, slope - point.stress_slope))
        })
        .map_err(|failure| failure.of(LAW, self.surface.strength()))?;
        let point = curve.at(eta);
        let increment = point.kappa - committed.kappa;
        let rho = flow.rho(increment);
        let principal = flow.principal(rho);
        let tangent = if operator == Operator::Tangent {
            let n = self.clipped_gradient(&principal).1;
            let hardening = point.hardening_modulus();
            let tangent = self.consistent_tangent(&flow, &axes, &n, increment, hardening);
            is_number(LAW, &tangent)?;
            tangent
        } else {
            self.elastic.stiffness
        };
        Ok(PlasticReturn {
            stress: flow.stress(rho),
            principal,
            axes,
            state: PlasticState {
                strain: committed.strain + flow.direction() * increment,
                kappa: point.kappa,
            },
            tangent,
        })
    }

    /// F(neg(sigma)) and its gradient with respect to the principal stresses.
    fn clipped_gradient(&self, principal: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let (f, mut gradient) = self.surface.principal_gradient(&negative(principal));
        for i in 0..3 {
            if principal[i] >= 0.0 {
                gradient[i] = 0.0;
            }
        }
        (f, gradient)
    }

    fn consistent_tangent(
        &self,
        flow: &Flow,
        axes: &Matrix3<f64>,
        gradient: &Vector3<f64>,
        increment: f64,
        hardening: f64,
    ) -> Matrix6<f64> {
        let (bulk, rho) = (self.elastic.bulk, flow.rho(increment));
        let two_g = 2.0 * self.elastic.shear * rho;
        let mut m = Matrix6::zeros();
        for i in 0..3 {
            for j in 0..3 {
                m[(i, j)] = bulk - two_g / 3.0;
            }
            m[(i, i)] += two_g;
            m[(i + 3, i + 3)] = 0.5 * two_g;
        }
        // 3G/q = 1/(full kappa); s : s = 2/3 q^2.
        let s = &flow.voigt_deviator;
        let per_q = 1.0 / flow.full;
        let c = increment / flow.full;
        m += s * s.transpose() * (per_q * c / flow.q);
        let n = strain_voigt(&(axes * Matrix3::from_diagonal(gradient) * axes.transpose()));
        let nm = m.tr_mul(&n);
        let slope = hardening + per_q * gradient.dot(&flow.deviator);
        m - s * nm.transpose() * (per_q / slope)
    }
}

/// The line of stresses p 1 + rho s_tr that a return moves along.
struct Flow {
    mean: f64,
    /// Principal values of the trial deviator.
    deviator: Vector3<f64>,
    /// The trial deviator, Voigt.
    voigt_deviator: Vector6<f64>,
    /// q_tr = sqrt(3 J2) of the trial stress.
    q: f64,
    /// Plastic strain q_tr/(3G) that would bring the deviator to zero.
    full: f64,
}

impl Flow {
    fn new(trial: &PlasticReturn, shear: f64) -> Self {
        let mean = trial.principal.mean();
        let deviator = trial.principal.add_scalar(-mean);
        let q = (1.5 * deviator.norm_squared()).sqrt();
        let mut voigt_deviator = trial.stress;
        for i in 0..3 {
            voigt_deviator[i] -= mean;
        }
        Self {
            mean,
            deviator,
            voigt_deviator,
            q,
            full: q / (3.0 * shear),
        }
    }

    /// Remaining share of the deviator after a plastic strain.
    fn rho(&self, increment: f64) -> f64 {
        (1.0 - increment / self.full).max(0.0)
    }

    fn principal(&self, rho: f64) -> Vector3<f64> {
        self.deviator.map(|s| self.mean + rho * s)
    }

    fn stress(&self, rho: f64) -> Vector6<f64> {
        let mean = Vector6::new(self.mean, self.mean, self.mean, 0.0, 0.0, 0.0);
        mean + self.voigt_deviator * rho
    }

    /// Plastic strain per dlam: (3/2) s/q, engineering shear.
    fn direction(&self) -> Vector6<f64> {
        let mut direction = self.voigt_deviator * (1.5 / self.q);
        for i in 3..6 {
            direction[i] *= 2.0;
        }
        direction
    }
}

/// Principal stresses with the positive ones set to zero.
fn negative(principal: &Vector3<f64>) -> Vector3<f64> {
    principal.map(|s| s.min(0.0))
}

impl Material<Solid> for Isochoric {
    fn name(&self) -> &'static str {
        LAW
    }

    fn state_vars(&self) -> &[StateVar] {
        &PLASTIC_VARS
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        finite(LAW, strain)?;
        let plastic = PlasticState::read(committed);
        let stress = self.trial_stress(strain, &plastic);
        if surely_elastic(&stress, plastic.kappa, &self.curve) {
            trial.copy_from_slice(committed);
            return Ok(self.elastic_response(stress));
        }
        let response = self.respond(&stress, &plastic, &self.curve, ctx.operator)?;
        response.state.write(trial);
        Ok(Response {
            stress: response.stress,
            tangent: response.tangent,
        })
    }

    fn unsymmetric_tangent(&self) -> bool {
        true
    }

    fn free_energy(&self, strain: &Vector6<f64>, state: &[f64], _: &PointContext) -> Option<f64> {
        Some(
            self.elastic
                .energy(&(strain - PlasticState::read(state).strain)),
        )
    }

    fn report(&self, _: &Vector6<f64>, state: &[f64]) -> PointReport {
        PlasticState::read(state).report(&self.curve)
    }
}
