//! Laws of a case, by name.

use fe_core::kinematics::{Axial, PlaneStress, Solid};
use fe_core::material::{Material, PointContext};
use serde::{Deserialize, Serialize};

use super::concrete::Property;
use super::{CaseError, ConcreteCase};
use crate::concrete::{
    Associated, Calibration, Isochoric, Objective, Ottosen, Reference, ReferenceParameters,
    ShearRetention, TensionStiffening,
};
use crate::fixed_crack::{
    CRUSHING_OVER_FRACTURE, CompressionSoftening, Confinement, FixedCrack, FixedCrackParameters,
    ShearTransfer, TensionSoftening,
};
use crate::{Biso, Elastic, Hardening, Lamina, LaminaParameters, Laminate, Ply, VonMises};

/// A law of this crate with its parameters; units in the names of the fields.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum LawCase {
    /// [`Elastic`] solid.
    Elastic {
        /// Young's modulus (MPa).
        young_mpa: f64,
        /// Poisson's ratio (-).
        poisson: f64,
    },
    /// [`Elastic`] sheet in plane stress.
    ElasticSheet {
        /// Young's modulus (MPa).
        young_mpa: f64,
        /// Poisson's ratio (-).
        poisson: f64,
    },
    /// [`Elastic`] bar.
    ElasticBar {
        /// Young's modulus (MPa).
        young_mpa: f64,
    },
    /// [`VonMises`] solid; the plastic modulus is 0 unless given.
    VonMises {
        /// Young's modulus (MPa).
        young_mpa: f64,
        /// Poisson's ratio (-).
        poisson: f64,
        /// Yield stress (MPa).
        yield_mpa: f64,
        /// Plastic modulus H (MPa).
        #[serde(default)]
        hardening_mpa: f64,
    },
    /// [`Associated`] Ottosen plasticity.
    Associated {
        /// The concrete.
        concrete: ConcreteCase,
    },
    /// [`Isochoric`] Ottosen plasticity.
    Isochoric {
        /// The concrete.
        concrete: ConcreteCase,
    },
    /// [`Objective`] concrete with the crack-band width of the point.
    Objective {
        /// The concrete.
        concrete: ConcreteCase,
        /// Crack-band width h (mm).
        band_width_mm: f64,
    },
    /// [`Reference`] concrete; see [`ReferenceParameters::new`] for what is not given.
    Reference {
        /// The concrete.
        concrete: ConcreteCase,
        /// Cracks that keep tension stiffening.
        stiffening: TensionStiffening,
        /// Shear retention of open cracks.
        #[serde(default)]
        retention: ShearRetention,
        /// Stress after cracking over the tensile strength (-).
        #[serde(default)]
        stiffening_share: Option<f64>,
        /// Strain at which the stiffening ends (-).
        #[serde(default)]
        stiffening_end: Option<f64>,
        /// Least shear factor of open cracks (-).
        #[serde(default)]
        shear_floor: Option<f64>,
    },
    /// [`FixedCrack`] concrete with the crack-band width of the point; see
    /// [`FixedCrackParameters::from_strength`] for what is not given. Cracks open on the Ottosen surface
    /// too unless `ottosen_onset` is false.
    FixedCrack {
        /// The concrete.
        concrete: ConcreteCase,
        /// Crack-band width h (mm).
        band_width_mm: f64,
        /// Crushing energy (N/mm).
        #[serde(default)]
        crushing_energy_n_per_mm: Option<f64>,
        /// Least shear factor of open cracks (-).
        #[serde(default)]
        shear_floor: Option<f64>,
        /// Softening in tension.
        #[serde(default)]
        tension_softening: TensionSoftening,
        /// What carries shear across open cracks.
        #[serde(default)]
        shear_transfer: Option<ShearTransfer>,
        /// What cracks do to the compression across them.
        #[serde(default)]
        compression_softening: CompressionSoftening,
        /// What pressure from the sides does to compression.
        #[serde(default)]
        confinement: Confinement,
        /// Distance of cracks (mm).
        #[serde(default)]
        crack_spacing_mm: Option<f64>,
        /// Share of the strength at which axes are fixed (-).
        #[serde(default)]
        fixing_share: Option<f64>,
        /// Whether cracks open on the Ottosen surface too.
        #[serde(default = "yes")]
        ottosen_onset: bool,
    },
    /// [`Biso::hot_rolled`] bar.
    HotRolledBar {
        /// Young's modulus (MPa).
        young_mpa: f64,
        /// Yield stress (MPa).
        yield_mpa: f64,
        /// Slope after yielding in total strain (MPa).
        tangent_mpa: f64,
        /// Kind of hardening.
        #[serde(default)]
        hardening: Hardening,
    },
    /// [`Biso::cold_worked`] bar.
    ColdWorkedBar {
        /// Young's modulus (MPa).
        young_mpa: f64,
        /// Strength at a strain of 1 % (MPa).
        strength_mpa: f64,
        /// Kind of hardening.
        #[serde(default)]
        hardening: Hardening,
    },
    /// [`Lamina`] in the axes of its fibres.
    Lamina {
        /// The sheet.
        sheet: LaminaParameters,
    },
    /// [`Laminate`].
    Laminate {
        /// The plies, from one face to the other.
        plies: Vec<PlyCase>,
    },
}

/// One ply of a [`LawCase::Laminate`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlyCase {
    /// The sheet.
    pub sheet: LaminaParameters,
    /// Angle from axis 1 of the laminate to the fibres, towards axis 2 (degrees).
    pub angle_deg: f64,
    /// Thickness (mm).
    pub thickness_mm: f64,
}

const fn yes() -> bool {
    true
}

/// A law that is ready to be driven.
#[derive(Debug)]
pub enum BuiltLaw {
    /// Law of a solid.
    Solid(Box<dyn Material<Solid>>),
    /// Law of a sheet.
    PlaneStress(Box<dyn Material<PlaneStress>>),
    /// Law of a bar.
    Axial(Box<dyn Material<Axial>>),
}

impl LawCase {
    /// The point the law is driven at: inviscid, with the crack-band width of the case. Laws that have
    /// none do not use it.
    pub const fn context(&self) -> PointContext {
        match self {
            Self::Objective { band_width_mm, .. } | Self::FixedCrack { band_width_mm, .. } => {
                PointContext::new(*band_width_mm)
            }
            _ => PointContext::new(0.0),
        }
    }

    /// The law.
    ///
    /// # Errors
    ///
    /// [`CaseError::Law`] if a parameter is impossible, [`CaseError::Strength`], [`CaseError::Unused`].
    pub fn build(&self) -> Result<BuiltLaw, CaseError> {
        Ok(match self {
            Self::Elastic { young_mpa, poisson } => solid(Elastic::new(*young_mpa, *poisson)?),
            Self::ElasticSheet { young_mpa, poisson } => {
                BuiltLaw::PlaneStress(Box::new(Elastic::new(*young_mpa, *poisson)?))
            }
            Self::ElasticBar { young_mpa } => {
                BuiltLaw::Axial(Box::new(Elastic::new(*young_mpa, 0.0)?))
            }
            Self::VonMises {
                young_mpa,
                poisson,
                yield_mpa,
                hardening_mpa,
            } => solid(VonMises::new(
                *young_mpa,
                *poisson,
                *yield_mpa,
                *hardening_mpa,
            )?),
            Self::Associated { concrete } => {
                let c = concrete.build_for("Associated", Property::FractureEnergy)?;
                solid(Associated::new(&c)?)
            }
            Self::Isochoric { concrete } => {
                let c = concrete.build_for("Isochoric", Property::FractureEnergy)?;
                solid(Isochoric::new(&c)?)
            }
            Self::Objective { concrete, .. } => {
                let c = concrete.build_for("Objective", Property::LimitStrain)?;
                solid(Objective::new(&c)?)
            }
            Self::Reference {
                concrete,
                stiffening,
                retention,
                stiffening_share,
                stiffening_end,
                shear_floor,
            } => {
                let c = concrete.build_for("Reference", Property::FractureEnergy)?;
                let default = ReferenceParameters::new(c, *stiffening);
                solid(Reference::new(&ReferenceParameters {
                    retention: *retention,
                    stiffening_share: stiffening_share.unwrap_or(default.stiffening_share),
                    stiffening_end: stiffening_end.unwrap_or(default.stiffening_end),
                    shear_floor: shear_floor.unwrap_or(default.shear_floor),
                    ..default
                })?)
            }
            Self::FixedCrack {
                concrete,
                crushing_energy_n_per_mm,
                shear_floor,
                tension_softening,
                shear_transfer,
                compression_softening,
                confinement,
                crack_spacing_mm,
                fixing_share,
                ottosen_onset,
                ..
            } => {
                let c = concrete.build_for("FixedCrack", Property::LimitStrain)?;
                let default =
                    FixedCrackParameters::from_strength(c.fcm_mpa, c.fctm_mpa, c.young_mpa);
                let p = FixedCrackParameters {
                    poisson: c.poisson,
                    eps_c1: c.eps_c1,
                    fracture_energy: c.fracture_energy,
                    crushing_energy: crushing_energy_n_per_mm
                        .unwrap_or(CRUSHING_OVER_FRACTURE * c.fracture_energy),
                    shear_floor: shear_floor.unwrap_or(default.shear_floor),
                    tension_softening: *tension_softening,
                    shear_transfer: shear_transfer.unwrap_or(default.shear_transfer),
                    compression_softening: *compression_softening,
                    confinement: *confinement,
                    crack_spacing_mm: crack_spacing_mm.unwrap_or(default.crack_spacing_mm),
                    fixing_share: fixing_share.unwrap_or(default.fixing_share),
                    ..default
                };
                let calibration = Calibration::model_code(c.fcm_mpa, c.fctm_mpa);
                let surface = ottosen_onset
                    .then(|| Ottosen::new(&calibration))
                    .transpose()?;
                solid(FixedCrack::new(p, surface)?)
            }
            Self::HotRolledBar {
                young_mpa,
                yield_mpa,
                tangent_mpa,
                hardening,
            } => {
                let bar = Biso::hot_rolled(*young_mpa, *yield_mpa, *tangent_mpa)?;
                BuiltLaw::Axial(Box::new(bar.with_hardening(*hardening)))
            }
            Self::ColdWorkedBar {
                young_mpa,
                strength_mpa,
                hardening,
            } => {
                let bar = Biso::cold_worked(*young_mpa, *strength_mpa)?;
                BuiltLaw::Axial(Box::new(bar.with_hardening(*hardening)))
            }
            Self::Lamina { sheet } => BuiltLaw::PlaneStress(Box::new(Lamina::new(sheet)?)),
            Self::Laminate { plies } => {
                let plies = plies.iter().map(PlyCase::build).collect::<Result<_, _>>()?;
                BuiltLaw::PlaneStress(Box::new(Laminate::new(plies)?))
            }
        })
    }
}

fn solid(law: impl Material<Solid> + 'static) -> BuiltLaw {
    BuiltLaw::Solid(Box::new(law))
}

impl PlyCase {
    fn build(&self) -> Result<Ply, CaseError> {
        Ok(Ply {
            lamina: Lamina::new(&self.sheet)?,
            angle_deg: self.angle_deg,
            thickness_mm: self.thickness_mm,
        })
    }
}
