//! Associated plasticity of concrete on the Ottosen surface.

mod projection;

use fe_core::kinematics::Solid;
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use fe_core::voigt::{principal, stress_tensor, stress_voigt};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use super::plastic_state::{PLASTIC_VARS, PlasticState, RETURN_TOLERANCE, yield_limit};
use super::root::{NotConverged, bracketed_root, is_number};
use super::spectral::{from_principal, spin_quotients};
use super::{Calibration, CompressionCurve, ConcreteScalars, CurvePoint, Ottosen};
use crate::elasticity::Elasticity;
use crate::limits::finite;
use projection::{Projected, Projection};

const LAW: &str = "associated Ottosen plasticity";

/// Associated plasticity with the Ottosen surface as loading surface.
///
/// With the effective stress F of [`Ottosen`] and the curve sbar(kappa) of [`CompressionCurve`]:
///
/// $$ F(\sigma) \le \bar s(\kappa), \qquad
///    \dot\varepsilon_p = \dot\lambda \frac{\partial F}{\partial \sigma}, \qquad
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
/// **Return mapping** (backward Euler) in the principal axes of the trial stress. The closest point on
/// F = sbar in the norm of the elastic compliance is unique; in the coordinates mean stress, sqrt(J2) and Lode
/// angle it comes from scalar equations with brackets, without a singularity on the meridians or at the apex on
/// the tensile hydrostatic axis. The apex is the closest point if and only if the trial deviator lies in the
/// cone of its normals, tested first. dlam(sbar(eta)) = kappa(eta) - kappa_n, with eta = eps/eps_c1 of the
/// curve, is then one more equation with a bracket: the return cannot fail. Where the curve falls under high pressure there may
/// be three roots, and the stress jumps where strains pass from one to another.
///
/// **Consistent tangent** in those axes, with a = dF/dsigma, H = dsbar/dkappa and
/// Q = (C + dlam d2F/dsigma2)^-1: Q - (Q a)(Q a)/(a Q a + H) for the principal strains, and
/// G (s_i - s_j)/(s_tr,i - s_tr,j) for the shear strains, which turn the axes. It is symmetric.
///
/// The secant operator is the elastic stiffness. The dissipation sbar dlam of a step is never negative; the
/// free energy is that of the elastic strain.
///
/// Sources: Ottosen (1977); fib Model Code 2010; closest-point projection after J. C. Simo and T. J. R. Hughes,
/// "Computational Inelasticity" (1998), chapters 3 and 4.
#[derive(Debug, Clone, PartialEq)]
pub struct Associated {
    elastic: Elasticity,
    surface: Ottosen,
    curve: CompressionCurve,
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

    /// The new stress and the point of the curve that it lies on.
    fn solve(
        &self,
        trial: &Vector3<f64>,
        kappa: f64,
    ) -> Result<(Projected, CurvePoint), NotConverged> {
        let projection = Projection::new(&self.surface, &self.elastic, trial)?;
        let f = self.surface.principal_effective_stress(trial);
        let first = (kappa + f / self.elastic.young) / self.curve.peak_strain();
        // The energy norm of the projection bounds dlam by sigma_tr : C : sigma_tr/(2 s).
        let energy = 0.5 * trial.dot(&(self.elastic.principal_compliance() * trial));
        let mut last = first;
        let mut end = self.curve.at(last);
        while energy > end.stress * (end.kappa - kappa) {
            last *= 2.0;
            end = self.curve.at(last);
        }
        let bracket = (self.curve.eta(kappa), last);
        let tolerance = RETURN_TOLERANCE * f / self.elastic.young;
        let mut near = None;
        let eta = bracketed_root(bracket, first, tolerance, |eta| {
            let point = self.curve.at(eta);
            let projected = projection.onto(point.stress, near.as_ref())?;
            near = Some(projected);
            let slope = -point.stress_slope / projected.level_drop() - point.kappa_slope;
            Ok((projected.dlam - (point.kappa - kappa), slope))
        })?;
        let point = self.curve.at(eta);
        Ok((projection.onto(point.stress, near.as_ref())?, point))
    }

    fn tangent(
        &self,
        axes: &Matrix3<f64>,
        trial: &Vector3<f64>,
        projected: &Projected,
        hardening: f64,
    ) -> Matrix6<f64> {
        let qa = projected.stiffness * projected.gradient;
        let divisor = projected.gradient.dot(&qa) + hardening;
        let normal = projected.stiffness - qa * qa.transpose() / divisor;
        let slopes = normal * self.elastic.principal_compliance();
        let spin = spin_quotients(trial, &projected.stress, &slopes);
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
        let effective = self.surface.principal_effective_stress(&principal);
        if effective <= yield_limit(&self.curve, self.curve.eta(state.kappa)) {
            state.write(trial);
            return Ok(Response {
                stress: predictor,
                tangent: self.elastic.stiffness,
            });
        }
        let (projected, point) = self
            .solve(&principal, state.kappa)
            .map_err(|failure| failure.of(LAW, self.surface.strength()))?;
        let diagonal = Matrix3::from_diagonal(&projected.stress);
        let stress = stress_voigt(&(axes * diagonal * axes.transpose()));
        state.strain += self.elastic.strain(&(predictor - stress));
        state.kappa = point.kappa;
        state.write(trial);
        let tangent = if ctx.operator == Operator::Tangent {
            let hardening = point.hardening_modulus();
            let tangent = self.tangent(&axes, &principal, &projected, hardening);
            is_number(LAW, &tangent)?;
            tangent
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
