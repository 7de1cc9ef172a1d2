//! STAB-16: elements longer than the process zone of a bond: the peak is far too high, and the closed form warns.

use std::sync::Arc;

use fe_contact::{BondSettings, InterfaceRule, PullOut, SlipDamage};
use fe_core::dof::Dof;
use fe_solver::automatic::Automatic;
use fe_solver::newton::NewtonSettings;

use crate::driven::{Leg, drive};
use crate::mesh::lines;
use crate::stability::{Case, Failure, Figure, Method, Scenario};
use crate::strip::{Strip, THICKNESS, WIDTH, YOUNG, bond};

/// Peak (N) of the strip of 400 mm in elements of a length (mm).
fn peak(size: f64) -> Result<f64, Failure> {
    let law = Arc::new(SlipDamage::new(bond()?, BondSettings::default())?);
    let x = lines(0.0, 400.0, (400.0 / size).round() as usize);
    let strip = Strip::new(&x, InterfaceRule::Gauss3, &(law as _))?;
    let mut conditions = strip.held()?;
    for (node, _) in strip.line(400.0) {
        conditions.prescribe(&strip.model, node, Dof::Ux, 1.0)?;
    }
    let mut driver = Automatic::new(NewtonSettings::default());
    let leg = Leg {
        to: 1.2,
        step: 0.02,
    };
    Ok(drive(&strip.model, &conditions, &[leg], 1e-4, &mut driver)?.peak())
}

fn figures() -> Result<Vec<Figure>, Failure> {
    let closed = PullOut::new(bond()?, YOUNG * THICKNESS)?;
    let longest = closed.longest_element();
    let exact = WIDTH * closed.ultimate();
    Ok(vec![
        Figure::near(
            "longest element without a warning, mm",
            longest,
            27.04,
            1e-3,
        ),
        Figure::near(
            "peak in elements of 20 mm over the exact one",
            peak(20.0)? / exact,
            1.0,
            0.01,
        ),
        Figure::at_least(
            "peak in elements of 80 mm over the exact one",
            peak(80.0)? / exact,
            1.03,
        )
        .measured("1.53, of linear bars with springs at their nodes"),
    ])
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-16",
    title: "elements longer than the process zone: warned of by the closed form",
    remark: "",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
