//! Pictures of a run: the load-deflection curve, the cracks at the peak.

use fe_solver::capacity::{Capacity, Verdict};

use super::RunError;
use super::judgement::Judgement;
use super::walk::Walk;
use crate::analysis::{Outcome, Snapshot as State};
use crate::build::{BarKind, BarRecord, Beam, Line, SheetRecord};
use crate::results::crack::CrackView;
use crate::results::curve::Curve;
use crate::results::drawing::Picture;
use crate::results::error::ResultsError;
use crate::results::evidence::Snapshot;
use crate::results::folder::Folder;
use crate::results::sheets::{MapRow, MapState, SheetLayout, SheetView, Shown, write_map};
use crate::results::summary::Setup;
use crate::spec::Specimen;

/// Points closer than this (mm) to a plane lie in it.
const ON: f64 = 1e-6;

/// All pictures of a beam.
pub(super) fn draw(
    (folder, specimen, beam): (&Folder, &Specimen, &Beam),
    walk: &Walk<'_>,
    (setup, judgement): (&Setup, &Judgement<'_>),
) -> Result<(), RunError> {
    let (capacity, verdict) = (&judgement.capacity, &judgement.verdict);
    curve(folder, specimen, setup, &walk.outcome, (capacity, verdict))?;
    let figures = &judgement.figures;
    let (load_kn, at_mm) = (figures.peak_load_kn, figures.deflection_at_peak_mm);
    let title = format!("cracks at the peak, {load_kn:.1} kN at {at_mm:.2} mm");
    let (at_peak, peak) = &judgement.peak;
    crack(folder, specimen, beam, peak, &title)?;
    if let Some(record) = &beam.sheets {
        let layout = walk.recording.watch().sheet_layout();
        let states = [(MapState::Peak, *at_peak), (MapState::End, judgement.end)];
        sheets(
            folder,
            specimen,
            (beam, record),
            layout,
            states,
            (load_kn, at_mm),
        )?;
    }
    Ok(())
}

/// `curve.svg` and `curve.png`.
fn curve(
    folder: &Folder,
    specimen: &Specimen,
    setup: &Setup,
    outcome: &Outcome,
    (capacity, verdict): (&Capacity, &Verdict),
) -> Result<(), ResultsError> {
    let title = format!(
        "{}; {}, {} integration, {}",
        specimen.title, setup.law, setup.integration, setup.mesh
    );
    // From the unloaded beam on, also where the sheets were bonded later.
    let path = [outcome.before.as_slice(), &outcome.path].concat();
    let curve = Curve {
        specimen: &specimen.name,
        title: &title,
        path: &path,
        capacity: &capacity.behind(outcome.before.len()),
        bonded: outcome.before.len().checked_sub(1),
        verdict,
        test_load_kn: specimen.test.as_ref().map(|t| t.load_kn.get()),
    };
    curve.save_svg(folder, "curve")?;
    curve.save_png(folder, "curve")
}

/// `crack.svg`: the integration points next to the side face, at the peak.
fn crack(
    folder: &Folder,
    specimen: &Specimen,
    beam: &Beam,
    peak: &Snapshot,
    title: &str,
) -> Result<(), ResultsError> {
    let elements = outlines(beam);
    let outermost = peak
        .concrete
        .iter()
        .map(|p| p.position[2])
        .fold(0.0, f64::max);
    let points: Vec<_> = peak
        .concrete
        .iter()
        .filter(|p| p.position[2] > outermost - ON)
        .copied()
        .collect();
    let lines = |of: &dyn Fn(&BarKind) -> bool| -> Vec<Vec<[f64; 2]>> {
        let bars = beam.bars.iter().filter(|bar| of(&bar.kind));
        bars.map(side_view).collect()
    };
    let view = CrackView {
        specimen: &specimen.name,
        title,
        elements: &elements,
        bars: &lines(&|kind| *kind == BarKind::Longitudinal),
        stirrups: &lines(&|kind| matches!(kind, BarKind::StirrupLeg(_))),
        supports: &beam
            .measures
            .supports
            .iter()
            .map(|l| [l.x, l.y])
            .collect::<Vec<_>>(),
        loads: &beam
            .measures
            .loads
            .iter()
            .map(|l| [l.x, l.y])
            .collect::<Vec<_>>(),
        points: &points,
    };
    view.save_svg(folder, "crack")
}

/// `sheet_map.csv`, and from it `slip.svg` and `sheet.svg` at the peak (kN, mm).
fn sheets(
    folder: &Folder,
    specimen: &Specimen,
    (beam, record): (&Beam, &SheetRecord),
    layout: &SheetLayout,
    states: [(MapState, &State); 2],
    (load_kn, deflection_mm): (f64, f64),
) -> Result<(), RunError> {
    let mut rows = Vec::new();
    for (name, at) in states {
        let seen = super::sheets::state(record, (&beam.model, &at.displacement, &at.state))?;
        rows.extend(MapRow::of(name, layout, &seen));
    }
    write_map(folder, &rows)?;
    let places = |lines: &[Line]| lines.iter().map(|l| [l.x, l.y]).collect::<Vec<_>>();
    for shown in [Shown::Slip, Shown::FibreStress] {
        if !shown.is_in(&rows) {
            continue;
        }
        let title = shown.title(load_kn, deflection_mm);
        let view = SheetView {
            specimen: &specimen.name,
            title: &title,
            shown,
            state: MapState::Peak,
            rows: &rows,
            zones: &layout.zones,
            elements: &outlines(beam),
            supports: &places(&beam.measures.supports),
            loads: &places(&beam.measures.loads),
        };
        view.save_svg(folder, shown.file())?;
    }
    Ok(())
}

/// Outlines of the elements next to the symmetry plane: lower left and upper right corner.
fn outlines(beam: &Beam) -> Vec<[[f64; 2]; 2]> {
    let nodes = beam.model.mesh().nodes();
    let blocks = beam.model.mesh().blocks().iter();
    blocks
        .flat_map(fe_core::mesh::Block::cells)
        .map(|cell| (nodes[cell[0]], nodes[cell[6]]))
        .filter(|(low, _)| low[2] < ON)
        .map(|(low, high)| [[low[0], low[1]], [high[0], high[1]]])
        .collect()
}

fn side_view(bar: &BarRecord) -> Vec<[f64; 2]> {
    bar.ends.iter().map(|p| [p[0], p[1]]).collect()
}
