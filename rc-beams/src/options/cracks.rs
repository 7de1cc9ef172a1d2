//! Ingredients of the fixed-crack law.

use clap::{Args, ValueEnum};
use serde::Serialize;

use super::numbers::{aggregate, band_factor, crack_spacing, factor, fixing_share, shear_floor};

/// Ingredients of the fixed-crack law; those not given are of the preset.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Args)]
pub struct Cracks {
    /// Softening in tension; without it, that of the preset
    #[arg(long, value_enum)]
    pub tension_softening: Option<TensionSoftening>,

    /// Shear across cracks; without it, that of the preset
    #[arg(long, value_enum)]
    pub shear_transfer: Option<ShearTransfer>,

    /// What cracks do to the compression across them; without it, that of the preset
    #[arg(long, value_enum)]
    pub compression_softening: Option<CompressionSoftening>,

    /// What pressure from the sides does to compression; without it, nothing
    #[arg(long, value_enum)]
    pub confinement: Option<Confinement>,

    /// Distance of cracks, over which narrower elements share one (mm)
    #[arg(long, value_name = "MM", value_parser = crack_spacing, allow_negative_numbers = true)]
    pub crack_spacing_mm: Option<f64>,

    /// Share of the tensile strength down to which the axes of a crack follow the strain, fixed then, 1: at the onset; without it, that of the preset
    #[arg(long, value_name = "SHARE", value_parser = fixing_share, allow_negative_numbers = true)]
    pub fixing_share: Option<f64>,

    /// Least shear stiffness of open cracks over that of sound concrete; without it, that of the preset, 1e-4 of the default
    #[arg(long, value_name = "SHARE", value_parser = shear_floor, allow_negative_numbers = true)]
    pub shear_floor: Option<f64>,

    /// Crack-band width over the side of the square of the same area as an element; without it, that of the preset
    #[arg(long, value_name = "FACTOR", value_parser = band_factor, allow_negative_numbers = true)]
    pub band_factor: Option<f64>,

    /// Tensile strength over that of the preset
    #[arg(long, value_name = "FACTOR", value_parser = factor, allow_negative_numbers = true)]
    pub tensile_strength_factor: Option<f64>,

    /// Fracture energy over that of the Model Code
    #[arg(long, value_name = "FACTOR", value_parser = factor, allow_negative_numbers = true)]
    pub fracture_energy_factor: Option<f64>,

    /// Crushing energy over 250 times the fracture energy of the Model Code
    #[arg(long, value_name = "FACTOR", value_parser = factor, allow_negative_numbers = true)]
    pub crushing_energy_factor: Option<f64>,

    /// Largest aggregate (mm)
    #[arg(long, value_name = "MM", value_parser = aggregate, allow_negative_numbers = true)]
    pub aggregate_mm: Option<f64>,
}

/// Softening in tension.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum TensionSoftening {
    /// A line
    Linear,
    /// An exponential
    Exponential,
}

/// Shear across cracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum ShearTransfer {
    /// As far as the crack is still bridged in tension
    Damage,
    /// That and aggregate interlock
    Interlock,
}

/// What cracks do to the compression across them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum CompressionSoftening {
    /// Nothing
    None,
    /// The strength falls with the strain across
    VecchioCollins,
    /// The same, less, as cracks slip by themselves
    VecchioCollinsSlip,
}

/// What pressure from the sides does to compression.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Confinement {
    /// Nothing
    None,
    /// Concrete gets stronger, as in tests with two and three axes pressed
    Vecchio,
}
