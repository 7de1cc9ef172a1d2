//! Which law serves which block.

use std::sync::Arc;

use fe_core::kinematics::Solid;
use fe_core::material::{Material, MaterialError};
use fe_core::mesh::Mesh;
use fe_materials::Elastic;
use fe_materials::concrete::{
    Calibration, ConcreteScalars, Objective, Ottosen, Reference, ReferenceParameters,
    TensionStiffening,
};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};

use super::ModelSettings;
use super::mesh::{concrete_block, load_plate, support_plate};
use crate::options::{Law, Preset};
use crate::spec::Specimen;

/// A law shared by the elements of a block.
pub(super) type SolidLaw = Arc<dyn Material<Solid>>;

/// Law of every block of concrete that the mesh has.
pub(super) fn concrete_laws(
    specimen: &Specimen,
    settings: &ModelSettings,
    mesh: &Mesh,
) -> Result<Vec<(&'static str, SolidLaw)>, MaterialError> {
    [true, false]
        .into_iter()
        .map(|stirrups| (concrete_block(stirrups), stirrups))
        .filter(|(block, _)| mesh.block(block).is_some())
        .map(|(block, stirrups)| Ok((block, concrete(specimen, settings, stirrups)?)))
        .collect()
}

/// Mean properties of the concrete as the settings read the report.
fn properties(
    specimen: &Specimen,
    settings: &ModelSettings,
) -> Result<ConcreteScalars, MaterialError> {
    let reported = &specimen.concrete;
    let strength = reported.reported_strength_mpa.get();
    let mut read = match settings.preset {
        Preset::Physical => ConcreteScalars::from_mean(strength)?,
        Preset::Reference | Preset::Characteristic => {
            ConcreteScalars::from_characteristic(strength)?
        }
    };
    if let Some(tensile) = &reported.reported_tensile_mpa
        && settings.preset != Preset::Reference
    {
        read.fctm_mpa = tensile.get();
    }
    read.fctm_mpa *= settings.tensile_strength_factor;
    read.poisson = reported.poisson.get();
    Ok(read)
}

/// Whether the concrete has a law with these settings: not where no convex surface runs through its strengths.
pub(crate) fn has_law(specimen: &Specimen, settings: &ModelSettings) -> bool {
    concrete(specimen, settings, false).is_ok()
}

/// Mean compressive strength (MPa) as the settings read the report.
pub(super) fn mean_strength(
    specimen: &Specimen,
    settings: &ModelSettings,
) -> Result<f64, MaterialError> {
    Ok(properties(specimen, settings)?.fcm_mpa)
}

/// Mean tensile strength (MPa) as the settings read the report.
pub(super) fn tensile_strength(
    specimen: &Specimen,
    settings: &ModelSettings,
) -> Result<f64, MaterialError> {
    Ok(properties(specimen, settings)?.fctm_mpa)
}

/// Law of the concrete in zones with or without stirrups. The fixed-crack law takes the reported modulus,
/// the others that of the Model Code, as the reference does.
fn concrete(
    specimen: &Specimen,
    settings: &ModelSettings,
    stirrups: bool,
) -> Result<SolidLaw, MaterialError> {
    let c = properties(specimen, settings)?;
    Ok(match settings.law {
        Law::FixedCrack => {
            let young = specimen.concrete.young_mpa.get();
            let source = FixedCrackParameters::from_strength(c.fcm_mpa, c.fctm_mpa, young);
            let parameters = FixedCrackParameters {
                fracture_energy: settings.fracture_energy_factor * source.fracture_energy,
                crushing_energy: settings.crushing_energy_factor * source.crushing_energy,
                poisson: c.poisson,
                shear_floor: settings.shear_floor,
                tension_softening: settings.tension_softening,
                shear_transfer: settings.shear_transfer,
                compression_softening: settings.compression_softening,
                confinement: settings.confinement,
                crack_spacing_mm: settings.crack_spacing_mm,
                fixing_share: settings.fixing_share,
                ..source
            };
            let onset = Ottosen::new(&Calibration::model_code(c.fcm_mpa, c.fctm_mpa))?;
            Arc::new(FixedCrack::new(parameters, Some(onset))?)
        }
        Law::Reference => {
            let stiffening = if stirrups {
                TensionStiffening::Stirrups
            } else {
                TensionStiffening::VerticalCracks([0.0, 1.0, 0.0])
            };
            Arc::new(Reference::new(&ReferenceParameters::new(c, stiffening))?)
        }
        Law::Objective => Arc::new(Objective::new(&c)?),
    })
}

/// Elastic law of every plate, by block.
pub(super) fn plates(specimen: &Specimen) -> Result<Vec<(String, SolidLaw)>, MaterialError> {
    let supports = specimen.supports.iter().map(|s| &s.plate).enumerate();
    let loads = specimen.loads.iter().map(|l| &l.plate).enumerate();
    supports
        .map(|(i, plate)| (support_plate(i), plate))
        .chain(loads.map(|(i, plate)| (load_plate(i), plate)))
        .map(|(block, plate)| -> Result<_, MaterialError> {
            let law = Elastic::new(plate.young_mpa.get(), plate.poisson.get())?;
            Ok((block, Arc::new(law) as SolidLaw))
        })
        .collect()
}

/// Weight of the concrete per volume (N/mm3).
pub(super) fn weight_density(specimen: &Specimen) -> f64 {
    specimen.concrete.density_kg_m3.get() * specimen.gravity.acceleration_m_s2.get() * 1e-9
}
