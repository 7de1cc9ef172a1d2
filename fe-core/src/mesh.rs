//! Nodes, cells grouped in blocks, and named node sets.

use std::collections::BTreeMap;

/// Index of a node.
pub type NodeId = usize;

/// Shape of a cell; node order as in VTK.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellKind {
    /// 20-node hexahedron (VTK type 25): 8 corners, 4 mid-sides below (0-1, 1-2, 2-3, 3-0), 4 above
    /// (4-5, 5-6, 6-7, 7-4), 4 upright (0-4, 1-5, 2-6, 3-7).
    Hex20,
    /// 8-node quadrilateral (VTK type 23): 4 corners, then the mid-sides 0-1, 1-2, 2-3, 3-0.
    Quad8,
}

impl CellKind {
    /// Nodes of a cell.
    pub const fn nodes(self) -> usize {
        match self {
            Self::Hex20 => 20,
            Self::Quad8 => 8,
        }
    }

    /// Cell type number of VTK.
    pub const fn vtk_type(self) -> u8 {
        match self {
            Self::Hex20 => 25,
            Self::Quad8 => 23,
        }
    }
}

/// Cells of one kind that share a name: a material region.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// Name, unique in the mesh.
    pub name: String,
    /// Shape of every cell.
    pub kind: CellKind,
    /// Nodes of all cells, one after the other.
    connectivity: Vec<NodeId>,
}

impl Block {
    /// Nodes of each cell.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = &[NodeId]> {
        self.connectivity.chunks_exact(self.kind.nodes())
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.connectivity.len() / self.kind.nodes()
    }

    /// Whether the block has no cell.
    pub fn is_empty(&self) -> bool {
        self.connectivity.is_empty()
    }
}

/// What is wrong with a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A block refers to a node that does not exist.
    #[error("block {block}: cell {cell} refers to node {node}, but there are {nodes} nodes")]
    NoSuchNode {
        /// Block.
        block: String,
        /// Cell, counted from 0.
        cell: usize,
        /// Node asked for.
        node: NodeId,
        /// Nodes there are.
        nodes: usize,
    },
    /// The list of nodes is not a whole number of cells.
    #[error("block {block}: {given} node numbers are not a multiple of {per_cell}")]
    RaggedConnectivity {
        /// Block.
        block: String,
        /// Entries given.
        given: usize,
        /// Nodes per cell.
        per_cell: usize,
    },
    /// A name is used twice.
    #[error("the name {0} is used twice; give every block and node set its own")]
    DuplicateName(String),
    /// A block of boxes has no cell.
    #[error("block {0} has no cell: give at least two lines in each direction")]
    NoCell(String),
    /// Lines of a box lie on one another or run backwards.
    #[error("block {0} has lines that do not ascend: sort them, each one once")]
    Lines(String),
    /// A node lies so far from the origin that it cannot be told from others.
    #[error(
        "node {0} lies beyond 9e12 mm, where nodes cannot be told apart: give coordinates in mm, from an origin near the body"
    )]
    Far(NodeId),
    /// A layer is asked for over a node of no face.
    #[error(
        "node {0} is on none of the faces that the layers lie over: build the layers over its faces, too"
    )]
    OffFaces(NodeId),
    /// A layer is asked for at another distance than before.
    #[error(
        "layer {layer} lies at {known} mm, not at {distance} mm: give another distance a number of its own"
    )]
    Distance {
        /// Number of the layer.
        layer: usize,
        /// Where it lies (mm).
        known: f64,
        /// Distance asked for (mm).
        distance: f64,
    },
    /// A coordinate is NaN or infinite.
    #[error("node {0} has a coordinate that is not finite")]
    NotFinite(NodeId),
}

/// Nodes (mm), blocks of cells, and named node sets.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    nodes: Vec<[f64; 3]>,
    blocks: Vec<Block>,
    sets: BTreeMap<String, Vec<NodeId>>,
}

impl Mesh {
    /// A mesh with nodes (mm) only.
    ///
    /// # Errors
    ///
    /// [`MeshError::NotFinite`].
    pub fn new(nodes: Vec<[f64; 3]>) -> Result<Self, MeshError> {
        match nodes.iter().position(|x| x.iter().any(|c| !c.is_finite())) {
            Some(bad) => Err(MeshError::NotFinite(bad)),
            None => Ok(Self {
                nodes,
                ..Self::default()
            }),
        }
    }

    /// Adds a node (mm) and returns its index. Sets made before do not take it up.
    ///
    /// # Errors
    ///
    /// [`MeshError::NotFinite`].
    pub fn add_node(&mut self, position: [f64; 3]) -> Result<NodeId, MeshError> {
        let id = self.nodes.len();
        if position.iter().any(|c| !c.is_finite()) {
            return Err(MeshError::NotFinite(id));
        }
        self.nodes.push(position);
        Ok(id)
    }

    /// Adds a block of cells.
    ///
    /// # Errors
    ///
    /// [`MeshError`] for a name used twice, a node that does not exist or a ragged list.
    pub fn add_block(
        &mut self,
        name: &str,
        kind: CellKind,
        connectivity: Vec<NodeId>,
    ) -> Result<(), MeshError> {
        if self.blocks.iter().any(|b| b.name == name) {
            return Err(MeshError::DuplicateName(name.into()));
        }
        let per_cell = kind.nodes();
        if !connectivity.len().is_multiple_of(per_cell) {
            return Err(MeshError::RaggedConnectivity {
                block: name.into(),
                given: connectivity.len(),
                per_cell,
            });
        }
        if let Some(i) = connectivity.iter().position(|&n| n >= self.nodes.len()) {
            return Err(MeshError::NoSuchNode {
                block: name.into(),
                cell: i / per_cell,
                node: connectivity[i],
                nodes: self.nodes.len(),
            });
        }
        self.blocks.push(Block {
            name: name.into(),
            kind,
            connectivity,
        });
        Ok(())
    }

    /// Adds a named node set: all nodes for which `test` holds.
    ///
    /// # Errors
    ///
    /// [`MeshError::DuplicateName`].
    pub fn add_set(
        &mut self,
        name: &str,
        mut test: impl FnMut([f64; 3]) -> bool,
    ) -> Result<&[NodeId], MeshError> {
        if self.sets.contains_key(name) {
            return Err(MeshError::DuplicateName(name.into()));
        }
        let members = (0..self.nodes.len())
            .filter(|&n| test(self.nodes[n]))
            .collect();
        Ok(self.sets.entry(name.into()).or_insert(members))
    }

    /// Coordinates (mm).
    pub fn nodes(&self) -> &[[f64; 3]] {
        &self.nodes
    }

    /// Blocks, in the order they were added.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The block of a name.
    pub fn block(&self, name: &str) -> Option<&Block> {
        self.blocks.iter().find(|b| b.name == name)
    }

    /// Members of a node set; empty for an unknown name.
    pub fn set(&self, name: &str) -> &[NodeId] {
        self.sets.get(name).map_or(&[], Vec::as_slice)
    }

    /// Names of the node sets that have members.
    pub fn set_names(&self) -> impl Iterator<Item = &str> {
        self.sets
            .iter()
            .filter(|(_, members)| !members.is_empty())
            .map(|(name, _)| name.as_str())
    }

    /// Corners of the bounding box (mm).
    pub fn bounding_box(&self) -> [[f64; 3]; 2] {
        let mut corners = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for x in &self.nodes {
            for k in 0..3 {
                corners[0][k] = corners[0][k].min(x[k]);
                corners[1][k] = corners[1][k].max(x[k]);
            }
        }
        corners
    }

    /// Longest side of the bounding box (mm).
    pub fn extent(&self) -> f64 {
        let [low, high] = self.bounding_box();
        (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max)
    }
}
