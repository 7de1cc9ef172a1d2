//! A specimen: the whole beam as tested, described for its half model.
//!
//! Axes: x along the beam from its left end, y up from the soffit, z across the width from the
//! symmetry plane z = 0 to the side face. Every group of values states its source; "assumed: ..."
//! where no source gives it.

use serde::{Deserialize, Serialize};

use super::quantity::{
    Acceleration, BeamLength, ConcreteModulus, ConcreteStrength, Coordinate, Deflection, Density,
    Load, PlateLength, PlateModulus, PlateThickness, Poisson, SectionSize, StubDepth,
    TensileStrength,
};
use super::reinforcement::{Bar, Stirrups};
use super::sheets::{SheetGauge, Sheets, Staged};

/// One beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Specimen {
    /// Short name; also the name of the result folder.
    pub name: String,
    /// What the specimen is, in a few words.
    pub title: String,
    /// Test series.
    pub series: Series,
    /// Outline of the beam.
    pub beam: Beam,
    /// Concrete.
    pub concrete: Concrete,
    /// Self weight.
    pub gravity: Gravity,
    /// Longitudinal bars.
    pub bars: Vec<Bar>,
    /// Stirrups, if any.
    pub stirrups: Option<Stirrups>,
    /// Fibre sheets, if any.
    #[serde(default)]
    pub sheets: Option<Sheets>,
    /// When the sheets are bonded; `None`: before any load.
    #[serde(default)]
    pub staged: Option<Staged>,
    /// Supports from left to right.
    pub supports: Vec<Support>,
    /// Loads from left to right; all are pushed down by the same amount.
    pub loads: Vec<LoadPoint>,
    /// What is measured.
    pub measuring: Measuring,
    /// How far the loads are pushed.
    pub imposed: Imposed,
    /// Result of the laboratory test; without one, the result of the program is a prediction.
    pub test: Option<Test>,
}

/// Test series of Khalifa (1999).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Series {
    /// Simply supported, four-point bending.
    A,
    /// Two-span continuous.
    B,
}

/// Outline of the beam: a rectangular prism.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Beam {
    /// Length (mm).
    pub length_mm: BeamLength,
    /// Width of the whole section (mm); the model holds half of it.
    pub width_mm: SectionSize,
    /// Height of the section (mm).
    pub height_mm: SectionSize,
    /// Source of the values.
    pub source: String,
}

/// Concrete as reported by the test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Concrete {
    /// Reported compressive strength (MPa).
    pub reported_strength_mpa: ConcreteStrength,
    /// Reported tensile strength (MPa); without one, it follows from the compressive strength.
    #[serde(default)]
    pub reported_tensile_mpa: Option<TensileStrength>,
    /// Young's modulus (MPa).
    pub young_mpa: ConcreteModulus,
    /// Poisson's ratio.
    pub poisson: Poisson,
    /// Density (kg/m3).
    pub density_kg_m3: Density,
    /// Source of the values.
    pub source: String,
}

/// Gravity, against y.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gravity {
    /// Acceleration (m/s2).
    pub acceleration_m_s2: Acceleration,
    /// Source of the value.
    pub source: String,
}

/// A support: a plate under the beam, or under a stub of concrete under the beam, held on the line at
/// the centre of its lower face.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Support {
    /// Centre (mm).
    pub x_mm: Coordinate,
    /// Displacements held at zero.
    pub held: Vec<Held>,
    /// Plate.
    pub plate: Plate,
    /// Stub between beam and plate, of the concrete of the beam and as wide.
    pub stub: Option<Stub>,
    /// Source of position and held displacements.
    pub source: String,
}

/// A displacement held by a support.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Held {
    /// Along the beam.
    Ux,
    /// Vertical.
    Uy,
}

/// A plate, as wide as the beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plate {
    /// Length along the beam (mm).
    pub length_mm: PlateLength,
    /// Thickness (mm).
    pub thickness_mm: PlateThickness,
    /// Young's modulus (MPa).
    pub young_mpa: PlateModulus,
    /// Poisson's ratio.
    pub poisson: Poisson,
    /// Source of the values.
    pub source: String,
}

/// A block of concrete between beam and support plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stub {
    /// Length along the beam (mm).
    pub length_mm: PlateLength,
    /// Depth below the soffit (mm).
    pub depth_mm: StubDepth,
    /// Source of the values.
    pub source: String,
}

/// A load: a plate on the beam, pushed down on the line at the centre of its upper face.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadPoint {
    /// Centre (mm).
    pub x_mm: Coordinate,
    /// Plate.
    pub plate: Plate,
    /// Source of the position.
    pub source: String,
}

/// What the test measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measuring {
    /// Where the deflection is read.
    pub deflection: Point,
    /// Which load is reported.
    pub load: LoadMeasure,
    /// The shear span under test.
    pub test_span: Span,
    /// Strain gauges on the fibre sheets.
    #[serde(default)]
    pub sheet_gauges: Vec<SheetGauge>,
}

/// A point of the half model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// Along the beam (mm).
    pub x_mm: Coordinate,
    /// Above the soffit (mm).
    pub y_mm: Coordinate,
    /// From the symmetry plane (mm).
    pub z_mm: Coordinate,
    /// Source of the values.
    pub source: String,
}

/// A stretch of the beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Span {
    /// Left end (mm).
    pub x_from_mm: Coordinate,
    /// Right end (mm).
    pub x_to_mm: Coordinate,
    /// Source of the values.
    pub source: String,
}

/// The reported load, of the whole width and net of self weight.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum LoadMeasure {
    /// Sum of the vertical reactions of all supports.
    TotalReactions,
    /// Shear force at an inner support: the load of one span, which is the sum of all reactions shared
    /// equally by the spans, less the reaction of the end support of that span.
    InnerShear {
        /// Which end support, counted from 0 at the left.
        end_support: usize,
    },
}

/// The deflection imposed on the loads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Imposed {
    /// Final value (mm).
    pub deflection_mm: Deflection,
    /// Source of the value.
    pub source: String,
}

/// Result of the laboratory test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Test {
    /// Largest load, measured as [`Measuring::load`] says (kN).
    pub load_kn: Load,
    /// Observed mode of failure.
    pub mode: Mode,
    /// Source of the values.
    pub source: String,
}

/// Mode of failure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// Diagonal cracking of a shear span.
    Shear,
    /// Yield of the longitudinal bars, then crushing.
    Flexure,
    /// Fibre sheets come off the concrete.
    Debonding,
    /// The concrete splits, with the sheets on it.
    Splitting,
    /// Fibre sheets tear.
    Rupture,
}

impl Specimen {
    /// Where (mm) longitudinal bars have gauges: at the loads and in the middle of the test span.
    pub(crate) fn gauge_places(&self) -> Vec<f64> {
        let span = &self.measuring.test_span;
        let centre = 0.5 * (span.x_from_mm.get() + span.x_to_mm.get());
        let mut places: Vec<f64> = self.loads.iter().map(|l| l.x_mm.get()).collect();
        if !places.contains(&centre) {
            places.push(centre);
        }
        places
    }

    /// Longitudinal bars and the places (mm) of their gauges.
    pub(crate) fn bar_gauges(&self) -> impl Iterator<Item = (&str, f64)> {
        let places = self.gauge_places();
        let bars = self.bars.iter().map(|bar| bar.name.as_str());
        bars.flat_map(move |bar| places.clone().into_iter().map(move |x| (bar, x)))
    }

    /// Plates at supports and loads: centre and length along the beam (mm).
    pub(crate) fn plates(&self) -> impl Iterator<Item = (f64, f64)> {
        let supports = self.supports.iter().map(|s| (s.x_mm, &s.plate));
        let all = supports.chain(self.loads.iter().map(|l| (l.x_mm, &l.plate)));
        all.map(|(x, plate)| (x.get(), plate.length_mm.get()))
    }

    /// Half of the width, the extent of the model in z (mm).
    pub fn half_width_mm(&self) -> f64 {
        0.5 * self.beam.width_mm.get()
    }
}
