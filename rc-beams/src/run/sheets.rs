//! Sheets and their bond, read off a state of the model.

use fe_contact::SlipDamage;
use fe_core::model::{Model, ModelError};
use fe_core::state::StateStore;
use nalgebra::Vector3;

use crate::build::{BarKind, Beam, SheetRecord};
use crate::results::evidence::Layout;
use crate::results::sheets::{Face, InterfacePoint, SheetLayout, SheetPoint, SheetState, Zone};
use crate::spec;

/// Zones of the sheets and stirrups of the shear spans.
pub(super) fn layout(beam: &Beam, layout: &Layout) -> SheetLayout {
    let zones = beam.sheets.iter().flat_map(|s| &s.zones);
    let mut stirrups_in_spans = vec![0; layout.shear_spans.len()];
    for bar in &beam.bars {
        let BarKind::StirrupLeg(x) = bar.kind else {
            continue;
        };
        if let Some(span) = layout.span_at(x) {
            stirrups_in_spans[span] += 1;
        }
    }
    SheetLayout {
        zones: zones
            .map(|z| Zone {
                name: z.name.clone(),
                x_mm: [z.x_from_mm, z.x_to_mm],
                y_mm: z.side_mm,
                covered_mm: z.covered_mm,
            })
            .collect(),
        stirrups_in_spans,
    }
}

/// Points of sheets and interfaces.
pub(super) fn state(
    sheets: &SheetRecord,
    (model, u, state): (&Model, &[f64], &StateStore),
) -> Result<SheetState, ModelError> {
    let mut seen = SheetState::default();
    for cell in &sheets.cells {
        let face = match cell.face {
            spec::Face::Side => Face::Side,
            spec::Face::Soffit => Face::Soffit,
            spec::Face::Top => Face::Top,
        };
        let thickness = cell.laminate.thickness_mm();
        model.sample(cell.membrane, u, state, &mut |s| {
            let strain = Vector3::from_column_slice(s.strain);
            let stresses = cell.laminate.fibre_stresses(&strain);
            seen.sheet.push(SheetPoint {
                position: s.position,
                zone: cell.zone,
                face,
                area_mm2: s.volume / thickness,
                hoop_n_per_mm: cell.laminate.fibre_force_along_2(&strain),
                fibre_stress_mpa: stresses.fold(f64::NEG_INFINITY, f64::max),
                utilisation: s.report.utilisation,
            });
        })?;
        let Some(e) = cell.interface else {
            continue;
        };
        let curve = cell.bond.envelope();
        let (s0_mm, sf_mm) = (curve.peak_slip(), curve.final_slip());
        model.sample(e, u, state, &mut |s| {
            seen.interface.push(InterfacePoint {
                position: s.position,
                zone: cell.zone,
                face,
                area_mm2: s.volume,
                slip_mm: s.strain[0].hypot(s.strain[1]),
                slip_max_mm: SlipDamage::slip_max(s.state),
                s0_mm,
                sf_mm,
            });
        })?;
    }
    Ok(seen)
}
