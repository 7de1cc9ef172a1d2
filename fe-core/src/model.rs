//! A model: mesh, elements, equation numbers; and the conditions of one load stage.

use std::collections::BTreeMap;

use crate::dof::{Dof, DofMap};
use crate::element::{Element, ElementError, PointSample};
use crate::followers::Followers;
use crate::mesh::{Mesh, NodeId};
use crate::state::StateStore;

/// What can go wrong with a model as a whole.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// An element failed.
    #[error("element {element} (first node {node} at {position:?} mm): {source}")]
    Element {
        /// Index of the element.
        element: usize,
        /// Its first node.
        node: NodeId,
        /// Position of that node (mm).
        position: [f64; 3],
        /// What the element said.
        source: Box<ElementError>,
    },
    /// A condition names a DOF that no element uses.
    #[error(
        "{dof} of node {node} at {position:?} mm is prescribed or loaded, but no element uses it"
    )]
    UnusedDof {
        /// Node.
        node: NodeId,
        /// DOF.
        dof: Dof,
        /// Position of the node (mm).
        position: [f64; 3],
    },
    /// An element or a condition names a node that does not exist.
    #[error("node {node} does not exist; the mesh has {nodes} nodes")]
    NoSuchNode {
        /// Node asked for.
        node: NodeId,
        /// Nodes there are.
        nodes: usize,
    },
    /// An element is built on no node.
    #[error("element {element} has no node: it could neither move nor be found")]
    NoNode {
        /// Index of the element.
        element: usize,
    },
    /// An element is built on a node that follows another.
    #[error("element {element} has node {node}, which follows another: build it on leaders")]
    OnFollower {
        /// Index of the element.
        element: usize,
        /// Its node.
        node: NodeId,
    },
    /// A node follows one that follows another itself.
    #[error("node {node} follows node {leader}, which follows another: let it follow that one")]
    Chain {
        /// The node.
        node: NodeId,
        /// The node it follows.
        leader: NodeId,
    },
    /// A part of the model can move as a rigid body.
    #[error(
        "the part of {nodes} nodes with node {node} at {position:?} mm can {motion}: support it, or connect it to the rest"
    )]
    NotHeld {
        /// First node of the part.
        node: NodeId,
        /// Position of that node (mm).
        position: [f64; 3],
        /// Nodes of the part.
        nodes: usize,
        /// What it can do.
        motion: &'static str,
    },
    /// Two nodes at one place are not connected.
    #[error(
        "nodes {} and {} both lie at {position:?} mm and no element connects them: use one of them in both elements",
        nodes[0], nodes[1]
    )]
    Seam {
        /// The nodes.
        nodes: [NodeId; 2],
        /// Where they lie (mm).
        position: [f64; 3],
    },
    /// Conditions of another model.
    #[error("the conditions are those of a model with {found} DOFs, this one has {expected}")]
    ForeignConditions {
        /// DOFs of the model that the conditions were made for.
        found: usize,
        /// DOFs of the model at hand.
        expected: usize,
    },
    /// Displacements, states or a numbering of another model.
    #[error("{what}: {found} for a model that has {expected}; build it from the same model")]
    Foreign {
        /// What is counted.
        what: &'static str,
        /// How many are given.
        found: usize,
        /// How many the model at hand has.
        expected: usize,
    },
    /// A load or a prescribed displacement is not a number.
    #[error("the {what} of {dof} of node {node} at {position:?} mm is not a finite number")]
    NotFinite {
        /// Kind of condition.
        what: &'static str,
        /// Node.
        node: NodeId,
        /// DOF.
        dof: Dof,
        /// Position of the node (mm).
        position: [f64; 3],
    },
    /// A node set is empty or does not exist.
    #[error("no node is in the set {set}; the mesh has {known}")]
    EmptySet {
        /// Set asked for.
        set: String,
        /// Sets that have nodes.
        known: String,
    },
}

impl ModelError {
    /// Refuses what another model than the one at hand has so many of.
    pub(crate) const fn same(
        what: &'static str,
        found: usize,
        expected: usize,
    ) -> Result<(), Self> {
        if found == expected {
            return Ok(());
        }
        Err(Self::Foreign {
            what,
            found,
            expected,
        })
    }

    /// Whether a shorter step may cure it.
    pub const fn is_recoverable(&self) -> bool {
        match self {
            Self::Element { source, .. } => source.is_recoverable(),
            _ => false,
        }
    }
}

/// Mesh, elements and the numbering of their DOFs.
#[derive(Debug)]
pub struct Model {
    mesh: Mesh,
    elements: Vec<Box<dyn Element>>,
    dofs: DofMap,
    followers: Followers,
}

impl Model {
    /// Numbers the DOFs of the elements.
    ///
    /// # Errors
    ///
    /// [`ModelError::NoSuchNode`] for an element on a node that the mesh does not have, [`ModelError::NoNode`] for one on none.
    pub fn new(mesh: Mesh, elements: Vec<Box<dyn Element>>) -> Result<Self, ModelError> {
        Self::with_followers(mesh, elements, Followers::default())
    }

    /// The same where some nodes follow others. Elements are built on leaders only; conditions on followers are passed on
    /// to their leaders.
    ///
    /// # Errors
    ///
    /// Those of [`Self::new`], [`ModelError::NoSuchNode`] also for a follower, [`ModelError::OnFollower`] for an element on a
    /// follower, [`ModelError::Chain`] for a follower of a follower.
    pub fn with_followers(
        mesh: Mesh,
        elements: Vec<Box<dyn Element>>,
        followers: Followers,
    ) -> Result<Self, ModelError> {
        let dofs = DofMap::new(&mesh, &elements)?;
        for (element, e) in elements.iter().enumerate() {
            if e.nodes().is_empty() {
                return Err(ModelError::NoNode { element });
            }
            if let Some(&node) = e.nodes().iter().find(|&&n| followers.of(n).0 != n) {
                return Err(ModelError::OnFollower { element, node });
            }
        }
        let nodes = mesh.nodes().len();
        for (node, leader, _) in followers.iter() {
            if let Some(node) = [node, leader].into_iter().find(|&n| n >= nodes) {
                return Err(ModelError::NoSuchNode { node, nodes });
            }
            if followers.of(leader).0 != leader {
                return Err(ModelError::Chain { node, leader });
            }
        }
        Ok(Self {
            mesh,
            elements,
            dofs,
            followers,
        })
    }

    /// Nodes that follow others.
    pub const fn followers(&self) -> &Followers {
        &self.followers
    }

    /// The mesh.
    pub const fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The elements.
    pub fn elements(&self) -> &[Box<dyn Element>] {
        &self.elements
    }

    /// The numbering.
    pub const fn dofs(&self) -> &DofMap {
        &self.dofs
    }

    /// Index of a DOF, or of that of its leader which it equals.
    ///
    /// # Errors
    ///
    /// [`ModelError::NoSuchNode`], or [`ModelError::UnusedDof`] also for a follower that moves otherwise than its leader.
    pub fn dof(&self, node: NodeId, dof: Dof) -> Result<usize, ModelError> {
        match self.leading(node, dof)? {
            (d, 1.0) => Ok(d),
            _ => Err(self.unused(node, dof)),
        }
    }

    /// Index and factor of the DOF that moves a node.
    fn leading(&self, node: NodeId, dof: Dof) -> Result<(usize, f64), ModelError> {
        let nodes = self.mesh.nodes().len();
        if node >= nodes {
            return Err(ModelError::NoSuchNode { node, nodes });
        }
        let (leader, factor) = self.followers.dof(node, dof);
        let index = self.dofs.index(leader, dof);
        index.map_or_else(|| Err(self.unused(node, dof)), |d| Ok((d, factor)))
    }

    /// Makes sure that a condition is a finite number.
    fn finite(
        &self,
        (what, value): (&'static str, f64),
        node: NodeId,
        dof: Dof,
    ) -> Result<(), ModelError> {
        if value.is_finite() {
            return Ok(());
        }
        Err(ModelError::NotFinite {
            what,
            node,
            dof,
            position: self.mesh.nodes()[node],
        })
    }

    fn unused(&self, node: NodeId, dof: Dof) -> ModelError {
        let position = self.mesh.nodes()[node];
        ModelError::UnusedDof {
            node,
            dof,
            position,
        }
    }

    /// Displacement (mm) of a node at the displacement `u` of all DOFs; zero where no element uses the DOF.
    pub fn displacement(&self, node: NodeId, u: &[f64]) -> [f64; 3] {
        Dof::DISPLACEMENTS.map(|dof| {
            let (leader, factor) = self.followers.dof(node, dof);
            let index = self.dofs.index(leader, dof);
            index.map_or(0.0, |i| factor * u[i])
        })
    }

    /// Displacements (mm) of an element, gathered from the vector of all DOFs.
    pub fn gather(&self, element: usize, u: &[f64]) -> Vec<f64> {
        let dofs = self.dofs.element_dofs(self.elements[element].as_ref());
        dofs.iter().map(|&d| u[d as usize]).collect()
    }

    /// Refuses displacements and states of another model, as far as the numbers of DOFs and history variables tell.
    pub(crate) fn admit(&self, u: &[f64], state: &StateStore) -> Result<(), ModelError> {
        self.admit_at(0..self.elements.len(), u, state)
    }

    /// The same for some of the elements.
    fn admit_at(
        &self,
        mut elements: std::ops::Range<usize>,
        u: &[f64],
        state: &StateStore,
    ) -> Result<(), ModelError> {
        let (found, expected) = (state.elements(), self.elements.len());
        ModelError::same("displacements", u.len(), self.dofs.len())?;
        ModelError::same("elements with a state", found, expected)?;
        elements.try_for_each(|e| {
            let (found, expected) = (state.range(e).len(), self.elements[e].state_len());
            ModelError::same("history variables of an element", found, expected)
        })
    }

    /// Calls `visit` for every integration point of an element at the displacement `u` of all DOFs and the committed
    /// `state`.
    ///
    /// # Errors
    ///
    /// [`ModelError::Element`], and [`ModelError::Foreign`] for displacements or a state of another model.
    pub fn sample(
        &self,
        element: usize,
        u: &[f64],
        state: &StateStore,
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ModelError> {
        self.admit_at(element..element + 1, u, state)?;
        self.elements[element]
            .sample(&self.gather(element, u), state.committed(element), visit)
            .map_err(|source| self.locate(element, source))
    }

    /// Wraps an element's error with its place.
    pub fn locate(&self, element: usize, source: ElementError) -> ModelError {
        let node = self.elements[element].nodes()[0];
        ModelError::Element {
            element,
            node,
            position: self.mesh.nodes()[node],
            source: Box::new(source),
        }
    }
}

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

    /// External force (N) on all DOFs at a load factor.
    pub fn external(&self, lambda: f64, out: &mut [f64]) {
        for (o, (d, r)) in out.iter_mut().zip(self.dead.iter().zip(&self.reference)) {
            *o = d + lambda * r;
        }
    }

    /// Force (N) per unit of the load factor, all DOFs.
    pub fn reference(&self) -> &[f64] {
        &self.reference
    }
}
