//! The 3-node quadratic line (VTK type 21): two ends, then the middle.
//!
//! N = xi (xi -+ 1)/2 at the ends, 1 - xi^2 in the middle.

use nalgebra::Vector3;

/// Natural coordinates of the nodes.
pub const NODES: [f64; 3] = [-1.0, 1.0, 0.0];

/// Shape functions and their derivatives with respect to the natural coordinate.
pub fn shape(xi: f64) -> ([f64; 3], [f64; 3]) {
    (
        [0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), 1.0 - xi * xi],
        [xi - 0.5, xi + 0.5, -2.0 * xi],
    )
}

/// Position, derivative of the position with respect to xi (mm, its norm is the Jacobian), and shape functions with
/// their slopes, at a natural point.
pub fn map(coords: &[[f64; 3]; 3], xi: f64) -> (Vector3<f64>, Vector3<f64>, [f64; 3], [f64; 3]) {
    let (values, slopes) = shape(xi);
    let (mut position, mut along) = (Vector3::zeros(), Vector3::zeros());
    for a in 0..3 {
        let x = Vector3::from(coords[a]);
        position += values[a] * x;
        along += slopes[a] * x;
    }
    (position, along, values, slopes)
}

/// Share of the chord by which an end may turn back for rounding: a middle node at a quarter leaves it without slope.
const FLAT: f64 = 1e-9;

/// Number of the first end where the line turns back against its chord, or where it is no number, and the Jacobian (mm) there,
/// negative: the middle node lies nearer to one end than a quarter of the chord. `None` for a line that runs on.
pub fn turns_back(coords: &[[f64; 3]; 3]) -> Option<(usize, f64)> {
    let chord = Vector3::from(coords[1]) - Vector3::from(coords[0]);
    NODES[..2].iter().enumerate().find_map(|(end, xi)| {
        let along = map(coords, *xi).1;
        let runs = along.norm().is_finite() && along.dot(&chord) >= -FLAT * chord.norm_squared();
        (!runs).then(|| (end, -along.norm()))
    })
}

#[cfg(test)]
mod tests {
    //! Protects the node order of bars with nodes of their own, and from middle nodes that are none.
    use super::*;

    /// The middle node of a line of 8 mm may lie anywhere between its quarters, also beside the chord.
    #[test]
    fn a_line_that_turns_back_is_found() {
        let line = |middle| [[0.0; 3], [8.0, 0.0, 0.0], middle];
        for middle in [[4.0, 0.0, 0.0], [2.0, 0.0, 0.0], [6.0, 3.0, 0.0]] {
            assert_eq!(turns_back(&line(middle)), None, "{middle:?}");
        }
        for (middle, end) in [
            ([1.9, 0.0, 0.0], 0),
            ([6.1, 3.0, 0.0], 1),
            ([4.0, f64::INFINITY, 0.0], 0),
            ([f64::NAN, 0.0, 0.0], 0),
        ] {
            assert_eq!(
                turns_back(&line(middle)).map(|(at, _)| at),
                Some(end),
                "{middle:?}"
            );
        }
    }

    #[test]
    fn shape_functions_interpolate_and_derivatives_agree_with_differences() {
        for (a, &node) in NODES.iter().enumerate() {
            for (b, value) in shape(node).0.iter().enumerate() {
                assert!((value - f64::from(u8::from(a == b))).abs() < 1e-15);
            }
        }
        for a in 0..3 {
            let difference = (shape(0.3 + 1e-6).0[a] - shape(0.3 - 1e-6).0[a]) / 2e-6;
            assert!((difference - shape(0.3).1[a]).abs() < 1e-9);
        }
    }
}
