//! Strengthening of a specimen: fibre sheets bonded to its faces, their gauges and when they are bonded.

use serde::{Deserialize, Serialize};

use super::quantity::{
    AdhesiveModulus, AdhesiveThickness, Angle, Coordinate, FibreModulus, GaugeLength, Load,
    Overlap, PlyThickness, Poisson, SheetShearModulus, SheetStrength, TransverseModulus,
};

/// Fibre sheets bonded to the faces of the beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sheets {
    /// One ply of sheet.
    pub ply: SheetPly,
    /// What bonds the sheets to the concrete.
    pub adhesive: Adhesive,
    /// Where the sheets lie.
    pub wraps: Vec<Wrap>,
}

/// A ply of unidirectional fibres, linear elastic to the rupture of the fibres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SheetPly {
    /// Thickness (mm); all moduli refer to it.
    pub thickness_mm: PlyThickness,
    /// Young's modulus along the fibres (MPa).
    pub fibre_modulus_mpa: FibreModulus,
    /// Young's modulus across the fibres (MPa).
    pub transverse_modulus_mpa: TransverseModulus,
    /// Shear modulus in the plane of the sheet (MPa).
    pub shear_modulus_mpa: SheetShearModulus,
    /// Source of the shear modulus.
    pub shear_modulus_source: String,
    /// Poisson's ratio: strain across the fibres over strain along them, under stress along them.
    pub poisson: Poisson,
    /// Rupture stress along the fibres (MPa).
    pub rupture_mpa: SheetStrength,
    /// Source of the other values.
    pub source: String,
}

/// Adhesive: two layers alike, one on each side of the interface that may debond.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Adhesive {
    /// Thickness of each of the two layers (mm).
    pub layer_thickness_mm: AdhesiveThickness,
    /// Young's modulus (MPa).
    pub young_mpa: AdhesiveModulus,
    /// Poisson's ratio.
    pub poisson: Poisson,
    /// Source of the values.
    pub source: String,
}

/// One layout of sheet round the section, repeated over stretches of the beam.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wrap {
    /// Name, used in the results.
    pub name: String,
    /// Where along the beam, from left to right: one stretch per continuous sheet or strip.
    pub stretches: Vec<Stretch>,
    /// The faces covered.
    pub faces: Vec<Cover>,
    /// Source of the layout.
    pub source: String,
}

/// A stretch of the beam covered by a sheet.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stretch {
    /// Left end (mm).
    pub x_from_mm: Coordinate,
    /// Right end (mm).
    pub x_to_mm: Coordinate,
}

/// A face of the half model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Face {
    /// The side face, z = half of the width.
    Side,
    /// The lower face, y = 0.
    Soffit,
    /// The upper face, y = height.
    Top,
}

/// The plies on one face.
///
/// Sheets that meet at an edge of the section are one sheet bent round it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cover {
    /// Face.
    pub face: Face,
    /// Near edge (mm): height above the soffit on the side, distance from the symmetry plane elsewhere.
    pub from_mm: Coordinate,
    /// Far edge (mm).
    pub to_mm: Coordinate,
    /// Direction of the fibres of each ply (degrees), from the beam axis x in the plane of the face: 90 is
    /// vertical on the side, transverse on soffit and top. The first ply lies next to the concrete.
    pub angles_deg: Vec<Angle>,
    /// Width over which every ply lies twice (mm), counted in the whole section; smeared over the cover.
    #[serde(default)]
    pub overlap_mm: Option<Overlap>,
}

/// A strain gauge on a sheet, on the side face.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SheetGauge {
    /// Name, used in the results.
    pub name: String,
    /// Centre along the beam (mm).
    pub x_mm: Coordinate,
    /// Height of the centre above the soffit (mm).
    pub y_mm: Coordinate,
    /// Distance from the symmetry plane, half of the width (mm).
    pub z_mm: Coordinate,
    /// Direction of the strain read (degrees), from the beam axis x; 90 is vertical.
    pub angle_deg: Angle,
    /// Length over which the strain is averaged (mm).
    pub gauge_length_mm: GaugeLength,
    /// Source of the values.
    pub source: String,
}

impl SheetGauge {
    /// Its two ends (mm), x and y on the side.
    pub fn ends(&self) -> [(f64, f64); 2] {
        let (sin, cos) = self.angle_deg.get().to_radians().sin_cos();
        let half = 0.5 * self.gauge_length_mm.get();
        [-half, half].map(|r| (self.x_mm.get() + r * cos, self.y_mm.get() + r * sin))
    }
}

/// Strengthening of a beam that was loaded before.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Staged {
    /// Load at which the bare beam stops being loaded, measured as [`super::Measuring::load`] says (kN).
    pub load_kn: Load,
    /// What happens to the load while the sheets are bonded.
    pub hold: HoldOrUnload,
    /// Source of the values.
    pub source: String,
}

/// What happens to the load while sheets are bonded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum HoldOrUnload {
    /// The deflection is held.
    Hold,
    /// The load is taken off; self weight stays.
    Unload,
}

impl Wrap {
    /// Names of its sheets, one per stretch: that of the wrap, numbered from 1 where there are several.
    pub fn sheet_names(&self) -> impl Iterator<Item = String> {
        let count = self.stretches.len();
        (1..=count).map(move |number| match count {
            1 => self.name.clone(),
            _ => format!("{} {number}", self.name),
        })
    }

    /// Width of the strips over their spacing: of the first strip over the least distance of the centres of two neighbours; 1 where
    /// there are none: stretches, two or more, that are narrower than `height_mm`, that of the section.
    pub fn width_ratio(&self, height_mm: f64) -> f64 {
        let strips = self
            .stretches
            .iter()
            .map(|s| (s.x_from_mm.get(), s.x_to_mm.get()))
            .filter(|(from, to)| to - from < height_mm);
        let mut centres: Vec<f64> = strips.clone().map(|(from, to)| from.midpoint(to)).collect();
        centres.sort_by(f64::total_cmp);
        let spacing = centres
            .windows(2)
            .map(|w| w[1] - w[0])
            .min_by(f64::total_cmp);
        let width = strips.map(|(from, to)| to - from).next();
        let ratio = width.zip(spacing).map(|(width, spacing)| width / spacing);
        ratio.map_or(1.0, |ratio| ratio.min(1.0))
    }
}

impl Cover {
    /// Mean number of times every ply lies on the face, more than 1 with an overlap.
    pub fn smear(&self) -> f64 {
        let width = 2.0 * (self.to_mm.get() - self.from_mm.get());
        self.overlap_mm.map_or(1.0, |o| 1.0 + o.get() / width)
    }
}
