//! STAB-17: a penalty in the place of a bond makes the matrix far worse conditioned; a direct solver does not mind.
//!
//! A strip on a block of concrete of 50 mm x 50 mm x 25 mm. The condition is that of the stiffness scaled to a unit diagonal, by
//! its eigenvalues: 1.4e2 with the 76.9 MPa/mm of a bond, 1.8e5 with 1e6 MPa/mm, 1300 times as much (the catalogue has 1.2e2 and
//! 7.2e4, 600 times, in a mesh it does not state). The solver is held against what cannot be wrong: forces that are the stiffness
//! times given displacements, irregular from node to node, are to give these back. Target: within 1e-10 of the largest at every
//! stiffness; rounding alone allows some 1e-16 times the condition.

use std::sync::Arc;

use fe_contact::{Interface16, InterfaceRule};
use fe_core::dof::Dof;
use fe_core::mesh::{CellKind, Mesh, NodeId};
use fe_core::model::{Conditions, Model};
use fe_core::testing::Random;
use fe_elements::{HexRule, Membrane8, QuadRule};
use fe_materials::Elastic;

use super::stab09_traction::elastic;
use crate::conditions::hold;
use crate::dense::{DenseModel, internal};
use crate::laws;
use crate::mesh::{BLOCK, boxes, faces, hexahedra, lines};
use crate::solve::solve_to;
use crate::stability::{Case, Failure, Figure, Method, Scenario};
use crate::strip::{THICKNESS, YOUNG};

/// A block of concrete of 50 mm x 50 mm x 25 mm, held at its foot, under a strip bonded with a stiffness (MPa/mm).
fn bonded(stiffness: f64) -> Result<(Model, Conditions), Failure> {
    let side = lines(0.0, 50.0, 2);
    let block = boxes(&side, &side, &lines(0.0, 25.0, 1))?;
    let count = block.nodes().len();
    let top = faces(&block, |x| x[2] == 25.0);
    let mut on_top: Vec<NodeId> = top.iter().flatten().copied().collect();
    on_top.sort_unstable();
    on_top.dedup();
    let above = |n: NodeId| count + on_top.partition_point(|&t| t < n);
    let mut nodes = block.nodes().to_vec();
    nodes.extend(on_top.iter().map(|&n| block.nodes()[n]));
    let mut mesh = Mesh::new(nodes)?;
    let connectivity = block.blocks()[0].cells().flatten().copied().collect();
    mesh.add_block(BLOCK, CellKind::Hex20, connectivity)?;
    let mut elements = hexahedra(&mesh, HexRule::Full, &laws::elastic(30_000.0, 0.2)?)?;
    let bond = Arc::new(elastic(stiffness)?);
    let fibres = Arc::new(Elastic::new(YOUNG, 0.0)?);
    let x = [1.0, 0.0, 0.0];
    for face in top {
        let coords = face.map(|n| block.nodes()[n]);
        let sheet = face.map(above);
        let pair = std::array::from_fn(|a| if a < 8 { face[a] } else { sheet[a - 8] });
        let rule = InterfaceRule::Gauss3;
        elements.push(Box::new(Interface16::new(
            pair,
            &coords,
            x,
            rule,
            bond.clone(),
        )?));
        elements.push(Box::new(Membrane8::new(
            sheet,
            &coords,
            THICKNESS,
            QuadRule::Full,
            x,
            fibres.clone(),
        )?));
    }
    let model = Model::new(mesh, elements)?;
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &Dof::DISPLACEMENTS, |x| {
        x[2] == 0.0
    })?;
    Ok((model, conditions))
}

/// Condition of the scaled stiffness, and the largest error of the displacements over the largest of them.
fn measure(stiffness: f64) -> Result<[f64; 2], Failure> {
    let (model, mut conditions) = bonded(stiffness)?;
    let dense = DenseModel::new(&model, &conditions)?;
    let mut random = Random::new(17);
    let mut given = vec![0.0; model.dofs().len()];
    for &dof in &dense.free {
        given[dof] = random.uniform(-1.0, 1.0);
    }
    let force = internal(&model, &given)?;
    for &dof in &dense.free {
        let (node, kind) = model.dofs().owner(dof);
        conditions.add_reference(&model, node, kind, force[dof])?;
    }
    let found = solve_to(1e-9, &model, conditions)?.displacement;
    let error = found.iter().zip(&given).map(|(a, b)| (a - b).abs());
    let largest = given.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    Ok([dense.condition(), error.fold(0.0, f64::max) / largest])
}

fn figures() -> Result<Vec<Figure>, Failure> {
    let mut figures = Vec::new();
    let mut conditions = Vec::new();
    for k in [76.9, 1e3, 1e4, 1e6] {
        let [condition, error] = measure(k)?;
        let name = format!("error of the displacements at {k:e} MPa/mm");
        figures.push(Figure::at_most(name, error, 1e-10));
        conditions.push(condition);
    }
    let [bond, .., penalty] = conditions[..] else {
        return Err("no condition".into());
    };
    let bond = Figure::near("condition at 76.9 MPa/mm", bond, 142.8, 0.01);
    figures.push(bond.measured("1.2e2"));
    let penalty = Figure::near("condition at 1e6 MPa/mm", penalty, 1.843e5, 0.01);
    figures.push(penalty.measured("7.2e4"));
    Ok(figures)
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-17",
    title: "conditioning: a bond stiffness of up to 1e6 MPa/mm",
    remark: "The catalogue does not state the mesh of its conditions.",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
