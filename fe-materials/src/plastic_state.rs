//! Internal variables of the plastic laws of the continuum.

use fe_core::material::StateVar;
use nalgebra::Vector6;

/// Internal variables of a plastic law, in the order of its state slice.
pub(crate) const PLASTIC_VARS: [StateVar; 2] = [
    StateVar::vector("plastic_strain", "-", 6),
    StateVar::scalar("kappa", "-"),
];

/// Plastic strain and hardening variable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlasticState {
    /// Plastic strain, Voigt with engineering shear (-).
    pub(crate) strain: Vector6<f64>,
    /// Equivalent plastic strain kappa (-).
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
}
