//! STAB-21: end-notched flexure with a notch of 0.4 of the half span: the displacement turns back, and on again.
//!
//! Targets of beam theory: back at 1.8985 mm, on again at 1.499 mm. The first is not met: before the crack grows its cohesive zone
//! gives way, and the displacement turns at 1.738 mm with a shear strength of 40 MPa. It nears beam theory as the strength
//! grows (`str04_delamination`).

use crate::delamination::{SHEAR_STRENGTH, falling, least, off, turned, under_force, upper_turn};
use crate::follow::Path;
use crate::stability::{COARSE, Figure, Scenario, Scene, Steps};

/// The larger of two, or what is not a number.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

fn figures(path: &Path) -> Vec<Figure> {
    let falling = falling(path);
    // None of a path that does not come so far, which is no distance of nothing.
    let on = falling.iter().filter(|p| p[0] < 300.0);
    let worst = on
        .map(|[load, w]| off(*load, *w))
        .reduce(larger)
        .unwrap_or(f64::NAN);
    let upper = Figure::near("upper turning point, mm", upper_turn(path), 1.738, 0.02);
    vec![
        upper.measured("1.8985"),
        Figure::near("lower turning point, mm", least(falling), 1.499, 6e-3),
        Figure::at_most("largest distance from beam theory", worst, 0.012),
    ]
}

const SCENE: Scene = Scene {
    model: || under_force(20.0, SHEAR_STRENGTH),
    steps: Steps {
        displacement: 0.1,
        load: 25.0,
        arc: 1.0,
        energy: 4.0,
        start: 1.6,
    },
    criterion: 1e-4,
    arrived: turned,
    figures,
};

/// The scenario.
pub const SHORT: Scenario = Scenario {
    id: "STAB-21",
    title: "end-notched flexure, notch of 0.4 of the half span: snap-back and return",
    remark: "The displacement turns back at 1.738 mm, where displacement control ends; beam theory has 1.8985 mm. The cohesive zone \
             before the crack, of a shear strength of 40 MPa, gives way earlier: with 20 and 60 MPa it turns at 1.622 and \
             1.787 mm.",
    coarse: COARSE,
    run: |method, coarse| SCENE.run(method, coarse),
};
