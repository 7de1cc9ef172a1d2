//! Consistent nodal forces of body forces and face pressures.

use fe_core::mesh::NodeId;
use fe_core::shape::{hex20, quad8, quadrature};
use nalgebra::Vector3;

/// Nodal forces (N) of a body force `density` (N/mm3) on a 20-node hexahedron, f_a = int N_a b dV, with
/// 3 x 3 x 3 points. The cell is not checked, as [`Hex20::new`](crate::Hex20::new) does: where it is turned inside out, its
/// volume and the forces change their sign.
pub fn body_force(
    nodes: &[NodeId; 20],
    coords: &[[f64; 3]; 20],
    density: [f64; 3],
) -> Vec<(NodeId, [f64; 3])> {
    let mut forces: Vec<(NodeId, [f64; 3])> = nodes.iter().map(|&n| (n, [0.0; 3])).collect();
    for (xi, w) in quadrature::cube(3) {
        let (values, _) = hex20::shape(xi);
        let (_, _, determinant) = hex20::map(coords, xi);
        for ((_, f), value) in forces.iter_mut().zip(values) {
            for k in 0..3 {
                f[k] += w * determinant * value * density[k];
            }
        }
    }
    forces
}

/// Nodal forces (N) of a traction t (MPa) on an 8-node face, f_a = int N_a t dA, with 3 x 3 points. The
/// traction is given the outward unit normal of each point.
pub fn face_traction(
    nodes: &[NodeId; 8],
    coords: &[[f64; 3]; 8],
    mut traction: impl FnMut(Vector3<f64>) -> Vector3<f64>,
) -> Vec<(NodeId, [f64; 3])> {
    let mut forces: Vec<(NodeId, [f64; 3])> = nodes.iter().map(|&n| (n, [0.0; 3])).collect();
    for (xi, w) in quadrature::square(3) {
        let (values, slopes) = quad8::shape(xi);
        let [along, across] = quad8::base(coords, &slopes);
        let normal = along.cross(&across);
        let area = normal.norm();
        if area == 0.0 {
            // A face that has collapsed, as of a wedge.
            continue;
        }
        let t = traction(normal / area) * (w * area);
        for ((_, f), value) in forces.iter_mut().zip(values) {
            for k in 0..3 {
                f[k] += value * t[k];
            }
        }
    }
    forces
}

/// Nodal forces (N) of a pressure (MPa), positive against the face, on an 8-node face whose node order
/// gives the outward normal.
pub fn face_pressure(
    nodes: &[NodeId; 8],
    coords: &[[f64; 3]; 8],
    pressure: f64,
) -> Vec<(NodeId, [f64; 3])> {
    face_traction(nodes, coords, |normal| -pressure * normal)
}

#[cfg(test)]
mod tests {
    //! Protects the consistent loads: EL-11, corners carry -1/12 and mid-sides +1/3 of the total.
    use fe_core::testing::Worst;

    use super::*;

    /// EL-11. Target: these shares to rounding.
    #[test]
    fn a_uniform_pressure_pulls_at_the_corners() {
        let [mut corners, mut sides] =
            ["corner against -1/12", "mid-side against 1/3"].map(|what| {
                Worst::new(
                    &format!("EL-11: load of a {what} of the total, error"),
                    1e-12,
                )
            });
        let nodes = std::array::from_fn(|i| i);
        let coords = quad8::NODES.map(|[x, y]| [10.0 * x, 5.0 * y, 0.0]);
        let total = 2.0 * 200.0;
        for (node, f) in face_pressure(&nodes, &coords, 2.0) {
            let found = -f[2] / total;
            if node < 4 {
                corners.see(found + 1.0 / 12.0, node);
            } else {
                sides.see(found - 1.0 / 3.0, node);
            }
        }
        corners.tell();
        sides.tell();
    }

    #[test]
    fn face_tables_point_outwards() {
        let coords = hex20::NODES;
        for (face, table) in hex20::FACES.iter().enumerate() {
            let own = table.map(|a| coords[a]);
            let sum: f64 = face_pressure(table, &own, -1.0)
                .iter()
                .map(|(_, f)| f[face / 2])
                .sum();
            let outward = if face % 2 == 0 { -4.0 } else { 4.0 };
            assert!((sum - outward).abs() < 1e-12, "face {face}: {sum}");
        }
    }

    /// Faces of a wedge: one drawn together to a triangle of 20 mm x 10 mm carries the pressure on its area, one drawn together
    /// to an edge carries nothing; no force is lost to a normal that is none.
    #[test]
    fn collapsed_faces_carry_what_is_left_of_them() {
        let nodes = std::array::from_fn(|i| i);
        let triangle = quad8::NODES.map(|[x, y]| [10.0 * x, 2.5 * (1.0 + x) * y, 0.0]);
        let edge = quad8::NODES.map(|[x, _]| [10.0 * x, 0.0, 0.0]);
        for (coords, area) in [(triangle, 100.0), (edge, 0.0)] {
            let forces = face_pressure(&nodes, &coords, -2.0);
            for k in 0..3 {
                let total: f64 = forces.iter().map(|(_, f)| f[k]).sum();
                let expected = if k == 2 { 2.0 * area } else { 0.0 };
                assert!((total - expected).abs() < 1e-12 * 200.0, "{total}");
            }
        }
    }

    #[test]
    fn the_weight_of_a_box_is_carried_in_full() {
        let nodes = std::array::from_fn(|i| i);
        let forces = body_force(&nodes, &hex20::NODES, [0.0, -3.0, 0.0]);
        assert!((forces.iter().map(|(_, f)| f[1]).sum::<f64>() + 24.0).abs() < 1e-12);
    }
}
