//! The graph of a matrix, in which equations that couple with the same others are one vertex.
//!
//! The DOFs of a node nearly always are, so the graph of a solid has a third of the vertices and a ninth of the edges
//! of its matrix, and everything symbolic works on it.

use fe_core::sparsity::Sparsity;

/// Vertices and their neighbours.
#[derive(Debug)]
pub(super) struct Graph {
    /// First equation of each vertex, and the number of equations.
    first: Vec<usize>,
    start: Vec<usize>,
    neighbours: Vec<usize>,
}

impl Graph {
    /// Merges neighbouring equations with the same couplings.
    pub(super) fn new(pattern: &Sparsity) -> Self {
        let n = pattern.len();
        let rows = Rows::new(pattern);
        let mut first = Vec::new();
        let mut vertex = vec![0; n];
        for j in 0..n {
            if j == 0 || !same_couplings(pattern, &rows, j - 1) {
                first.push(j);
            }
            vertex[j] = first.len() - 1;
        }
        let mut start = vec![0];
        let mut neighbours: Vec<usize> = Vec::new();
        for (v, &j) in first.iter().enumerate() {
            let before = neighbours.len();
            let coupled = rows.of(j).iter().map(|&i| i as usize);
            for i in coupled.chain(below(pattern, j).iter().copied()) {
                let other = vertex[i];
                if other != v && neighbours[before..].last() != Some(&other) {
                    neighbours.push(other);
                }
            }
            start.push(neighbours.len());
        }
        first.push(n);
        Self {
            first,
            start,
            neighbours,
        }
    }

    /// Number of vertices.
    pub(super) fn len(&self) -> usize {
        self.first.len() - 1
    }

    /// Equations of a vertex.
    pub(super) fn equations(&self, vertex: usize) -> std::ops::Range<usize> {
        self.first[vertex]..self.first[vertex + 1]
    }

    /// Number of equations of a vertex.
    pub(super) fn weight(&self, vertex: usize) -> usize {
        self.equations(vertex).len()
    }

    /// Neighbours of a vertex, ascending.
    pub(super) fn neighbours(&self, vertex: usize) -> &[usize] {
        &self.neighbours[self.start[vertex]..self.start[vertex + 1]]
    }

    /// Start of each vertex in [`Self::adjacency`].
    pub(super) fn start(&self) -> &[usize] {
        &self.start
    }

    /// Neighbours of all vertices, one after the other.
    pub(super) fn adjacency(&self) -> &[usize] {
        &self.neighbours
    }
}

/// Columns left of the diagonal in each row.
struct Rows {
    start: Vec<usize>,
    columns: Vec<u32>,
}

impl Rows {
    fn new(pattern: &Sparsity) -> Self {
        let n = pattern.len();
        let mut start = vec![0; n + 1];
        for j in 0..n {
            for &i in &below(pattern, j)[1..] {
                start[i + 1] += 1;
            }
        }
        for i in 0..n {
            start[i + 1] += start[i];
        }
        let mut next = start.clone();
        let mut columns = vec![0; start[n]];
        for j in 0..n {
            for &i in &below(pattern, j)[1..] {
                columns[next[i]] = j as u32;
                next[i] += 1;
            }
        }
        Self { start, columns }
    }

    fn of(&self, i: usize) -> &[u32] {
        &self.columns[self.start[i]..self.start[i + 1]]
    }
}

/// Rows of column `j`, from the diagonal on.
fn below(pattern: &Sparsity, j: usize) -> &[usize] {
    &pattern.row_idx()[pattern.column(j)]
}

/// Whether equations `j` and `j + 1` couple with the same equations, each other included.
fn same_couplings(pattern: &Sparsity, rows: &Rows, j: usize) -> bool {
    let (left, right) = (rows.of(j), rows.of(j + 1));
    below(pattern, j)[1..] == *below(pattern, j + 1)
        && right.split_last() == Some((&(j as u32), left))
}
