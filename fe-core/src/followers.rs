//! Nodes that follow others: fewer unknowns where the displacement has a known shape.

use std::collections::BTreeMap;

use crate::dof::Dof;
use crate::mesh::{Mesh, NodeId};
use crate::places::Places;

/// Nodes whose displacement is that of another node, the leader, times a factor for each direction:
/// u_k = s_k u_k(leader). A follower has no DOFs of its own, and a factor of zero holds it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Followers(BTreeMap<NodeId, (NodeId, [f64; 3])>);

impl Followers {
    /// A half body that is uniform across its width: of its `nodes` at one (x, y) the one farthest from the plane of
    /// symmetry z = 0 leads, and the others follow it with u and v the same, w in proportion to z:
    ///
    /// u(x, y, z) = u(x, y),  v(x, y, z) = v(x, y),  w(x, y, z) = z/z_leader w(x, y)
    ///
    /// Nodes within 5e-7 mm along x and y are at one (x, y). Nodes with z < 0, or beyond 9e12 mm, and nodes that the mesh does
    /// not have, are not of the half body and lead themselves.
    pub fn uniform_across(mesh: &Mesh, nodes: impl IntoIterator<Item = NodeId>) -> Self {
        let mut places = Places::default();
        let mut columns: Vec<Vec<NodeId>> = Vec::new();
        for node in nodes {
            let Some(&[x, y, z]) = mesh.nodes().get(node) else {
                continue;
            };
            if z >= 0.0 && Places::within(&[x, y]) {
                let column = places.number([x, y], columns.len());
                if column == columns.len() {
                    columns.push(Vec::new());
                }
                columns[column].push(node);
            }
        }
        let depth = |n: NodeId| mesh.nodes()[n][2];
        let mut followers = BTreeMap::new();
        for nodes in columns {
            let Some(leader) = nodes
                .iter()
                .copied()
                .max_by(|&a, &b| depth(a).total_cmp(&depth(b)))
            else {
                continue;
            };
            for node in nodes.into_iter().filter(|&n| depth(n) < depth(leader)) {
                followers.insert(node, (leader, [1.0, 1.0, depth(node) / depth(leader)]));
            }
        }
        Self(followers)
    }

    /// Adds those of another body.
    pub fn extend(&mut self, other: Self) {
        self.0.extend(other.0);
    }

    /// Whether no node follows another.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Leader and factors of a node; itself and ones for a node that follows none.
    pub fn of(&self, node: NodeId) -> (NodeId, [f64; 3]) {
        self.0.get(&node).copied().unwrap_or((node, [1.0; 3]))
    }

    /// Leader of a node and factor of one DOF; rotations are the leader's.
    pub fn dof(&self, node: NodeId, dof: Dof) -> (NodeId, f64) {
        let (leader, factors) = self.of(node);
        (leader, factors.get(dof as usize).copied().unwrap_or(1.0))
    }

    /// Every follower with its leader and factors.
    pub fn iter(&self) -> impl Iterator<Item = (NodeId, NodeId, [f64; 3])> {
        self.0
            .iter()
            .map(|(&node, &(leader, factors))| (node, leader, factors))
    }
}

#[cfg(test)]
mod tests {
    //! Protects who leads and by how much.
    use super::*;
    use crate::grid::GridBuilder;

    #[test]
    fn the_farthest_node_leads_its_column() {
        let mut grid = GridBuilder::new();
        grid.add_box("wide", &[0.0, 1.0], &[0.0, 1.0], &[0.0, 4.0]);
        grid.add_box("other", &[0.0, 1.0], &[1.0, 2.0], &[0.0, 4.0]);
        let mesh = grid.finish().unwrap();
        let wide = mesh.block("wide").unwrap().cells().flatten();
        let followers = Followers::uniform_across(&mesh, wide.copied());
        // Of 20 nodes 8 lead.
        assert_eq!(followers.iter().count(), 12);
        for (node, leader, factors) in followers.iter() {
            let [a, b] = [node, leader].map(|n| mesh.nodes()[n]);
            assert_eq!([a[0], a[1], 4.0], b);
            assert_eq!(factors, [1.0, 1.0, a[2] / 4.0]);
        }
        let alone = mesh.block("other").unwrap().cells().next().unwrap()[3];
        assert_eq!(followers.of(alone), (alone, [1.0; 3]));
        assert!(Followers::default().is_empty());
    }

    /// Two nodes 2e-12 mm apart, on either side of where a coordinate is rounded, are of one column.
    #[test]
    fn a_column_is_one_whichever_way_it_is_rounded() {
        let x = 1.000_000_5;
        let nodes = vec![[x + 1e-12, 0.0, 1.0], [x - 1e-12, 0.0, 0.0]];
        let followers = Followers::uniform_across(&Mesh::new(nodes).unwrap(), 0..2);
        let all: Vec<_> = followers.iter().collect();
        assert_eq!(all, [(1, 0, [1.0, 1.0, 0.0])]);
    }
}
