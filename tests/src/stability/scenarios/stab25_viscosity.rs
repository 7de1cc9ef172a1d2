//! STAB-25: viscosity as a cure: what it swallows is told, and halving it changes nothing.

use fe_solver::newton::NewtonSettings;
use fe_solver::viscous::Viscous;

use super::stab05_crack_event::{draw, figures, weak_cell};
use crate::driven::{Leg, drive};
use crate::softening_bar::moved;
use crate::stability::{COARSE, Case, Failure, Figure, Method, Scenario};

fn run(method: Method, coarse: f64) -> Option<Result<Case, Failure>> {
    let step = 0.002 * coarse;
    let driven = draw(method, step, &weak_cell())?;
    Some(driven.and_then(|driven| {
        let mut figures = figures(&driven);
        // A method that is not viscous tells of none; one that is has to tell.
        if method == Method::Viscous {
            let share = driven.viscous.filter(|share| *share > 0.0);
            let share = share.unwrap_or(f64::NAN);
            figures.push(Figure::at_most("viscous share of the work", share, 0.02));
            let mut half = Viscous::new(0.025 * step, NewtonSettings::default())?;
            let (model, conditions) = moved(500.0, &weak_cell());
            let leg = Leg { to: 0.1, step };
            let halved = drive(&model, &conditions, &[leg], 1e-4, &mut half)?;
            figures.push(Figure::near(
                "peak with half of the viscosity, N",
                halved.peak(),
                driven.peak(),
                1e-2,
            ));
        }
        Ok(Case::driven(driven, figures))
    }))
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-25",
    title: "viscosity as a cure: the bar with a weak cell, steps of 0.002 mm",
    remark: "",
    coarse: COARSE,
    run,
};
