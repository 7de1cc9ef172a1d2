//! Reinforcement of a specimen: longitudinal bars and stirrups.

use fe_contact::envelope::{Bond, Confinement, ModelCodeParameters};
use serde::{Deserialize, Serialize};

use super::quantity::{
    BarArea, BarCount, BarDiameter, Coordinate, HardeningRatio, RibSpacing, Spacing, SteelModulus,
    SteelStrength,
};
use super::specimen::Span;

/// Slack when the last stirrup of a zone is compared with its end (mm).
const TOLERANCE: f64 = 1e-6;

/// Reinforcing steel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Steel {
    /// Yield stress (MPa).
    pub fy_mpa: SteelStrength,
    /// Rupture stress (MPa).
    pub fu_mpa: SteelStrength,
    /// Young's modulus (MPa).
    pub young_mpa: SteelModulus,
    /// Modulus after yield divided by Young's modulus.
    pub hardening_ratio: HardeningRatio,
    /// Source of the values.
    pub source: String,
}

/// Straight longitudinal bars at one place of the half section.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bar {
    /// Name, used in the results.
    pub name: String,
    /// Diameter (mm).
    pub diameter_mm: BarDiameter,
    /// Cross-section of one bar (mm2).
    pub area_mm2: BarArea,
    /// Number of bars in the half model at this place.
    pub count_in_half: BarCount,
    /// Source of diameter, cross-section and count.
    pub source: String,
    /// Steel.
    pub steel: Steel,
    /// Bond to the concrete.
    #[serde(default)]
    pub bond: BarBond,
    /// Whether hooks or anchor plates hold the ends of a bar that slips.
    #[serde(default)]
    pub anchored: bool,
    /// Where the bar lies.
    pub axis: Axis,
}

/// Bond of bars to the concrete.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum BarBond {
    /// The bar moves as the concrete around it.
    #[default]
    Perfect,
    /// Bond stress over slip of ribbed bars, fib Model Code 2010, 6.1.1.1.
    ModelCode {
        /// Bond condition.
        condition: BondCondition,
        /// What ends the bond.
        #[serde(default)]
        confinement: BondConfinement,
        /// Clear distance between the ribs (mm).
        rib_spacing_mm: RibSpacing,
        /// Source of the values.
        source: String,
    },
}

/// Bond condition of a bar (fib Model Code 2010, 6.1.3.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BondCondition {
    /// Good: the concrete under and around the bar was placed well, as at the bottom of the form.
    Good,
    /// All other conditions.
    Other,
}

/// What ends the bond of a bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum BondConfinement {
    /// The bar is pulled out: cover and confinement keep the concrete from splitting.
    #[default]
    PullOut,
    /// The concrete splits, held by stirrups.
    Stirrups,
    /// The concrete splits, held by nothing.
    Unconfined,
}

/// Axis of a straight longitudinal bar.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Height above the soffit (mm).
    pub y_mm: Coordinate,
    /// Distance from the symmetry plane (mm).
    pub z_mm: Coordinate,
    /// Left end (mm).
    pub x_from_mm: Coordinate,
    /// Right end (mm).
    pub x_to_mm: Coordinate,
    /// Source of the values.
    pub source: String,
}

/// Closed stirrups, all alike.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stirrups {
    /// Diameter (mm).
    pub diameter_mm: BarDiameter,
    /// Cross-section of one leg (mm2).
    pub area_mm2: BarArea,
    /// Source of diameter and cross-section.
    pub source: String,
    /// Steel.
    pub steel: Steel,
    /// Bond of the vertical legs to the concrete, between bends that hold.
    #[serde(default)]
    pub bond: BarBond,
    /// Shape in the half section.
    pub shape: StirrupShape,
    /// Zones along the beam, from left to right, without gaps.
    pub zones: Vec<Zone>,
}

/// Shape of a stirrup in the half section: one vertical leg and the halves of the two horizontal legs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StirrupShape {
    /// Vertical leg.
    pub vertical: VerticalLeg,
    /// Horizontal legs.
    pub horizontal: Vec<HorizontalLeg>,
    /// Source of the values.
    pub source: String,
}

/// Vertical leg of a stirrup.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VerticalLeg {
    /// Distance from the symmetry plane (mm).
    pub z_mm: Coordinate,
    /// Lower end (mm).
    pub y_from_mm: Coordinate,
    /// Upper end (mm).
    pub y_to_mm: Coordinate,
}

/// Horizontal leg of a stirrup.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HorizontalLeg {
    /// Height above the soffit (mm).
    pub y_mm: Coordinate,
    /// End next to the symmetry plane (mm).
    pub z_from_mm: Coordinate,
    /// End next to the side face (mm).
    pub z_to_mm: Coordinate,
}

/// A stretch of the beam with evenly spaced stirrups, or without any.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Zone {
    /// Left end (mm).
    pub x_from_mm: Coordinate,
    /// Right end (mm).
    pub x_to_mm: Coordinate,
    /// Stirrups of the zone; `None` for a zone without.
    pub stirrups: Option<Row>,
    /// Source of the values.
    pub source: String,
}

/// Evenly spaced stirrups: the first, then one every spacing up to the end of the zone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// Position of the first stirrup (mm).
    pub first_mm: Coordinate,
    /// Distance between stirrups (mm).
    pub spacing_mm: Spacing,
}

impl BarBond {
    /// Parameters of the curve in concrete of the mean strength `fcm_mpa` (MPa); `None` if the bond is perfect.
    pub fn parameters(&self, fcm_mpa: f64) -> Option<ModelCodeParameters> {
        let Self::ModelCode {
            condition,
            confinement,
            rib_spacing_mm,
            ..
        } = self
        else {
            return None;
        };
        Some(ModelCodeParameters {
            fcm_mpa,
            rib_spacing_mm: rib_spacing_mm.get(),
            bond: match condition {
                BondCondition::Good => Bond::Good,
                BondCondition::Other => Bond::Other,
            },
            confinement: match confinement {
                BondConfinement::PullOut => Confinement::PullOut,
                BondConfinement::Stirrups => Confinement::Stirrups,
                BondConfinement::Unconfined => Confinement::None,
            },
        })
    }
}

impl Zone {
    /// Positions of the stirrups of the zone (mm), ascending.
    pub fn positions(&self) -> Vec<f64> {
        let Some(row) = &self.stirrups else {
            return Vec::new();
        };
        let (first, spacing) = (row.first_mm.get(), row.spacing_mm.get());
        let gaps = (self.x_to_mm.get() - first + TOLERANCE) / spacing;
        (0..=gaps.floor().max(0.0) as u32)
            .map(|k| first + f64::from(k) * spacing)
            .collect()
    }
}

impl Stirrups {
    /// Positions of all stirrups along the beam (mm), ascending.
    pub fn positions(&self) -> Vec<f64> {
        self.zones.iter().flat_map(Zone::positions).collect()
    }

    /// Whether `x` (mm) lies in a zone with stirrups; the boundary of two zones belongs to both.
    pub fn cover(&self, x: f64) -> bool {
        let holds = |z: &&Zone| z.x_from_mm.get() <= x && x <= z.x_to_mm.get();
        self.zones
            .iter()
            .filter(holds)
            .any(|z| z.stirrups.is_some())
    }

    /// Distances between the stirrups of the zones that overlap a span (mm).
    pub fn spacings(&self, span: &Span) -> Vec<f64> {
        let (from, to) = (span.x_from_mm.get(), span.x_to_mm.get());
        let overlaps = |z: &&Zone| z.x_from_mm.get() < to && z.x_to_mm.get() > from;
        let rows = self
            .zones
            .iter()
            .filter(overlaps)
            .filter_map(|z| z.stirrups.as_ref());
        rows.map(|row| row.spacing_mm.get()).collect()
    }
}
