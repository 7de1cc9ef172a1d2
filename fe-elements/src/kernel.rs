//! Vectorised inner loops of the hexahedron: strain, internal force and stiffness.
//!
//! B has three non-zeros per column, so w D B is formed from the gradients by component (6 rows, three
//! displacement directions), for as many nodes as a vector holds, so that it stays in the innermost cache; 3 x 3
//! blocks of B^T (w D B) are accumulated over the points in registers. The loops are written once and compiled for
//! the vector unit found at run time; they hold no closures, which the compiler may leave outside and compile for the
//! least machine.

use nalgebra::{Matrix6, Vector6};
use pulp::{Arch, Simd, WithSimd};

use crate::vectors::{self, Aligned, ByDirection, lanes};

/// Nodes padded to a multiple of every vector length.
pub(crate) const PAD: usize = 24;
/// Lanes of the widest vector.
const MAX_LANES: usize = 8;
/// Most points of a rule.
pub(crate) const MAX_POINTS: usize = 27;

/// Gradients dN/dx, dN/dy, dN/dz (1/mm) of the 20 nodes, and the volume, of one point.
pub(crate) type Point = vectors::Point<PAD>;

/// Voigt rows that the derivatives along x, y, z of displacement direction `k` enter:
/// direction x gives xx, xy, xz; y gives xy, yy, yz; z gives xz, yz, zz.
const ROWS: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// Strains B u (Voigt, engineering shear) at the points.
pub(crate) fn strains(points: &[Point], u: &ByDirection<PAD>, out: &mut [Vector6<f64>]) {
    Arch::new().dispatch(Strains { points, u, out });
}

struct Strains<'a> {
    points: &'a [Point],
    u: &'a ByDirection<PAD>,
    out: &'a mut [Vector6<f64>],
}

impl WithSimd for Strains<'_> {
    type Output = ();

    // Inlining is what compiles the body for the vector unit of the caller.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (point, strain) in self.points.iter().zip(self.out) {
            // Displacement gradient du_k/dx_d.
            let mut sums = [[simd.splat_f64s(0.0); 3]; 3];
            for v in 0..PAD / S::F64_LANES {
                let (g, u) = (point.lanes::<S>(v), lanes::<S, PAD>(self.u, v));
                for k in 0..3 {
                    for d in 0..3 {
                        sums[k][d] = simd.mul_add_f64s(u[k], g[d], sums[k][d]);
                    }
                }
            }
            let mut h = [[0.0; 3]; 3];
            for k in 0..3 {
                for d in 0..3 {
                    h[k][d] = simd.reduce_sum_f64s(sums[k][d]);
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
pub(crate) fn force(points: &[Point], stresses: &[Vector6<f64>]) -> ByDirection<PAD> {
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
    out: &'a mut ByDirection<PAD>,
}

impl WithSimd for Force<'_> {
    type Output = ();

    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (point, stress) in self.points.iter().zip(self.stresses) {
            for k in 0..3 {
                let sx = simd.splat_f64s(point.volume * stress[ROWS[k][0]]);
                let sy = simd.splat_f64s(point.volume * stress[ROWS[k][1]]);
                let sz = simd.splat_f64s(point.volume * stress[ROWS[k][2]]);
                let out = S::as_mut_simd_f64s(&mut self.out[k]).0;
                for (v, f) in out.iter_mut().enumerate() {
                    let [gx, gy, gz] = point.lanes::<S>(v);
                    let sum = simd.mul_add_f64s(gx, sx, *f);
                    let sum = simd.mul_add_f64s(gy, sy, sum);
                    *f = simd.mul_add_f64s(gz, sz, sum);
                }
            }
        }
    }
}

/// Adds the sum over the points of w B^T D B to a 60 x 60 row-major matrix: to the upper triangle at least if
/// `symmetric`, else to all of it.
pub(crate) fn stiffness(
    points: &[Point],
    tangents: &[Matrix6<f64>],
    symmetric: bool,
    out: &mut [f64],
) {
    dispatch_narrow(Stiffness {
        points,
        tangents,
        symmetric,
        out,
    });
}

/// Runs an operation on vectors of four where the machine has them. The 20 nodes are five of these: eight at a time
/// compute 24, and a symmetric matrix by squares of 8 x 8 on the diagonal.
fn dispatch_narrow<W: WithSimd>(operation: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    if let Some(simd) = pulp::x86::V3::try_new() {
        return Simd::vectorize(simd, operation);
    }
    Arch::new().dispatch(operation)
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
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        if self.points.len() <= 8 {
            self.within::<S, 8>(simd);
        } else {
            self.within::<S, MAX_POINTS>(simd);
        }
    }
}

impl Stiffness<'_> {
    /// For at most `MOST` points.
    #[allow(clippy::inline_always, clippy::large_stack_arrays)]
    #[inline(always)]
    fn within<S: Simd, const MOST: usize>(self, simd: S) {
        let zero = simd.splat_f64s(0.0);
        let mut db: Aligned<[Product<S>; MOST]> = Aligned([[[zero; 3]; 6]; MOST]);
        let db = &mut db.0[..self.points.len()];
        for v in 0..20_usize.div_ceil(S::F64_LANES) {
            products(simd, self.points, self.tangents, v, db);
            let columns = v * S::F64_LANES..20.min((v + 1) * S::F64_LANES);
            for a in 0..if self.symmetric { columns.end } else { 20 } {
                let block = accumulate(simd, self.points, db, a);
                add::<S>(&block, a, columns.clone(), self.out);
            }
        }
    }
}

/// w D B of one point for the nodes of one vector, by Voigt row and displacement direction.
type Product<S> = [[<S as Simd>::f64s; 3]; 6];

/// Sums of 3 x 3 blocks for the nodes of one vector: direction of the row, of the column.
type Blocks<S> = [[<S as Simd>::f64s; 3]; 3];

/// w D B of the points for the nodes of vector `v`.
#[allow(clippy::inline_always)]
#[inline(always)]
fn products<S: Simd>(
    simd: S,
    points: &[Point],
    tangents: &[Matrix6<f64>],
    v: usize,
    db: &mut [Product<S>],
) {
    for (point, (d, t)) in points.iter().zip(tangents.iter().zip(db)) {
        let w = simd.splat_f64s(point.volume);
        let [gx, gy, gz] = point.lanes::<S>(v);
        let gx = simd.mul_f64s(w, gx);
        let gy = simd.mul_f64s(w, gy);
        let gz = simd.mul_f64s(w, gz);
        for i in 0..6 {
            for k in 0..3 {
                let sum = simd.mul_f64s(simd.splat_f64s(d[(i, ROWS[k][0])]), gx);
                let sum = simd.mul_add_f64s(simd.splat_f64s(d[(i, ROWS[k][1])]), gy, sum);
                t[i][k] = simd.mul_add_f64s(simd.splat_f64s(d[(i, ROWS[k][2])]), gz, sum);
            }
        }
    }
}

/// B^T (w D B) summed over the points: blocks of the row of node `a`.
#[allow(clippy::inline_always)]
#[inline(always)]
fn accumulate<S: Simd>(simd: S, points: &[Point], db: &[Product<S>], a: usize) -> Blocks<S> {
    let mut sums = [[simd.splat_f64s(0.0); 3]; 3];
    for (point, t) in points.iter().zip(db) {
        for d in 0..3 {
            let s = simd.splat_f64s(point.gradients[d][a]);
            for k in 0..3 {
                for l in 0..3 {
                    sums[k][l] = simd.mul_add_f64s(s, t[ROWS[k][d]][l], sums[k][l]);
                }
            }
        }
    }
    sums
}

/// Adds the blocks of row node `a` and the nodes `columns` of one vector.
#[allow(clippy::inline_always)]
#[inline(always)]
fn add<S: Simd>(block: &Blocks<S>, a: usize, columns: std::ops::Range<usize>, out: &mut [f64]) {
    let mut row = [[0.0_f64; MAX_LANES]; 3];
    for (k, sums) in block.iter().enumerate() {
        for (l, sum) in sums.iter().enumerate() {
            S::as_mut_simd_f64s(&mut row[l]).0[0] = *sum;
        }
        let start = (3 * a + k) * 60;
        let out = &mut out[start + 3 * columns.start..start + 3 * columns.end];
        for (b, out) in out.chunks_exact_mut(3).enumerate() {
            for l in 0..3 {
                out[l] += row[l][b];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the blocked kernel against the plain triple product.
    use super::*;
    use crate::vectors::by_direction;
    use nalgebra::SMatrix;

    /// Strain matrix B, 6 x 60.
    fn strain_matrix(g: &ByDirection<PAD>) -> SMatrix<f64, 6, 60> {
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
                points.push(Point {
                    gradients: g,
                    volume: weight,
                });
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
        let point = |volume| Point {
            gradients: g,
            volume,
        };
        let u: Vec<f64> = (0..60).map(value).collect();
        let e = strain_matrix(&g) * nalgebra::SVector::<f64, 60>::from_column_slice(&u);
        let mut strain = [Vector6::zeros()];
        strains(&[point(1.0)], &by_direction(&u), &mut strain);
        assert!((strain[0] - e).norm() < 1e-12);
        let s = Vector6::from_fn(|i, _| value(2000 + i));
        let f = strain_matrix(&g).transpose() * s * 0.7;
        let found = force(&[point(0.7)], &[s]);
        for i in 0..60 {
            assert!((found[i % 3][i / 3] - f[i]).abs() < 1e-12);
        }
    }
}
