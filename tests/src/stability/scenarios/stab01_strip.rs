//! STAB-01 to -04: limit point, plateau and snap-back of a strip pulled off.

use crate::follow::{Path, gone, pulled_strip};
use crate::stability::{COARSE, Figure, Scenario, Scene, Steps};

fn figures(path: &Path) -> Vec<Figure> {
    vec![
        Figure::near("peak, N", path.peak(), 9269.9, 1e-3),
        Figure::near("turning point, mm", path.turn(), 1.76917, 2e-3),
        Figure::near("dissipation, N mm", path.dissipated(), 9137.0, 1e-2),
    ]
}

/// The strip.
pub const STRIP: Scene = Scene {
    model: pulled_strip,
    steps: Steps {
        displacement: 0.02,
        load: 200.0,
        arc: 0.1,
        energy: 50.0,
        start: 0.2,
    },
    criterion: 1e-5,
    arrived: gone,
    figures,
};

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-01 to -04",
    title: "strip of 400 mm pulled off: limit point, plateau, snap-back",
    remark: "",
    coarse: COARSE,
    run: |method, coarse| STRIP.run(method, coarse),
};
