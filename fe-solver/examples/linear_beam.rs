//! A bare concrete beam on two line supports, pushed down by 1 mm along two lines: one linear solution.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, EvaluationContext};
use fe_core::grid::GridBuilder;
use fe_core::material::Operator;
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::Elastic;
use fe_solver::stage::Stage;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let lines = |end: f64, n: i32| (0..=n).map(|i| end * f64::from(i) / f64::from(n)).collect();
    let (x, y): (Vec<f64>, Vec<f64>) = (lines(3050.0, 60), lines(305.0, 4));
    let mut grid = GridBuilder::new();
    grid.add_box("beam", &x, &y, &[0.0, 75.0]);
    let mesh = grid.finish()?;
    let law = Arc::new(Elastic::new(30_000.0, 0.2)?);
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    for cell in mesh.blocks()[0].cells() {
        let nodes = std::array::from_fn(|a| cell[a]);
        let coords = nodes.map(|n| mesh.nodes()[n]);
        let band = BandWidth::CubeRoot;
        elements.push(Box::new(Hex20::new(
            nodes,
            &coords,
            HexRule::Reduced,
            law.clone(),
            band,
        )?));
    }
    let model = Model::new(mesh, elements)?;

    // Half of a beam: z = 0 is a plane of symmetry. Supports and loads at the corner nodes of lines.
    let mut conditions = Conditions::new(&model);
    let mut supports = Vec::new();
    let on =
        |p: [f64; 3], line: usize, height: f64| (p[0] - x[line]).abs() < 1e-6 && p[1] == height;
    for (node, &p) in model.mesh().nodes().iter().enumerate() {
        if p[2] == 0.0 {
            conditions.fix(&model, node, Dof::Uz)?;
        }
        if on(p, 12, 0.0) {
            conditions.fix(&model, node, Dof::Ux)?;
        }
        if on(p, 12, 0.0) || on(p, 48, 0.0) {
            conditions.fix(&model, node, Dof::Uy)?;
            supports.push(model.dof(node, Dof::Uy)?);
        }
        if on(p, 27, 305.0) || on(p, 33, 305.0) {
            conditions.prescribe(&model, node, Dof::Uy, -1.0)?;
        }
    }

    let mut state = StateStore::new(model.elements());
    let rest = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, rest.clone())?;
    stage.residual(&rest, 0.0, &EvaluationContext::new(Operator::Tangent))?;
    stage.factorise()?;
    let mut free = stage.reference_load();
    stage.solve(&mut free)?;
    let u = stage.compose(&free, 1.0);
    stage.residual(&u, 1.0, &EvaluationContext::new(Operator::None))?;

    let reaction: f64 = supports.iter().map(|&d| stage.reaction(d)).sum();
    println!("{reaction:.2} N at 1 mm");
    // Several codes agree on this number to the last digit.
    assert!((reaction - 41_128.09).abs() < 0.01);
    Ok(())
}
