//! The bare beam that several codes have solved: a block of 3050 x 305 x 75 mm, half of a beam cut along
//! its plane of symmetry z = 0, on two line supports under two lines of prescribed deflection.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::mesh::NodeId;
use fe_core::model::{Conditions, Model};
use fe_elements::HexRule;
use fe_solver::control::{OnFailure, StepControl};
use fe_solver::error::SolverError;
use fe_solver::secant::{SecantAnderson, SecantSettings};

use crate::mesh::{boxes, hexahedra, lines, nodes_where};
use crate::solve::{Solution, run};

/// Length, depth and half width (mm).
pub const SIZE: [f64; 3] = [3050.0, 305.0, 75.0];
/// Places of the supports and of the loads (mm); each snaps to the nearest corner nodes.
const SUPPORTS: [f64; 2] = [610.0, 2440.0];
const LOADS: [f64; 2] = [1370.0, 1680.0];

/// The beam with its conditions: the load factor is the deflection of the load lines (mm).
#[derive(Debug)]
pub struct BareBeam {
    /// The model.
    pub model: Model,
    /// Supports, plane of symmetry, and load lines moving down.
    pub conditions: Conditions,
    /// Nodes of both support lines.
    pub supports: Vec<NodeId>,
}

impl BareBeam {
    /// The beam at a deflection (mm), reached in six steps of the secant driver; steps that miss the criterion are kept.
    ///
    /// # Errors
    ///
    /// [`SolverError`].
    pub fn bent(&self, deflection: f64) -> Result<Solution, SolverError> {
        let control = StepControl {
            on_failure: OnFailure::Flag,
            ..StepControl::new(deflection / 6.0, deflection)
        };
        let mut driver = SecantAnderson::new(SecantSettings::default());
        let conditions = self.conditions.clone();
        run(
            &self.model,
            conditions,
            &control,
            &mut driver,
            |_| {},
            |_| {},
        )
    }
}

/// Builds the beam with `cells` along x, y, z.
///
/// # Errors
///
/// Whatever mesh, element or model refuse.
pub fn bare_beam(
    cells: [usize; 3],
    rule: HexRule,
    law: &Arc<dyn Material<Solid>>,
) -> Result<BareBeam, Box<dyn std::error::Error>> {
    let [x, y, z]: [Vec<f64>; 3] = std::array::from_fn(|k| lines(0.0, SIZE[k], cells[k]));
    let mesh = boxes(&x, &y, &z)?;
    let elements = hexahedra(&mesh, rule, law)?;
    let line = |place: f64, height: f64| {
        let step = SIZE[0] / cells[0] as f64;
        let snapped = (place / step).round() * step;
        nodes_where(&mesh, |p| (p[0] - snapped).abs() < 1e-6 && p[1] == height)
    };
    let [left, right] = SUPPORTS.map(|place| line(place, 0.0));
    let loads = LOADS.map(|place| line(place, SIZE[1])).concat();
    let symmetry = nodes_where(&mesh, |p| p[2] == 0.0);
    let model = Model::new(mesh, elements)?;
    let mut conditions = Conditions::new(&model);
    for &n in &symmetry {
        conditions.fix(&model, n, Dof::Uz)?;
    }
    for &n in &left {
        conditions.fix(&model, n, Dof::Ux)?;
    }
    let supports = [left, right].concat();
    for &n in &supports {
        conditions.fix(&model, n, Dof::Uy)?;
    }
    for &n in &loads {
        conditions.prescribe(&model, n, Dof::Uy, -1.0)?;
    }
    Ok(BareBeam {
        model,
        conditions,
        supports,
    })
}
