//! Fibre sheets and their bond: what is read off them, its tables and its pictures.
//!
//! Input are the integration points of a state, [`SheetState`], and what does not change,
//! [`SheetLayout`]. From them come
//!
//! - [`SheetRow`]: the measures of one accepted step, a row of `sheets.csv` ([`SheetTable`]);
//! - [`SheetDrop`]: what the sheets lose from the peak to 0.8 of it, for the mode of failure;
//! - [`MapRow`]: the points themselves, `sheet_map.csv`;
//! - [`SheetView`]: `sheet.svg` and `slip.svg`, drawn from the rows of `sheet_map.csv`.

mod drop;
mod map;
mod measures;
mod table;
#[cfg(test)]
pub(super) mod tests;
mod view;

pub use drop::{LOST, SheetDrop, SpanDrop, ZoneDrop, end_of_drop, is_lost};
pub use map::{MAP, MapError, MapKind, MapRow, MapState, read_map, write_map};
pub use measures::{SheetRow, SpanReading, ZoneReading};
pub use table::SheetTable;
pub use view::{SheetView, Shown};

use std::fmt;

use serde::{Deserialize, Serialize};

/// Face of the beam that carries a sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Face {
    /// The side.
    Side,
    /// The soffit.
    Soffit,
    /// The top.
    Top,
}

impl fmt::Display for Face {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Side => "side",
            Self::Soffit => "soffit",
            Self::Top => "top",
        })
    }
}

/// An integration point of a sheet, one for all its plies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SheetPoint {
    /// Position (mm).
    pub position: [f64; 3],
    /// Index of its [`Zone`].
    pub zone: usize,
    /// Face it lies on.
    pub face: Face,
    /// Area it stands for (mm2).
    pub area_mm2: f64,
    /// What the fibres carry round the section per length along the beam (N/mm), see
    /// [`Laminate::fibre_force_along_2`](fe_materials::Laminate::fibre_force_along_2).
    pub hoop_n_per_mm: f64,
    /// Stress along the fibres, that of the ply where it is largest, tension positive (MPa).
    pub fibre_stress_mpa: f64,
    /// Stress over strength, the largest of all plies.
    pub utilisation: f64,
}

/// An integration point of the interface between concrete and sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterfacePoint {
    /// Position (mm).
    pub position: [f64; 3],
    /// Index of its [`Zone`].
    pub zone: usize,
    /// Face it lies on.
    pub face: Face,
    /// Area it stands for (mm2).
    pub area_mm2: f64,
    /// Slip, the norm of both components (mm).
    pub slip_mm: f64,
    /// Largest slip so far (mm).
    pub slip_max_mm: f64,
    /// Slip at the bond strength (mm).
    pub s0_mm: f64,
    /// Slip from which no bond is left (mm).
    pub sf_mm: f64,
}

impl InterfacePoint {
    /// Whether the bond is lost.
    pub fn is_debonded(&self) -> bool {
        self.slip_max_mm >= self.sf_mm
    }
}

/// The sheets at one state of the half model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SheetState {
    /// Points of the sheets.
    pub sheet: Vec<SheetPoint>,
    /// Points of the interface.
    pub interface: Vec<InterfacePoint>,
}

/// A strip, or a sheet over a stretch of the beam.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    /// Name, as in "strip 9".
    pub name: String,
    /// Left and right end (mm).
    pub x_mm: [f64; 2],
    /// Lower and upper end on the side (mm); equal where it leaves the side bare.
    pub y_mm: [f64; 2],
    /// Height covered between them (mm), less where bands lie one above the other.
    pub covered_mm: f64,
}

impl Zone {
    /// Whether it lies on the soffit or the top alone.
    pub fn leaves_the_side_bare(&self) -> bool {
        self.covered_mm <= 0.0
    }
}

/// What does not change during a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SheetLayout {
    /// Strips and sheets.
    pub zones: Vec<Zone>,
    /// Stirrups in each shear span of [`Layout`](super::evidence::Layout).
    pub stirrups_in_spans: Vec<usize>,
}
