//! Vectorised inner loops of the hexahedron: strain, internal force and stiffness.
//!
//! B has three non-zeros per column, so w D B is formed from the gradients by component (6 rows, three
//! displacement directions of 20 nodes), and each 3 x 3 block row of B^T (w D B) is accumulated over the
//! points in registers; eight points at a time, so that w D B stays in the innermost cache. The loops are
//! written once and compiled for the vector unit found at run time; they hold no closures, which the compiler may
//! leave outside and compile for the least machine.

use nalgebra::{Matrix6, Vector6};
use pulp::{Arch, Simd, WithSimd};

/// Nodes padded to a multiple of every vector length.
pub(crate) const PAD: usize = 24;
/// Most points of a rule.
pub(crate) const MAX_POINTS: usize = 27;
/// Points treated together.
const CHUNK: usize = 8;

/// Gradients dN/dx, dN/dy, dN/dz (1/mm) of the 20 nodes at one point, by direction.
pub(crate) type Gradients = [[f64; PAD]; 3];

/// Gradients and weight times Jacobian determinant (mm3) of one point.
pub(crate) type Point = (Gradients, f64);

/// Voigt rows that the derivatives along x, y, z of displacement direction `k` enter:
/// direction x gives xx, xy, xz; y gives xy, yy, yz; z gives xz, yz, zz.
const ROWS: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// Displacements by direction, padded.
pub(crate) fn by_direction(u: &[f64]) -> Gradients {
    let mut out = [[0.0; PAD]; 3];
    for (a, node) in u.chunks_exact(3).take(20).enumerate() {
        for k in 0..3 {
            out[k][a] = node[k];
        }
    }
    out
}

/// Strains B u (Voigt, engineering shear) at the points.
pub(crate) fn strains(points: &[Point], u: &Gradients, out: &mut [Vector6<f64>]) {
    Arch::new().dispatch(Strains { points, u, out });
}

/// Strain B u at one point.
pub(crate) fn strain(point: &Point, u: &Gradients) -> Vector6<f64> {
    let mut out = [Vector6::zeros()];
    strains(std::slice::from_ref(point), u, &mut out);
    out[0]
}

struct Strains<'a> {
    points: &'a [Point],
    u: &'a Gradients,
    out: &'a mut [Vector6<f64>],
}

impl WithSimd for Strains<'_> {
    type Output = ();

    // Inlining is what compiles the body for the vector unit of the caller.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [ux, uy, uz] = self.u;
        let u = [
            S::as_simd_f64s(ux).0,
            S::as_simd_f64s(uy).0,
            S::as_simd_f64s(uz).0,
        ];
        for ((g, _), strain) in self.points.iter().zip(self.out) {
            // Displacement gradient du_k/dx_d.
            let mut h = [[0.0; 3]; 3];
            for d in 0..3 {
                let g = S::as_simd_f64s(&g[d]).0;
                for k in 0..3 {
                    let mut sum = simd.splat_f64s(0.0);
                    for (x, y) in u[k].iter().zip(g) {
                        sum = simd.mul_add_f64s(*x, *y, sum);
                    }
                    h[k][d] = simd.reduce_sum_f64s(sum);
                }
            }
            *strain = Vector6::new(
                h[0][0],
                h[1][1],
                h[2][2],
                h[0][1] + h[1][0],
                h[1][2] + h[2][1],
                h[0][2] + h[2][0],
            );
        }
    }
}

/// Sum over the points of w B^T sigma, by direction.
pub(crate) fn force(points: &[Point], stresses: &[Vector6<f64>]) -> Gradients {
    let mut out = [[0.0; PAD]; 3];
    Arch::new().dispatch(Force {
        points,
        stresses,
        out: &mut out,
    });
    out
}

struct Force<'a> {
    points: &'a [Point],
    stresses: &'a [Vector6<f64>],
    out: &'a mut Gradients,
}

impl WithSimd for Force<'_> {
    type Output = ();

    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for ((g, w), stress) in self.points.iter().zip(self.stresses) {
            let (gx, gy, gz) = (
                S::as_simd_f64s(&g[0]).0,
                S::as_simd_f64s(&g[1]).0,
                S::as_simd_f64s(&g[2]).0,
            );
            for k in 0..3 {
                let sx = simd.splat_f64s(w * stress[ROWS[k][0]]);
                let sy = simd.splat_f64s(w * stress[ROWS[k][1]]);
                let sz = simd.splat_f64s(w * stress[ROWS[k][2]]);
                let out = S::as_mut_simd_f64s(&mut self.out[k]).0;
                for (v, f) in out.iter_mut().enumerate() {
                    let sum = simd.mul_add_f64s(gx[v], sx, *f);
                    let sum = simd.mul_add_f64s(gy[v], sy, sum);
                    *f = simd.mul_add_f64s(gz[v], sz, sum);
                }
            }
        }
    }
}

/// Adds the sum over the points of w B^T D B to a 60 x 60 row-major matrix: to the upper triangle if
/// `symmetric`, else to all of it.
pub(crate) fn stiffness(
    points: &[Point],
    tangents: &[Matrix6<f64>],
    symmetric: bool,
    out: &mut [f64],
) {
    Arch::new().dispatch(Stiffness {
        points,
        tangents,
        symmetric,
        out,
    });
}

struct Stiffness<'a> {
    points: &'a [Point],
    tangents: &'a [Matrix6<f64>],
    symmetric: bool,
    out: &'a mut [f64],
}

impl WithSimd for Stiffness<'_> {
    type Output = ();

    // Inlining is what compiles the body for the vector unit of the caller.
    #[allow(clippy::inline_always, clippy::large_stack_arrays)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut db = [[[[0.0_f64; PAD]; 3]; 6]; CHUNK];
        let mut sums: Blocks = [[[[0.0; PAD]; 3]; 3]; 20];
        let chunks = self.points.chunks(CHUNK).zip(self.tangents.chunks(CHUNK));
        for (points, tangents) in chunks {
            products(simd, points, tangents, &mut db);
            accumulate(simd, points, &db, self.symmetric, &mut sums);
        }
        for (a, rows) in sums.iter().enumerate() {
            let first = if self.symmetric { a } else { 0 };
            for (k, row) in rows.iter().enumerate() {
                let out = &mut self.out[(3 * a + k) * 60..(3 * a + k + 1) * 60];
                for b in first..20 {
                    for l in 0..3 {
                        out[3 * b + l] += row[l][b];
                    }
                }
            }
        }
    }
}

/// Sums of 3 x 3 blocks of the stiffness: node and direction of the row, direction and node of the column.
type Blocks = [[[[f64; PAD]; 3]; 3]; 20];

/// w D B of one point, by Voigt row and displacement direction.
type Product = [[[f64; PAD]; 3]; 6];

#[allow(clippy::inline_always)]
#[inline(always)]
fn products<S: Simd>(simd: S, points: &[Point], tangents: &[Matrix6<f64>], db: &mut [Product]) {
    for ((g, w), (d, t)) in points.iter().zip(tangents.iter().zip(db)) {
        let (gx, gy, gz) = (
            S::as_simd_f64s(&g[0]).0,
            S::as_simd_f64s(&g[1]).0,
            S::as_simd_f64s(&g[2]).0,
        );
        for i in 0..6 {
            for k in 0..3 {
                let c = [
                    simd.splat_f64s(w * d[(i, ROWS[k][0])]),
                    simd.splat_f64s(w * d[(i, ROWS[k][1])]),
                    simd.splat_f64s(w * d[(i, ROWS[k][2])]),
                ];
                let row = S::as_mut_simd_f64s(&mut t[i][k]).0;
                for (v, r) in row.iter_mut().enumerate() {
                    let sum = simd.mul_f64s(c[0], gx[v]);
                    let sum = simd.mul_add_f64s(c[1], gy[v], sum);
                    *r = simd.mul_add_f64s(c[2], gz[v], sum);
                }
            }
        }
    }
}

/// Adds B^T (w D B) of the points, block by block.
#[allow(clippy::inline_always)]
#[inline(always)]
fn accumulate<S: Simd>(
    simd: S,
    points: &[Point],
    db: &[Product],
    symmetric: bool,
    out: &mut Blocks,
) {
    let lanes = S::F64_LANES;
    for a in 0..20 {
        let first = if symmetric { a / lanes } else { 0 };
        for v in first..20_usize.div_ceil(lanes) {
            let mut acc = [[simd.splat_f64s(0.0); 3]; 3];
            for ((g, _), t) in points.iter().zip(db) {
                let s = [
                    simd.splat_f64s(g[0][a]),
                    simd.splat_f64s(g[1][a]),
                    simd.splat_f64s(g[2][a]),
                ];
                for l in 0..3 {
                    let mut row = [simd.splat_f64s(0.0); 6];
                    for i in 0..6 {
                        row[i] = S::as_simd_f64s(&t[i][l]).0[v];
                    }
                    for k in 0..3 {
                        for d in 0..3 {
                            acc[k][l] = simd.mul_add_f64s(s[d], row[ROWS[k][d]], acc[k][l]);
                        }
                    }
                }
            }
            for k in 0..3 {
                for l in 0..3 {
                    let sum = &mut S::as_mut_simd_f64s(&mut out[a][k][l]).0[v];
                    *sum = simd.add_f64s(*sum, acc[k][l]);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the blocked kernel against the plain triple product.
    use super::*;
    use nalgebra::SMatrix;

    /// Strain matrix B, 6 x 60.
    fn strain_matrix(g: &Gradients) -> SMatrix<f64, 6, 60> {
        let mut b = SMatrix::<f64, 6, 60>::zeros();
        for a in 0..20 {
            for k in 0..3 {
                for d in 0..3 {
                    b[(ROWS[k][d], 3 * a + k)] += g[d][a];
                }
            }
        }
        b
    }

    fn value(i: usize) -> f64 {
        ((i * i) as f64 * 0.37).sin()
    }

    #[test]
    fn agrees_with_the_plain_product() {
        for (count, unsymmetry) in [(8, 0.0), (27, 0.0), (8, 1.0), (27, 1.0)] {
            let mut points = Vec::new();
            let mut tangents = Vec::new();
            let mut expected = nalgebra::DMatrix::<f64>::zeros(60, 60);
            for p in 0..count {
                let mut g = [[0.0; PAD]; 3];
                for (k, row) in g.iter_mut().enumerate() {
                    for a in 0..20 {
                        row[a] = value(p * 60 + k * 20 + a);
                    }
                }
                let weight = 0.5 + p as f64;
                let d = Matrix6::from_fn(|i, j| value(1000 + p * 36 + 6 * i + j));
                let d = d + d.transpose() + unsymmetry * d;
                let b = strain_matrix(&g);
                expected += b.transpose() * d * b * weight;
                points.push((g, weight));
                tangents.push(d);
            }
            let symmetric = unsymmetry == 0.0;
            let mut out = vec![0.0; 3600];
            stiffness(&points, &tangents, symmetric, &mut out);
            for i in 0..60 {
                for j in if symmetric { i } else { 0 }..60 {
                    let miss = out[60 * i + j] - expected[(i, j)];
                    assert!(miss.abs() < 1e-12 * expected.amax(), "{count}: ({i}, {j})");
                }
            }
        }
    }

    #[test]
    fn strain_and_force_agree_with_the_strain_matrix() {
        let mut g = [[0.0; PAD]; 3];
        for (k, row) in g.iter_mut().enumerate() {
            for a in 0..20 {
                row[a] = value(k * 20 + a);
            }
        }
        let u: Vec<f64> = (0..60).map(value).collect();
        let e = strain_matrix(&g) * nalgebra::SVector::<f64, 60>::from_column_slice(&u);
        assert!((strain(&(g, 1.0), &by_direction(&u)) - e).norm() < 1e-12);
        let s = Vector6::from_fn(|i, _| value(2000 + i));
        let f = strain_matrix(&g).transpose() * s * 0.7;
        let found = force(&[(g, 0.7)], &[s]);
        for i in 0..60 {
            assert!((found[i % 3][i / 3] - f[i]).abs() < 1e-12);
        }
    }
}
