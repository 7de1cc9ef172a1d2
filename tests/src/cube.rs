//! A cube of 10 mm and fck = 30 MPa under uniaxial stress, one hexahedron, with the concrete laws and the
//! curves they must follow.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::concrete::{
    ConcreteScalars, Isochoric, Objective, Reference, ReferenceParameters, TensionStiffening,
};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_solver::control::StepControl;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};

use crate::conditions::hold;
use crate::mesh::{boxes, cells, nodes_where};
use crate::solve::run;

/// Edge of the cube, which is also the crack-band width (mm).
pub const EDGE: f64 = 10.0;
/// Characteristic strength (MPa).
pub const FCK: f64 = 30.0;

/// Anything that can go wrong with a scene.
pub type Failure = Box<dyn std::error::Error>;

/// A law with its curves in closed form: stress magnitude (MPa) over strain magnitude.
#[derive(Debug)]
pub struct Case {
    /// Name of the law.
    pub name: &'static str,
    /// The law.
    pub law: Arc<dyn Material<Solid>>,
    /// Curve in tension; none where the law leaves tension to others.
    pub tension: Option<Softening>,
    /// Curve in compression beyond the peak.
    pub crushing: Crushing,
}

/// Tension beyond the strength ft at e0 = ft/E.
#[derive(Debug, Clone, Copy)]
pub enum Softening {
    /// ft exp(-(e - e0)/(ef - e0)), ef = GF/(h ft) + e0/2.
    Exponential,
    /// 0.6 ft (1 - e/0.01), at once.
    Stiffening,
}

/// Compression beyond the strength fcm at ec1.
#[derive(Debug, Clone, Copy)]
pub enum Crushing {
    /// The curve of the Model Code goes on to its limit strain.
    ModelCode,
    /// fcm (1 - ((e - ec1)/w)^2), w = 1.5 Gc/(h fcm).
    Parabola,
    /// fcm (1 - 0.9 (e - ec1)/w), w = 2 Gc/(h fcm).
    Line,
}

/// Mean properties, from the formulas of fib Model Code 2010 (5.1) worked out by hand.
mod concrete {
    pub const FCM: f64 = 38.0;
    pub const PEAK: f64 = 2.3e-3;

    pub fn strength() -> f64 {
        0.3 * super::FCK.powf(2.0 / 3.0)
    }

    pub fn young() -> f64 {
        21_500.0 * (FCM / 10.0_f64).cbrt()
    }

    pub fn fracture_energy() -> f64 {
        0.073 * FCM.powf(0.18)
    }

    pub fn crushing_energy() -> f64 {
        250.0 * fracture_energy()
    }
}

impl Softening {
    /// Stress (MPa) at a tensile strain.
    pub fn stress(self, strain: f64) -> f64 {
        let (strength, young) = (concrete::strength(), concrete::young());
        let onset = strength / young;
        if strain <= onset {
            return young * strain;
        }
        let energy = concrete::fracture_energy() / (EDGE * strength);
        match self {
            Self::Exponential => strength * (-(strain - onset) / (energy - 0.5 * onset)).exp(),
            Self::Stiffening => 0.6 * strength * (1.0 - strain / 0.01),
        }
    }
}

impl Crushing {
    /// Stress magnitude (MPa) at a compressive strain.
    pub fn stress(self, strain: f64) -> f64 {
        let eta = strain / concrete::PEAK;
        let k = concrete::young() * concrete::PEAK / concrete::FCM;
        let beyond = strain - concrete::PEAK;
        let width = concrete::crushing_energy() / (EDGE * concrete::FCM);
        match self {
            Self::Parabola if beyond > 0.0 => {
                concrete::FCM * (1.0 - (beyond / (1.5 * width)).powi(2))
            }
            Self::Line if beyond > 0.0 => concrete::FCM * (1.0 - 0.9 * beyond / (2.0 * width)),
            _ => concrete::FCM * (k * eta - eta * eta) / (1.0 + (k - 2.0) * eta),
        }
    }
}

/// The concrete laws.
///
/// # Errors
///
/// Whatever a law refuses.
pub fn cases() -> Result<Vec<Case>, Failure> {
    let scalars = ConcreteScalars::from_characteristic(FCK)?;
    let cracks = FixedCrackParameters {
        eps_c1: scalars.eps_c1,
        ..FixedCrackParameters::from_strength(scalars.fcm_mpa, scalars.fctm_mpa, scalars.young_mpa)
    };
    let reference = ReferenceParameters::new(scalars, TensionStiffening::Stirrups);
    Ok(vec![
        Case {
            name: "fixed crack",
            law: Arc::new(FixedCrack::new(cracks, None)?),
            tension: Some(Softening::Exponential),
            crushing: Crushing::Line,
        },
        Case {
            name: "objective",
            law: Arc::new(Objective::new(&scalars)?),
            tension: Some(Softening::Exponential),
            crushing: Crushing::Parabola,
        },
        Case {
            name: "reference",
            law: Arc::new(Reference::new(&reference)?),
            tension: Some(Softening::Stiffening),
            crushing: Crushing::ModelCode,
        },
        Case {
            name: "isochoric",
            law: Arc::new(Isochoric::new(&scalars)?),
            tension: None,
            crushing: Crushing::ModelCode,
        },
    ])
}

/// One cubic hexahedron, its crack-band width the side (mm).
///
/// # Errors
///
/// Whatever mesh, law or element refuse.
pub fn cell(side: f64, rule: HexRule, law: Arc<dyn Material<Solid>>) -> Result<Model, Failure> {
    let line = [0.0, side];
    let mesh = boxes(&line, &line, &line)?;
    let (nodes, coords) = cells(&mesh, &mesh.blocks()[0]).next().ok_or("no cell")?;
    let cube = Hex20::new(nodes, &coords, rule, law, BandWidth::Fixed(side))?;
    Ok(Model::new(mesh, vec![Box::new(cube)])?)
}

/// Mean stress (MPa) at equal steps of strain up to `end`, computed on the cube; the first point is at rest.
///
/// The cube has 27 points: with 8, its softening soon concentrates in half of the points, another path.
///
/// # Errors
///
/// Whatever element, model or solver refuse.
pub fn curve(
    law: &Arc<dyn Material<Solid>>,
    end: f64,
    steps: usize,
) -> Result<Vec<[f64; 2]>, Failure> {
    let model = cell(EDGE, HexRule::Full, Arc::clone(law))?;
    let mut conditions = Conditions::new(&model);
    for (axis, dof) in Dof::DISPLACEMENTS.into_iter().enumerate() {
        hold(&model, &mut conditions, &[dof], |x| x[axis] == 0.0)?;
    }
    let loaded = nodes_where(model.mesh(), |x| x[0] == EDGE);
    for &node in &loaded {
        conditions.prescribe(&model, node, Dof::Ux, end * EDGE)?;
    }
    let dofs: Result<Vec<usize>, _> = loaded.iter().map(|&n| model.dof(n, Dof::Ux)).collect();
    let dofs = dofs?;
    let control = StepControl {
        criterion: 1e-8,
        ..StepControl::new(1.0 / steps as f64, 1.0)
    };
    let mut newton = NewtonRaphson::new(NewtonSettings::default());
    let mut points = vec![[0.0, 0.0]];
    let record = |view: &fe_solver::recorder::StepView<'_>| {
        let force: f64 = dofs.iter().map(|&d| view.stage.reaction(d)).sum();
        points.push([view.lambda * end, force / (EDGE * EDGE)]);
    };
    run(&model, conditions, &control, &mut newton, |_| {}, record)?;
    Ok(points)
}
