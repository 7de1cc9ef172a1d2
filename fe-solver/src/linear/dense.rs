//! Elimination of the columns of one front, on faer's dense kernels, one thread.
//!
//! With the panel split into the square A of its own rows and the rows below C, elimination leaves -C A^-1 C^T (or
//! -C A^-1 R, R the rows to the right) on the rows below. Pivots are looked for within A only.

use faer::diag::DiagMut;
use faer::dyn_stack::{MemStack, StackReq};
use faer::linalg::cholesky::{lblt, llt};
use faer::linalg::lu::partial_pivoting::factor as lu;
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
};
use faer::prelude::{IntoConst, Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par};

use super::blocks::{Blocks, Inverse};
use super::elimination::Failure;

/// What one front leaves in the factor.
pub(super) struct Panel<'a> {
    /// Number of rows.
    pub(super) height: usize,
    /// Columns of L; beside the diagonal square its upper triangle is free.
    pub(super) lower: &'a mut [f64],
    /// Columns of U^T of an unsymmetric matrix, otherwise empty.
    pub(super) upper: &'a mut [f64],
    /// Subdiagonal of the blocks of B.
    pub(super) subdiagonal: &'a mut [f64],
    /// Column of the front that is the pivot of each of its columns, and the inverse.
    pub(super) pivots: [&'a mut [usize]; 2],
}

/// Columns of a panel that are updated together: narrow in low fronts.
const fn block(height: usize) -> usize {
    if height < 400 { 32 } else { 64 }
}

/// Memory that a front of this height needs beside itself.
pub(super) fn scratch(height: usize) -> StackReq {
    let one = Par::Seq;
    StackReq::any_of(&[
        llt::factor::cholesky_in_place_scratch::<f64>(height, one, faer::Spec::default()),
        lblt::factor::cholesky_in_place_scratch::<usize, f64>(height, one, faer::Spec::default()),
        lu::lu_in_place_scratch::<usize, f64>(height, height, one, faer::Spec::default()),
    ])
}

/// A matrix of `rows` rows, column by column.
fn columns(values: &mut [f64], rows: usize) -> MatMut<'_, f64> {
    let n = values.len().checked_div(rows).unwrap_or(0);
    MatMut::from_column_major_slice_mut(&mut values[..rows * n], rows, n)
}

/// L L^T of a panel; `update` becomes what it leaves, lower triangle.
pub(super) fn cholesky(
    panel: &mut Panel<'_>,
    update: &mut [f64],
    stack: &mut MemStack,
) -> Result<(), Failure> {
    let mut all = columns(panel.lower, panel.height);
    let (width, height) = (all.ncols(), panel.height);
    let step = block(height);
    for first in (0..width).step_by(step) {
        let n = step.min(width - first);
        let (done, mut rest) = all.rb_mut().split_at_col_mut(first);
        let mut rest = rest.rb_mut().submatrix_mut(first, 0, height - first, n);
        let done = done.into_const().subrows(first, height - first);
        if first > 0 {
            let right = done.subrows(0, n).transpose();
            matmul(rest.rb_mut(), Accum::Add, done, right, -1.0, Par::Seq);
        }
        let (mut square, below) = rest.split_at_row_mut(n);
        llt::factor::cholesky_in_place(
            square.rb_mut(),
            llt::factor::LltRegularization::default(),
            Par::Seq,
            stack,
            faer::Spec::default(),
        )
        .map_err(|_| Failure::Indefinite)?;
        solve_lower_triangular_in_place(square.into_const(), below.transpose_mut(), Par::Seq);
    }
    let below = all.into_const().subrows(width, height - width);
    leave(update, below, below);
    Ok(())
}

/// update = -left right^T, lower triangle.
fn leave(update: &mut [f64], left: MatRef<'_, f64>, right: MatRef<'_, f64>) {
    triangular::matmul(
        columns(update, left.nrows()),
        BlockStructure::TriangularLower,
        Accum::Replace,
        left,
        BlockStructure::Rectangular,
        right.transpose(),
        BlockStructure::Rectangular,
        -1.0,
        Par::Seq,
    );
}

/// L B L^T of a panel (Bunch and Kaufman 1977); `update` becomes what it leaves, lower triangle.
pub(super) fn bunch_kaufman(
    panel: &mut Panel<'_>,
    update: &mut [f64],
    spare: &mut Vec<f64>,
    stack: &mut MemStack,
) {
    let all = columns(panel.lower, panel.height);
    let (width, height) = (all.ncols(), panel.height);
    let (mut square, mut below) = all.split_at_row_mut(width);
    let [forward, backward] = &mut panel.pivots;
    lblt::factor::cholesky_in_place(
        square.rb_mut(),
        DiagMut::from_slice_mut(panel.subdiagonal),
        forward,
        backward,
        Par::Seq,
        stack,
        faer::Spec::default(),
    );
    // W = C P^T L^-T, kept beside W B^-1, which is the panel.
    let mut whole = permuted(below.rb(), forward, spare);
    solve_unit_lower_triangular_in_place(square.rb(), whole.rb_mut().transpose_mut(), Par::Seq);
    let rows = height - width;
    for block in Blocks::new(|j| square[(j, j)], panel.subdiagonal) {
        let j = block.column;
        match block.inverse() {
            Inverse::Single(a) => {
                for i in 0..rows {
                    below[(i, j)] = a * whole[(i, j)];
                }
            }
            Inverse::Double([a, b], c) => {
                for i in 0..rows {
                    let (u, v) = (whole[(i, j)], whole[(i, j + 1)]);
                    below[(i, j)] = a * u + c * v;
                    below[(i, j + 1)] = c * u + b * v;
                }
            }
        }
    }
    leave(update, below.into_const(), whole.into_const());
}

/// Columns of `matrix` in the order of the pivots, in `spare`.
fn permuted<'a>(
    matrix: MatRef<'_, f64>,
    pivots: &[usize],
    spare: &'a mut Vec<f64>,
) -> MatMut<'a, f64> {
    let (rows, n) = (matrix.nrows(), matrix.ncols());
    spare.clear();
    for &p in pivots {
        spare.extend(matrix.col(p).iter());
    }
    MatMut::from_column_major_slice_mut(&mut spare[..rows * n], rows, n)
}

/// L U of a panel with row pivots; `update` becomes what it leaves.
pub(super) fn lu(
    panel: &mut Panel<'_>,
    update: &mut [f64],
    spare: &mut Vec<f64>,
    stack: &mut MemStack,
) {
    let height = panel.height;
    let lower = columns(panel.lower, height);
    let upper = columns(panel.upper, height);
    let width = lower.ncols();
    let (mut square, mut below) = lower.split_at_row_mut(width);
    let (mut corner, mut right) = upper.split_at_row_mut(width);
    for j in 0..width {
        for i in 0..j {
            square[(i, j)] = corner[(j, i)];
        }
    }
    let [forward, backward] = &mut panel.pivots;
    lu::lu_in_place(
        square.rb_mut(),
        forward,
        backward,
        Par::Seq,
        stack,
        faer::Spec::default(),
    );
    for j in 0..width {
        for i in j..width {
            corner[(i, j)] = square[(j, i)];
        }
    }
    solve_lower_triangular_in_place(corner.rb(), below.rb_mut().transpose_mut(), Par::Seq);
    let mut whole = permuted(right.rb(), forward, spare);
    solve_unit_lower_triangular_in_place(square.rb(), whole.rb_mut().transpose_mut(), Par::Seq);
    right.copy_from(whole.rb());
    let (below, right) = (below.into_const(), right.into_const());
    let update = columns(update, height - width);
    matmul(
        update,
        Accum::Replace,
        below,
        right.transpose(),
        -1.0,
        Par::Seq,
    );
}
