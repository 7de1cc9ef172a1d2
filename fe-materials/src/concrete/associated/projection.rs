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
    /// F of the trial stress (MPa).
    effective: f64,
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
    place: Place,
}

/// Where a projection lies: multiplier w (MPa), sqrt(J2) (MPa) and Lode angle (rad).
#[derive(Debug, Clone, Copy)]
struct Place {
    w: f64,
    r: f64,
    angle: f64,
}

impl Projected {
    /// -ds/ddlam = a Q a (MPa): how fast the level falls with the plastic multiplier.
    pub(super) fn level_drop(&self) -> f64 {
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
            .atan2((trial[0] - trial[1]) + (trial[0] - trial[2]))
            .min(FRAC_PI_3);
        let apex_angle = apex_angle(surface, angle)?;
        let [of_trial, ..] = surface.polar_lambda(angle);
        let [lambda, ..] = surface.polar_lambda(apex_angle);
        let apex = radius * (apex_angle - angle).cos() / lambda;
        Ok(Self {
            surface,
            elastic,
            // As `place` finds it: next to the hydrostatic axis rounding of the other way is larger than the tolerance.
            effective: surface.polar_value(of_trial, radius, 3.0 * mean).0,
            mean,
            radius,
            angle,
            apex_angle,
            apex,
        })
    }

    /// The projection on F <= `level`; one on a level near by, if there is one, saves iterations.
    pub(super) fn onto(
        &self,
        level: f64,
        near: Option<&Projected>,
    ) -> Result<Projected, NotConverged> {
        let trial = Place {
            w: 0.0,
            r: self.radius,
            angle: self.angle,
        };
        let mut at = near.map_or(trial, |p| p.place);
        if self.effective <= level {
            at = trial;
        } else {
            // Beyond both bounds r = 0 and p <= 0, hence F = 0.
            let last = self.apex.max(-self.mean / self.mean_slope());
            bracketed_root((0.0, last), at.w, RETURN_TOLERANCE * level, |w| {
                let (f, slope);
                (at, f, slope) = self.place(w, level, at.angle)?;
                Ok((f - level, slope))
            })?;
        }
        let dlam =
            at.w / self.elastic.shear * (1.0 + self.surface.alpha() * (at.r / level).powi(2));
        let stress = Vector3::from_fn(|i, _| {
            let angle = at.angle - i as f64 * TAU / 3.0;
            self.mean + self.mean_slope() * at.w + 2.0 / 3.0_f64.sqrt() * at.r * angle.cos()
        });
        let (effective, gradient, hessian) = self.surface.principal_derivatives(&stress);
        let stiffness = if at.r > 0.0 {
            let singular = NotConverged {
                residual: effective,
                iterations: 0,
            };
            let inverse = (self.elastic.principal_compliance() + hessian * dlam)
                .try_inverse()
                .ok_or(singular)?;
            // Symmetric but for the rounding of an inverse that is near singular.
            0.5 * (inverse + inverse.transpose())
        } else {
            Matrix3::repeat(self.elastic.bulk)
        };
        Ok(Projected {
            stress,
            dlam,
            gradient,
            stiffness,
            place: at,
        })
    }

    /// dp/dw.
    fn mean_slope(&self) -> f64 {
        -3.0 * self.surface.beta() * self.elastic.bulk / self.elastic.shear
    }

    /// The stress at a multiplier, its F and dF/dw; `start` approximates the Lode angle.
    fn place(&self, w: f64, level: f64, start: f64) -> Result<(Place, f64, f64), NotConverged> {
        let (alpha, beta) = (self.surface.alpha(), self.surface.beta());
        let mean = self.mean + self.mean_slope() * w;
        let axial_slope = 3.0 * beta * self.mean_slope();
        if w >= self.apex {
            let place = Place {
                w,
                r: 0.0,
                angle: self.apex_angle,
            };
            return Ok((place, (3.0 * beta * mean).max(0.0), axial_slope));
        }
        let angle = self.angle_at(w, start)?;
        let [lambda, d_lambda, d2_lambda] = self.surface.polar_lambda(angle);
        let along = self.radius * (angle - self.angle).cos();
        let stiffening = 1.0 + 2.0 * alpha * w / level;
        let r = (along - w * lambda) / stiffening;
        let (f, s) = self.surface.polar_value(lambda, r, 3.0 * mean);
        let r_slope = -(lambda + 2.0 * alpha * r / level) / stiffening;
        let lambda_slope = -d_lambda * d_lambda / (along + w * d2_lambda);
        let a_slope = lambda * r_slope + r * lambda_slope + axial_slope;
        Ok((
            Place { w, r, angle },
            f,
            (f * a_slope + 2.0 * alpha * r * r_slope) / s,
        ))
    }

    /// Lode angle at a multiplier below the apex: r_tr sin(f - f_tr) + w lambda'(f) = 0.
    fn angle_at(&self, w: f64, start: f64) -> Result<f64, NotConverged> {
        let bracket = (self.angle, self.apex_angle);
        bracketed_root(bracket, start, ANGLE_TOLERANCE * self.radius, |angle| {
            let [_, slope, curvature] = self.surface.polar_lambda(angle);
            let (sin, cos) = (angle - self.angle).sin_cos();
            Ok((
                -self.radius * sin - w * slope,
                -self.radius * cos - w * curvature,
            ))
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
