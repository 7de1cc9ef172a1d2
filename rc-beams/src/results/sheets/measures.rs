//! The measures of one accepted step.

use std::collections::BTreeMap;

use super::{Face, SheetLayout, SheetState};
use crate::results::evidence::Layout;

/// Points whose x differ by less than this (mm) stand in one column.
const SAME_COLUMN_MM: f64 = 1e-3;

/// The sheets of one shear span.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SpanReading {
    /// Largest fibre stress on all faces (MPa); 0 where all are in compression.
    pub stress_mpa: f64,
    /// Largest vertical force that the sides can carry across a diagonal crack (kN), whole width:
    /// SVf = sum of 2 dx max_y(n) over the columns of points of the side, dx the width of a column and n the
    /// [tension round the section](super::SheetPoint::hoop_n_per_mm), all plies together.
    pub force_kn: f64,
    /// Share of the bonded side that is debonded; none without bonded side.
    pub debonded: Option<f64>,
}

/// The interface of one zone, all faces.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ZoneReading {
    /// Debonded share of the bonded area; none without bonded area.
    pub debonded: Option<f64>,
    /// Largest slip so far (mm).
    pub slip_max_mm: f64,
    /// Largest fibre stress (MPa); 0 where all are in compression.
    pub fibre_mpa: f64,
}

/// The measures of one accepted step, a row of `sheets.csv`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SheetRow {
    /// Step.
    pub step: usize,
    /// Deflection (mm).
    pub deflection_mm: f64,
    /// Load (kN).
    pub load_kn: f64,
    /// Largest utilisation of all sheets.
    pub utilisation: f64,
    /// Shear spans, in the order of [`Layout`].
    pub spans: Vec<SpanReading>,
    /// Zones, in the order of [`SheetLayout`].
    pub zones: Vec<ZoneReading>,
}

/// Debonded and bonded area (mm2).
#[derive(Debug, Clone, Copy, Default)]
struct Areas {
    debonded: f64,
    bonded: f64,
}

impl Areas {
    fn add(&mut self, area: f64, debonded: bool) {
        self.bonded += area;
        if debonded {
            self.debonded += area;
        }
    }

    fn share(self) -> Option<f64> {
        (self.bonded > 0.0).then(|| self.debonded / self.bonded)
    }
}

/// Points of one column: their area (mm2) and the largest tension per length (N/mm).
#[derive(Debug, Clone, Copy, Default)]
struct Column {
    area: f64,
    tension: f64,
}

impl SheetRow {
    /// Reads a state; `step`, deflection (mm) and load (kN) are those of the step.
    pub fn of(
        layout: &Layout,
        sheets: &SheetLayout,
        state: &SheetState,
        (step, deflection_mm, load_kn): (usize, f64, f64),
    ) -> Self {
        let mut spans = vec![SpanReading::default(); layout.shear_spans.len()];
        let mut zones = vec![ZoneReading::default(); sheets.zones.len()];
        let mut columns: BTreeMap<(usize, usize, i64), Column> = BTreeMap::new();
        for point in &state.sheet {
            if let Some(zone) = zones.get_mut(point.zone) {
                zone.fibre_mpa = zone.fibre_mpa.max(point.fibre_stress_mpa);
            }
            let x = point.position[0];
            let Some(span) = layout.span_at(x) else {
                continue;
            };
            spans[span].stress_mpa = spans[span].stress_mpa.max(point.fibre_stress_mpa);
            if point.face == Face::Side {
                let place = (x / SAME_COLUMN_MM).round() as i64;
                let column = columns.entry((span, point.zone, place)).or_default();
                column.area += point.area_mm2;
                column.tension = column.tension.max(point.hoop_n_per_mm);
            }
        }
        for ((span, zone, _), column) in columns {
            let height = sheets.zones.get(zone).map_or(0.0, |z| z.covered_mm);
            if height > 0.0 {
                spans[span].force_kn += 2e-3 * column.tension * column.area / height;
            }
        }
        let mut sides = vec![Areas::default(); spans.len()];
        let mut bonds = vec![Areas::default(); zones.len()];
        for point in &state.interface {
            let (area, debonded) = (point.area_mm2, point.is_debonded());
            let span = layout.span_at(point.position[0]);
            if let Some(i) = span.filter(|_| point.face == Face::Side) {
                sides[i].add(area, debonded);
            }
            if let (Some(bond), Some(zone)) = (bonds.get_mut(point.zone), zones.get_mut(point.zone))
            {
                bond.add(area, debonded);
                zone.slip_max_mm = zone.slip_max_mm.max(point.slip_max_mm);
            }
        }
        for (span, side) in spans.iter_mut().zip(sides) {
            span.debonded = side.share();
        }
        for (zone, bond) in zones.iter_mut().zip(bonds) {
            zone.debonded = bond.share();
        }
        let utilisation = state.sheet.iter().map(|p| p.utilisation);
        Self {
            step,
            deflection_mm,
            load_kn,
            utilisation: utilisation.fold(0.0, f64::max),
            spans,
            zones,
        }
    }
}
