//! How a specimen is modelled: one set for all beams.

use fe_elements::{BandWidth, HexRule};
use fe_materials::fixed_crack::{
    AGGREGATE_MM, CRACK_SPACING_MM, CompressionSoftening, Confinement, FIXING_SHARE, ShearTransfer,
    TensionSoftening,
};

use super::default_mesh;
use crate::options::{Bond, Cracks, Law, MeshSize, Preset, SheetShear, SoffitFibre, StripBond};
use crate::spec::Specimen;

/// Settings of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelSettings {
    /// Named set the settings started from.
    pub preset: Preset,
    /// Elements along, over the height of, and across the half beam.
    pub mesh: MeshSize,
    /// Integration of the concrete.
    pub integration: HexRule,
    /// Law of the concrete.
    pub law: Law,
    /// Dowel action of bars against shear across cracks.
    pub dowel: bool,
    /// Softening of the fixed-crack law in tension.
    pub tension_softening: TensionSoftening,
    /// Shear across its cracks.
    pub shear_transfer: ShearTransfer,
    /// What its cracks do to the compression across them.
    pub compression_softening: CompressionSoftening,
    /// What pressure from the sides does to compression.
    pub confinement: Confinement,
    /// Distance of its cracks (mm).
    pub crack_spacing_mm: f64,
    /// Share of the strength bridged at which the axes of a crack are fixed (-).
    pub fixing_share: f64,
    /// Floor of the shear factor of open cracks (-).
    pub shear_floor: f64,
    /// Crack-band width of the fixed-crack law over the side of the equivalent square in the plane of the beam.
    pub band_factor: f64,
    /// Tensile strength of the fixed-crack law over that of the preset.
    pub tensile_strength_factor: f64,
    /// Fracture energy of the fixed-crack law over that of its source.
    pub fracture_energy_factor: f64,
    /// The same of its crushing energy.
    pub crushing_energy_factor: f64,
    /// Bond of the sheets.
    pub bond: Bond,
    /// Fibres of the sheet on the soffit.
    pub soffit_fibre: SoffitFibre,
    /// Shear modulus of the sheets.
    pub sheet_shear: SheetShear,
    /// Width factor of the bond of strips.
    pub strip_bond: StripBond,
}

impl ModelSettings {
    /// The settings of a preset on the mesh that suits a specimen, see [`default_mesh`].
    pub fn new(preset: Preset, specimen: &Specimen) -> Self {
        let (soffit_fibre, sheet_shear, strip_bond) = match preset {
            Preset::Reference => (SoffitFibre::Along, SheetShear::Half, StripBond::Sheet),
            Preset::Physical => (SoffitFibre::Given, SheetShear::Given, StripBond::Strip),
            Preset::Characteristic => (SoffitFibre::Given, SheetShear::Given, StripBond::Sheet),
        };
        let plain = Self {
            preset,
            mesh: default_mesh(specimen, preset),
            integration: HexRule::Irons,
            law: preset.law(),
            dowel: true,
            tension_softening: TensionSoftening::Exponential,
            shear_transfer: ShearTransfer::Interlock {
                aggregate_mm: AGGREGATE_MM,
            },
            compression_softening: CompressionSoftening::default(),
            confinement: Confinement::default(),
            crack_spacing_mm: CRACK_SPACING_MM,
            fixing_share: FIXING_SHARE,
            shear_floor: 1e-4,
            band_factor: 1.0,
            tensile_strength_factor: 1.0,
            fracture_energy_factor: 1.0,
            crushing_energy_factor: 1.0,
            bond: Bond::Cohesive,
            soffit_fibre,
            sheet_shear,
            strip_bond,
        };
        match preset {
            Preset::Physical => plain,
            Preset::Reference => Self {
                integration: HexRule::Reduced,
                dowel: false,
                ..plain
            },
            Preset::Characteristic => Self {
                integration: HexRule::Reduced,
                dowel: false,
                tension_softening: TensionSoftening::Linear,
                shear_transfer: ShearTransfer::Damage,
                compression_softening: CompressionSoftening::None,
                fixing_share: 1.0,
                shear_floor: 1e-3,
                band_factor: 0.5,
                ..plain
            },
        }
    }

    /// The same with the ingredients that are given.
    #[must_use]
    pub fn with_cracks(mut self, given: &Cracks) -> Self {
        use crate::options::{
            CompressionSoftening as Compression, Confinement as Pressed, ShearTransfer as Shear,
            TensionSoftening as Tension,
        };
        if let Some(shape) = given.tension_softening {
            self.tension_softening = match shape {
                Tension::Linear => TensionSoftening::Linear,
                Tension::Exponential => TensionSoftening::Exponential,
            };
        }
        if let Some(transfer) = given.shear_transfer {
            self.shear_transfer = match transfer {
                Shear::Damage => ShearTransfer::Damage,
                Shear::Interlock => ShearTransfer::Interlock {
                    aggregate_mm: AGGREGATE_MM,
                },
            };
        }
        if let (ShearTransfer::Interlock { aggregate_mm }, Some(given)) =
            (&mut self.shear_transfer, given.aggregate_mm)
        {
            *aggregate_mm = given;
        }
        if let Some(softening) = given.compression_softening {
            self.compression_softening = match softening {
                Compression::None => CompressionSoftening::None,
                Compression::VecchioCollins => CompressionSoftening::VecchioCollins,
                Compression::VecchioCollinsSlip => CompressionSoftening::VecchioCollinsSlip,
            };
        }
        if let Some(confinement) = given.confinement {
            self.confinement = match confinement {
                Pressed::None => Confinement::None,
                Pressed::Vecchio => Confinement::Vecchio,
            };
        }
        self.crack_spacing_mm = given.crack_spacing_mm.unwrap_or(self.crack_spacing_mm);
        self.fixing_share = given.fixing_share.unwrap_or(self.fixing_share);
        self.shear_floor = given.shear_floor.unwrap_or(self.shear_floor);
        self.band_factor = given.band_factor.unwrap_or(self.band_factor);
        self.tensile_strength_factor = given
            .tensile_strength_factor
            .unwrap_or(self.tensile_strength_factor);
        self.fracture_energy_factor = given
            .fracture_energy_factor
            .unwrap_or(self.fracture_energy_factor);
        self.crushing_energy_factor = given
            .crushing_energy_factor
            .unwrap_or(self.crushing_energy_factor);
        self
    }

    /// Crack-band width (mm) of the average concrete element: the length over which a dowel acts.
    pub(super) fn nominal_band_width(&self, specimen: &Specimen) -> f64 {
        let [nx, ny] = [self.mesh.nx, self.mesh.ny].map(|n| n as f64);
        let area = specimen.beam.length_mm.get() / nx * specimen.beam.height_mm.get() / ny;
        self.band_factor() * area.sqrt()
    }

    const fn band_factor(&self) -> f64 {
        match self.law {
            Law::FixedCrack => self.band_factor,
            Law::Reference | Law::Objective => 1.0,
        }
    }

    /// Crack-band width of concrete elements.
    pub const fn band_width(&self) -> BandWidth {
        BandWidth::InPlane {
            normal: [0.0, 0.0, 1.0],
            factor: self.band_factor(),
        }
    }
}
