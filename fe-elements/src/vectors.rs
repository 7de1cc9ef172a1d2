//! Values of nodes by direction, laid out for vectors.

use pulp::Simd;

/// One value for each node, by direction; `N` is a multiple of every vector length.
pub(crate) type ByDirection<const N: usize> = [[f64; N]; 3];

/// Starts at a line of the cache, so that no vector lies in two.
#[repr(align(64))]
pub(crate) struct Aligned<T>(pub(crate) T);

/// One integration point; it starts at a line of the cache like [`Aligned`].
#[repr(align(64))]
#[derive(Debug)]
pub(crate) struct Point<const N: usize> {
    /// Gradients (1/mm) of the nodes, by direction.
    pub(crate) gradients: ByDirection<N>,
    /// Weight times Jacobian determinant (mm3).
    pub(crate) volume: f64,
}

impl<const N: usize> Point<N> {
    /// Gradients of the nodes of vector `v`.
    // Inlining is what compiles it for the vector unit of the caller.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    pub(crate) fn lanes<S: Simd>(&self, v: usize) -> [S::f64s; 3] {
        lanes::<S, N>(&self.gradients, v)
    }
}

/// Values of the nodes of vector `v`.
#[allow(clippy::inline_always)]
#[inline(always)]
pub(crate) fn lanes<S: Simd, const N: usize>(values: &ByDirection<N>, v: usize) -> [S::f64s; 3] {
    let [x, y, z] = values;
    [
        S::as_simd_f64s(x).0[v],
        S::as_simd_f64s(y).0[v],
        S::as_simd_f64s(z).0[v],
    ]
}

/// Node-major values by direction, padded to `N` nodes.
pub(crate) fn by_direction<const N: usize>(u: &[f64]) -> ByDirection<N> {
    let mut out = [[0.0; N]; 3];
    for (a, node) in u.chunks_exact(3).enumerate() {
        for k in 0..3 {
            out[k][a] = node[k];
        }
    }
    out
}

/// Adds values by direction to node-major ones.
pub(crate) fn add_by_node<const N: usize>(values: &ByDirection<N>, out: &mut [f64]) {
    for (a, node) in out.chunks_exact_mut(3).enumerate() {
        for k in 0..3 {
            node[k] += values[k][a];
        }
    }
}
