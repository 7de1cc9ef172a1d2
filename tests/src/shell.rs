//! Shells: elements on the quadrilaterals of a mesh, and loads on them.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError};
use fe_core::mesh::{Block, CellKind, Mesh, NodeId};
use fe_core::model::{Conditions, Model, ModelError};
use fe_elements::loads::face_traction;
use fe_elements::{Layer, QuadRule, Shell8, ShellSection};
use fe_materials::Elastic;
use nalgebra::Vector3;

use crate::conditions::push;

/// Both rules of the shell.
pub const RULES: [QuadRule; 2] = [QuadRule::Reduced, QuadRule::Full];

/// A homogeneous isotropic section.
///
/// # Panics
///
/// For impossible elastic constants.
pub fn isotropic(young: f64, poisson: f64, thickness_mm: f64) -> ShellSection {
    let law = Elastic::new(young, poisson).expect("elastic constants");
    let shear = young / (2.0 * (1.0 + poisson));
    ShellSection::new(vec![Layer {
        thickness_mm,
        angle_deg: 0.0,
        law: Arc::new(law),
        shear_mpa: [shear, shear],
    }])
}

/// Nodes and places of the quadrilaterals of the mesh.
pub fn cells(mesh: &Mesh) -> impl Iterator<Item = ([NodeId; 8], [[f64; 3]; 8])> + '_ {
    let blocks = mesh.blocks().iter().filter(|b| b.kind == CellKind::Quad8);
    blocks.flat_map(Block::cells).map(|cell| {
        let nodes: [NodeId; 8] = std::array::from_fn(|a| cell[a]);
        (nodes, nodes.map(|n| mesh.nodes()[n]))
    })
}

/// One shell in every quadrilateral of the mesh, axis 1 of the section along the projection of `axis`.
///
/// # Errors
///
/// [`ElementError`].
pub fn shells(
    mesh: &Mesh,
    section: &ShellSection,
    rule: QuadRule,
    axis: [f64; 3],
) -> Result<Vec<Box<dyn Element>>, ElementError> {
    let element = |(nodes, coords)| {
        let element = Shell8::new(nodes, &coords, section, rule, axis)?;
        Ok(Box::new(element) as Box<dyn Element>)
    };
    cells(mesh).map(element).collect()
}

/// Adds a force per area (MPa) to every quadrilateral, per unit of the load factor.
///
/// # Errors
///
/// [`ModelError`] for a DOF that no element uses.
pub fn push_area(
    model: &Model,
    conditions: &mut Conditions,
    traction: [f64; 3],
) -> Result<(), ModelError> {
    for (nodes, coords) in cells(model.mesh()) {
        let forces = face_traction(&nodes, &coords, |_| Vector3::from(traction));
        push(model, conditions, &forces)?;
    }
    Ok(())
}

/// Holds single DOFs at every node where `test` says so.
///
/// # Errors
///
/// [`ModelError`] for a DOF that no element uses.
pub fn hold_where(
    model: &Model,
    conditions: &mut Conditions,
    test: impl Fn([f64; 3], Dof) -> bool,
) -> Result<(), ModelError> {
    for (node, &x) in model.mesh().nodes().iter().enumerate() {
        for dof in Dof::ALL {
            if test(x, dof) {
                conditions.fix(model, node, dof)?;
            }
        }
    }
    Ok(())
}
