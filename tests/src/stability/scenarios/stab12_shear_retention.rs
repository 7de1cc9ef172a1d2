//! STAB-12: a crack that opens and slides: the shear it transfers falls with the opening, and the energy is finite.

use fe_materials::fixed_crack::ShearTransfer;
use nalgebra::Vector6;

use super::stab11_stress_locking::{BAND, Point, concrete};
use crate::stability::{Case, Failure, Figure, Method, Scenario};

/// Strain across the crack from which it slides: open so far that its axes are fixed.
const OPEN: f64 = 1.2e-3;

/// Shear stress (MPa) and energy per area (N/mm) at an opening of 5 mm, sliding as far as it opens.
fn slide(transfer: ShearTransfer) -> Result<[f64; 2], Failure> {
    let mut point = Point::new(concrete(transfer)?);
    let (mut energy, mut last) = (0.0, 0.0);
    for strain in [1.2e-4, OPEN] {
        point.stress(&Vector6::new(strain, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    }
    let steps = 50_000;
    let step = (5.0 / BAND - OPEN) / f64::from(steps);
    for i in 1..=steps {
        let slid = step * f64::from(i);
        let stress = point.stress(&Vector6::new(OPEN + slid, 0.0, 0.0, slid, 0.0, 0.0))?;
        energy += 0.5 * (stress[3] + last) * step * BAND;
        last = stress[3];
    }
    Ok([last, energy])
}

fn figures() -> Result<Vec<Figure>, Failure> {
    let mut figures = Vec::new();
    for (name, transfer) in [
        ("damage", ShearTransfer::Damage),
        ("interlock", ShearTransfer::Interlock { aggregate_mm: 19.0 }),
    ] {
        let [shear, energy] = slide(transfer)?;
        figures.push(Figure::at_most(
            format!("shear at 5 mm, {name}, MPa"),
            shear,
            0.05,
        ));
        figures.push(Figure::at_most(
            format!("energy up to 5 mm, {name}, N/mm"),
            energy,
            2.0,
        ));
    }
    Ok(figures)
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-12",
    title: "shear retention: falls to nothing as a crack opens, finite energy",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
