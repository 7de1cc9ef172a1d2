//! The stress returned for a given plastic multiplier.

use nalgebra::{Matrix3, Vector3};

use crate::concrete::Ottosen;
use crate::concrete::elasticity::Elasticity;
use crate::concrete::root::NotConverged;

/// Tolerance of the stationarity, relative to the trial strain.
const TOLERANCE: f64 = 1e-13;

/// Stationarity that is still accepted where rounding stops the descent.
const ROUNDING: f64 = 1e-10;

const MAX_ITERATIONS: usize = 100;

/// Share of the predicted descent that a step must achieve (Armijo).
const SUFFICIENT: f64 = 1e-4;

/// Halvings of a step before the descent counts as stopped.
const MAX_HALVINGS: i32 = 40;

/// The minimiser of a strictly convex function of the principal stresses: for dlam >= 0,
///
/// Phi(sigma) = 1/2 (sigma - sigma_tr) : C : (sigma - sigma_tr) + dlam F(sigma),
///
/// whose stationarity is the backward Euler rule C (sigma - sigma_tr) + dlam dF/dsigma = 0.
pub(super) struct Resolvent<'a> {
    surface: &'a Ottosen,
    trial: Vector3<f64>,
    compliance: Matrix3<f64>,
    bulk: f64,
    /// dlam from which on the trial deviator lies inside dlam 2G times the deviatoric section of the
    /// subdifferential of F on the tensile hydrostatic axis, so that it is returned to zero.
    apex: f64,
}

/// A returned stress and how it changes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Returned {
    pub(super) stress: Vector3<f64>,
    /// F [MPa].
    pub(super) effective: f64,
    /// a = dF/dsigma.
    pub(super) gradient: Vector3<f64>,
    /// Q = (C + dlam d2F/dsigma2)^-1: dsigma = Q (deps - a ddlam).
    pub(super) stiffness: Matrix3<f64>,
}

/// Phi and its derivatives at a stress.
struct Iterate {
    stress: Vector3<f64>,
    effective: f64,
    gradient: Vector3<f64>,
    value: f64,
    slope: Vector3<f64>,
    curvature: Matrix3<f64>,
}

impl<'a> Resolvent<'a> {
    pub(super) fn new(surface: &'a Ottosen, elastic: &Elasticity, trial: Vector3<f64>) -> Self {
        let apex = surface.deviatoric_gauge(&trial) / (2.0 * elastic.shear);
        Self {
            surface,
            trial,
            compliance: elastic.principal_compliance(),
            bulk: elastic.bulk,
            apex,
        }
    }

    /// Upper bound of F of the returned stress, from Phi(sigma) <= Phi(0).
    pub(super) fn effective_bound(&self, dlam: f64) -> f64 {
        0.5 * self.trial.dot(&(self.compliance * self.trial)) / dlam
    }

    /// The returned stress; `start` approximates it.
    pub(super) fn at(&self, dlam: f64, start: &Vector3<f64>) -> Result<Returned, NotConverged> {
        let mean = self.trial.mean() - 3.0 * self.bulk * self.surface.beta() * dlam;
        if dlam >= self.apex && mean > 0.0 {
            Ok(self.apex(mean))
        } else {
            self.smooth(dlam, start)
        }
    }

    /// A return to the tensile hydrostatic axis, where only the mean stress changes.
    fn apex(&self, mean: f64) -> Returned {
        let stress = Vector3::repeat(mean);
        let (effective, gradient) = self.surface.principal_gradient(&stress);
        Returned {
            stress,
            effective,
            gradient,
            stiffness: Matrix3::repeat(self.bulk),
        }
    }

    /// A return off that axis, by damped Newton iterations.
    fn smooth(&self, dlam: f64, start: &Vector3<f64>) -> Result<Returned, NotConverged> {
        let scale = (self.compliance * self.trial).norm();
        let mut now = self.evaluate(dlam, start);
        for iteration in 0..MAX_ITERATIONS {
            let residual = now.slope.norm() / scale;
            let failure = NotConverged {
                residual,
                iterations: iteration,
            };
            let stiffness = now.curvature.try_inverse().ok_or(failure)?;
            let returned = Returned {
                stress: now.stress,
                effective: now.effective,
                gradient: now.gradient,
                stiffness,
            };
            if residual <= TOLERANCE {
                return Ok(returned);
            }
            let step = -(stiffness * now.slope);
            let descent = now.slope.dot(&step);
            let accepted = (0..MAX_HALVINGS).find_map(|k| {
                let share = 0.5_f64.powi(k);
                let next = self.evaluate(dlam, &(now.stress + step * share));
                let descends = next.value <= now.value + SUFFICIENT * share * descent;
                (descends || next.slope.norm() < 0.5 * now.slope.norm()).then_some(next)
            });
            match accepted {
                Some(next) => now = next,
                None if residual <= ROUNDING => return Ok(returned),
                None => return Err(failure),
            }
        }
        Err(NotConverged {
            residual: now.slope.norm() / scale,
            iterations: MAX_ITERATIONS,
        })
    }

    fn evaluate(&self, dlam: f64, stress: &Vector3<f64>) -> Iterate {
        let (effective, gradient, hessian) = self.surface.principal_derivatives(stress);
        let elastic = self.compliance * (stress - self.trial);
        Iterate {
            stress: *stress,
            effective,
            gradient,
            value: 0.5 * elastic.dot(&(stress - self.trial)) + dlam * effective,
            slope: elastic + gradient * dlam,
            curvature: self.compliance + hessian * dlam,
        }
    }
}
