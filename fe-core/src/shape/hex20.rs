//! The 20-node serendipity hexahedron (VTK type 25).
//!
//! With node a at xi_a, corners N = (1 + xi xi_a)(1 + eta eta_a)(1 + zeta zeta_a)(xi xi_a + eta eta_a +
//! zeta zeta_a - 2)/8; a mid-side node with xi_a = 0 has N = (1 - xi^2)(1 + eta eta_a)(1 + zeta zeta_a)/4,
//! the others likewise (Zienkiewicz and Taylor 2000, section 8.7).

use nalgebra::{Matrix3, Vector3};

/// Natural coordinates of the nodes.
pub const NODES: [[f64; 3]; 20] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [0.0, -1.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, -1.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [-1.0, 0.0, 1.0],
    [-1.0, -1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
];

/// Nodes of the six faces (low and high xi, eta, zeta) in the order of an 8-node quadrilateral whose
/// normal points outwards.
pub const FACES: [[usize; 8]; 6] = [
    [0, 4, 7, 3, 16, 15, 19, 11],
    [1, 2, 6, 5, 9, 18, 13, 17],
    [0, 1, 5, 4, 8, 17, 12, 16],
    [3, 7, 6, 2, 19, 14, 18, 10],
    [0, 3, 2, 1, 11, 10, 9, 8],
    [4, 5, 6, 7, 12, 13, 14, 15],
];

/// Shape functions and their derivatives with respect to the natural coordinates.
pub fn shape(xi: [f64; 3]) -> ([f64; 20], [[f64; 3]; 20]) {
    let mut values = [0.0; 20];
    let mut slopes = [[0.0; 3]; 20];
    for (a, node) in NODES.iter().enumerate() {
        let t: [f64; 3] = std::array::from_fn(|k| 1.0 + node[k] * xi[k]);
        match node.iter().position(|&c| c == 0.0) {
            None => {
                let s = node[0] * xi[0] + node[1] * xi[1] + node[2] * xi[2] - 2.0;
                values[a] = 0.125 * t[0] * t[1] * t[2] * s;
                for k in 0..3 {
                    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                    slopes[a][k] = 0.125 * node[k] * t[i] * t[j] * (s + t[k]);
                }
            }
            Some(k) => {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let bubble = 1.0 - xi[k] * xi[k];
                values[a] = 0.25 * bubble * t[i] * t[j];
                slopes[a][k] = -0.5 * xi[k] * t[i] * t[j];
                slopes[a][i] = 0.25 * bubble * node[i] * t[j];
                slopes[a][j] = 0.25 * bubble * t[i] * node[j];
            }
        }
    }
    (values, slopes)
}

/// Position, gradients dN/dx (1/mm) and Jacobian determinant (mm3) at a natural point.
pub fn map(coords: &[[f64; 3]; 20], xi: [f64; 3]) -> (Vector3<f64>, [[f64; 3]; 20], f64) {
    let (values, slopes) = shape(xi);
    let mut position = Vector3::zeros();
    let mut jacobian = Matrix3::zeros();
    for a in 0..20 {
        let x = Vector3::from(coords[a]);
        position += values[a] * x;
        // Row r: derivative of the position with respect to xi_r.
        for r in 0..3 {
            for c in 0..3 {
                jacobian[(r, c)] += slopes[a][r] * x[c];
            }
        }
    }
    let determinant: f64 = jacobian.determinant();
    let inverse = jacobian.try_inverse().unwrap_or_else(Matrix3::zeros);
    let gradients = slopes.map(|s| (inverse * Vector3::from(s)).into());
    (position, gradients, determinant)
}

/// Whether the map is affine: straight edges, parallel faces, mid-side nodes in the middle.
pub fn is_affine(coords: &[[f64; 3]; 20]) -> bool {
    let x = |a: usize| Vector3::from(coords[a]);
    let (ex, ey, ez) = (x(1) - x(0), x(3) - x(0), x(4) - x(0));
    let size = ex.norm() + ey.norm() + ez.norm();
    NODES.iter().enumerate().all(|(a, n)| {
        let ideal = x(0) + 0.5 * ((n[0] + 1.0) * ex + (n[1] + 1.0) * ey + (n[2] + 1.0) * ez);
        (x(a) - ideal).norm() < 1e-9 * size
    })
}

/// Natural coordinates of a point, by Newton iteration; `None` when it does not converge or the point
/// lies outside by more than a quarter of the cell, |xi| > 1.5.
pub fn inverse_map(coords: &[[f64; 3]; 20], point: [f64; 3]) -> Option<[f64; 3]> {
    let target = Vector3::from(point);
    let mut xi = [0.0; 3];
    for _ in 0..30 {
        let (values, slopes) = shape(xi);
        let mut miss = target;
        let mut jacobian = Matrix3::<f64>::zeros();
        for a in 0..20 {
            let x = Vector3::from(coords[a]);
            miss -= values[a] * x;
            for c in 0..3 {
                for r in 0..3 {
                    jacobian[(r, c)] += x[r] * slopes[a][c];
                }
            }
        }
        let step = jacobian.lu().solve(&miss)?;
        for k in 0..3 {
            xi[k] = (xi[k] + step[k]).clamp(-2.0, 2.0);
        }
        if step.amax() < 1e-13 {
            break;
        }
    }
    let (reached, _, _) = map(coords, xi);
    let size = (Vector3::from(coords[6]) - Vector3::from(coords[0])).norm();
    ((reached - target).norm() < 1e-9 * size && xi.iter().all(|c| c.abs() < 1.5)).then_some(xi)
}

#[cfg(test)]
mod tests {
    //! Protects the node order and the maps every element and bar relies on.
    use super::*;

    #[test]
    fn shape_functions_interpolate_and_sum_to_one() {
        for (a, &node) in NODES.iter().enumerate() {
            let (n, _) = shape(node);
            for (b, value) in n.iter().enumerate() {
                let expected = if a == b { 1.0 } else { 0.0 };
                assert!((value - expected).abs() < 1e-14);
            }
        }
        let (n, d) = shape([0.3, -0.2, 0.7]);
        assert!((n.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        for k in 0..3 {
            assert!(d.iter().map(|g| g[k]).sum::<f64>().abs() < 1e-14);
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let xi = [0.3, -0.2, 0.7];
        let (_, d) = shape(xi);
        for k in 0..3 {
            let (mut up, mut down) = (xi, xi);
            up[k] += 1e-6;
            down[k] -= 1e-6;
            for a in 0..20 {
                let difference = (shape(up).0[a] - shape(down).0[a]) / 2e-6;
                assert!((difference - d[a][k]).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn the_inverse_map_finds_a_point_of_a_distorted_cell() {
        let mut coords = NODES;
        for (i, x) in coords.iter_mut().enumerate() {
            x[0] += 0.05 * (i as f64).sin();
            x[2] += 0.04 * (2.0 * i as f64).cos();
        }
        let (point, _, _) = map(&coords, [0.4, -0.8, 0.1]);
        let xi = inverse_map(&coords, point.into()).unwrap();
        assert!((xi[0] - 0.4).abs() + (xi[1] + 0.8).abs() + (xi[2] - 0.1).abs() < 1e-10);
        assert!(inverse_map(&coords, [5.0, 0.0, 0.0]).is_none());
        assert!(is_affine(&NODES) && !is_affine(&coords));
    }
}
