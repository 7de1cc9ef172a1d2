//! Scenes under forces whose path is known.

use fe_core::model::{Conditions, Model};

use super::{Case, Failure, Figure, Method};
use crate::follow::Path;

/// Lengths of the steps by what they are measured in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steps {
    /// Displacement under the forces (mm).
    pub displacement: f64,
    /// Load factor.
    pub load: f64,
    /// Norm of all displacements (mm).
    pub arc: f64,
    /// Dissipated energy (N mm).
    pub energy: f64,
    /// Displacement (mm) from which on dissipation can be controlled.
    pub start: f64,
}

/// One scene.
#[derive(Debug, Clone, Copy)]
pub struct Scene {
    /// Model and conditions.
    pub model: fn() -> (Model, Conditions),
    /// Lengths of the steps.
    pub steps: Steps,
    /// Relative residual of a step.
    pub criterion: f64,
    /// Whether the path is at its end.
    pub arrived: fn(&Path) -> bool,
    /// What is held against the closed form.
    pub figures: fn(&Path) -> Vec<Figure>,
}

impl Scene {
    /// Follows the path by a method in steps `coarse` times as long as those of the scene; none where the method does not
    /// apply.
    pub fn run(&self, method: Method, coarse: f64) -> Option<Result<Case, Failure>> {
        let path = method.follow(self, coarse)?;
        Some(path.map_err(Failure::from).map(|path| Case {
            figures: (self.figures)(&path),
            stopped: path.stopped,
            marked: path.marked,
            counters: path.counters,
        }))
    }
}
