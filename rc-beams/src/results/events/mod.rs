//! Events of a run: what happens first, where, and under which load.
//!
//! A [`Survey`] looks at the points of one accepted step and keeps the largest reading of each kind, as
//! [`StepEvidence`]. An [`EventLog`] compares it with the threshold of the kind; the first step that
//! reaches it is the event, with the load and the deflection of that step.
//!
//! | event | reading | threshold |
//! |---|---|---|
//! | `flexural_crack` | width of a crack whose normal is within 30 degrees of the beam axis | 0.05 mm |
//! | `diagonal_crack` | width of a crack in a shear span, normal at 30 to 75 degrees to the axis | 0.05 mm |
//! | `stirrup_yield` | tensile stress over yield stress, stirrups | 1 |
//! | `bar_yield` | the same, longitudinal bars | 1 |
//! | `interface_strength` | largest slip so far over the slip at the bond strength | 1 |
//! | `debonding` | largest slip so far over the slip without bond | 1 |
//! | `sheet_rupture` | utilisation of the sheet | 1 |
//! | `crushing` | crushing of the concrete: past its compressive strength | above 0 |
//! | `crushed` | the same: at its residual stress | 1 |
//!
//! The width of a crack is its strain times the crack-band width of the law. Cracked points alone would be
//! noise: concrete is past its tensile strength long before a crack is seen. 0.05 mm is assumed, about what is
//! seen without a lens. The table holds the state of single integration points: `crushing` beside a plate
//! comes early and says little of the beam.

mod log;
mod survey;
#[cfg(test)]
mod tests;

pub use log::EventLog;
pub use survey::Survey;

use std::fmt;
use std::ops::RangeInclusive;

/// Width from which a crack counts (mm).
pub const VISIBLE_WIDTH_MM: f64 = 0.05;
/// Largest angle between normal and beam axis of a flexural crack (degrees).
const FLEXURAL_DEG: f64 = 30.0;
/// Angles between normal and beam axis of a diagonal crack (degrees).
const DIAGONAL_DEG: RangeInclusive<f64> = 30.0..=75.0;

/// What can happen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventKind {
    /// A crack across the beam is as wide as [`VISIBLE_WIDTH_MM`].
    FlexuralCrack,
    /// So is an inclined crack in a shear span.
    DiagonalCrack,
    /// A stirrup yields.
    StirrupYield,
    /// A longitudinal bar yields.
    BarYield,
    /// The interface reaches its bond strength.
    InterfaceStrength,
    /// The interface has lost its bond.
    Debonding,
    /// A sheet ruptures.
    SheetRupture,
    /// Concrete is past its compressive strength.
    Crushing,
    /// Concrete is at its residual compressive stress.
    Crushed,
}

impl EventKind {
    /// All kinds, in the order of a table.
    pub const ALL: [Self; 9] = [
        Self::FlexuralCrack,
        Self::DiagonalCrack,
        Self::StirrupYield,
        Self::BarYield,
        Self::InterfaceStrength,
        Self::Debonding,
        Self::SheetRupture,
        Self::Crushing,
        Self::Crushed,
    ];

    /// Name in `events.csv`.
    pub const fn key(self) -> &'static str {
        match self {
            Self::FlexuralCrack => "flexural_crack",
            Self::DiagonalCrack => "diagonal_crack",
            Self::StirrupYield => "stirrup_yield",
            Self::BarYield => "bar_yield",
            Self::InterfaceStrength => "interface_strength",
            Self::Debonding => "debonding",
            Self::SheetRupture => "sheet_rupture",
            Self::Crushing => "crushing",
            Self::Crushed => "crushed",
        }
    }

    /// What a reader is told.
    pub const fn words(self) -> &'static str {
        match self {
            Self::FlexuralCrack => "first flexural crack",
            Self::DiagonalCrack => "first diagonal crack",
            Self::StirrupYield => "first stirrup yields",
            Self::BarYield => "longitudinal bar yields",
            Self::InterfaceStrength => "interface at its bond strength",
            Self::Debonding => "first debonding",
            Self::SheetRupture => "sheet ruptures",
            Self::Crushing => "concrete past its compressive strength",
            Self::Crushed => "concrete at its residual stress",
        }
    }

    /// Whether a reading makes the event.
    pub fn is_reached(self, value: f64) -> bool {
        match self {
            Self::FlexuralCrack | Self::DiagonalCrack => value >= VISIBLE_WIDTH_MM,
            Self::Crushing => value > 0.0,
            // Rounding keeps a bar that yields without hardening just below its yield stress.
            Self::StirrupYield | Self::BarYield => value >= 1.0 - 1e-9,
            _ => value >= 1.0,
        }
    }

    /// The quantity behind the reading, with its unit.
    fn detail(self, amount: f64) -> String {
        match self {
            Self::FlexuralCrack | Self::DiagonalCrack => format!("crack width {amount:.3} mm"),
            Self::StirrupYield | Self::BarYield => format!("stress {amount:.0} MPa"),
            Self::InterfaceStrength | Self::Debonding => format!("slip {amount:.3} mm"),
            Self::SheetRupture => format!("fibre stress {amount:.0} MPa"),
            // It begins at nothing.
            Self::Crushing => String::from("crushing begins"),
            Self::Crushed => format!("crushing {amount:.3}"),
        }
    }
}

/// The largest reading of a kind within one step.
#[derive(Debug, Clone, PartialEq)]
pub struct Reach {
    /// Reading, in the measure of the threshold.
    pub value: f64,
    /// Quantity behind it: width (mm), stress (MPa), slip (mm) or crushing.
    pub amount: f64,
    /// Where (mm).
    pub position: [f64; 3],
    /// Span, bar or zone.
    pub place: String,
}

/// What one accepted step shows.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StepEvidence {
    /// Step, counted from 1; 0 is self weight.
    pub step: usize,
    /// Deflection (mm).
    pub deflection_mm: f64,
    /// Load, net of self weight (kN).
    pub load_kn: f64,
    readings: [Option<Reach>; EventKind::ALL.len()],
}

impl StepEvidence {
    /// Largest reading of a kind; none where nothing of that kind was looked at.
    pub const fn reading(&self, kind: EventKind) -> Option<&Reach> {
        self.readings[kind as usize].as_ref()
    }
}

/// The first time that a kind reaches its threshold.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// What happens.
    pub kind: EventKind,
    /// In which step.
    pub step: usize,
    /// Deflection (mm).
    pub deflection_mm: f64,
    /// Load (kN).
    pub load_kn: f64,
    /// Reading with its place.
    pub reach: Reach,
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.reach.position;
        write!(
            f,
            "{} at {:.1} kN, {:.2} mm: {}, {} (x {x:.0}, y {y:.0}, z {z:.0} mm)",
            self.kind.words(),
            self.load_kn,
            self.deflection_mm,
            self.kind.detail(self.reach.amount),
            self.reach.place,
        )
    }
}
