//! Quantities of a specimen file: a number, its unit and the range in which it is believed.
//!
//! The range is checked while the file is read, so the error knows line and column.

use std::fmt;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

/// A unit and the units commonly written by mistake in its place, with their factors.
#[derive(Debug)]
struct Unit {
    symbol: &'static str,
    mistaken: &'static [(&'static str, f64)],
}

const NUMBER: Unit = Unit {
    symbol: "",
    mistaken: &[("%", 0.01)],
};
const MM: Unit = Unit {
    symbol: " mm",
    mistaken: &[("m", 1e3), ("cm", 10.0)],
};
const MM2: Unit = Unit {
    symbol: " mm2",
    mistaken: &[("cm2", 1e2), ("m2", 1e6)],
};
const MPA: Unit = Unit {
    symbol: " MPa",
    mistaken: &[("GPa", 1e3), ("kN/cm2", 10.0), ("Pa", 1e-6)],
};
const KG_M3: Unit = Unit {
    symbol: " kg/m3",
    mistaken: &[("t/m3", 1e3), ("kN/m3", 1e3 / 9.81)],
};
const M_S2: Unit = Unit {
    symbol: " m/s2",
    mistaken: &[("mm/s2", 1e-3)],
};
const DEGREES: Unit = Unit {
    symbol: " degrees",
    mistaken: &[],
};
const KN: Unit = Unit {
    symbol: " kN",
    mistaken: &[("N", 1e-3), ("MN", 1e3)],
};

/// A value that no specimen can have, with its allowed range and, where it would fit, the unit it seems
/// to be written in.
#[derive(Debug)]
struct OutOfRange {
    value: f64,
    range: RangeInclusive<f64>,
    unit: &'static Unit,
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { value, range, unit } = self;
        let symbol = unit.symbol;
        if value.is_finite() {
            write!(f, "{value}{symbol} is out of range; ")?;
        } else {
            write!(f, "{value} is not a finite number; ")?;
        }
        write!(f, "allowed: {} to {}{symbol}", range.start(), range.end())?;
        // What is below one is no percentage.
        let meant = |&&(other, factor): &&(&str, f64)| {
            range.contains(&(value * factor)) && (other != "%" || *value >= 1.0)
        };
        if let Some((other, factor)) = unit.mistaken.iter().find(meant) {
            write!(
                f,
                "; is it in {other}? Then write {}",
                round(value * factor)
            )?;
        }
        Ok(())
    }
}

/// Six significant digits, enough for a suggestion.
fn round(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Defines one newtype per quantity: deserialised from a plain number, refused outside its range.
macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident: $unit:ident in $low:literal to $high:literal;)*) => {$(
        $(#[$doc])*
        #[doc = concat!("\n\nAllowed: ", stringify!($low), " to ", stringify!($high), ".")]
        #[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
        #[serde(try_from = "f64", into = "f64")]
        pub struct $name(f64);

        impl $name {
            /// The number, in the unit of the quantity.
            pub fn get(self) -> f64 {
                self.0
            }
        }

        impl TryFrom<f64> for $name {
            type Error = String;

            fn try_from(value: f64) -> Result<Self, String> {
                let range = $low..=$high;
                if range.contains(&value) {
                    Ok(Self(value))
                } else {
                    Err(OutOfRange { value, range, unit: &$unit }.to_string())
                }
            }
        }

        impl From<$name> for f64 {
            fn from(quantity: $name) -> f64 {
                quantity.0
            }
        }
    )*};
}

quantities! {
    /// Compressive strength of concrete (MPa), as far as the laws of concrete reach.
    ConcreteStrength: MPA in 16.0 to 63.0;
    /// Tensile strength of concrete (MPa).
    TensileStrength: MPA in 0.3 to 10.0;
    /// Young's modulus of concrete (MPa).
    ConcreteModulus: MPA in 5000.0 to 60000.0;
    /// Poisson's ratio.
    Poisson: NUMBER in 0.0 to 0.45;
    /// Density (kg/m3).
    Density: KG_M3 in 1000.0 to 4000.0;
    /// Acceleration of gravity (m/s2).
    Acceleration: M_S2 in 0.0 to 20.0;
    /// Yield or rupture stress of reinforcing steel (MPa).
    SteelStrength: MPA in 100.0 to 1500.0;
    /// Young's modulus of reinforcing steel (MPa).
    SteelModulus: MPA in 50000.0 to 250000.0;
    /// Modulus after yield divided by Young's modulus.
    HardeningRatio: NUMBER in 0.0 to 0.1;
    /// Young's modulus of a loading plate (MPa).
    PlateModulus: MPA in 5000.0 to 1000000.0;
    /// Thickness of a ply of fibre sheet (mm).
    PlyThickness: MM in 0.01 to 5.0;
    /// Young's modulus of a fibre sheet along its fibres (MPa).
    FibreModulus: MPA in 10000.0 to 700000.0;
    /// Young's modulus of a fibre sheet across its fibres (MPa).
    TransverseModulus: MPA in 1.0 to 50000.0;
    /// Shear modulus of a fibre sheet in its plane (MPa).
    SheetShearModulus: MPA in 100.0 to 150000.0;
    /// Rupture stress of a fibre sheet along its fibres (MPa).
    SheetStrength: MPA in 100.0 to 7000.0;
    /// Direction of fibres or of a gauge (degrees).
    Angle: DEGREES in -90.0 to 90.0;
    /// Width over which a fibre sheet lies twice (mm).
    Overlap: MM in 1.0 to 2000.0;
    /// Thickness of a layer of adhesive (mm).
    AdhesiveThickness: MM in 0.05 to 10.0;
    /// Young's modulus of adhesive (MPa).
    AdhesiveModulus: MPA in 100.0 to 20000.0;
    /// Length over which a strain gauge averages (mm).
    GaugeLength: MM in 1.0 to 200.0;
    /// Diameter of a bar (mm).
    BarDiameter: MM in 3.0 to 60.0;
    /// Cross-section of a bar or of one leg of a stirrup (mm2).
    BarArea: MM2 in 5.0 to 3000.0;
    /// Clear distance between the ribs of a bar (mm).
    RibSpacing: MM in 1.0 to 50.0;
    /// Length of a beam (mm).
    BeamLength: MM in 500.0 to 20000.0;
    /// Width or height of a section (mm).
    SectionSize: MM in 50.0 to 2000.0;
    /// Coordinate in the half model (mm).
    Coordinate: MM in 0.0 to 20000.0;
    /// Distance between stirrups (mm).
    Spacing: MM in 20.0 to 1000.0;
    /// Length of a plate or stub along the beam (mm).
    PlateLength: MM in 10.0 to 1000.0;
    /// Thickness of a plate (mm).
    PlateThickness: MM in 1.0 to 200.0;
    /// Depth of a concrete stub under a beam (mm).
    StubDepth: MM in 10.0 to 1000.0;
    /// Imposed deflection (mm).
    Deflection: MM in 0.1 to 500.0;
    /// Load (kN).
    Load: KN in 1.0 to 10000.0;
}

/// Number of bars at one place.
///
/// Allowed: 1 to 100.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "i64", into = "i64")]
pub struct BarCount(u8);

impl BarCount {
    const MAX: u8 = 100;

    /// The number.
    pub const fn get(self) -> u8 {
        self.0
    }
}

impl TryFrom<i64> for BarCount {
    type Error = String;

    fn try_from(value: i64) -> Result<Self, String> {
        let count = u8::try_from(value)
            .ok()
            .filter(|n| (1..=Self::MAX).contains(n));
        count.map(Self).ok_or_else(|| {
            format!(
                "{value} is out of range; allowed: whole numbers from 1 to {}",
                Self::MAX
            )
        })
    }
}

impl From<BarCount> for i64 {
    fn from(count: BarCount) -> i64 {
        count.0.into()
    }
}
