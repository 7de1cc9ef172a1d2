//! A cantilever of six hexahedra under a force at its tip, against beam theory.

use std::sync::Arc;

use fe_core::assembly::{Assembled, Assembler};
use fe_core::dof::Dof;
use fe_core::element::{Element, EvaluationContext};
use fe_core::grid::GridBuilder;
use fe_core::material::Operator;
use fe_core::model::{Conditions, Model};
use fe_core::shape::hex20::FACES;
use fe_core::state::StateStore;
use fe_elements::loads::face_traction;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::Elastic;
use nalgebra::{DMatrix, DVector, Vector3};

const LENGTH: f64 = 600.0;
const SIDE: f64 = 100.0;
const YOUNG: f64 = 30_000.0;
const FORCE: f64 = 1000.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let x: Vec<f64> = (0..=6).map(|i| LENGTH / 6.0 * f64::from(i)).collect();
    let mut grid = GridBuilder::new();
    grid.add_box("beam", &x, &[0.0, SIDE], &[0.0, SIDE]);
    let mesh = grid.finish()?;

    let law = Arc::new(Elastic::new(YOUNG, 0.0)?);
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    for cell in mesh.blocks()[0].cells() {
        let nodes = std::array::from_fn(|a| cell[a]);
        let coords = nodes.map(|n| mesh.nodes()[n]);
        let band = BandWidth::CubeRoot;
        elements.push(Box::new(Hex20::new(
            nodes,
            &coords,
            HexRule::Full,
            law.clone(),
            band,
        )?));
    }
    let model = Model::new(mesh, elements)?;

    let mut conditions = Conditions::new(&model);
    for node in (0..model.mesh().nodes().len()).filter(|&n| model.mesh().nodes()[n][0] == 0.0) {
        for dof in Dof::DISPLACEMENTS {
            conditions.fix(&model, node, dof)?;
        }
    }
    let tip = FACES[1].map(|a| model.elements()[5].nodes()[a]);
    let traction = Vector3::new(0.0, -FORCE / (SIDE * SIDE), 0.0);
    for (node, force) in face_traction(&tip, &tip.map(|n| model.mesh().nodes()[n]), |_| traction) {
        conditions.add_reference(&model, node, Dof::Uy, force[1])?;
    }

    let mut assembler = Assembler::new(&model, &conditions)?;
    let mut out = Assembled::default();
    let (rest, mut state) = (
        vec![0.0; model.dofs().len()],
        StateStore::new(model.elements()),
    );
    let ctx = EvaluationContext::new(Operator::Tangent);
    assembler.evaluate(&model, &rest, &mut state, &ctx, &mut out)?;
    let (free, csc) = (assembler.free(), out.matrix.to_csc(assembler.pattern()));
    let k = DMatrix::from_fn(free.len(), free.len(), |i, j| {
        csc.get(i, j).copied().unwrap_or(0.0)
    });
    let f = DVector::from_fn(free.len(), |i, _| conditions.reference()[free[i] as usize]);
    let u = k.cholesky().ok_or("the model is not held")?.solve(&f);

    // Bending, and the shear deflection of a rectangle (shear factor 5/6).
    let bending = FORCE * LENGTH.powi(3) / (3.0 * YOUNG * SIDE.powi(4) / 12.0);
    let shear = FORCE * LENGTH / (5.0 / 6.0 * YOUNG / 2.0 * SIDE * SIDE);
    let deflection = f.dot(&u) / FORCE;
    println!("{deflection:.4} mm, beam theory {:.4} mm", bending + shear);
    assert!((deflection / (bending + shear) - 1.0).abs() < 5e-3);
    Ok(())
}
