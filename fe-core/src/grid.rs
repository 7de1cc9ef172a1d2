//! Structured hex20 boxes that share their nodes where they touch.

use crate::mesh::{CellKind, Mesh, MeshError, NodeId};
use crate::places::{MERGE, Places};
use crate::shape::hex20;

/// Builds a mesh of hex20 boxes from grid lines; boxes whose lines coincide on a common face share the
/// nodes of that face.
///
/// ```
/// use fe_core::grid::GridBuilder;
///
/// let mut grid = GridBuilder::new();
/// grid.add_box("beam", &[0.0, 50.0, 100.0], &[0.0, 30.0], &[0.0, 20.0]);
/// grid.add_box("plate", &[50.0, 100.0], &[30.0, 35.0], &[0.0, 20.0]);
/// let mesh = grid.finish()?;
/// assert_eq!(mesh.nodes().len(), 32 + 12);
/// # Ok::<(), fe_core::mesh::MeshError>(())
/// ```
#[derive(Debug, Default)]
pub struct GridBuilder {
    nodes: Vec<[f64; 3]>,
    at: Places<3>,
    blocks: Vec<(String, Vec<NodeId>)>,
    /// The first block whose lines do not ascend.
    unordered: Option<String>,
}

impl GridBuilder {
    /// An empty grid.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds one cell between each pair of neighbouring lines (mm, ascending); boxes of the same name
    /// form one block.
    pub fn add_box(&mut self, block: &str, x: &[f64], y: &[f64], z: &[f64]) {
        let lines = [x, y, z];
        let mut steps = lines.iter().flat_map(|l| l.windows(2));
        if steps.any(|pair| pair[1] - pair[0] <= 2.0 * MERGE) {
            self.unordered.get_or_insert_with(|| block.into());
        }
        let mut cells = Vec::new();
        for k in 0..z.len().saturating_sub(1) {
            for j in 0..y.len().saturating_sub(1) {
                for i in 0..x.len().saturating_sub(1) {
                    let first = [i, j, k];
                    for natural in hex20::NODES {
                        let position = std::array::from_fn(|a| {
                            let (low, high) = (lines[a][first[a]], lines[a][first[a] + 1]);
                            low + 0.5 * (natural[a] + 1.0) * (high - low)
                        });
                        cells.push(self.node(position));
                    }
                }
            }
        }
        match self.blocks.iter_mut().find(|(name, _)| name == block) {
            Some((_, own)) => own.extend(cells),
            None => self.blocks.push((block.into(), cells)),
        }
    }

    /// The node at a position, new unless there is one.
    fn node(&mut self, position: [f64; 3]) -> NodeId {
        let next = self.nodes.len();
        if !Places::within(&position) {
            // Not rounded to a place of others: refused in the end.
            self.nodes.push(position);
            return next;
        }
        let id = self.at.number(position, next);
        if id == next {
            self.nodes.push(position);
        }
        id
    }

    /// The mesh.
    ///
    /// # Errors
    ///
    /// [`MeshError::NotFinite`] for a line that is not a number, [`MeshError::Far`] for one beyond 9e12 mm, where nodes cannot be
    /// told apart, [`MeshError::Lines`] for lines that do not ascend,
    /// [`MeshError::NoCell`] for a block without a cell: boxes of fewer than two lines in some direction.
    pub fn finish(self) -> Result<Mesh, MeshError> {
        let far = self.nodes.iter().position(|x| !Places::within(x));
        let mut mesh = Mesh::new(self.nodes)?;
        if let Some(node) = far {
            return Err(MeshError::Far(node));
        }
        if let Some(block) = self.unordered {
            return Err(MeshError::Lines(block));
        }
        for (name, cells) in self.blocks {
            if cells.is_empty() {
                return Err(MeshError::NoCell(name));
            }
            mesh.add_block(&name, CellKind::Hex20, cells)?;
        }
        Ok(mesh)
    }
}
