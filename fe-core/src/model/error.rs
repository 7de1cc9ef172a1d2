//! What can go wrong with a model as a whole.

use crate::dof::Dof;
use crate::element::ElementError;
use crate::mesh::NodeId;

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
    /// An element is asked for that does not exist.
    #[error("element {element} does not exist; the model has {elements} elements, counted from 0")]
    NoSuchElement {
        /// Element asked for.
        element: usize,
        /// Elements there are.
        elements: usize,
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
