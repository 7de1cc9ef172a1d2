//! Associated plasticity of concrete on the Ottosen surface.

mod resolvent;

use fe_core::kinematics::Solid;
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use fe_core::voigt::{principal, stress_tensor, stress_voigt};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::elasticity::Elasticity;
use super::limits::finite;
use super::plastic_state::{PLASTIC_VARS, PlasticState};
use super::root::{NotConverged, bracketed_root};
use super::spectral::{from_principal, spin_quotients};
use super::{Calibration, CompressionCurve, ConcreteScalars, Ottosen};
use resolvent::{Resolvent, Returned};

const LAW: &str = "associated Ottosen plasticity";

/// Overshoot of the yield condition that still counts as elastic, relative to fcm: above the tolerance of
/// the return, so that a returned stress is elastic at the same strain.
const YIELD_TOLERANCE: f64 = 1e-11;

/// Tolerance of the return, relative to fcm.
const RETURN_TOLERANCE: f64 = 2e-13;

/// Associated plasticity with the Ottosen surface as loading surface.
///
/// With the effective stress F of [`Ottosen`] and the curve sbar(kappa) of [`CompressionCurve`]:
///
/// $$ F(\sigma) \le \bar s(\kappa), \qquad
///    \dot\varepsilon_p = \dot\lambda\, \frac{\partial F}{\partial \sigma}, \qquad
///    \dot\kappa = \dot\lambda, $$
///
/// the last because F is homogeneous of degree one: sigma : deps_p = F dlam = sbar dkappa. Uniaxial
/// compression reproduces the curve exactly for any step size.
///
/// **Use.** For material points in compression. The initial yield stress is zero and the surface passes
/// through fctm in tension, so a tensile stress hardens along the compression curve as well and reaches fctm
/// only at a strain of a percent or so; and the dilatancy is large: in uniaxial compression the lateral
/// plastic strain is four to five times the axial one. [`Isochoric`](super::Isochoric) has neither.
///
/// **Return mapping** (backward Euler) in the principal axes of the trial stress. For a given dlam the
/// returned stress is the unique minimum of the strictly convex
/// Phi = 1/2 (sigma - sigma_tr) : C : (sigma - sigma_tr) + dlam F(sigma), found by Newton's method with a
/// line search on Phi; the yield condition is then one monotone equation for eta = eps/eps_c1 of the curve,
/// with a bracket. On the tensile hydrostatic axis F has a kink, the apex: the minimum lies there, with
/// p = p_tr - 3 beta K dlam, if and only if the trial deviator is inside the cone of the apex, which is tested
/// first.
///
/// **Consistent tangent** in those axes, with a = dF/dsigma, H = dsbar/dkappa and
/// Q = (C + dlam d2F/dsigma2)^-1: Q - (Q a)(Q a)/(a Q a + H) for the principal strains, and
/// G (s_i - s_j)/(s_tr,i - s_tr,j) for the shear strains, which turn the axes. It is symmetric.
///
/// The secant operator is the elastic stiffness. The dissipation sbar dlam of a step is never negative; the
/// free energy is that of the elastic strain.
///
/// Sources: Ottosen (1977); fib Model Code 2010; convex form of the return after J. C. Simo and T. J. R.
/// Hughes, "Computational Inelasticity" (1998), chapters 3 and 4.
#[derive(Debug, Clone, PartialEq)]
pub struct Associated {
    elastic: Elasticity,
    surface: Ottosen,
    curve: CompressionCurve,
}

/// A return in principal axes with its hardening variable.
struct Solution {
    returned: Returned,
    kappa: f64,
    /// H = dsbar/dkappa [MPa].
    hardening: f64,
}

impl Associated {
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

    /// The loading surface.
    pub const fn surface(&self) -> &Ottosen {
        &self.surface
    }

    /// The uniaxial curve that drives the hardening.
    pub const fn curve(&self) -> &CompressionCurve {
        &self.curve
    }

    fn solve(&self, trial: &Vector3<f64>, kappa: f64) -> Result<Solution, NotConverged> {
        let resolvent = Resolvent::new(&self.surface, &self.elastic, *trial);
        let f = self.surface.principal_effective_stress(trial);
        let first = (kappa + f / self.elastic.young) / self.curve.peak_strain();
        let bound = |eta: f64| resolvent.effective_bound(self.curve.at(eta).kappa - kappa);
        let mut last = first;
        while bound(last) > self.curve.at(last).stress {
            last *= 2.0;
        }
        let bracket = (self.curve.eta(kappa), last);
        let tolerance = RETURN_TOLERANCE * self.surface.strength();
        let mut start = trial * (self.curve.at(first).stress / f);
        let eta = bracketed_root(bracket, first, tolerance, |eta| {
            let point = self.curve.at(eta);
            let returned = resolvent.at(point.kappa - kappa, &start)?;
            start = returned.stress;
            let a = &returned.gradient;
            let slope = -a.dot(&(returned.stiffness * a)) * point.kappa_slope - point.stress_slope;
            Ok((returned.effective - point.stress, slope))
        })?;
        let point = self.curve.at(eta);
        Ok(Solution {
            returned: resolvent.at(point.kappa - kappa, &start)?,
            kappa: point.kappa,
            hardening: point.hardening_modulus(),
        })
    }

    fn tangent(
        &self,
        axes: &Matrix3<f64>,
        trial: &Vector3<f64>,
        solution: &Solution,
    ) -> Matrix6<f64> {
        let Returned {
            stress,
            gradient,
            stiffness,
            ..
        } = &solution.returned;
        let qa = stiffness * gradient;
        let normal = stiffness - qa * qa.transpose() / (gradient.dot(&qa) + solution.hardening);
        let slopes = normal * self.elastic.principal_compliance();
        let spin = spin_quotients(trial, stress, &slopes);
        from_principal(
            axes,
            &normal,
            spin.map(|quotient| self.elastic.shear * quotient),
        )
    }
}

impl Material<Solid> for Associated {
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
        let mut state = PlasticState::read(committed);
        let predictor = self.elastic.stress(&(strain - state.strain));
        let (principal, axes) = principal(&stress_tensor(&predictor));
        let fcm = self.surface.strength();
        let yield_stress = self.curve.at(self.curve.eta(state.kappa)).stress;
        let effective = self.surface.principal_effective_stress(&principal);
        if effective <= yield_stress + YIELD_TOLERANCE * fcm {
            state.write(trial);
            return Ok(Response {
                stress: predictor,
                tangent: self.elastic.stiffness,
            });
        }
        let solution = self
            .solve(&principal, state.kappa)
            .map_err(|failure| failure.of(LAW, fcm))?;
        let diagonal = Matrix3::from_diagonal(&solution.returned.stress);
        let stress = stress_voigt(&(axes * diagonal * axes.transpose()));
        state.strain += self.elastic.strain(&(predictor - stress));
        state.kappa = solution.kappa;
        state.write(trial);
        let tangent = if ctx.operator == Operator::Tangent {
            self.tangent(&axes, &principal, &solution)
        } else {
            self.elastic.stiffness
        };
        Ok(Response { stress, tangent })
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
