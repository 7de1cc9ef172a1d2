//! What the plastic laws of concrete show of their state.

use fe_core::material::PointReport;

use super::CompressionCurve;
pub(crate) use crate::plastic_state::{PLASTIC_VARS, PlasticState};

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
