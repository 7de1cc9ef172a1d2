//! What the size of the elements costs in bond: the pull-out of a long strip, with elements of the size they
//! have in the beam, against its closed form.

use std::io;

use fe_contact::{Interface16, InterfaceRule, PullOut};
use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::grid::GridBuilder;
use fe_core::mesh::NodeId;
use fe_core::model::{Conditions, Model};
use fe_core::skin::{Layers, outer_faces};
use fe_core::state::StateStore;
use fe_elements::{Membrane8, QuadRule};
use fe_solver::control::StepControl;
use fe_solver::recorder::{Continue, Recorder, StepView};
use fe_solver::secant::SecantAnderson;
use fe_solver::stage::Stage;

use super::RunError;
use crate::analysis::AnalysisError;
use crate::build::{BuildError, SheetRecord};
use crate::results::summary::BondError;
use crate::spec::Face;

/// Bonded length (mm): several times the length that transfers the force.
const LENGTH_MM: f64 = 450.0;
/// Width of the strip (mm); of no influence.
const WIDTH_MM: f64 = 50.0;
/// Steps up to [`END`].
const STEPS: f64 = 120.0;
/// Displacement of the loaded end over the slip without bond.
const END: f64 = 3.5;

struct Largest(f64);

impl Recorder for Largest {
    fn step(&mut self, view: &StepView<'_>) -> io::Result<Continue> {
        self.0 = self.0.max(view.load);
        Ok(Continue::Yes)
    }
}

/// Error of the sheets on the side of a beam; none without such sheets, or where they cannot slip.
pub(super) fn error(model: &Model, sheets: &SheetRecord) -> Result<Option<BondError>, RunError> {
    let on_side = |c: &&crate::build::SheetCell| c.face == Face::Side && c.interface.is_some();
    let Some(first) = sheets.cells.iter().find(on_side) else {
        return Ok(None);
    };
    let Some(ply) = first.laminate.plies().first() else {
        return Ok(None);
    };
    let (sin, cos) = ply.angle_deg.to_radians().sin_cos();
    let size = sheets.cells.iter().filter(on_side).map(|cell| {
        let nodes = model.elements()[cell.membrane].nodes();
        let x = |a: usize| model.mesh().nodes()[nodes[a]];
        let extent = |k: usize| (x(2)[k] - x(0)[k]).abs();
        extent(0) * cos.abs() + extent(1) * sin.abs()
    });
    let size = size.fold(0.0, f64::max);
    let membrane = first.laminate.stiffness_along(ply.angle_deg) * first.laminate.thickness_mm();
    let closed =
        PullOut::new(first.curve, membrane).map_err(|e| solver(BuildError::from(e).into()))?;
    let exact = closed.ultimate();
    let found = strip(size, first).map_err(solver)?;
    Ok(Some(BondError {
        element_mm: size,
        force_n_per_mm: found,
        exact_n_per_mm: exact,
        relative: found / exact - 1.0,
        resolving_mm: closed.longest_element(),
    }))
}

fn solver(error: AnalysisError) -> RunError {
    RunError::Solver {
        specimen: "pull-out of the sheet".into(),
        reason: Box::new(error),
    }
}

/// Largest force per width (N/mm) of a strip of elements `size` (mm) long along the fibres of the first ply.
fn strip(size: f64, cell: &crate::build::SheetCell) -> Result<f64, AnalysisError> {
    let count = (LENGTH_MM / size).ceil().max(4.0);
    let x: Vec<f64> = (0..=count as usize).map(|i| i as f64 * size).collect();
    let mut grid = GridBuilder::new();
    grid.add_box("substrate", &x, &[0.0, WIDTH_MM], &[0.0, 1.0]);
    let mut mesh = grid.finish().map_err(BuildError::from)?;
    let mut faces = outer_faces(&mesh, &["substrate"]);
    faces.retain(|f| f.normal[2] > 0.5);
    let mut layers = Layers::over(&faces);
    let angle = cell.laminate.plies().first().map_or(0.0, |p| p.angle_deg);
    // The fibres lie along x: axis 1 is turned back by their angle.
    let (sin, cos) = angle.to_radians().sin_cos();
    let axis = [cos, -sin, 0.0];
    let law = &cell.bond;
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    let mut held: Vec<NodeId> = Vec::new();
    let mut sheet: Vec<NodeId> = Vec::new();
    for face in &faces {
        let above = layers
            .nodes(&mut mesh, face.nodes, 0, 0.0)
            .map_err(BuildError::from)?;
        let coords = above.map(|n| mesh.nodes()[n]);
        let both = std::array::from_fn(|i| if i < 8 { face.nodes[i] } else { above[i - 8] });
        let laminate = cell.laminate.clone();
        let (thickness, rule) = (laminate.thickness_mm(), QuadRule::Full);
        let membrane = Membrane8::new(above, &coords, thickness, rule, axis, laminate);
        elements.push(Box::new(membrane.map_err(BuildError::from)?));
        let rule = InterfaceRule::Gauss3;
        let interface = Interface16::new(both, &coords, axis, rule, law.clone());
        elements.push(Box::new(interface.map_err(BuildError::from)?));
        held.extend(face.nodes);
        sheet.extend(above);
    }
    let model = Model::new(mesh, elements).map_err(BuildError::from)?;
    let mut conditions = Conditions::new(&model);
    let end = count * size;
    let fix = |conditions: &mut Conditions, node, dof| conditions.fix(&model, node, dof);
    for node in held {
        for dof in Dof::DISPLACEMENTS {
            fix(&mut conditions, node, dof).map_err(BuildError::from)?;
        }
    }
    for node in sheet {
        for dof in [Dof::Uy, Dof::Uz] {
            fix(&mut conditions, node, dof).map_err(BuildError::from)?;
        }
        if (model.mesh().nodes()[node][0] - end).abs() < 1e-9 {
            let moved = conditions.prescribe(&model, node, Dof::Ux, 1.0);
            moved.map_err(BuildError::from)?;
        }
    }
    let mut state = StateStore::new(model.elements());
    let zero = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, zero)?;
    let until = END * law.envelope().final_slip();
    let mut largest = Largest(0.0);
    let control = StepControl::new(until / STEPS, until);
    control.run(&mut stage, &mut SecantAnderson::default(), &mut largest)?;
    Ok(largest.0 / WIDTH_MM)
}
