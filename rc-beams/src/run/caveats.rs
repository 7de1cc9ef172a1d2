//! What a reader of the answer should know: where the model is not what was asked for, or more than the beam is.

use crate::results::evidence::Snapshot;
use crate::results::summary::Energy;
use crate::spec::Specimen;

/// Share of all loads below which a pull is no matter.
const PULLS: f64 = 0.02;

/// Share of the external work up to which the energies may miss it.
const CLOSURE: f64 = 0.01;

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
        format!(
            "the deflection is that of the nearest node, at x = {x:.1}, y = {y:.1}, z = {z:.1} mm, {off:.1} mm from the \
             place asked for"
        )
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

/// What is said where the energies of the path do not add up to the work of the loads.
pub(super) fn unbalanced(energy: &Energy) -> Option<String> {
    let missed = energy.closure.map(f64::abs).filter(|c| *c > CLOSURE)?;
    Some(format!(
        "the energies of the whole path miss the external work by {:.0} %, in steps without equilibrium (history.csv)",
        100.0 * missed
    ))
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

#[cfg(test)]
mod tests {
    //! Protects the warnings from silence and from noise.
    use super::*;
    use crate::results::evidence::BarReach;
    use crate::results::summary::PartEnergy;
    use crate::spec::{BUILTIN, read};

    fn specimen() -> Specimen {
        let (name, text) = BUILTIN[0];
        read(name, text).unwrap()
    }

    #[test]
    fn only_pulls_that_matter_are_told() {
        assert_eq!(pulls(0.01), None);
        assert!(pulls(0.2).unwrap().contains("by 20 % of all loads"));
    }

    #[test]
    fn energies_that_do_not_add_up_are_told() {
        let energy = |external| {
            let part = PartEnergy {
                work_j: 100.0,
                ..PartEnergy::default()
            };
            Energy::new(external, [("bars".to_owned(), part)].into())
        };
        assert_eq!(unbalanced(&energy(100.5)), None);
        assert_eq!(unbalanced(&energy(0.0)), None);
        let text = unbalanced(&energy(40.0)).unwrap();
        assert!(text.contains("external work by 150 %"), "{text}");
    }

    #[test]
    fn a_node_elsewhere_is_told_with_its_place() {
        let specimen = specimen();
        let at = &specimen.measuring.deflection;
        let [x, y, z] = [at.x_mm.get(), at.y_mm.get(), at.z_mm.get()];
        assert_eq!(read_elsewhere(&specimen, [x, y, z]), None);
        let text = read_elsewhere(&specimen, [x + 3.0, y + 4.0, z]).unwrap();
        assert!(text.contains("5.0 mm from the place asked for"), "{text}");
    }

    #[test]
    fn bars_and_stirrups_beyond_their_strength_are_told() {
        let specimen = specimen();
        let (bar, stirrups) = (&specimen.bars[0], specimen.stirrups.as_ref().unwrap());
        let reach = |bar: &str, utilisation| BarReach {
            bar: bar.into(),
            x_mm: 0.0,
            utilisation,
        };
        let rupture = |steel: &crate::spec::Steel| steel.fu_mpa.get() / steel.fy_mpa.get();
        let at = Snapshot {
            bars: vec![reach(&bar.name, 1.1 * rupture(&bar.steel))],
            stirrups: vec![
                reach("leg", 1.2 * rupture(&stirrups.steel)),
                reach("leg", 0.5),
            ],
            ..Snapshot::default()
        };
        let told = broken(&specimen, &at);
        assert_eq!(told.len(), 2);
        assert!(told[0].contains("1.10 times") && told[1].starts_with("stirrups carry up to 1.20"));
        let whole = Snapshot {
            bars: vec![reach(&bar.name, 1.0)],
            ..Snapshot::default()
        };
        assert!(broken(&specimen, &whole).is_empty());
    }
}
