//! Options of which one is chosen by its name.

use clap::ValueEnum;
use serde::Serialize;

/// Set of modelling choices.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Preset {
    /// The reported strengths are means; 14-point integration, dowel action of the bars; sheets as given
    #[default]
    Physical,
    /// The model of the reference: its law of the concrete, mean strength of 8 MPa more than reported, reduced integration, no
    /// dowel action, fibres of the soffit along the beam, shear modulus of the sheets E/2, bond of strips as under a sheet
    Reference,
    /// The reported strength is characteristic (mean: 8 MPa more); reduced integration, no dowel action, no interlock,
    /// no compression softening, linear softening in tension, half the band width, axes of cracks fixed at the onset, a tenfold floor
    /// of the shear of open cracks, bond of strips as under a sheet
    Characteristic,
}

impl Preset {
    /// Its law of the concrete.
    pub const fn law(self) -> Law {
        match self {
            Self::Reference => Law::Reference,
            Self::Physical | Self::Characteristic => Law::FixedCrack,
        }
    }
}

/// Integration points of the concrete elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Integration {
    /// 2x2x2
    Reduced,
    /// 14 points, as exact as 3x3x3
    Irons,
    /// 3x3x3
    Full,
}

/// Law of the concrete.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Law {
    /// Orthogonal cracks that follow the strain, then stay fixed; crack band, interlock, struts weakened by cracks
    FixedCrack,
    /// The law of the reference: Ottosen surface, fixed cracks
    Reference,
    /// Ottosen surface, softening by fracture energy
    Objective,
}

/// Bond of the sheets.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Bond {
    /// Cohesive interface without thickness
    #[default]
    Cohesive,
    /// No slip: the sheets share the nodes of the concrete
    Perfect,
    /// Two solid layers of adhesive with the cohesive interface between them
    Adhesive,
}

/// Fibres of the sheet on the soffit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum SoffitFibre {
    /// As the specimen says
    Given,
    /// Along the beam
    Along,
}

/// Shear modulus of the sheets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum SheetShear {
    /// As the specimen says
    Given,
    /// Half of Young's modulus along the fibres
    Half,
}

/// Width factor of the bond of strips (Lu et al. 2005).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum StripBond {
    /// Width of the strips over their spacing
    Strip,
    /// As under a sheet that covers the concrete
    Sheet,
}

/// Solution of a step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Driver {
    /// Secant operator with Anderson acceleration
    #[default]
    Secant,
    /// The same in steps limited by events: a snap, a fall of the load or a loss of stability is met in the shortest steps
    Automatic,
    /// Newton-Raphson, tangent renewed at every iteration
    Newton,
    /// Newton-Raphson, tangent kept while it serves
    ModifiedNewton,
    /// Newton-Raphson on laws that lag behind; the viscous work is told
    Viscous,
    /// One linear solve a step, no iteration; the unbalanced force is told
    Implex,
    /// No equilibria: slow motion with fictitious masses, to check the others by; takes minutes
    Explicit,
}

/// Steps whose fields are written for ParaView.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Fields {
    /// No step
    None,
    /// The peak and the last step
    #[default]
    Last,
    /// Every accepted step
    All,
}

/// Name of a value, as on the command line.
pub fn name(value: &impl ValueEnum) -> String {
    let shown = value.to_possible_value();
    shown.map_or_else(String::new, |v| v.get_name().to_owned())
}
