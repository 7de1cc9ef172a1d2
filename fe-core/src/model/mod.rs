//! A model: mesh, elements, equation numbers; and the conditions of one load stage.

mod conditions;
mod error;

use crate::dof::{Dof, DofMap};
use crate::element::{Element, ElementError, PointSample};
use crate::followers::Followers;
use crate::mesh::{Mesh, NodeId};
use crate::state::StateStore;

pub use conditions::Conditions;
pub use error::ModelError;

/// Mesh, elements and the numbering of their DOFs.
#[derive(Debug)]
pub struct Model {
    mesh: Mesh,
    elements: Vec<Box<dyn Element>>,
    dofs: DofMap,
    followers: Followers,
    sizes: Vec<Size>,
}

/// How much an element has, kept so that it can be looked at before every evaluation.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Size {
    /// DOFs.
    pub(crate) dofs: usize,
    /// History variables.
    history: usize,
}

impl Size {
    fn of(element: &dyn Element) -> Self {
        Self {
            dofs: element.nodes().len() * element.dofs().len(),
            history: element.state_len(),
        }
    }
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
            sizes: elements.iter().map(|e| Size::of(e.as_ref())).collect(),
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

    /// Sizes of the elements.
    pub(crate) fn sizes(&self) -> &[Size] {
        &self.sizes
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
    ///
    /// # Panics
    ///
    /// For a `u` that is shorter than that.
    pub fn displacement(&self, node: NodeId, u: &[f64]) -> [f64; 3] {
        Dof::DISPLACEMENTS.map(|dof| {
            let (leader, factor) = self.followers.dof(node, dof);
            let index = self.dofs.index(leader, dof);
            index.map_or(0.0, |i| factor * u[i])
        })
    }

    /// Displacements (mm) of an element, gathered from the vector of all DOFs.
    ///
    /// # Panics
    ///
    /// For an element that is not there, or a vector that is shorter than that.
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
            let (found, expected) = (state.range(e).len(), self.sizes[e].history);
            ModelError::same("history variables of an element", found, expected)
        })
    }

    /// Calls `visit` for every integration point of an element at the displacement `u` of all DOFs and the committed
    /// `state`.
    ///
    /// # Errors
    ///
    /// [`ModelError::Element`], [`ModelError::NoSuchElement`], and [`ModelError::Foreign`] for displacements or a state of
    /// another model.
    pub fn sample(
        &self,
        element: usize,
        u: &[f64],
        state: &StateStore,
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ModelError> {
        let elements = self.elements.len();
        if element >= elements {
            return Err(ModelError::NoSuchElement { element, elements });
        }
        self.admit_at(element..element + 1, u, state)?;
        self.elements[element]
            .sample(&self.gather(element, u), state.committed(element), visit)
            .map_err(|source| self.locate(element, source))
    }

    /// Wraps an element's error with its place.
    ///
    /// # Panics
    ///
    /// For an element that is not there.
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
