//! Where the entries of an element's matrix go in the arrays of values.

use std::collections::HashSet;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use rayon::prelude::*;

use crate::sparsity::Sparsity;

/// Equation number of a constrained DOF, and place of an entry that is dropped.
pub(super) const NONE: u32 = u32::MAX;

/// Set in a place whose entry (i, j) lies above the diagonal of the system: it is in the column of i, others in that of j.
const ABOVE: u32 = 1 << 31;

/// Where the upper triangle of an element's matrix goes: where the columns of its equations begin, and the places there,
/// which elements in like surroundings share. Patterns of more than 2^32 entries (32 GiB of values) are beyond a direct
/// solver.
#[derive(Debug)]
pub(super) struct Scatter {
    begins: Vec<u32>,
    places: Arc<Places>,
}

/// Places of entries in the columns of the system. Neighbouring entries mostly go to neighbouring places, three to a node,
/// or two where one is held: these are kept by the first.
#[derive(Debug, Default, PartialEq, Eq)]
struct Places {
    threes: Runs,
    twos: Runs,
    /// The others.
    single: Vec<Entry>,
}

/// First entries of those that follow one another.
#[derive(Debug, Default, PartialEq, Eq)]
struct Runs {
    /// Along a row.
    in_rows: Vec<Entry>,
    /// Along a column.
    in_columns: Vec<Entry>,
}

/// An entry of the element's matrix and its place in its column of the system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Entry {
    place: u32,
    row: u16,
    column: u16,
}

impl Hash for Places {
    /// One number of all entries, for a fraction of the time of a hash of each.
    fn hash<H: Hasher>(&self, state: &mut H) {
        let Self {
            threes,
            twos,
            single,
        } = self;
        let runs = [threes, twos].map(|r| [&r.in_rows, &r.in_columns]);
        let all = runs.into_iter().flatten().chain([single]);
        let mix = |mix: u64, entry: &Entry| mix.rotate_left(7) ^ entry.packed();
        state.write_u64(all.flatten().fold(0, mix));
    }
}

/// Elements whose places are looked up before those found alike are dropped.
const AT_ONCE: usize = 1024;

/// Looks up every entry of the elements with these equations once.
pub(super) fn scatter(pattern: &Sparsity, equations: &[Vec<u32>]) -> Vec<Scatter> {
    let mut known: HashSet<Arc<Places>> = HashSet::new();
    let mut all = Vec::with_capacity(equations.len());
    for some in equations.chunks(AT_ONCE) {
        let found: Vec<Scatter> = some
            .par_iter()
            .map(|equations| Scatter::new(pattern, equations))
            .collect();
        for mut scatter in found {
            if let Some(places) = known.get(&scatter.places) {
                scatter.places = Arc::clone(places);
            } else {
                known.insert(Arc::clone(&scatter.places));
            }
            all.push(scatter);
        }
    }
    all
}

impl Scatter {
    fn new(pattern: &Sparsity, equations: &[u32]) -> Self {
        let begin = |equation: u32| match equation {
            NONE => NONE,
            column => pattern.column(column as usize).start as u32,
        };
        let begins: Vec<u32> = equations.iter().map(|&e| begin(e)).collect();
        let places = Places::new(pattern, equations, &begins);
        Self {
            begins,
            places: Arc::new(places),
        }
    }

    /// Where an entry, and those that follow it, go.
    fn position(&self, entry: Entry) -> usize {
        let column = if entry.is_above() {
            entry.row
        } else {
            entry.column
        };
        self.begins[usize::from(column)] as usize + (entry.place & !ABOVE) as usize
    }

    /// Adds a symmetric matrix, of which the upper triangle is read, to one triangle of the system.
    pub(super) fn add_symmetric(&self, matrix: &[f64], values: &mut [f64]) {
        self.add_runs::<3>(&self.places.threes, matrix, values);
        self.add_runs::<2>(&self.places.twos, matrix, values);
        let n = self.begins.len();
        for entry in &self.places.single {
            values[self.position(*entry)] += matrix[entry.at(n)];
        }
    }

    fn add_runs<const COUNT: usize>(&self, runs: &Runs, matrix: &[f64], values: &mut [f64]) {
        let n = self.begins.len();
        for entry in &runs.in_rows {
            let (at, to) = (entry.at(n), self.position(*entry));
            let (from, to) = (&matrix[at..at + COUNT], &mut values[to..to + COUNT]);
            for (value, add) in to.iter_mut().zip(from) {
                *value += add;
            }
        }
        for entry in &runs.in_columns {
            let (at, to) = (entry.at(n), self.position(*entry));
            let to = &mut values[to..to + COUNT];
            for (k, value) in to.iter_mut().enumerate() {
                *value += matrix[at + k * n];
            }
        }
    }

    /// Adds a full matrix to both triangles; the diagonal goes to both.
    pub(super) fn add_unsymmetric(&self, matrix: &[f64], lower: &mut [f64], upper: &mut [f64]) {
        let n = self.begins.len();
        let mut add = |entry: &Entry, count: usize, (by_row, by_column): (usize, usize)| {
            let to = self.position(*entry);
            let (lower, upper) = (&mut lower[to..to + count], &mut upper[to..to + count]);
            let (row, column) = (usize::from(entry.row), usize::from(entry.column));
            for (k, (lower, upper)) in lower.iter_mut().zip(upper).enumerate() {
                let (i, j) = (row + k * by_row, column + k * by_column);
                let (ij, ji) = (matrix[i * n + j], matrix[j * n + i]);
                let (below, above) = if entry.is_above() { (ji, ij) } else { (ij, ji) };
                *lower += below;
                *upper += above;
            }
        };
        for (runs, count) in [(&self.places.threes, 3), (&self.places.twos, 2)] {
            for entry in &runs.in_rows {
                add(entry, count, (0, 1));
            }
            for entry in &runs.in_columns {
                add(entry, count, (1, 0));
            }
        }
        for entry in &self.places.single {
            add(entry, 1, (0, 0));
        }
    }
}

impl Places {
    fn new(pattern: &Sparsity, equations: &[u32], begins: &[u32]) -> Self {
        let n = equations.len();
        let mut places = vec![NONE; n * n];
        let mut twice = Vec::new();
        for i in 0..n {
            for j in i..n {
                let (row, column) = (equations[i], equations[j]);
                let (low, high) = (row.min(column), row.max(column));
                let position = if high == NONE {
                    None
                } else {
                    pattern.position(high as usize, low as usize)
                };
                let (begin, above) = if row <= column {
                    (begins[i], ABOVE)
                } else {
                    (begins[j], 0)
                };
                let place = position.map_or(NONE, |p| (p as u32 - begin) | above);
                places[i * n + j] = place;
                if i != j && row == column && place != NONE {
                    twice.push(Entry {
                        place: place & !ABOVE,
                        row: i as u16,
                        column: j as u16,
                    });
                }
            }
        }
        let mut found = Self::default();
        for i in 0..n {
            for j in i..n {
                found.take(&mut places, (i, j), n);
            }
        }
        // Where an element has an equation twice, (j, i) goes to the same entry of the diagonal.
        found.single.append(&mut twice);
        found
    }

    /// Takes entry (i, j) and those that follow it out of the `places`.
    fn take(&mut self, places: &mut [u32], (i, j): (usize, usize), n: usize) {
        let first = places[i * n + j];
        if first == NONE {
            return;
        }
        let in_column_of_row = first & ABOVE != 0;
        let (step, left) = if in_column_of_row {
            (1, n - j)
        } else {
            (n, n - i)
        };
        let along = |count: usize| (0..count).map(move |k| i * n + j + k * step);
        let follow = |count: usize| {
            count <= left
                && along(count)
                    .zip(first..)
                    .all(|(at, wanted)| places[at] == wanted)
        };
        let mut counts = [3, 2].into_iter();
        let count = counts.find(|count| follow(*count)).unwrap_or(1);
        let entries = match (count, in_column_of_row) {
            (3, true) => &mut self.threes.in_rows,
            (3, false) => &mut self.threes.in_columns,
            (2, true) => &mut self.twos.in_rows,
            (2, false) => &mut self.twos.in_columns,
            _ => &mut self.single,
        };
        entries.push(entry(first, i, j));
        for at in along(count) {
            places[at] = NONE;
        }
    }
}

fn entry(place: u32, row: usize, column: usize) -> Entry {
    Entry {
        place,
        row: row as u16,
        column: column as u16,
    }
}

impl Entry {
    fn packed(self) -> u64 {
        u64::from(self.place) << 32 | u64::from(self.row) << 16 | u64::from(self.column)
    }

    const fn is_above(self) -> bool {
        self.place & ABOVE != 0
    }

    /// Index in a row-major matrix of `n` columns.
    fn at(self, n: usize) -> usize {
        usize::from(self.row) * n + usize::from(self.column)
    }
}
