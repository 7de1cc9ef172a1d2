//! STAB-24: bars too long for displacement control.

use crate::follow::{Path, gone};
use crate::softening_bar::{AREA, ENERGY, STRENGTH, bar};
use crate::stability::{COARSE, Figure, Scenario, Scene, Steps};

/// The dissipation of a bar is GF A less its share still to come.
fn figures(path: &Path) -> Vec<Figure> {
    let left = path.points.last().map_or(1.0, |p| p[0]) / path.peak();
    // A path that stops at its peak says nothing of it.
    let dissipated = if left < 0.99 {
        path.dissipated() / (1.0 - left)
    } else {
        f64::NAN
    };
    vec![
        Figure::near("peak, N", path.peak(), STRENGTH * AREA, 5e-3),
        Figure::near("dissipation, N mm", dissipated, ENERGY * AREA, 1e-2),
    ]
}

/// A bar of 1000 mm.
pub const LONG: Scene = Scene {
    model: || bar(1000.0, 20),
    steps: Steps {
        displacement: 0.004,
        load: 0.1,
        arc: 0.02,
        energy: 0.2,
        start: 0.072,
    },
    criterion: 1e-6,
    arrived: gone,
    figures,
};

/// A bar of 2000 mm.
pub const LONGER: Scene = Scene {
    model: || bar(2000.0, 20),
    ..LONG
};

/// A bar a little too long for displacement control.
pub const BAR_1000: Scenario = Scenario {
    id: "STAB-24",
    title: "bar of 1000 mm cracks: nearly vertical snap-back",
    remark: "",
    coarse: COARSE,
    run: |method, coarse| LONG.run(method, coarse),
};

/// A bar twice as long.
pub const BAR_2000: Scenario = Scenario {
    title: "bar of 2000 mm cracks: snap-back to half the displacement",
    run: |method, coarse| LONGER.run(method, coarse),
    ..BAR_1000
};
