//! Degrees of freedom and their numbering.

use crate::element::Element;
use crate::mesh::{Mesh, NodeId};
use crate::model::ModelError;

/// A nodal degree of freedom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Dof {
    /// Displacement along x (mm).
    Ux,
    /// Displacement along y (mm).
    Uy,
    /// Displacement along z (mm).
    Uz,
    /// Rotation about x (rad).
    Rx,
    /// Rotation about y (rad).
    Ry,
    /// Rotation about z (rad).
    Rz,
}

impl Dof {
    /// All DOFs, in order.
    pub const ALL: [Self; 6] = [Self::Ux, Self::Uy, Self::Uz, Self::Rx, Self::Ry, Self::Rz];
    /// The three displacements of a solid.
    pub const DISPLACEMENTS: [Self; 3] = [Self::Ux, Self::Uy, Self::Uz];
}

impl std::fmt::Display for Dof {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(["ux", "uy", "uz", "rx", "ry", "rz"][*self as usize])
    }
}

/// Indices of every (node, DOF) that some element uses.
///
/// Nodes are numbered along the longest axis of the mesh (then the next longest, then the
/// shortest), which keeps the profile of a slender beam as small as a fill-reducing ordering
/// would; DOFs of a node are consecutive.
#[derive(Debug, Clone)]
pub struct DofMap {
    /// Index of each DOF by node.
    index: Vec<[u32; 6]>,
    owner: Vec<(NodeId, Dof)>,
}

const UNUSED: u32 = u32::MAX;

impl DofMap {
    /// Numbers the DOFs that `elements` use.
    ///
    /// # Errors
    ///
    /// [`ModelError::NoSuchNode`] for an element on a node that the mesh does not have.
    pub fn new(mesh: &Mesh, elements: &[Box<dyn Element>]) -> Result<Self, ModelError> {
        let nodes = mesh.nodes().len();
        let mut used = vec![[false; 6]; nodes];
        for element in elements {
            for &node in element.nodes() {
                if node >= nodes {
                    return Err(ModelError::NoSuchNode { node, nodes });
                }
                for &dof in element.dofs() {
                    used[node][dof as usize] = true;
                }
            }
        }
        let mut index = vec![[UNUSED; 6]; used.len()];
        let mut owner = Vec::new();
        for node in order_along_longest_axis(mesh) {
            for dof in Dof::ALL {
                if used[node][dof as usize] {
                    index[node][dof as usize] = owner.len() as u32;
                    owner.push((node, dof));
                }
            }
        }
        Ok(Self { index, owner })
    }

    /// Number of DOFs, constrained ones included.
    pub fn len(&self) -> usize {
        self.owner.len()
    }

    /// Whether there is no DOF.
    pub fn is_empty(&self) -> bool {
        self.owner.is_empty()
    }

    /// Index of a DOF, or `None` where no element uses it.
    pub fn index(&self, node: NodeId, dof: Dof) -> Option<usize> {
        let i = self.index.get(node)?[dof as usize];
        (i != UNUSED).then_some(i as usize)
    }

    /// Node and DOF of an index.
    ///
    /// # Panics
    ///
    /// For an index that is not below [`Self::len`].
    pub fn owner(&self, index: usize) -> (NodeId, Dof) {
        self.owner[index]
    }

    /// Indices of an element's DOFs, node-major.
    pub fn element_dofs(&self, element: &dyn Element) -> Vec<u32> {
        element
            .nodes()
            .iter()
            .flat_map(|&n| {
                element
                    .dofs()
                    .iter()
                    .map(move |&d| self.index[n][d as usize])
            })
            .collect()
    }
}

/// Nodes sorted along the longest extent, ties along the next ones.
fn order_along_longest_axis(mesh: &Mesh) -> Vec<NodeId> {
    let [low, high] = mesh.bounding_box();
    let mut axes = [0, 1, 2];
    axes.sort_by(|&a, &b| (high[b] - low[b]).total_cmp(&(high[a] - low[a])));
    let mut order: Vec<NodeId> = (0..mesh.nodes().len()).collect();
    let x = mesh.nodes();
    order.sort_by(|&a, &b| {
        axes.iter()
            .map(|&k| x[a][k].total_cmp(&x[b][k]))
            .find(|o| o.is_ne())
            .unwrap_or_else(|| a.cmp(&b))
    });
    order
}
