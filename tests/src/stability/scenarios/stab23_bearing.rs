//! STAB-23: a uniform pressure on 20-node hexahedra has consistent forces of -1/12 at the corners; on a unilateral bearing
//! with points of contact at the nodes no corner may lift.

use std::sync::Arc;

use fe_contact::{Interface16, InterfaceRule};
use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::mesh::{CellKind, Mesh, NodeId};
use fe_core::model::{Conditions, Model};
use fe_elements::HexRule;
use fe_elements::loads::face_traction;
use nalgebra::Vector3;

use super::stab09_traction::elastic;
use crate::conditions::push;
use crate::laws;
use crate::mesh::{BLOCK, boxes, faces, hexahedra, lines};
use crate::solve::solve;
use crate::stability::{Case, Failure, Figure, Method, Scenario};

/// Least and largest normal traction (MPa) below a block under 1 MPa, for an interface rule.
fn tractions(rule: InterfaceRule) -> Result<[f64; 2], Failure> {
    let line = lines(0.0, 100.0, 2);
    let block = boxes(&line, &line, &lines(0.0, 50.0, 1))?;
    let count = block.nodes().len();
    let mut nodes = block.nodes().to_vec();
    nodes.extend_from_slice(block.nodes());
    let mut mesh = Mesh::new(nodes)?;
    let connectivity: Vec<NodeId> = block.blocks()[0].cells().flatten().copied().collect();
    mesh.add_block(BLOCK, CellKind::Hex20, connectivity)?;
    let mut elements = hexahedra(&mesh, HexRule::Full, &laws::elastic(30_000.0, 0.0)?)?;
    let solid = elements.len();
    let law = Arc::new(elastic(1e4)?);
    for face in faces(&block, |x| x[2] == 0.0) {
        let coords = face.map(|n| block.nodes()[n]);
        let pair = std::array::from_fn(|a| if a < 8 { face[a] } else { count + face[a - 8] });
        let contact = Interface16::new(pair, &coords, [1.0, 0.0, 0.0], rule, law.clone())?;
        elements.push(Box::new(contact) as Box<dyn Element>);
    }
    let ground: Vec<NodeId> = faces(&block, |x| x[2] == 0.0)
        .into_iter()
        .flatten()
        .map(|n| count + n)
        .collect();
    let model = Model::new(mesh, elements)?;
    let mut conditions = Conditions::new(&model);
    for node in ground {
        for dof in Dof::DISPLACEMENTS {
            conditions.fix(&model, node, dof)?;
        }
    }
    for node in (0..count).filter(|&n| block.nodes()[n][2] > 0.0) {
        conditions.fix(&model, node, Dof::Ux)?;
        conditions.fix(&model, node, Dof::Uy)?;
    }
    for nodes in faces(&block, |x| x[2] == 50.0) {
        let coords = nodes.map(|n| block.nodes()[n]);
        let forces = face_traction(&nodes, &coords, |_| -Vector3::z());
        push(&model, &mut conditions, &forces)?;
    }
    let solution = solve(&model, conditions)?;
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for (e, element) in model.elements().iter().enumerate().skip(solid) {
        let u = model.gather(e, &solution.displacement);
        element.sample(&u, solution.state.committed(e), &mut |s| {
            range = [range[0].min(s.stress[2]), range[1].max(s.stress[2])];
        })?;
    }
    Ok(range)
}

fn figures() -> Result<Vec<Figure>, Failure> {
    let mut figures = Vec::new();
    for rule in [InterfaceRule::Gauss3, InterfaceRule::Lobatto3] {
        let [least, largest] = tractions(rule)?;
        figures.push(Figure::near(
            format!("least traction, {rule:?}, MPa"),
            least,
            -1.0,
            1e-6,
        ));
        figures.push(Figure::near(
            format!("largest traction, {rule:?}, MPa"),
            largest,
            -1.0,
            1e-6,
        ));
    }
    Ok(figures)
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-23",
    title: "bearing: no corner lifts under a uniform pressure",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
