//! The 8-node serendipity quadrilateral (VTK type 23).
//!
//! Corners N = (1 + xi xi_a)(1 + eta eta_a)(xi xi_a + eta eta_a - 1)/4; a mid-side node with xi_a = 0 has
//! N = (1 - xi^2)(1 + eta eta_a)/2, the others likewise.

use nalgebra::Vector3;

/// Natural coordinates of the nodes.
pub const NODES: [[f64; 2]; 8] = [
    [-1.0, -1.0],
    [1.0, -1.0],
    [1.0, 1.0],
    [-1.0, 1.0],
    [0.0, -1.0],
    [1.0, 0.0],
    [0.0, 1.0],
    [-1.0, 0.0],
];

/// Shape functions and their derivatives with respect to the natural coordinates.
pub fn shape(xi: [f64; 2]) -> ([f64; 8], [[f64; 2]; 8]) {
    let mut values = [0.0; 8];
    let mut slopes = [[0.0; 2]; 8];
    for (a, node) in NODES.iter().enumerate() {
        let t: [f64; 2] = std::array::from_fn(|k| 1.0 + node[k] * xi[k]);
        match node.iter().position(|&c| c == 0.0) {
            None => {
                let s = node[0] * xi[0] + node[1] * xi[1] - 1.0;
                values[a] = 0.25 * t[0] * t[1] * s;
                slopes[a] = [
                    0.25 * node[0] * t[1] * (s + t[0]),
                    0.25 * node[1] * t[0] * (s + t[1]),
                ];
            }
            Some(k) => {
                let i = 1 - k;
                let bubble = 1.0 - xi[k] * xi[k];
                values[a] = 0.5 * bubble * t[i];
                slopes[a][k] = -xi[k] * t[i];
                slopes[a][i] = 0.5 * bubble * node[i];
            }
        }
    }
    (values, slopes)
}

/// Base vectors dx/dxi and dx/deta (mm) of the surface through `coords` (mm), from the slopes of the shape functions.
pub fn base(coords: &[[f64; 3]; 8], slopes: &[[f64; 2]; 8]) -> [Vector3<f64>; 2] {
    std::array::from_fn(|k| {
        let terms = slopes.iter().zip(coords);
        terms.map(|(s, x)| s[k] * Vector3::from(*x)).sum()
    })
}

#[cfg(test)]
mod tests {
    //! Protects the node order of faces.
    use super::*;

    #[test]
    fn shape_functions_interpolate_and_derivatives_agree_with_differences() {
        for (a, &node) in NODES.iter().enumerate() {
            for (b, value) in shape(node).0.iter().enumerate() {
                assert!((value - f64::from(u8::from(a == b))).abs() < 1e-14);
            }
        }
        let xi = [0.3, -0.6];
        for k in 0..2 {
            let (mut up, mut down) = (xi, xi);
            up[k] += 1e-6;
            down[k] -= 1e-6;
            for a in 0..8 {
                let difference = (shape(up).0[a] - shape(down).0[a]) / 2e-6;
                assert!((difference - shape(xi).1[a][k]).abs() < 1e-9);
            }
        }
    }
}
