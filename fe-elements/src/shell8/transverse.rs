//! The elastic part of a shell: transverse shear with assumed strains, and the stabilisation of drilling.

use fe_core::shape::quad8;
use nalgebra::{Matrix2, Vector3};

use super::DOFS_PER_ELEMENT as N;
use crate::surface::Place;

/// A row of a strain matrix.
type Row = [f64; N];

/// Distance of the two points on a line of constant strain interpolation from its middle.
const TIE: f64 = 0.577_350_269_189_625_8;

/// The two of them.
const SIDES: [f64; 2] = [-1.0, 1.0];

/// Transverse shear strains of the two natural directions, gamma_r = x,_r . u,_z + x,_z . u,_r, at six points
/// each: on the lines across -1, 0, 1 the two at -TIE and TIE along the direction.
#[derive(Debug)]
pub(super) struct TiedShear([[Row; 6]; 2]);

/// The point of index i for a direction.
fn tying_point(direction: usize, i: usize) -> [f64; 2] {
    let mut xi = [0.0; 2];
    xi[direction] = SIDES[i % 2] * TIE;
    xi[1 - direction] = (i / 2) as f64 - 1.0;
    xi
}

impl TiedShear {
    pub(super) fn new(coords: &[[f64; 3]; 8], directors: &[Vector3<f64>; 8]) -> Self {
        Self(std::array::from_fn(|direction| {
            std::array::from_fn(|i| {
                natural_shear(coords, directors, direction, tying_point(direction, i))
            })
        }))
    }

    /// Shear strains 1n and 2n at a point. Along the direction the strain is linear; across, its mean of the
    /// two points is quadratic and its slope linear, taken from the edges.
    fn at(&self, place: &Place) -> [Row; 2] {
        let natural: [Row; 2] = std::array::from_fn(|direction| {
            let (r, s) = (place.xi[direction], place.xi[1 - direction]);
            let mean = [0.5 * s * (s - 1.0), 1.0 - s * s, 0.5 * s * (s + 1.0)];
            let slope = [0.5 * (1.0 - s), 0.0, 0.5 * (1.0 + s)];
            let mut row = [0.0; N];
            for (i, sample) in self.0[direction].iter().enumerate() {
                let weight = 0.5 * (mean[i / 2] + SIDES[i % 2] * r / TIE * slope[i / 2]);
                add(&mut row, weight, sample);
            }
            row
        });
        std::array::from_fn(|c| {
            let mut row = [0.0; N];
            for (r, strain) in natural.iter().enumerate() {
                add(&mut row, place.inverse[(c, r)], strain);
            }
            row
        })
    }

    /// Adds w S^T A S with the shear stiffness A (N/mm), to both triangles of an N x N matrix.
    pub(super) fn add_stiffness(&self, place: &Place, shear: &Matrix2<f64>, out: &mut [f64]) {
        let rows = self.at(place);
        for c in 0..2 {
            for d in 0..2 {
                add_product(out, place.area * shear[(c, d)], &rows[c], &rows[d]);
            }
        }
    }
}

/// gamma_r at a point: x,_r . sum N_a (theta_a x d_a) + d . sum N_a,_r u_a, d = sum N_a d_a.
fn natural_shear(
    coords: &[[f64; 3]; 8],
    directors: &[Vector3<f64>; 8],
    direction: usize,
    xi: [f64; 2],
) -> Row {
    let (values, slopes) = quad8::shape(xi);
    let along = quad8::base(coords, &slopes)[direction];
    let director: Vector3<f64> = values.iter().zip(directors).map(|(n, d)| *n * d).sum();
    let mut row = [0.0; N];
    for a in 0..8 {
        let turn = directors[a].cross(&along);
        for k in 0..3 {
            row[6 * a + k] = slopes[a][direction] * director[k];
            row[6 * a + 3 + k] = values[a] * turn[k];
        }
    }
    row
}

/// Adds w c r^T r of the drilling strain r = theta . n - (e_2 . u,_1 - e_1 . u,_2)/2 with the stiffness c (N/mm).
pub(super) fn add_drilling(place: &Place, stiffness: f64, out: &mut [f64]) {
    let [e1, e2, normal] = place.axes;
    let mut row = [0.0; N];
    for a in 0..8 {
        let [g1, g2] = place.gradients[a];
        for k in 0..3 {
            row[6 * a + k] = 0.5 * (g2 * e1[k] - g1 * e2[k]);
            row[6 * a + 3 + k] = place.values[a] * normal[k];
        }
    }
    add_product(out, place.area * stiffness, &row, &row);
}

fn add(sum: &mut Row, weight: f64, row: &Row) {
    for (s, r) in sum.iter_mut().zip(row) {
        *s += weight * r;
    }
}

fn add_product(out: &mut [f64], weight: f64, left: &Row, right: &Row) {
    for (row, l) in out.chunks_exact_mut(N).zip(left) {
        for (o, r) in row.iter_mut().zip(right) {
            *o += weight * l * r;
        }
    }
}
