//! Energy of a run, part by part.

use std::collections::BTreeMap;

use serde::Serialize;

/// Energy of one part of the model, whole width (J).
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct PartEnergy {
    /// Work of its stresses.
    pub work_j: f64,
    /// Of it recoverable.
    pub stored_j: f64,
    /// Of it dissipated.
    pub dissipated_j: f64,
}

/// Energy of a run at its last step, whole width (J).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Energy {
    /// Work of loads, supports and self weight.
    pub external_work_j: f64,
    /// Parts of the model by name.
    pub parts: BTreeMap<String, PartEnergy>,
    /// External work less the work of all parts, relative to the external work; null without work.
    pub closure: Option<f64>,
}

impl Energy {
    /// Balance of the external work (J) with the parts.
    pub fn new(external_work_j: f64, parts: BTreeMap<String, PartEnergy>) -> Self {
        let inner: f64 = parts.values().map(|p| p.work_j).sum();
        let closure = (external_work_j - inner) / external_work_j;
        Self {
            external_work_j,
            parts,
            closure: Some(closure).filter(|c| c.is_finite()),
        }
    }
}
