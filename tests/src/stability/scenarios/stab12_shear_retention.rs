//! STAB-12: a crack that opens and slides: the share of the elastic shear that it transfers falls as it opens.
//!
//! Target of the catalogue: a share that falls with the strain of the crack, and a finite energy. Reached: the share never
//! grows, and falls to b_min = 1e-4, a floor that keeps the matrix regular, not to nothing. Down there the shear grows with
//! the slide, as b_min G0 gamma (0.041 MPa at 5 mm, 0.083 MPa at 10 mm), and the energy as b_min G0 gamma^2/2 per volume
//! (0.10 N/mm at 5 mm). What is finite is the energy above that of the floor: it is the same at 5 and at 10 mm.

use fe_materials::fixed_crack::ShearTransfer;
use nalgebra::Vector6;

use super::stab11_stress_locking::{BAND, Point, concrete};
use crate::stability::{Case, Failure, Figure, Method, Scenario};

/// Strain across the crack from which it slides: open so far that its axes are fixed.
const OPEN: f64 = 1.2e-3;
/// Elastic shear modulus G0 (MPa).
const SHEAR_MODULUS: f64 = 10_000.0 / 2.4;
/// Steps of 5 mm.
const STEPS: u32 = 50_000;

/// A crack that has slid as far as it has opened since.
#[derive(Debug, Clone, Copy)]
struct Slid {
    /// Shear stress over that of the floor, b_min G0 gamma (-).
    over_floor: f64,
    /// Energy above that of the floor (N/mm).
    above_floor: f64,
    /// Largest growth, in one step so far, of the share of the elastic shear (-).
    growth: f64,
}

/// The crack at openings of 5 and 10 mm.
fn slide(transfer: ShearTransfer) -> Result<[Slid; 2], Failure> {
    let law = concrete(transfer)?;
    let floor = law.parameters().shear_floor * SHEAR_MODULUS;
    let mut point = Point::new(law);
    for strain in [1.2e-4, OPEN] {
        point.stress(&Vector6::new(strain, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    }
    let step = (5.0 / BAND - OPEN) / f64::from(STEPS);
    let (mut energy, mut last, mut share, mut growth) = (0.0, 0.0, 1.0, 0.0_f64);
    let mut places = Vec::new();
    for i in 1..=2 * STEPS {
        let slid = step * f64::from(i);
        let stress = point.stress(&Vector6::new(OPEN + slid, 0.0, 0.0, slid, 0.0, 0.0))?;
        energy += 0.5 * (stress[3] + last) * step * BAND;
        last = stress[3];
        let now = last / (SHEAR_MODULUS * slid);
        growth = growth.max(now - share);
        share = now;
        if i % STEPS == 0 {
            places.push(Slid {
                over_floor: last / (floor * slid),
                above_floor: energy - 0.5 * floor * slid * slid * BAND,
                growth,
            });
        }
    }
    Ok([places[0], places[1]])
}

fn figures() -> Result<Vec<Figure>, Failure> {
    let mut figures = Vec::new();
    for (name, transfer, bound) in [
        ("damage", ShearTransfer::Damage, 0.01),
        (
            "interlock",
            ShearTransfer::Interlock { aggregate_mm: 19.0 },
            1.5,
        ),
    ] {
        let [at_5, at_10] = slide(transfer)?;
        for (place, at) in [("5 mm", at_5), ("10 mm", at_10)] {
            let what = format!("shear over that of the floor at {place}, {name}");
            figures.push(Figure::near(what, at.over_floor, 1.0, 1e-6));
        }
        let what = format!("growth of the share, {name}");
        figures.push(Figure::at_most(what, at_10.growth, 1e-12));
        let what = format!("energy above that of the floor, {name}, N/mm");
        let above = Figure::at_most(what, at_5.above_floor, bound);
        figures.push(above.measured("finite"));
        let what = format!("that at 10 mm, {name}, N/mm");
        let same = at_5.above_floor;
        figures.push(Figure::near(what, at_10.above_floor, same, 1e-3));
    }
    Ok(figures)
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-12",
    title: "shear retention: falls to its floor as a crack opens, finite energy above that",
    remark: "The energy itself is not finite: see what is not solved.",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
