//! Vectorised inner loops of the hexahedron that is uniform across: the hexahedron's, for eight nodes and the four strains
//! that do not vanish on the plane of symmetry.

use nalgebra::{Matrix6, Vector6};
use pulp::{Arch, Simd, WithSimd};

use crate::vectors::{self, Aligned, ByDirection, lanes};

/// Nodes, which fill the widest vector.
pub(super) const NODES: usize = 8;
/// DOFs.
const DOFS: usize = 3 * NODES;

/// Gradients du/dx and dv/dx, du/dy and dv/dy, dw/dz (1/mm) of the nodes, and the volume, of one point.
pub(super) type Point = vectors::Point<NODES>;

/// Voigt rows of the strains that do not vanish: xx, yy, zz, xy.
const ROWS: [usize; 4] = [0, 1, 2, 3];

/// Strains B u (Voigt, engineering shear) at the points.
pub(super) fn strains(points: &[Point], u: &ByDirection<NODES>, out: &mut [Vector6<f64>]) {
    Arch::new().dispatch(Strains { points, u, out });
}

struct Strains<'a> {
    points: &'a [Point],
    u: &'a ByDirection<NODES>,
    out: &'a mut [Vector6<f64>],
}

impl WithSimd for Strains<'_> {
    type Output = ();

    // Inlining is what compiles the body for the vector unit of the caller.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (point, strain) in self.points.iter().zip(self.out) {
            let mut sums = [simd.splat_f64s(0.0); 4];
            for i in 0..NODES / S::F64_LANES {
                let [x, y, z] = point.lanes::<S>(i);
                let [u, v, w] = lanes::<S, NODES>(self.u, i);
                sums[0] = simd.mul_add_f64s(x, u, sums[0]);
                sums[1] = simd.mul_add_f64s(y, v, sums[1]);
                sums[2] = simd.mul_add_f64s(z, w, sums[2]);
                sums[3] = simd.mul_add_f64s(y, u, sums[3]);
                sums[3] = simd.mul_add_f64s(x, v, sums[3]);
            }
            *strain = Vector6::zeros();
            for (row, sum) in ROWS.into_iter().zip(sums) {
                strain[row] = simd.reduce_sum_f64s(sum);
            }
        }
    }
}

/// Sum over the points of w B^T sigma, by direction.
pub(super) fn force(points: &[Point], stresses: &[Vector6<f64>]) -> ByDirection<NODES> {
    let mut sums = [[0.0; NODES]; 3];
    Arch::new().dispatch(Force {
        points,
        stresses,
        out: &mut sums,
    });
    sums
}

struct Force<'a> {
    points: &'a [Point],
    stresses: &'a [Vector6<f64>],
    out: &'a mut ByDirection<NODES>,
}

impl WithSimd for Force<'_> {
    type Output = ();

    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [fu, fv, fw] = self.out;
        let fu = S::as_mut_simd_f64s(fu).0;
        let fv = S::as_mut_simd_f64s(fv).0;
        let fw = S::as_mut_simd_f64s(fw).0;
        for i in 0..NODES / S::F64_LANES {
            let mut sums = [simd.splat_f64s(0.0); 3];
            for (point, stress) in self.points.iter().zip(self.stresses) {
                let [x, y, z] = point.lanes::<S>(i);
                let xx = simd.splat_f64s(point.volume * stress[ROWS[0]]);
                let yy = simd.splat_f64s(point.volume * stress[ROWS[1]]);
                let zz = simd.splat_f64s(point.volume * stress[ROWS[2]]);
                let xy = simd.splat_f64s(point.volume * stress[ROWS[3]]);
                sums[0] = simd.mul_add_f64s(x, xx, sums[0]);
                sums[0] = simd.mul_add_f64s(y, xy, sums[0]);
                sums[1] = simd.mul_add_f64s(y, yy, sums[1]);
                sums[1] = simd.mul_add_f64s(x, xy, sums[1]);
                sums[2] = simd.mul_add_f64s(z, zz, sums[2]);
            }
            [fu[i], fv[i], fw[i]] = sums;
        }
    }
}

/// Adds the sum over the points of w B^T D B to a 24 x 24 row-major matrix.
pub(super) fn stiffness(points: &[Point], tangents: &[Matrix6<f64>], out: &mut [f64]) {
    Arch::new().dispatch(Stiffness {
        points,
        tangents,
        out,
    });
}

struct Stiffness<'a> {
    points: &'a [Point],
    tangents: &'a [Matrix6<f64>],
    out: &'a mut [f64],
}

/// Most points of a rule in the plane.
const MAX_POINTS: usize = 9;

impl WithSimd for Stiffness<'_> {
    type Output = ();

    #[allow(clippy::inline_always, clippy::large_stack_arrays)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let zero = simd.splat_f64s(0.0);
        // w D B of every point for the nodes of one vector, by row and direction of displacement.
        let mut db = Aligned([[[zero; 3]; 4]; MAX_POINTS]);
        let db = &mut db.0[..self.points.len()];
        for i in 0..NODES / S::F64_LANES {
            for (point, (d, t)) in self.points.iter().zip(self.tangents.iter().zip(&mut *db)) {
                let w = simd.splat_f64s(point.volume);
                let [x, y, z] = point.lanes::<S>(i);
                let x = simd.mul_f64s(w, x);
                let y = simd.mul_f64s(w, y);
                let z = simd.mul_f64s(w, z);
                for (row, t) in ROWS.into_iter().zip(t) {
                    let shear = simd.splat_f64s(d[(row, 3)]);
                    t[0] = simd.mul_f64s(simd.splat_f64s(d[(row, 0)]), x);
                    t[0] = simd.mul_add_f64s(shear, y, t[0]);
                    t[1] = simd.mul_f64s(simd.splat_f64s(d[(row, 1)]), y);
                    t[1] = simd.mul_add_f64s(shear, x, t[1]);
                    t[2] = simd.mul_f64s(simd.splat_f64s(d[(row, 2)]), z);
                }
            }
            for a in 0..NODES {
                let mut sums = [[zero; 3]; 3];
                for (point, t) in self.points.iter().zip(&*db) {
                    let x = simd.splat_f64s(point.gradients[0][a]);
                    let y = simd.splat_f64s(point.gradients[1][a]);
                    let z = simd.splat_f64s(point.gradients[2][a]);
                    for l in 0..3 {
                        sums[0][l] = simd.mul_add_f64s(x, t[0][l], sums[0][l]);
                        sums[0][l] = simd.mul_add_f64s(y, t[3][l], sums[0][l]);
                        sums[1][l] = simd.mul_add_f64s(y, t[1][l], sums[1][l]);
                        sums[1][l] = simd.mul_add_f64s(x, t[3][l], sums[1][l]);
                        sums[2][l] = simd.mul_add_f64s(z, t[2][l], sums[2][l]);
                    }
                }
                for (k, sums) in sums.iter().enumerate() {
                    let mut row = [[0.0_f64; NODES]; 3];
                    for (row, sum) in row.iter_mut().zip(sums) {
                        S::as_mut_simd_f64s(row).0[i] = *sum;
                    }
                    let out = &mut self.out[(3 * a + k) * DOFS..(3 * a + k + 1) * DOFS];
                    for b in i * S::F64_LANES..(i + 1) * S::F64_LANES {
                        for l in 0..3 {
                            out[3 * b + l] += row[l][b];
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the loops against the plain products with the strain matrix.
    use super::*;
    use crate::vectors::{add_by_node, by_direction};
    use nalgebra::{DMatrix, DVector, SMatrix};

    fn value(i: usize) -> f64 {
        ((i * i) as f64 * 0.37).sin()
    }

    fn strain_matrix(g: &ByDirection<NODES>) -> SMatrix<f64, 6, DOFS> {
        let mut b = SMatrix::<f64, 6, DOFS>::zeros();
        for a in 0..NODES {
            b[(0, 3 * a)] = g[0][a];
            b[(1, 3 * a + 1)] = g[1][a];
            b[(2, 3 * a + 2)] = g[2][a];
            b[(3, 3 * a)] = g[1][a];
            b[(3, 3 * a + 1)] = g[0][a];
        }
        b
    }

    #[test]
    fn agree_with_the_plain_products() {
        let u: Vec<f64> = (0..DOFS).map(value).collect();
        let (mut points, mut tangents, mut stresses) = (vec![], vec![], vec![]);
        let mut expected = DMatrix::<f64>::zeros(DOFS, DOFS);
        let mut resultant = DVector::<f64>::zeros(DOFS);
        let mut elongations = vec![];
        for p in 0..9 {
            let at = |i| value(100 * p + i);
            let g = std::array::from_fn(|k| std::array::from_fn(|a| at(8 * k + a)));
            let b = strain_matrix(&g);
            let (weight, d) = (0.5 + p as f64, Matrix6::from_fn(|i, j| at(30 + 6 * i + j)));
            let s = Vector6::from_fn(|i, _| at(80 + i));
            expected += b.transpose() * d * b * weight;
            resultant += b.transpose() * s * weight;
            elongations.push(b * DVector::from_column_slice(&u));
            points.push(Point {
                gradients: g,
                volume: weight,
            });
            tangents.push(d);
            stresses.push(s);
        }
        let mut k = vec![0.0; DOFS * DOFS];
        stiffness(&points, &tangents, &mut k);
        let mut f = vec![0.0; DOFS];
        add_by_node(&force(&points, &stresses), &mut f);
        let mut e = vec![Vector6::zeros(); 9];
        strains(&points, &by_direction(&u), &mut e);
        for i in 0..DOFS {
            assert!((f[i] - resultant[i]).abs() < 1e-12 * resultant.amax());
            for j in 0..DOFS {
                let miss = k[DOFS * i + j] - expected[(i, j)];
                assert!(miss.abs() < 1e-12 * expected.amax(), "({i}, {j})");
            }
        }
        for (e, expected) in e.iter().zip(elongations) {
            assert!((e - expected).norm() < 1e-12);
        }
    }
}
