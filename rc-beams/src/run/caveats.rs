//! What a reader of the answer should know: where the model is not what was asked for, or more than the beam is.

use crate::results::evidence::Snapshot;
use crate::spec::Specimen;

/// Share of all loads below which a pull is no matter.
const PULLS: f64 = 0.02;

/// Slack (mm) of the place of a node.
const SAME_PLACE_MM: f64 = 0.1;

/// What is said where no node of the mesh lies where the deflection is asked for.
pub(super) fn read_elsewhere(specimen: &Specimen, node: [f64; 3]) -> Option<String> {
    let asked = &specimen.measuring.deflection;
    let asked = [asked.x_mm.get(), asked.y_mm.get(), asked.z_mm.get()];
    let off = (0..3)
        .map(|k| (node[k] - asked[k]).powi(2))
        .sum::<f64>()
        .sqrt();
    (off > SAME_PLACE_MM).then(|| {
        let [x, y, z] = node;
        format!("the deflection is that of the nearest node, at x = {x:.1}, y = {y:.1}, z = {z:.1} mm, {off:.1} mm from the place asked for")
    })
}

/// What is said where loads pull or supports hold down, by that share of all loads: plates can only press.
pub(super) fn pulls(share: f64) -> Option<String> {
    (share > PULLS).then(|| {
        format!(
            "a load pulls the beam up or a support holds it down, by {:.0} % of all loads: loads go down together and supports \
             act both ways in this model",
            100.0 * share
        )
    })
}

/// What is said of bars that carry more than their rupture stress.
pub(super) fn broken(specimen: &Specimen, at: &Snapshot) -> Vec<String> {
    let bars = at.bars.iter().filter_map(|reach| {
        let bar = specimen.bars.iter().find(|bar| bar.name == reach.bar)?;
        Some((format!("{} bars", reach.bar), &bar.steel, reach.utilisation))
    });
    let legs = at.stirrups.iter().map(|reach| reach.utilisation);
    let leg = specimen.stirrups.iter().map(|stirrups| {
        let most = legs.clone().fold(0.0, f64::max);
        ("stirrups".to_owned(), &stirrups.steel, most)
    });
    let said = bars.chain(leg).filter_map(|(name, steel, utilisation)| {
        let ratio = utilisation * steel.fy_mpa.get() / steel.fu_mpa.get();
        (ratio > 1.0).then(|| {
            format!("{name} carry up to {ratio:.2} times their rupture stress: none breaks in this model")
        })
    });
    said.collect()
}
