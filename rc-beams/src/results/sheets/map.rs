//! `sheet_map.csv`: the points of sheets and interface at the peak and at the end of the drop after it.

use std::io::{self, Read};

use serde::{Deserialize, Serialize};

use super::{Face, SheetLayout, SheetState};
use crate::results::error::ResultsError;
use crate::results::folder::Folder;

/// Name of the file.
pub const MAP: &str = "sheet_map.csv";

/// Which state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MapState {
    /// The largest load.
    Peak,
    /// The first step at 0.8 of the peak, or the last one.
    End,
}

/// What a row is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MapKind {
    /// A point of a sheet.
    Sheet,
    /// A point of the interface.
    Interface,
}

/// A row of `sheet_map.csv`; what does not apply to its kind is an empty cell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MapRow {
    /// State.
    pub state: MapState,
    /// Sheet or interface.
    pub kind: MapKind,
    /// Face of the beam.
    pub face: Face,
    /// Name of the zone.
    pub zone: String,
    /// Position along the beam (mm).
    pub x_mm: f64,
    /// Position above the soffit (mm).
    pub y_mm: f64,
    /// Distance from the symmetry plane (mm).
    pub z_mm: f64,
    /// Largest stress along the fibres of a ply (MPa).
    pub fibre_stress_mpa: Option<f64>,
    /// Slip (mm).
    pub slip_mm: Option<f64>,
    /// Largest slip so far (mm).
    pub slip_max_mm: Option<f64>,
    /// 1 where the bond is lost, else 0.
    pub debonded: Option<u8>,
}

impl MapRow {
    /// Rows of a state.
    pub fn of(state: MapState, sheets: &SheetLayout, at: &SheetState) -> Vec<Self> {
        let row = |kind, face, zone: usize, [x_mm, y_mm, z_mm]: [f64; 3]| Self {
            state,
            kind,
            face,
            zone: sheets
                .zones
                .get(zone)
                .map_or_else(String::new, |z| z.name.clone()),
            x_mm,
            y_mm,
            z_mm,
            fibre_stress_mpa: None,
            slip_mm: None,
            slip_max_mm: None,
            debonded: None,
        };
        let sheet = at.sheet.iter().map(|p| Self {
            fibre_stress_mpa: Some(p.fibre_stress_mpa),
            ..row(MapKind::Sheet, p.face, p.zone, p.position)
        });
        let interface = at.interface.iter().map(|p| Self {
            slip_mm: Some(p.slip_mm),
            slip_max_mm: Some(p.slip_max_mm),
            debonded: Some(u8::from(p.is_debonded())),
            ..row(MapKind::Interface, p.face, p.zone, p.position)
        });
        sheet.chain(interface).collect()
    }

    /// Whether there is what belongs to its kind.
    const fn is_complete(&self) -> bool {
        match self.kind {
            MapKind::Sheet => self.fibre_stress_mpa.is_some(),
            MapKind::Interface => {
                self.slip_mm.is_some() && self.slip_max_mm.is_some() && self.debonded.is_some()
            }
        }
    }

    /// What it is about, whichever the state.
    fn point(&self) -> (MapKind, Face, &str, [f64; 3]) {
        let place = [self.x_mm, self.y_mm, self.z_mm];
        (self.kind, self.face, &self.zone, place)
    }
}

/// Writes `sheet_map.csv` as a whole.
///
/// # Errors
///
/// [`ResultsError::Output`].
pub fn write_map(folder: &Folder, rows: &[MapRow]) -> Result<(), ResultsError> {
    folder.replace(MAP, |out| {
        let mut writer = csv::Writer::from_writer(out);
        for row in rows {
            writer.serialize(row).map_err(io::Error::from)?;
        }
        writer.flush()
    })
}

/// Why the rows cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// Not a table of this kind, or damaged.
    #[error(transparent)]
    Table(#[from] csv::Error),
    /// No rows.
    #[error("the table has no rows")]
    Empty,
    /// A row without a number of its kind.
    #[error("row {row} of the points lacks a number: the table was cut or changed")]
    Incomplete {
        /// Counted from 1, without the header.
        row: usize,
    },
    /// Not every point has both states.
    #[error(
        "{peak} points at the peak and {end} at the end are not the same ones: the table was cut or changed"
    )]
    Unlike {
        /// Rows of the peak.
        peak: usize,
        /// Rows of the end.
        end: usize,
    },
}

/// Reads the rows of a `sheet_map.csv`.
///
/// # Errors
///
/// [`MapError`], with the line and the field.
pub fn read_map(text: impl Read) -> Result<Vec<MapRow>, MapError> {
    let rows: Vec<MapRow> = csv::Reader::from_reader(text)
        .deserialize()
        .collect::<Result<_, _>>()?;
    if rows.is_empty() {
        return Err(MapError::Empty);
    }
    if let Some(row) = rows.iter().position(|row| !row.is_complete()) {
        return Err(MapError::Incomplete { row: row + 1 });
    }
    let of = |state| rows.iter().filter(move |row| row.state == state);
    if !of(MapState::Peak)
        .map(MapRow::point)
        .eq(of(MapState::End).map(MapRow::point))
    {
        let [peak, end] = [MapState::Peak, MapState::End].map(|state| of(state).count());
        return Err(MapError::Unlike { peak, end });
    }
    Ok(rows)
}
