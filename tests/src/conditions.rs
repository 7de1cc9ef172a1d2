//! Supports and loads by place.

use fe_core::dof::Dof;
use fe_core::mesh::NodeId;
use fe_core::model::{Conditions, Model, ModelError};

use crate::mesh::{faces, nodes_where};
use fe_elements::loads::face_traction;
use nalgebra::Vector3;

/// Holds DOFs at all nodes that satisfy `test`.
///
/// # Errors
///
/// [`ModelError`] for a DOF that no element uses.
pub fn hold(
    model: &Model,
    conditions: &mut Conditions,
    dofs: &[Dof],
    test: impl Fn([f64; 3]) -> bool,
) -> Result<(), ModelError> {
    for node in nodes_where(model.mesh(), test) {
        for &dof in dofs {
            conditions.fix(model, node, dof)?;
        }
    }
    Ok(())
}

/// Adds nodal forces (N) per unit of the load factor.
///
/// # Errors
///
/// [`ModelError`] for a DOF that no element uses.
pub fn push(
    model: &Model,
    conditions: &mut Conditions,
    forces: &[(NodeId, [f64; 3])],
) -> Result<(), ModelError> {
    for &(node, force) in forces {
        for (dof, component) in Dof::DISPLACEMENTS.into_iter().zip(force) {
            conditions.add_reference(model, node, dof, component)?;
        }
    }
    Ok(())
}

/// Adds a traction (MPa), a function of the outward normal, per unit of the load factor to all faces of
/// hexahedra whose nodes satisfy `test`.
///
/// # Errors
///
/// [`ModelError`] for a DOF that no element uses.
pub fn push_faces(
    model: &Model,
    conditions: &mut Conditions,
    test: impl Fn([f64; 3]) -> bool,
    traction: impl Fn(Vector3<f64>) -> Vector3<f64>,
) -> Result<(), ModelError> {
    for nodes in faces(model.mesh(), test) {
        let coords = nodes.map(|n| model.mesh().nodes()[n]);
        push(
            model,
            conditions,
            &face_traction(&nodes, &coords, &traction),
        )?;
    }
    Ok(())
}
