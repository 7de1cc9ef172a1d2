//! Scenes with a known path.

use fe_core::model::{Conditions, Model};

use super::Figure;
use crate::follow::{Path, pulled_strip};
use crate::softening_bar::{AREA, ENERGY, STRENGTH, bar};

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
pub struct Scenario {
    /// Name in the catalogue.
    pub id: &'static str,
    /// What happens.
    pub title: &'static str,
    /// Model and conditions.
    pub scene: fn() -> (Model, Conditions),
    /// Lengths of the steps.
    pub steps: Steps,
    /// Relative residual of a step.
    pub criterion: f64,
    /// What is held against the closed form.
    pub figures: fn(&Path) -> Vec<Figure>,
}

fn strip(path: &Path) -> Vec<Figure> {
    vec![
        Figure::near("peak, N", path.peak(), 9269.9, 1e-3),
        Figure::near("turning point, mm", path.turn(), 1.76917, 2e-3),
        Figure::near("dissipation, N mm", path.dissipated(), 9137.0, 1e-2),
    ]
}

/// The dissipation of a bar is GF A less its share still to come.
fn snapping(path: &Path) -> Vec<Figure> {
    let left = path.points.last().map_or(1.0, |p| p[0]) / path.peak();
    let dissipated = path.dissipated() / (1.0 - left);
    vec![
        Figure::near("peak, N", path.peak(), STRENGTH * AREA, 5e-3),
        Figure::near("dissipation, N mm", dissipated, ENERGY * AREA, 1e-2),
    ]
}

/// The strip.
pub const STRIP: Scenario = Scenario {
    id: "STAB-01 to -04",
    title: "strip of 400 mm pulled off: limit point, plateau, snap-back",
    scene: pulled_strip,
    steps: Steps {
        displacement: 0.02,
        load: 200.0,
        arc: 0.1,
        energy: 50.0,
        start: 0.2,
    },
    criterion: 1e-5,
    figures: strip,
};

/// A bar a little too long for displacement control.
pub const BAR_1000: Scenario = Scenario {
    id: "STAB-24",
    title: "bar of 1000 mm cracks: nearly vertical snap-back",
    scene: || bar(1000.0, 20),
    steps: Steps {
        displacement: 0.004,
        load: 0.1,
        arc: 0.02,
        energy: 0.2,
        start: 0.072,
    },
    criterion: 1e-6,
    figures: snapping,
};

/// A bar twice as long.
pub const BAR_2000: Scenario = Scenario {
    title: "bar of 2000 mm cracks: snap-back to half the displacement",
    scene: || bar(2000.0, 20),
    ..BAR_1000
};

/// The scenes.
pub const SCENARIOS: [Scenario; 3] = [STRIP, BAR_1000, BAR_2000];
