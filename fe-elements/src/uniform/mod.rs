//! The 20-node hexahedron of a half body that is uniform across its width.

mod kernel;

use std::sync::Arc;

use fe_core::element::ElementError;
use fe_core::followers::Followers;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::mesh::NodeId;
use nalgebra::{Matrix6, Vector6};

use crate::hex20::{self, BandWidth, HexRule};
use crate::solid::{Interpolation, SolidElement};
use crate::vectors::{add_by_node, by_direction};
use kernel::{NODES, Point};

/// Hexahedron on the DOFs of the eight nodes that lead the others, see [`Followers::uniform_across`].
///
/// With u, v uniform across the width and w in proportion to z, the plane of symmetry stands for the width:
///
/// eps = (du/dx, dv/dy, dw/dz, du/dy + dv/dx, 0, 0) at z = 0,  f = b int B^T sigma dA
///
/// with b half the width: plane stress whose stress across is settled by an unknown, so that stirrups and sheets take part in
/// it. The shear strains z dw/dx and z dw/dy of a width that varies are left out, as plane stress does. An integration rule
/// keeps its points in the plane: the 9 into which the 14 fall, or 3 x 3.
pub type UniformHex20 = SolidElement<Slice>;

/// Interpolation of the [`UniformHex20`].
#[derive(Debug)]
pub struct Slice {
    nodes: [NodeId; NODES],
    cell: [NodeId; 20],
    points: Vec<Point>,
}

impl UniformHex20 {
    /// An element on the cell of 20 `nodes` at `coords` (mm), its third local axis along z from the plane z = 0.
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] unless eight of the nodes lead the others, the cell begins at z = 0 and its nodes across lie one
    /// behind the other, those at mid-depth in the middle, and for the reduced rule, whose four points leave some of the strains
    /// across unseen; otherwise as [`Hex20::new`](crate::Hex20::new).
    pub fn new(
        cell: [NodeId; 20],
        coords: &[[f64; 3]; 20],
        followers: &Followers,
        rule: HexRule,
        law: Arc<dyn Material<Solid>>,
        band: BandWidth,
    ) -> Result<Self, ElementError> {
        let mut leaders: Vec<NodeId> = cell.iter().map(|&n| followers.of(n).0).collect();
        leaders.sort_unstable();
        leaders.dedup();
        let nodes = <[NodeId; NODES]>::try_from(leaders).map_err(|leaders| {
            let count = leaders.len() as f64;
            refuse("leading nodes of the hexahedron".into(), count, "8".into())
        })?;
        if rule == HexRule::Reduced {
            return Err(ElementError::Input {
                what: "integration points in the plane".into(),
                value: 4.0,
                allowed: "9".into(),
                remedy: "four leave strains across unseen: take the 14-point or the full rule, or hexahedra with DOFs across"
                    .into(),
            });
        }
        hex20::refuse_folds(coords)?;
        straight_across(coords)?;
        let mut points = Vec::new();
        let mut positions = Vec::new();
        for (point, ([xi, eta], w)) in in_plane(rule).into_iter().enumerate() {
            let (position, gradients, determinant) = hex20::map(coords, point, [xi, eta, -1.0])?;
            let mut g = [[0.0; NODES]; 3];
            for (n, d) in cell.iter().zip(gradients) {
                let (leader, factors) = followers.of(*n);
                if let Ok(a) = nodes.binary_search(&leader) {
                    for k in 0..3 {
                        g[k][a] += factors[k] * d[k];
                    }
                }
            }
            points.push(Point {
                gradients: g,
                volume: w * determinant,
            });
            positions.push(position.into());
        }
        let volume: f64 = points.iter().map(|p| p.volume).sum();
        let band = band.of(coords, volume, points.len());
        let slice = Slice {
            nodes,
            cell,
            points,
        };
        Self::of(slice, positions, law, band)
    }
}

/// Share of the depth by which nodes may lie off their places.
const OFF: f64 = 1e-6;

/// Refuses a cell unless its inner face lies at z = 0 and every other node behind one of this face, at mid-depth in the middle.
fn straight_across(coords: &[[f64; 3]; 20]) -> Result<(), ElementError> {
    let depth = (coords[4][2] - coords[0][2]).abs();
    let inner = (0..4).chain(8..12);
    let on_plane = inner.clone().map(|a| (a, a, 0.0));
    let outer = inner.map(|a| (a + 4, a, 1.0));
    let middle = (0..4).map(|a| (a + 16, a, 0.5));
    for (node, front, share) in on_plane.chain(outer).chain(middle) {
        let [x, y, _] = coords[front];
        let place = [x, y, share * coords[front + 4][2]];
        for (axis, (value, place)) in ["x", "y", "z"].iter().zip(coords[node].iter().zip(place)) {
            let miss = (value - place).abs();
            if miss.is_nan() || miss > OFF * depth {
                let what = format!("{axis} of node {node} of the hexahedron (mm)");
                return Err(refuse(what, *value, format!("{place}")));
            }
        }
    }
    Ok(())
}

fn refuse(what: String, value: f64, allowed: String) -> ElementError {
    ElementError::Input {
        what,
        value,
        allowed,
        remedy: "give it one element straight across, its third axis along z, which grows from 0 to the outer face".into(),
    }
}

/// Points of a rule in the plane, with the weights of all that lie one behind the other.
fn in_plane(rule: HexRule) -> Vec<([f64; 2], f64)> {
    let mut points: Vec<([f64; 2], f64)> = Vec::new();
    for ([xi, eta, _], w) in rule.points() {
        match points.iter_mut().find(|(place, _)| *place == [xi, eta]) {
            Some((_, sum)) => *sum += w,
            None => points.push(([xi, eta], w)),
        }
    }
    points
}

impl Interpolation for Slice {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn cell(&self) -> &[NodeId; 20] {
        &self.cell
    }

    fn volumes(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|p| p.volume)
    }

    fn strains(&self, u: &[f64], out: &mut [Vector6<f64>]) {
        kernel::strains(&self.points, &by_direction(u), out);
    }

    fn add_force(&self, stresses: &[Vector6<f64>], out: &mut [f64]) {
        add_by_node(&kernel::force(&self.points, stresses), out);
    }

    fn add_stiffness(&self, tangents: &[Matrix6<f64>], _symmetric: bool, out: &mut [f64]) {
        kernel::stiffness(&self.points, tangents, out);
    }
}
