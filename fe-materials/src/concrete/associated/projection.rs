//! Closest-point projection on a level of the effective stress, in Haigh-Westergaard coordinates.

use std::f64::consts::{FRAC_PI_3, TAU};

use nalgebra::{Matrix3, Vector3};

use crate::concrete::Ottosen;
use crate::concrete::plastic_state::RETURN_TOLERANCE;
use crate::concrete::root::{NotConverged, bracketed_root};
use crate::elasticity::Elasticity;

/// Tolerance of the Lode angle, relative to the deviator of the trial stress.
const ANGLE_TOLERANCE: f64 = 4e-16;

/// Tolerance of the Lode angle at the apex (rad): it only bounds the others.
const APEX_TOLERANCE: f64 = 1e-14;

/// Projection of a trial stress on the sets F <= s in the norm of the elastic compliance.
///
/// In the coordinates p (mean stress), r = sqrt(J2) and f (Lode angle), with the trial values marked tr and a
/// multiplier w >= 0, the projection reads, from g = alpha r^2/s + lambda(f) r + 3 beta p - s,
///
/// $$ p = p_{tr} - 3 \beta \tfrac{K}{G} w, \qquad
///    r \left(1 + \tfrac{2 \alpha w}{s}\right) = \rho(w) =
///    \max_f \left[ r_{tr} \cos(f - f_{tr}) - w \lambda(f) \right] $$
///
/// with r = 0, the apex on the tensile hydrostatic axis, where the maximum is negative. The plastic multiplier
/// of the flow rule is dlam = (w/G) (1 + alpha r^2/s^2).
///
/// Every unknown comes from a scalar equation with a bracket: f in w, and w in s because g is convex.
pub(super) struct Projection<'a> {
    surface: &'a Ottosen,
    elastic: &'a Elasticity,
    mean: f64,
    radius: f64,
    angle: f64,
    /// Lode angle that the return direction approaches at the apex.
    apex_angle: f64,
    /// Multiplier from which on the deviator is returned to zero: max of r_tr cos(f - f_tr)/lambda(f).
    apex: f64,
}

/// A projected stress.
#[derive(Debug, Clone, Copy)]
pub(super) struct Projected {
    /// Principal stresses, descending (MPa).
    pub(super) stress: Vector3<f64>,
    /// Plastic multiplier (-).
    pub(super) dlam: f64,
    /// a = dF/dsigma.
    pub(super) gradient: Vector3<f64>,
    /// Q = (C + dlam d2F/dsigma2)^-1: dsigma = Q (deps - a ddlam).
    pub(super) stiffness: Matrix3<f64>,
}

impl Projected {
    /// -ds/ddlam = a Q a (MPa): how fast the level falls with the plastic multiplier.
    pub(super) fn softening(&self) -> f64 {
        self.gradient.dot(&(self.stiffness * self.gradient))
    }
}

impl<'a> Projection<'a> {
    /// `trial`: principal stresses, descending.
    pub(super) fn new(
        surface: &'a Ottosen,
        elastic: &'a Elasticity,
        trial: &Vector3<f64>,
    ) -> Result<Self, NotConverged> {
        let mean = trial.mean();
        let radius = (0.5 * trial.add_scalar(-mean).norm_squared()).sqrt();
        // Exact on the meridians, where cos 3f is stationary.
        let angle = (3.0_f64.sqrt() * (trial[1] - trial[2]))
            .atan2((trial[0] - trial[1]) + (trial[0] - trial[2]));
        let apex_angle = apex_angle(surface, angle)?;
        let [lambda, ..] = surface.polar_lambda(apex_angle);
        let apex = radius * (apex_angle - angle).cos() / lambda;
        Ok(Self {
            surface,
            elastic,
            mean,
            radius,
            angle,
            apex_angle,
            apex,
        })
    }

    /// The projection on F <= `level`, for a trial stress outside.
    pub(super) fn onto(&self, level: f64) -> Result<Projected, NotConverged> {
        let (alpha, beta, shear) = (
            self.surface.alpha(),
            self.surface.beta(),
            self.elastic.shear,
        );
        let p_slope = -3.0 * beta * self.elastic.bulk / shear;
        // Beyond both bounds r = 0 and p <= 0, hence F = 0.
        let last = self.apex.max(-self.mean / p_slope);
        let mut found = (0.0, 0.0, 0.0);
        let tolerance = RETURN_TOLERANCE * level;
        let w = bracketed_root((0.0, last), 0.0, tolerance, |w| {
            let mean = self.mean + p_slope * w;
            let (f, slope);
            if w < self.apex {
                let angle = self.angle_at(w)?;
                let [lambda, d_lambda, d2_lambda] = self.surface.polar_lambda(angle);
                let along = self.radius * (angle - self.angle).cos();
                let stiffening = 1.0 + 2.0 * alpha * w / level;
                let r = (along - w * lambda) / stiffening;
                let r_slope = -(lambda + 2.0 * alpha * r / level) / stiffening;
                let lambda_slope = -d_lambda * d_lambda / (along + w * d2_lambda);
                let s;
                (f, s) = self.surface.polar_value(lambda, r, 3.0 * mean);
                let a_slope = lambda * r_slope + r * lambda_slope + 3.0 * beta * p_slope;
                slope = (f * a_slope + 2.0 * alpha * r * r_slope) / s;
                found = (mean, r, angle);
            } else {
                (f, slope) = ((3.0 * beta * mean).max(0.0), 3.0 * beta * p_slope);
                found = (mean, 0.0, self.apex_angle);
            }
            Ok((f - level, slope))
        })?;
        let (mean, r, angle) = found;
        let dlam = w / shear * (1.0 + alpha * (r / level).powi(2));
        let stress = Vector3::from_fn(|i, _| {
            mean + 2.0 / 3.0_f64.sqrt() * r * (angle - i as f64 * TAU / 3.0).cos()
        });
        self.projected(stress, dlam, r > 0.0)
    }

    /// Lode angle at a multiplier below the apex: r_tr sin(f - f_tr) + w lambda'(f) = 0.
    fn angle_at(&self, w: f64) -> Result<f64, NotConverged> {
        let bracket = (self.angle, self.apex_angle);
        bracketed_root(
            bracket,
            self.angle,
            ANGLE_TOLERANCE * self.radius,
            |angle| {
                let [_, slope, curvature] = self.surface.polar_lambda(angle);
                let (sin, cos) = (angle - self.angle).sin_cos();
                Ok((
                    -self.radius * sin - w * slope,
                    -self.radius * cos - w * curvature,
                ))
            },
        )
    }

    fn projected(
        &self,
        stress: Vector3<f64>,
        dlam: f64,
        smooth: bool,
    ) -> Result<Projected, NotConverged> {
        let (effective, gradient, hessian) = self.surface.principal_derivatives(&stress);
        let stiffness = if smooth {
            let singular = NotConverged {
                residual: effective,
                iterations: 0,
            };
            (self.elastic.principal_compliance() + hessian * dlam)
                .try_inverse()
                .ok_or(singular)?
        } else {
            Matrix3::repeat(self.elastic.bulk)
        };
        Ok(Projected {
            stress,
            dlam,
            gradient,
            stiffness,
        })
    }
}

/// Lode angle f at the maximum of cos(f - t)/lambda(f), where f - arctan(-lambda'/lambda) = t: the normal of
/// the deviatoric section points along t. The left-hand side grows with f because the section is convex.
fn apex_angle(surface: &Ottosen, t: f64) -> Result<f64, NotConverged> {
    bracketed_root((t, FRAC_PI_3), t, APEX_TOLERANCE, |angle| {
        let [lambda, slope, curvature] = surface.polar_lambda(angle);
        let normal = angle - (-slope / lambda).atan();
        let growth = lambda * (lambda + curvature) / (lambda * lambda + slope * slope);
        Ok((t - normal, -growth))
    })
}
