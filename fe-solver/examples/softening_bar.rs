//! A concrete bar of 300 mm in tension that cracks in its middle, under displacement control.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::grid::GridBuilder;
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters, TensionSoftening};
use fe_solver::control::StepControl;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::recorder::{Continue, Recorder, StepView};
use fe_solver::stage::Stage;

const LENGTH: f64 = 300.0;
/// Fracture energy (N/mm) and critical opening of the crack, 2 GF/ft (mm).
const ENERGY: f64 = 0.08;
const OPENING: f64 = 2.0 * ENERGY / 2.2;

/// Force and displacement of the end.
#[derive(Default)]
struct Curve(Vec<[f64; 2]>);

impl Recorder for Curve {
    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue> {
        self.0.push([view.load, view.lambda]);
        Ok(Continue::Yes)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut grid = GridBuilder::new();
    let (x, side) = ([0.0, 100.0, 200.0, LENGTH], [0.0, 10.0]);
    grid.add_box("bar", &x, &side, &side);
    let mesh = grid.finish()?;
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    for (cell, strength) in mesh.blocks()[0].cells().zip([2.5, 2.2, 2.5]) {
        let nodes = std::array::from_fn(|a| cell[a]);
        let coords = nodes.map(|n| mesh.nodes()[n]);
        let mut concrete = FixedCrackParameters::from_strength(30.0, strength, 30_000.0);
        (concrete.poisson, concrete.fracture_energy) = (0.0, ENERGY);
        concrete.tension_softening = TensionSoftening::Linear;
        let law = Arc::new(FixedCrack::new(concrete, None)?);
        let (rule, band) = (HexRule::Full, BandWidth::Fixed(100.0));
        elements.push(Box::new(Hex20::new(nodes, &coords, rule, law, band)?));
    }
    let model = Model::new(mesh, elements)?;
    let mut conditions = Conditions::new(&model);
    for (node, x) in model.mesh().nodes().iter().enumerate() {
        conditions.fix(&model, node, Dof::Uy)?;
        conditions.fix(&model, node, Dof::Uz)?;
        if x[0] == 0.0 || x[0] == LENGTH {
            conditions.prescribe(&model, node, Dof::Ux, x[0] / LENGTH)?;
        }
    }

    let mut state = StateStore::new(model.elements());
    let rest = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, rest)?;
    let mut driver = NewtonRaphson::new(NewtonSettings::default());
    let mut curve = Curve::default();
    StepControl::new(5e-4, 0.98 * OPENING).run(&mut stage, &mut driver, &mut curve)?;

    let trapezium = |p: &[[f64; 2]]| 0.5 * (p[0][0] + p[1][0]) * (p[1][1] - p[0][1]);
    let energy = curve.0.windows(2).map(trapezium).sum::<f64>() / 100.0;
    println!("{energy:.4} N/mm dissipated, fracture energy {ENERGY:.4} N/mm");
    assert!((energy / ENERGY - 1.0).abs() < 5e-3);
    Ok(())
}
