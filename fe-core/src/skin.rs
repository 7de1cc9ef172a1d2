//! Outer faces of solids, and layers of nodes laid over them: the carriers of sheets, coatings and
//! interfaces.

use std::collections::{BTreeMap, HashMap};

use nalgebra::{DMatrix, DVector};

use crate::mesh::{CellKind, Mesh, MeshError, NodeId};
use crate::shape::hex20;

/// A face of a 20-node hexahedron in the node order of [`CellKind::Quad8`], its normal pointing outwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Nodes.
    pub nodes: [NodeId; 8],
    /// Mean of the corners (mm).
    pub centre: [f64; 3],
    /// Unit normal at the mean of the corners, from the diagonals of the face.
    pub normal: [f64; 3],
}

impl Face {
    fn new(mesh: &Mesh, nodes: [NodeId; 8]) -> Self {
        let x = nodes.map(|n| mesh.nodes()[n]);
        let centre = std::array::from_fn(|k| 0.25 * x[..4].iter().map(|p| p[k]).sum::<f64>());
        let diagonal =
            |a: usize, b: usize| -> [f64; 3] { std::array::from_fn(|k| x[b][k] - x[a][k]) };
        let (d, e) = (diagonal(0, 2), diagonal(1, 3));
        let cross = [
            d[1] * e[2] - d[2] * e[1],
            d[2] * e[0] - d[0] * e[2],
            d[0] * e[1] - d[1] * e[0],
        ];
        let length = cross.iter().map(|c| c * c).sum::<f64>().sqrt();
        Self {
            nodes,
            centre,
            normal: cross.map(|c| c / length),
        }
    }
}

/// Faces of the hexahedra of `blocks` that no other of these hexahedra shares, in the order of blocks, cells
/// and [`hex20::FACES`]. Blocks that are not there or hold other cells are passed over.
pub fn outer_faces(mesh: &Mesh, blocks: &[&str]) -> Vec<Face> {
    let mut faces: Vec<([NodeId; 8], [NodeId; 4])> = Vec::new();
    let mut seen: HashMap<[NodeId; 4], usize> = HashMap::new();
    let wanted = mesh
        .blocks()
        .iter()
        .filter(|b| b.kind == CellKind::Hex20 && blocks.contains(&b.name.as_str()));
    for cell in wanted.flat_map(crate::mesh::Block::cells) {
        for local in hex20::FACES {
            let nodes = local.map(|a| cell[a]);
            let mut corners = [nodes[0], nodes[1], nodes[2], nodes[3]];
            corners.sort_unstable();
            *seen.entry(corners).or_default() += 1;
            faces.push((nodes, corners));
        }
    }
    faces
        .into_iter()
        .filter(|(_, corners)| seen[corners] == 1)
        .map(|(nodes, _)| Face::new(mesh, nodes))
        .collect()
}

/// Layers of nodes over a set of faces: a layer at distance h lies h (mm) from each face, mitred where faces
/// meet at an edge. Faces that share a node share its copies.
#[derive(Debug)]
pub struct Layers {
    /// Where a node goes per distance from the faces at it: d with n_i . d = 1 for their distinct normals.
    directions: BTreeMap<NodeId, [f64; 3]>,
    copies: BTreeMap<(NodeId, usize), NodeId>,
    /// Distances (mm) of the layers.
    distances: BTreeMap<usize, f64>,
}

/// The shortest d with n_i . d = 1 for all `normals`, in the least-squares sense: their sum where they are perpendicular.
fn away(normals: &[[f64; 3]]) -> [f64; 3] {
    let dot = |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
    let mut pairs = normals
        .iter()
        .enumerate()
        .flat_map(|(i, a)| normals[..i].iter().map(move |b| dot(a, b)));
    if pairs.all(|cos| cos.abs() < SAME_NORMAL) {
        return std::array::from_fn(|k| normals.iter().map(|n| n[k]).sum());
    }
    let rows = DMatrix::from_fn(normals.len(), 3, |i, k| normals[i][k]);
    let ones = DVector::repeat(normals.len(), 1.0);
    let d = rows.svd(true, true).solve(&ones, SAME_NORMAL);
    d.map_or([0.0; 3], |d| [d[0], d[1], d[2]])
}

/// Distances closer than this share of them are one.
const SAME_DISTANCE: f64 = 1e-9;

/// Normals closer than this are one.
const SAME_NORMAL: f64 = 1e-9;

impl Layers {
    /// Layers over the given faces, with no node yet.
    pub fn over(faces: &[Face]) -> Self {
        let mut normals: BTreeMap<NodeId, Vec<[f64; 3]>> = BTreeMap::new();
        for face in faces {
            for node in face.nodes {
                let own = normals.entry(node).or_default();
                let known =
                    |n: &[f64; 3]| (0..3).all(|k| (n[k] - face.normal[k]).abs() < SAME_NORMAL);
                if !own.iter().any(known) {
                    own.push(face.normal);
                }
            }
        }
        Self {
            directions: normals.into_iter().map(|(id, n)| (id, away(&n))).collect(),
            copies: BTreeMap::new(),
            distances: BTreeMap::new(),
        }
    }

    /// Nodes of layer number `layer`, `distance` (mm) from the face, over `nodes` of one of the faces; made
    /// when asked for first.
    ///
    /// # Errors
    ///
    /// [`MeshError::NotFinite`], [`MeshError::OffFaces`] for a node of none of the faces, [`MeshError::Distance`] for another
    /// distance than that of the layer so far.
    pub fn nodes<const N: usize>(
        &mut self,
        mesh: &mut Mesh,
        nodes: [NodeId; N],
        layer: usize,
        distance: f64,
    ) -> Result<[NodeId; N], MeshError> {
        if let Some(&known) = self.distances.get(&layer)
            && (known - distance).abs() > SAME_DISTANCE * known.abs()
        {
            return Err(MeshError::Distance {
                layer,
                known,
                distance,
            });
        }
        // All places before the first node: a failure leaves nothing.
        let mut places = [[0.0; 3]; N];
        for (place, node) in places.iter_mut().zip(nodes) {
            let off = MeshError::OffFaces(node);
            let direction = self.directions.get(&node).ok_or(off.clone())?;
            let x = mesh.nodes().get(node).ok_or(off)?;
            *place = std::array::from_fn(|k| x[k] + distance * direction[k]);
            if place.iter().any(|x| !x.is_finite()) {
                return Err(MeshError::NotFinite(mesh.nodes().len()));
            }
        }
        let mut copies = nodes;
        for (copy, place) in copies.iter_mut().zip(places) {
            let key = (*copy, layer);
            *copy = match self.copies.get(&key) {
                Some(&id) => id,
                None => mesh.add_node(place)?,
            };
            self.copies.insert(key, *copy);
        }
        self.distances.entry(layer).or_insert(distance);
        Ok(copies)
    }

    /// Nodes made so far with the node of the solid each one lies over.
    pub fn pairs(&self) -> impl Iterator<Item = (NodeId, NodeId)> {
        self.copies
            .iter()
            .map(|(&(below, _), &above)| (below, above))
    }
}

#[cfg(test)]
mod tests {
    //! Protects the faces that sheets are laid on: which ones are outside, where they point, which nodes
    //! they share.
    use super::*;
    use crate::grid::GridBuilder;

    fn two_cells() -> Mesh {
        let mut grid = GridBuilder::new();
        grid.add_box("a", &[0.0, 2.0, 4.0], &[0.0, 1.0], &[0.0, 1.0]);
        grid.add_box("plate", &[0.0, 2.0], &[1.0, 1.5], &[0.0, 1.0]);
        grid.finish().unwrap()
    }

    #[test]
    fn faces_shared_by_two_cells_are_inside() {
        let mesh = two_cells();
        let faces = outer_faces(&mesh, &["a"]);
        assert_eq!(faces.len(), 10);
        for face in &faces {
            // From the middle of the box (2, 0.5, 0.5) the normal points away.
            let away: f64 = (0..3)
                .map(|k| face.normal[k] * (face.centre[k] - [2.0, 0.5, 0.5][k]))
                .sum();
            assert!(away > 0.49);
        }
        assert_eq!(outer_faces(&mesh, &["a", "plate"]).len(), 10 + 6 - 2);
        assert!(outer_faces(&mesh, &["nothing"]).is_empty());
    }

    /// Where two faces meet at a slope of 1 in 10, 5.7 degrees, a layer keeps its distance from both.
    #[test]
    fn layers_keep_their_distance_at_a_slight_bend() {
        let straight = two_cells();
        let bent = |[x, y, z]: [f64; 3]| [x, y + 0.1 * (x - 2.0).max(0.0), z];
        let mut mesh = Mesh::new(straight.nodes().iter().copied().map(bent).collect()).unwrap();
        let cells = straight.block("a").unwrap().cells().flatten();
        mesh.add_block("a", CellKind::Hex20, cells.copied().collect())
            .unwrap();
        let mut faces = outer_faces(&mesh, &["a"]);
        faces.retain(|f| f.normal[1] < -0.9);
        assert_eq!(faces.len(), 2);
        let mut layers = Layers::over(&faces);
        for face in &faces {
            let copies = layers.nodes(&mut mesh, face.nodes, 0, 0.1).unwrap();
            for (below, above) in face.nodes.into_iter().zip(copies) {
                let (p, q) = (mesh.nodes()[below], mesh.nodes()[above]);
                let distance: f64 = (0..3).map(|k| face.normal[k] * (q[k] - p[k])).sum();
                assert!((distance - 0.1).abs() < 1e-12, "{distance}");
            }
        }
    }

    #[test]
    fn layers_keep_to_their_faces_and_distances() {
        let mut mesh = two_cells();
        let faces = outer_faces(&mesh, &["a"]);
        let mut layers = Layers::over(&faces[..1]);
        let own = faces[0].nodes;
        let other = faces
            .iter()
            .flat_map(|f| f.nodes)
            .find(|n| !own.contains(n));
        for off in [other.unwrap(), 9999] {
            assert_eq!(
                layers.nodes(&mut mesh, [off], 0, 0.1),
                Err(MeshError::OffFaces(off))
            );
        }
        // What fails at its second node leaves no copy of the first.
        let before = mesh.clone();
        let half = [own[0], other.unwrap()];
        assert!(layers.nodes(&mut mesh, half, 0, 0.1).is_err());
        assert!(mesh == before && layers.pairs().next().is_none());
        let first = layers.nodes(&mut mesh, own, 0, 0.1).unwrap();
        assert_eq!(layers.nodes(&mut mesh, own, 0, 0.1), Ok(first));
        assert!(matches!(
            layers.nodes(&mut mesh, own, 0, 0.7),
            Err(MeshError::Distance { layer: 0, .. })
        ));
        assert!(layers.nodes(&mut mesh, own, 1, f64::NAN).is_err());
    }

    #[test]
    fn layers_are_mitred_and_shared() {
        let mut mesh = two_cells();
        let faces: Vec<Face> = outer_faces(&mesh, &["a"])
            .into_iter()
            .filter(|f| f.normal[2] > 0.5 || f.normal[1] < -0.5)
            .collect();
        let before = mesh.nodes().len();
        let mut layers = Layers::over(&faces);
        for face in &faces {
            layers.nodes(&mut mesh, face.nodes, 0, 0.1).unwrap();
        }
        // Two rows of 13 nodes of two faces each that share the five nodes of an edge.
        assert_eq!(mesh.nodes().len() - before, 13 + 13 - 5);
        for (below, above) in layers.pairs() {
            let (p, q) = (mesh.nodes()[below], mesh.nodes()[above]);
            let side = p[2] > 0.99;
            let soffit = p[1] < 0.01;
            assert!((q[2] - p[2] - if side { 0.1 } else { 0.0 }).abs() < 1e-15);
            assert!((p[1] - q[1] - if soffit { 0.1 } else { 0.0 }).abs() < 1e-15);
        }
    }
}
