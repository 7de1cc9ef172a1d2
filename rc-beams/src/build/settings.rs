//! How a specimen is modelled: one set for all beams.

use fe_elements::{BandWidth, HexRule};

use super::default_mesh;
use crate::options::{Bond, Law, Preset, SheetShear, SoffitFibre};
use crate::spec::Specimen;

/// Settings of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelSettings {
    /// Named set the settings started from.
    pub preset: Preset,
    /// Elements along, over the height of, and across the half beam.
    pub mesh: [usize; 3],
    /// Integration of the concrete.
    pub integration: HexRule,
    /// Law of the concrete.
    pub law: Law,
    /// Dowel action of bars against shear across cracks.
    pub dowel: bool,
    /// Floor of the shear factor of open cracks (-).
    pub shear_floor: f64,
    /// Bond of the sheets.
    pub bond: Bond,
    /// Fibres of the sheet on the soffit.
    pub soffit_fibre: SoffitFibre,
    /// Shear modulus of the sheets.
    pub sheet_shear: SheetShear,
}

impl ModelSettings {
    /// The settings of a preset on the mesh that suits a specimen, see [`default_mesh`].
    pub fn new(preset: Preset, specimen: &Specimen) -> Self {
        let (integration, dowel, shear_floor) = match preset {
            Preset::Physical | Preset::Reference => (HexRule::Full, true, 1e-4),
            Preset::Characteristic => (HexRule::Reduced, false, 1e-3),
        };
        let (soffit_fibre, sheet_shear) = match preset {
            Preset::Reference => (SoffitFibre::Along, SheetShear::Half),
            Preset::Physical | Preset::Characteristic => (SoffitFibre::Given, SheetShear::Given),
        };
        Self {
            preset,
            mesh: default_mesh(specimen),
            integration,
            law: Law::FixedCrack,
            dowel,
            shear_floor,
            bond: Bond::Cohesive,
            soffit_fibre,
            sheet_shear,
        }
    }

    /// Crack-band width (mm) of the average concrete element: the length over which a dowel acts.
    pub(super) fn nominal_band_width(&self, specimen: &Specimen) -> f64 {
        let [nx, ny, _] = self.mesh.map(|n| n as f64);
        let area = specimen.beam.length_mm.get() / nx * specimen.beam.height_mm.get() / ny;
        self.band_factor() * area.sqrt()
    }

    const fn band_factor(&self) -> f64 {
        match self.law {
            Law::FixedCrack => 0.5,
            Law::Reference | Law::Objective => 1.0,
        }
    }

    /// Crack-band width of concrete elements: half the side of the equivalent square in the plane of
    /// the beam for the fixed-crack law, the full side for the others.
    pub const fn band_width(&self) -> BandWidth {
        BandWidth::InPlane {
            normal: [0.0, 0.0, 1.0],
            factor: self.band_factor(),
        }
    }
}
