//! Structured hex20 boxes that share their nodes where they touch.

use std::collections::HashMap;

use crate::mesh::{CellKind, Mesh, MeshError, NodeId};
use crate::shape::hex20;

/// Nodes within half of this (mm) along every axis are one; those farther apart than one and a half of it are two.
const MERGE: f64 = 1e-6;

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
    at: HashMap<[i64; 3], NodeId>,
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
        // A node next door may have been rounded either way, so both neighbours are asked.
        let scaled = position.map(|c| c / MERGE);
        if !scaled.iter().all(|c| c.is_finite()) {
            // Not rounded to a place of others: the mesh refuses it.
            self.nodes.push(position);
            return self.nodes.len() - 1;
        }
        for corner in 0..8 {
            let key = std::array::from_fn(|k| {
                let up = corner >> k & 1 == 1;
                (if up {
                    scaled[k].ceil()
                } else {
                    scaled[k].floor()
                }) as i64
            });
            if let Some(&id) = self.at.get(&key) {
                return id;
            }
        }
        let id = self.nodes.len();
        self.at.insert(scaled.map(|c| c.round() as i64), id);
        self.nodes.push(position);
        id
    }

    /// The mesh.
    ///
    /// # Errors
    ///
    /// [`MeshError::NotFinite`] for a line that is not a number, [`MeshError::Lines`] for lines that do not ascend,
    /// [`MeshError::NoCell`] for a block without a cell: boxes of fewer than two lines in some direction.
    pub fn finish(self) -> Result<Mesh, MeshError> {
        let mut mesh = Mesh::new(self.nodes)?;
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
