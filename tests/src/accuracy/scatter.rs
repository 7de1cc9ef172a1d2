//! Scatter of the peak over meshes of nearly one size: what it leaves to chance on which columns cracks fall.

use super::cases::{COARSE, Case, FINE, KINDS};
use super::tables::{Outcomes, fixed, header, percent, row};
use crate::sample::mean_and_variation;

/// Mean peak (kN) and coefficient of variation of a beam over meshes.
fn over(outcomes: &Outcomes, meshes: &[Case], beam: &'static str) -> Option<[f64; 2]> {
    let peak = |case: &Case| outcomes.get(&(case.name, beam))?.peak();
    let peaks: Option<Vec<f64>> = meshes.iter().map(peak).collect();
    Some(mean_and_variation(&peaks?))
}

/// Means and coefficients of variation of both families of meshes, and the change of the mean from one to the other.
pub fn table(outcomes: &Outcomes) -> String {
    let mut text = header(&[
        "beam",
        "52 to 68 columns, kN",
        "variation, %",
        "80 to 96 columns, kN",
        "variation, %",
        "change of the mean, %",
    ]);
    for beam in KINDS {
        let [coarse, fine] = [COARSE, FINE].map(|meshes| over(outcomes, &meshes, beam));
        let change = coarse.zip(fine).map(|(a, b)| b[0] / a[0] - 1.0);
        let cells = [coarse, fine].map(|family| {
            [
                fixed(family.map(|f| f[0]), 1),
                fixed(family.map(|f| 100.0 * f[1]), 1),
            ]
        });
        let first = [(*beam).to_owned()].into_iter();
        text += &row(first.chain(cells.concat()).chain([percent(change)]));
    }
    text
}
