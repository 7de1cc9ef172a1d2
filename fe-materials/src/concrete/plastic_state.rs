//! Tolerances of the plastic laws of concrete, and what they show of their state.

use fe_core::material::PointReport;

use super::CompressionCurve;
pub(crate) use crate::plastic_state::{PLASTIC_VARS, PlasticState};

/// Overshoot of the yield condition that still counts as elastic, relative to the yield stress: above
/// [`RETURN_TOLERANCE`], so that a returned stress is elastic at the same strain.
const YIELD_TOLERANCE: f64 = 1e-12;

/// Effective stress over the strength up to which a virgin law is elastic, to any digit: the derivatives of smaller ones leave
/// the range of numbers.
const NOTHING: f64 = 1e-50;

/// Effective stress (MPa) up to which a point at `eta` of its curve is elastic.
pub(crate) fn yield_limit(curve: &CompressionCurve, eta: f64) -> f64 {
    let limit = curve.at(eta).stress * (1.0 + YIELD_TOLERANCE);
    limit.max(NOTHING * curve.strength())
}

/// Tolerance of a stress return, relative to the stress it solves for.
pub(crate) const RETURN_TOLERANCE: f64 = 1e-13;

impl PlasticState {
    /// What a plastic point shows.
    pub(crate) fn report(&self, curve: &CompressionCurve) -> PointReport {
        PointReport {
            plastic_strain: self.strain.into(),
            crushing: curve.crushing(curve.eta(self.kappa)),
            ..PointReport::default()
        }
    }
}
