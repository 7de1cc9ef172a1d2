//! Meshes made from boxes, and the elements on them.

use std::collections::HashMap;
use std::sync::Arc;

use fe_core::element::{Element, ElementError};
use fe_core::grid::GridBuilder;
use fe_core::kinematics::{PlaneStress, Solid};
use fe_core::material::Material;
use fe_core::mesh::{Block, CellKind, Mesh, MeshError, NodeId};
use fe_core::shape::{hex20, quad8};
use fe_elements::{BandWidth, Hex20, HexRule, Membrane8, Quad8, QuadRule};
use nalgebra::{Rotation3, Unit, Vector3};

/// Name of the only block of [`boxes`].
pub const BLOCK: &str = "block";

/// Corners at the ends of the twelve edges, in the order of the mid-side nodes.
const EDGES: [[usize; 2]; 12] = [
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 0],
    [4, 5],
    [5, 6],
    [6, 7],
    [7, 4],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];

/// `n` equal cells from `low` to `high`.
pub fn lines(low: f64, high: f64, n: usize) -> Vec<f64> {
    let step = (high - low) / n as f64;
    (0..=n).map(|i| low + step * i as f64).collect()
}

/// A box with one cell between neighbouring grid lines.
///
/// # Errors
///
/// [`MeshError`] for a line that is not a number.
pub fn boxes(x: &[f64], y: &[f64], z: &[f64]) -> Result<Mesh, MeshError> {
    let mut grid = GridBuilder::new();
    grid.add_box(BLOCK, x, y, z);
    grid.finish()
}

/// The same cells with every node moved to `map` of its place; node sets are dropped.
///
/// # Errors
///
/// [`MeshError`] for a place that is not a number.
pub fn mapped(mesh: &Mesh, map: impl FnMut([f64; 3]) -> [f64; 3]) -> Result<Mesh, MeshError> {
    let mut moved = Mesh::new(mesh.nodes().iter().copied().map(map).collect())?;
    for block in mesh.blocks() {
        let cells = block.cells().flatten().copied().collect();
        moved.add_block(&block.name, block.kind, cells)?;
    }
    Ok(moved)
}

/// Nodes and coordinates of the hexahedra of a block.
pub fn cells<'a>(
    mesh: &'a Mesh,
    block: &'a Block,
) -> impl Iterator<Item = ([NodeId; 20], [[f64; 3]; 20])> + 'a {
    block.cells().map(|cell| {
        let nodes: [NodeId; 20] = std::array::from_fn(|a| cell[a]);
        (nodes, nodes.map(|n| mesh.nodes()[n]))
    })
}

/// One element of the given law in every hexahedron of the mesh.
///
/// # Errors
///
/// [`ElementError::Jacobian`] for a distorted cell.
pub fn hexahedra(
    mesh: &Mesh,
    rule: HexRule,
    law: &Arc<dyn Material<Solid>>,
) -> Result<Vec<Box<dyn Element>>, ElementError> {
    let mut elements = Vec::new();
    for block in mesh.blocks().iter().filter(|b| b.kind == CellKind::Hex20) {
        elements.extend(hexahedra_of(mesh, block, rule, law)?);
    }
    Ok(elements)
}

/// One element of the given law in every cell of a block of hexahedra.
///
/// # Errors
///
/// [`ElementError::Jacobian`] for a distorted cell.
pub fn hexahedra_of(
    mesh: &Mesh,
    block: &Block,
    rule: HexRule,
    law: &Arc<dyn Material<Solid>>,
) -> Result<Vec<Box<dyn Element>>, ElementError> {
    let element = |(nodes, coords)| {
        let element = Hex20::new(nodes, &coords, rule, Arc::clone(law), BandWidth::CubeRoot)?;
        Ok(Box::new(element) as Box<dyn Element>)
    };
    cells(mesh, block).map(element).collect()
}

/// Faces of hexahedra all of whose nodes satisfy `test`: nodes in the order of an outward quadrilateral.
pub fn faces(mesh: &Mesh, test: impl Fn([f64; 3]) -> bool) -> Vec<[NodeId; 8]> {
    let hexahedra = mesh.blocks().iter().filter(|b| b.kind == CellKind::Hex20);
    hexahedra
        .flat_map(Block::cells)
        .flat_map(|cell| hex20::FACES.map(|face| face.map(|a| cell[a])))
        .filter(|face| face.iter().all(|&n| test(mesh.nodes()[n])))
        .collect()
}

/// Nodes that satisfy `test`.
pub fn nodes_where(mesh: &Mesh, test: impl Fn([f64; 3]) -> bool) -> Vec<NodeId> {
    let all = mesh.nodes().iter().enumerate();
    all.filter(|(_, x)| test(**x)).map(|(n, _)| n).collect()
}

/// Straight-sided 20-node hexahedra from the corners of 8-node ones, VTK order: mid-side nodes are put in the
/// middle of the edges, shared where edges are.
///
/// # Errors
///
/// [`MeshError`] for a corner that does not exist or is not a number.
pub fn quadratic(corners: &[[f64; 3]], cells: &[[usize; 8]]) -> Result<Mesh, MeshError> {
    with_mid_sides(corners, cells, &EDGES, CellKind::Hex20)
}

/// Straight-sided 8-node quadrilaterals from the corners of 4-node ones, likewise.
///
/// # Errors
///
/// [`MeshError`] for a corner that does not exist or is not a number.
pub fn quadratic_sheet(corners: &[[f64; 3]], cells: &[[usize; 4]]) -> Result<Mesh, MeshError> {
    with_mid_sides(corners, cells, &EDGES[..4], CellKind::Quad8)
}

fn with_mid_sides<const CORNERS: usize>(
    corners: &[[f64; 3]],
    cells: &[[usize; CORNERS]],
    edges: &[[usize; 2]],
    kind: CellKind,
) -> Result<Mesh, MeshError> {
    let mut nodes = corners.to_vec();
    let mut middle: HashMap<[usize; 2], NodeId> = HashMap::new();
    let mut connectivity = Vec::with_capacity((CORNERS + edges.len()) * cells.len());
    for cell in cells {
        connectivity.extend(cell);
        for [a, b] in edges.iter().map(|edge| edge.map(|c| cell[c])) {
            let key = [a.min(b), a.max(b)];
            connectivity.push(*middle.entry(key).or_insert_with(|| {
                let (p, q) = (corners[a], corners[b]);
                nodes.push(std::array::from_fn(|k| p[k].midpoint(q[k])));
                nodes.len() - 1
            }));
        }
    }
    let mut mesh = Mesh::new(nodes)?;
    mesh.add_block(BLOCK, kind, connectivity)?;
    Ok(mesh)
}

/// n x n 8-node quadrilaterals over the unit square, every node moved to `map` of its place.
///
/// # Errors
///
/// [`MeshError`] for a place that is not a number.
pub fn quadrilaterals(n: usize, map: impl Fn(f64, f64) -> [f64; 2]) -> Result<Mesh, MeshError> {
    surface([n, n], |s, t| {
        let [x, y] = map(s, t);
        [x, y, 0.0]
    })
}

/// 8-node quadrilaterals over the unit square, so many along its sides, every node moved to `map` of its place in space.
///
/// # Errors
///
/// [`MeshError`] for a place that is not a number.
pub fn surface(cells: [usize; 2], map: impl Fn(f64, f64) -> [f64; 3]) -> Result<Mesh, MeshError> {
    let sides = cells.map(|n| 2 * n + 1);
    let mut nodes = Vec::new();
    let mut number = vec![0; sides[0] * sides[1]];
    for j in 0..sides[1] {
        for i in (0..sides[0]).filter(|i| i % 2 == 0 || j % 2 == 0) {
            number[j * sides[0] + i] = nodes.len();
            nodes.push(map(
                i as f64 / (2 * cells[0]) as f64,
                j as f64 / (2 * cells[1]) as f64,
            ));
        }
    }
    let mut connectivity = Vec::with_capacity(8 * cells[0] * cells[1]);
    for j in (0..sides[1] - 1).step_by(2) {
        for i in (0..sides[0] - 1).step_by(2) {
            let half_steps = quad8::NODES.map(|[s, t]| [(s + 1.0) as usize, (t + 1.0) as usize]);
            connectivity.extend(half_steps.map(|[a, b]| number[(j + b) * sides[0] + i + a]));
        }
    }
    let mut mesh = Mesh::new(nodes)?;
    mesh.add_block(BLOCK, CellKind::Quad8, connectivity)?;
    Ok(mesh)
}

/// Rotation about (1, 2, 3) by one radian: takes the x-y plane to one oblique to all axes.
pub fn oblique(x: [f64; 3]) -> [f64; 3] {
    let axis = Unit::new_normalize(Vector3::new(1.0, 2.0, 3.0));
    (Rotation3::from_axis_angle(&axis, 1.0) * Vector3::from(x)).into()
}

/// One plane-stress element in every quadrilateral of the mesh.
///
/// # Errors
///
/// [`ElementError`] for a distorted cell or an impossible thickness.
pub fn sheets(
    mesh: &Mesh,
    thickness: f64,
    rule: QuadRule,
    law: &Arc<dyn Material<PlaneStress>>,
) -> Result<Vec<Box<dyn Element>>, ElementError> {
    let blocks = mesh.blocks().iter().filter(|b| b.kind == CellKind::Quad8);
    let element = |cell: &[NodeId]| {
        let nodes: [NodeId; 8] = std::array::from_fn(|a| cell[a]);
        let coords = nodes.map(|n| [mesh.nodes()[n][0], mesh.nodes()[n][1]]);
        let element = Quad8::new(nodes, &coords, thickness, rule, Arc::clone(law))?;
        Ok(Box::new(element) as Box<dyn Element>)
    };
    blocks.flat_map(Block::cells).map(element).collect()
}

/// One membrane in every quadrilateral of the mesh, axis 1 of the law along the projection of `axis`.
///
/// # Errors
///
/// [`ElementError`] for a distorted cell, an impossible thickness or axis.
pub fn membranes(
    mesh: &Mesh,
    thickness: f64,
    rule: QuadRule,
    axis: [f64; 3],
    law: &Arc<dyn Material<PlaneStress>>,
) -> Result<Vec<Box<dyn Element>>, ElementError> {
    let blocks = mesh.blocks().iter().filter(|b| b.kind == CellKind::Quad8);
    let element = |cell: &[NodeId]| {
        let nodes: [NodeId; 8] = std::array::from_fn(|a| cell[a]);
        let coords = nodes.map(|n| mesh.nodes()[n]);
        let element = Membrane8::new(nodes, &coords, thickness, rule, axis, Arc::clone(law))?;
        Ok(Box::new(element) as Box<dyn Element>)
    };
    blocks.flat_map(Block::cells).map(element).collect()
}
