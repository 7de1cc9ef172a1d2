//! Internal variables and tolerances of the plastic laws.

use fe_core::material::{PointReport, StateVar};
use nalgebra::Vector6;

use super::CompressionCurve;

/// Overshoot of the yield condition that still counts as elastic, relative to the yield stress: above
/// [`RETURN_TOLERANCE`], so that a returned stress is elastic at the same strain.
pub(crate) const YIELD_TOLERANCE: f64 = 1e-12;

/// Tolerance of a stress return, relative to the stress it solves for.
pub(crate) const RETURN_TOLERANCE: f64 = 1e-13;

/// Internal variables of a plastic law, in the order of its state slice.
pub(crate) const PLASTIC_VARS: [StateVar; 2] = [
    StateVar::vector("plastic_strain", "-", 6),
    StateVar::scalar("kappa", "-"),
];

/// Plastic strain and hardening variable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlasticState {
    /// Plastic strain, Voigt with engineering shear [-].
    pub(crate) strain: Vector6<f64>,
    /// Equivalent plastic strain kappa [-].
    pub(crate) kappa: f64,
}

impl PlasticState {
    pub(crate) fn read(state: &[f64]) -> Self {
        Self {
            strain: Vector6::from_column_slice(&state[..6]),
            kappa: state[6],
        }
    }

    pub(crate) fn write(&self, state: &mut [f64]) {
        state[..6].copy_from_slice(self.strain.as_slice());
        state[6] = self.kappa;
    }

    /// What a plastic point shows.
    pub(crate) fn report(&self, curve: &CompressionCurve) -> PointReport {
        PointReport {
            plastic_strain: self.strain.into(),
            crushing: curve.crushing(curve.eta(self.kappa)),
            ..PointReport::default()
        }
    }
}
