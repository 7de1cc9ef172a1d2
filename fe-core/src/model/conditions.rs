//! The conditions of one load stage.

use std::collections::BTreeMap;

use super::{Model, ModelError};
use crate::dof::Dof;
use crate::mesh::NodeId;

/// Prescribed displacements and external forces of one load stage, driven by a load factor lambda:
///
/// u_c = u_c(start) + lambda p,  f = f_dead + lambda f_ref
///
/// with p the displacement pattern on the constrained DOFs.
#[derive(Debug, Clone, PartialEq)]
pub struct Conditions {
    prescribed: BTreeMap<usize, f64>,
    dead: Vec<f64>,
    reference: Vec<f64>,
}

impl Conditions {
    /// No constraint, no load.
    pub fn new(model: &Model) -> Self {
        let zero = vec![0.0; model.dofs().len()];
        Self {
            prescribed: BTreeMap::new(),
            dead: zero.clone(),
            reference: zero,
        }
    }

    /// Refuses another model than that of [`Self::new`], as far as the numbers of DOFs tell.
    pub(crate) fn admit(&self, model: &Model) -> Result<(), ModelError> {
        let (found, expected) = (self.reference.len(), model.dofs().len());
        if found == expected {
            return Ok(());
        }
        Err(ModelError::ForeignConditions { found, expected })
    }

    /// The [leading](Model::leading) DOF of a condition. Refuses what is no number, and another model than that of
    /// [`Self::new`], as far as the numbers of DOFs tell.
    fn place(
        &self,
        model: &Model,
        node: NodeId,
        dof: Dof,
        quantity: (&'static str, f64),
    ) -> Result<(usize, f64), ModelError> {
        self.admit(model)?;
        let leading = model.leading(node, dof)?;
        model.finite(quantity, node, dof)?;
        Ok(leading)
    }

    /// Holds a DOF where it is: a support or a symmetry plane.
    ///
    /// # Errors
    ///
    /// [`ModelError`] for a node or DOF that is not there.
    pub fn fix(&mut self, model: &Model, node: NodeId, dof: Dof) -> Result<(), ModelError> {
        self.prescribe(model, node, dof, 0.0)
    }

    /// Holds a DOF of every node of a set: a plane of symmetry, with the displacement normal to it.
    ///
    /// # Errors
    ///
    /// [`ModelError::EmptySet`] for a set without nodes, [`ModelError::UnusedDof`] for a node without the DOF; no node is fixed
    /// then.
    pub fn fix_set(&mut self, model: &Model, set: &str, dof: Dof) -> Result<(), ModelError> {
        let nodes = model.mesh().set(set);
        if nodes.is_empty() {
            return Err(ModelError::EmptySet {
                set: set.into(),
                known: match model.mesh().set_names().collect::<Vec<_>>() {
                    names if names.is_empty() => "none".into(),
                    names => names.join(", "),
                },
            });
        }
        let mut fixed = self.clone();
        for &node in nodes {
            fixed.fix(model, node, dof)?;
        }
        *self = fixed;
        Ok(())
    }

    /// Moves a DOF by `rate` (mm) per unit of the load factor. Of two conditions on one DOF, fixings included, the later one
    /// counts.
    ///
    /// # Errors
    ///
    /// [`ModelError`] for a node or DOF that is not there, or a rate that is not a finite number.
    pub fn prescribe(
        &mut self,
        model: &Model,
        node: NodeId,
        dof: Dof,
        rate: f64,
    ) -> Result<(), ModelError> {
        let (d, factor) = self.place(model, node, dof, ("prescribed displacement", rate))?;
        if factor != 0.0 {
            self.prescribed.insert(d, rate / factor);
        } else if rate != 0.0 {
            return Err(model.unused(node, dof));
        }
        Ok(())
    }

    /// Adds a force (N) that acts in full throughout the stage.
    ///
    /// # Errors
    ///
    /// [`ModelError`] for a node or DOF that is not there, another model, or a force that is not a finite number.
    pub fn add_dead(
        &mut self,
        model: &Model,
        node: NodeId,
        dof: Dof,
        force: f64,
    ) -> Result<(), ModelError> {
        let (d, factor) = self.place(model, node, dof, ("dead load", force))?;
        self.dead[d] += factor * force;
        Ok(())
    }

    /// Adds a force (N) per unit of the load factor.
    ///
    /// # Errors
    ///
    /// [`ModelError`] for a node or DOF that is not there, another model, or a force that is not a finite number.
    pub fn add_reference(
        &mut self,
        model: &Model,
        node: NodeId,
        dof: Dof,
        force: f64,
    ) -> Result<(), ModelError> {
        let (d, factor) = self.place(model, node, dof, ("load", force))?;
        self.reference[d] += factor * force;
        Ok(())
    }

    /// Constrained DOFs and their rates (mm per unit of the load factor).
    pub const fn prescribed(&self) -> &BTreeMap<usize, f64> {
        &self.prescribed
    }

    /// External force (N) on all DOFs at a load factor, on the first of them if `out` is shorter; what it has beyond is left as
    /// it is.
    pub fn external(&self, lambda: f64, out: &mut [f64]) {
        for (o, (d, r)) in out.iter_mut().zip(self.dead.iter().zip(&self.reference)) {
            *o = d + lambda * r;
        }
    }

    /// Force (N) that acts in full throughout the stage, all DOFs.
    pub fn dead(&self) -> &[f64] {
        &self.dead
    }

    /// Force (N) per unit of the load factor, all DOFs.
    pub fn reference(&self) -> &[f64] {
        &self.reference
    }
}
