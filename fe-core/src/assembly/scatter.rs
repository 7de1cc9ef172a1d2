//! Where the entries of an element's matrix go in the arrays of values.

use crate::sparsity::Sparsity;

/// Equation number of a constrained DOF, and target of an entry that is dropped.
pub(super) const NONE: u32 = u32::MAX;

/// Set in a target whose entry (i, j) lies above the diagonal of the system; patterns of more than 2^31
/// entries (16 GiB of values) are beyond a direct solver.
const ABOVE: u32 = 1 << 31;

/// Targets of the upper triangle of an element's matrix. Neighbouring entries mostly go to neighbouring targets, three
/// to a node: these are kept by the first.
#[derive(Debug)]
pub(super) struct Scatter {
    /// Three entries of a row.
    in_rows: Vec<Entry>,
    /// Three entries of a column.
    in_columns: Vec<Entry>,
    /// The others.
    single: Vec<Entry>,
    /// Number of rows.
    n: usize,
}

/// An entry of the element's matrix and its target.
#[derive(Debug, Clone, Copy)]
struct Entry {
    target: u32,
    row: u16,
    column: u16,
}

/// Entries that follow one another.
const RUN: usize = 3;

impl Scatter {
    /// Looks up every entry once.
    pub(super) fn new(pattern: &Sparsity, equations: &[u32]) -> Self {
        let n = equations.len();
        let mut targets = vec![NONE; n * n];
        for i in 0..n {
            for j in i..n {
                let (row, col) = (equations[i], equations[j]);
                let (low, high) = (row.min(col), row.max(col));
                let position = if high == NONE {
                    None
                } else {
                    pattern.position(high as usize, low as usize)
                };
                let above = if row < col { ABOVE } else { 0 };
                targets[i * n + j] = position.map_or(NONE, |p| p as u32 | above);
            }
        }
        let mut scatter = Self {
            in_rows: Vec::new(),
            in_columns: Vec::new(),
            single: Vec::new(),
            n,
        };
        for i in 0..n {
            for j in i..n {
                scatter.take(&mut targets, i, j);
            }
        }
        scatter
    }

    /// Takes entry (i, j) and those that follow it out of the `targets`.
    fn take(&mut self, targets: &mut [u32], i: usize, j: usize) {
        let n = self.n;
        let first = targets[i * n + j];
        if first == NONE {
            return;
        }
        let along = |step: usize| (0..RUN).map(move |k| i * n + j + k * step);
        let follows = |step: usize| {
            let mut wanted = first..;
            along(step).all(|at| targets.get(at).copied() == wanted.next())
        };
        let (runs, step) = if j + RUN <= n && follows(1) {
            (&mut self.in_rows, 1)
        } else if i + RUN <= n && follows(n) {
            (&mut self.in_columns, n)
        } else {
            targets[i * n + j] = NONE;
            self.single.push(entry(first, i, j));
            return;
        };
        runs.push(entry(first, i, j));
        for at in along(step) {
            targets[at] = NONE;
        }
    }

    /// Adds a symmetric matrix, of which the upper triangle is read, to one triangle of the system.
    pub(super) fn add_symmetric(&self, matrix: &[f64], values: &mut [f64]) {
        let n = self.n;
        for entry in &self.in_rows {
            let (at, to) = (entry.at(n), entry.position());
            let (from, to) = (&matrix[at..at + RUN], &mut values[to..to + RUN]);
            for (value, add) in to.iter_mut().zip(from) {
                *value += add;
            }
        }
        for entry in &self.in_columns {
            let (at, to) = (entry.at(n), entry.position());
            let to = &mut values[to..to + RUN];
            for (k, value) in to.iter_mut().enumerate() {
                *value += matrix[at + k * n];
            }
        }
        for entry in &self.single {
            values[entry.position()] += matrix[entry.at(n)];
        }
    }

    /// Adds a full matrix to both triangles; the diagonal goes to both.
    pub(super) fn add_unsymmetric(&self, matrix: &[f64], lower: &mut [f64], upper: &mut [f64]) {
        let n = self.n;
        let mut add = |entry: &Entry, k: usize, (row, column): (usize, usize)| {
            let (ij, ji) = (matrix[row * n + column], matrix[column * n + row]);
            let (below, above) = if entry.target & ABOVE == 0 {
                (ij, ji)
            } else {
                (ji, ij)
            };
            lower[entry.position() + k] += below;
            upper[entry.position() + k] += above;
        };
        let place = |entry: &Entry| (usize::from(entry.row), usize::from(entry.column));
        for entry in &self.in_rows {
            let (i, j) = place(entry);
            (0..RUN).for_each(|k| add(entry, k, (i, j + k)));
        }
        for entry in &self.in_columns {
            let (i, j) = place(entry);
            (0..RUN).for_each(|k| add(entry, k, (i + k, j)));
        }
        for entry in &self.single {
            add(entry, 0, place(entry));
        }
    }
}

fn entry(target: u32, row: usize, column: usize) -> Entry {
    Entry {
        target,
        row: row as u16,
        column: column as u16,
    }
}

impl Entry {
    /// Index in a row-major matrix of `n` columns.
    fn at(self, n: usize) -> usize {
        usize::from(self.row) * n + usize::from(self.column)
    }

    /// Index of the target.
    const fn position(self) -> usize {
        (self.target & !ABOVE) as usize
    }
}
