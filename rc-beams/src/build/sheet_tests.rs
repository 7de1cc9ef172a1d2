//! Protects the sheets of the models: where they lie, what they share with the concrete, and that no bond
//! leaves a piece of the model loose.

use std::collections::BTreeSet;

use fe_contact::envelope::Envelope as _;
use fe_core::mesh::NodeId;
use fe_core::state::StateStore;
use fe_solver::control::StepControl;
use fe_solver::recorder::Silent;
use fe_solver::secant::SecantAnderson;
use fe_solver::stage::Stage;

use super::sheets::bond;
use super::{Beam, ModelSettings, SheetRecord};
use crate::options::{Bond, Preset};
use crate::spec::{BUILTIN, Face, Specimen, read};

fn specimen(name: &str) -> Specimen {
    let (_, text) = BUILTIN.iter().find(|(n, _)| *n == name).unwrap();
    read(name, text).unwrap()
}

/// The specimen on a coarse mesh, changed.
fn beam(specimen: &Specimen, bond: Bond) -> Beam {
    let settings = ModelSettings {
        bond,
        ..ModelSettings::new(Preset::Physical, specimen)
    };
    Beam::new(specimen, &settings).unwrap()
}

fn volume(beam: &Beam, element: usize) -> f64 {
    let element = &beam.model.elements()[element];
    let mut state = vec![0.0; element.state_len()];
    element.init_state(&mut state);
    let mut sum = 0.0;
    let zero = vec![0.0; 3 * element.nodes().len()];
    let sampled = element.sample(&zero, &state, &mut |s| sum += s.volume);
    sampled.unwrap();
    sum
}

fn sheets(beam: &Beam) -> &SheetRecord {
    beam.sheets.as_ref().unwrap()
}

/// Source: the layouts of the specimens. Membranes hold the volume of their plies, 0.165 mm each (twice over
/// the overlap of a full wrap); interfaces hold the covered area. Target: rounding.
#[test]
fn sheets_cover_what_the_specimen_says() {
    for (name, _) in BUILTIN {
        let specimen = specimen(name);
        let Some(spec) = &specimen.sheets else {
            continue;
        };
        let beam = beam(&specimen, Bond::Cohesive);
        let (mut area, mut plies) = (0.0, 0.0);
        for wrap in &spec.wraps {
            let length: f64 = wrap
                .stretches
                .iter()
                .map(|s| s.x_to_mm.get() - s.x_from_mm.get())
                .sum();
            for cover in &wrap.faces {
                let covered = length * (cover.to_mm.get() - cover.from_mm.get());
                area += covered;
                plies += covered * cover.angles_deg.len() as f64;
                plies += length * 0.5 * cover.overlap_mm.map_or(0.0, f64::from);
            }
        }
        let record = sheets(&beam);
        let membranes: f64 = record.membranes.clone().map(|e| volume(&beam, e)).sum();
        let bonds: f64 = record.interfaces.clone().map(|e| volume(&beam, e)).sum();
        assert!(
            (membranes - 0.165 * plies).abs() < 1e-6 * membranes,
            "{name}"
        );
        assert!((bonds - area).abs() < 1e-6 * area, "{name}");
    }
}

/// Side and soffit of a U are one sheet bent round the corner, two strips are not one, and no node of a sheet
/// is one of the concrete unless the bond is perfect.
#[test]
fn sheets_share_nodes_round_the_corner_only() {
    let specimen = specimen("A-SO3-3");
    let beam = beam(&specimen, Bond::Cohesive);
    let record = sheets(&beam);
    let nodes = |keep: &dyn Fn(&super::SheetCell) -> bool| -> BTreeSet<NodeId> {
        let cells = record.cells.iter().filter(|c| keep(c));
        let elements = cells.map(|c| &beam.model.elements()[c.membrane]);
        elements.flat_map(|e| e.nodes().iter().copied()).collect()
    };
    for zone in 0..record.zones.len() {
        let side = nodes(&|c| c.zone == zone && c.face == Face::Side);
        let soffit = nodes(&|c| c.zone == zone && c.face == Face::Soffit);
        for &n in side.intersection(&soffit) {
            let [_, y, z] = beam.model.mesh().nodes()[n];
            assert!(y.abs() < 1e-9 && (z - 75.0).abs() < 1e-9);
        }
        assert!(side.intersection(&soffit).count() >= 3);
        let other = nodes(&|c| c.zone != zone);
        assert!(side.is_disjoint(&other) && soffit.is_disjoint(&other));
    }
    let all = nodes(&|_| true);
    let concrete = beam.concrete.clone().map(|e| &beam.model.elements()[e]);
    let concrete: BTreeSet<NodeId> = concrete.flat_map(|e| e.nodes().iter().copied()).collect();
    assert!(all.is_disjoint(&concrete));
    let perfect = self::beam(&specimen, Bond::Perfect);
    let elements = sheets(&perfect).membranes.clone();
    for e in elements {
        let nodes = perfect.model.elements()[e].nodes();
        assert!(nodes.iter().all(|n| concrete.contains(n)));
    }
}

/// Every kind of sheet and bond carries the weight of the beam: no singular matrix, nothing loose.
#[test]
fn no_bond_leaves_a_piece_loose() {
    for name in ["A-SO3-2", "A-SO3-5", "B-CF4"] {
        for bond in [Bond::Cohesive, Bond::Perfect, Bond::Adhesive] {
            let beam = beam(&specimen(name), bond);
            let mut state = StateStore::new(beam.model.elements());
            let zero = vec![0.0; beam.model.dofs().len()];
            let mut stage = Stage::new(&beam.model, beam.weight.clone(), &mut state, zero).unwrap();
            let mut driver = SecantAnderson::default();
            StepControl::new(1.0, 1.0)
                .run(&mut stage, &mut driver, &mut Silent)
                .unwrap_or_else(|e| panic!("{name} {bond:?}: {e}"));
            assert_eq!(stage.counters().negative_pivots, 0, "{name} {bond:?}");
        }
    }
}

/// Sheets of a user: other widths, heights, three plies, fibres at 45 degrees. Under the same displacements
/// fibres at 45 degrees are stretched by shear, which leaves fibres along and across alone.
#[test]
fn sheets_of_other_widths_angles_and_plies_are_laid() {
    let mut specimen = specimen("A-SO3-4");
    let text = BUILTIN.iter().find(|(n, _)| *n == "A-SO3-4").unwrap().1;
    let changed = text
        .replace(
            "(x_from_mm: 670, x_to_mm: 2380)",
            "(x_from_mm: 700.5, x_to_mm: 1111), (x_from_mm: 1700, x_to_mm: 2313)",
        )
        .replace(
            "(face: Side, from_mm: 0, to_mm: 305, angles_deg: [90])",
            "(face: Side, from_mm: 0, to_mm: 200, angles_deg: [45, -45, 90])",
        );
    assert_ne!(changed, text);
    specimen.sheets = read("user", &changed).unwrap().sheets;
    let beam = beam(&specimen, Bond::Cohesive);
    let record = sheets(&beam);
    assert_eq!(record.zones.len(), 2);
    assert_eq!(record.zones[0].side_mm, [0.0, 200.0]);
    let total: f64 = record.membranes.clone().map(|e| volume(&beam, e)).sum();
    let length = (1111.0 - 700.5) + (2313.0 - 1700.0);
    assert!((total - 0.165 * length * (3.0 * 200.0 + 75.0)).abs() < 1e-6 * total);
    let cell = record.cells.iter().find(|c| c.face == Face::Side).unwrap();
    let element = &beam.model.elements()[cell.membrane];
    let mut u = Vec::new();
    for &n in element.nodes() {
        let [_, y, _] = beam.model.mesh().nodes()[n];
        u.extend([1e-3 * y, 0.0, 0.0]);
    }
    element
        .sample(&u, &[], &mut |s| {
            let strain = nalgebra::Vector3::from_column_slice(s.strain);
            let fibres: Vec<f64> = cell.laminate.fibre_stresses(&strain).collect();
            assert!((fibres[0] - 228e3 * 0.5e-3).abs() < 1e-6);
            assert!((fibres[1] + 228e3 * 0.5e-3).abs() < 1e-6);
            assert!(fibres[2].abs() < 1e-6);
        })
        .unwrap();
}

/// The bond of strips counts with their width over their spacing, that of sheets and of the reference with 1.
#[test]
fn the_bond_of_strips_counts_with_their_width_over_their_spacing() {
    for (name, ratio) in [
        ("A-SO3-2", 0.4),
        ("A-SO3-3", 0.6),
        ("A-SO3-4", 1.0),
        ("B-CO2", 0.4),
        ("B-CF2", 1.0),
    ] {
        let specimen = specimen(name);
        let height = specimen.beam.height_mm.get();
        let sheets = specimen.sheets.as_ref().unwrap();
        let [wrap] = &sheets.wraps[..] else {
            panic!("{name} has one wrap");
        };
        assert!((wrap.width_ratio(height) - ratio).abs() < 1e-12, "{name}");
        let energy = |preset| {
            let settings = ModelSettings::new(preset, &specimen);
            bond(&specimen, wrap, &settings).unwrap().energy()
        };
        // The energy goes with the square of the width factor.
        let more = energy(Preset::Physical) / energy(Preset::Reference);
        let expected = (2.25 - ratio) / (1.25 + ratio) * 2.25 / 1.25;
        assert!((more - expected).abs() < 1e-9, "{name} {more} {expected}");
    }
}

/// Narrow anchors elsewhere on the beam make no strips of a continuous sheet: each wrap has the bond of its own layout.
#[test]
fn the_bond_of_a_wrap_is_that_of_its_own_layout() {
    let [mut changed, strips] = ["A-SO3-4", "A-SO3-2"].map(specimen);
    let anchors = strips.sheets.unwrap().wraps.remove(0);
    let wraps = &mut changed.sheets.as_mut().unwrap().wraps;
    wraps[0].faces.retain(|cover| cover.face == Face::Soffit);
    wraps.push(anchors);
    wraps[1].faces.retain(|cover| cover.face == Face::Side);
    let specimen = changed;
    let record = beam(&specimen, Bond::Cohesive).sheets.unwrap();
    let energy = |face| {
        let of_face = record.cells.iter().filter(move |c| c.face == face);
        of_face
            .map(|c| c.bond.envelope().energy())
            .collect::<Vec<_>>()
    };
    let (side, soffit) = (energy(Face::Side), energy(Face::Soffit));
    assert!(!side.is_empty() && !soffit.is_empty());
    let alone = beam(&self::specimen("A-SO3-4"), Bond::Cohesive)
        .sheets
        .unwrap();
    let sheet = alone.cells[0].bond.envelope().energy();
    assert!(soffit.iter().all(|g| *g == sheet), "{soffit:?} {sheet}");
    assert!(side.iter().all(|g| *g > 1.9 * sheet), "{side:?} {sheet}");
}
