//! Rows of strain matrices, most of whose entries are zero: a bar along x stretches by the displacements in x alone.

/// Row vector of DOFs, node-major: the entries that are not zero, in order.
#[derive(Debug, Clone)]
pub(super) struct Row(Box<[(usize, f64)]>);

impl Row {
    pub(super) fn new(dense: &[f64]) -> Self {
        let entries = dense.iter().copied().enumerate();
        Self(entries.filter(|&(_, r)| r != 0.0).collect())
    }

    /// The same with `count` more DOFs before the others.
    pub(super) fn after(&self, count: usize) -> Self {
        Self(self.0.iter().map(|&(i, r)| (i + count, r)).collect())
    }

    /// The row of the `n` DOFs that those of this one follow: column and factor of each.
    pub(super) fn led(&self, columns: &[(usize, f64)], n: usize) -> Self {
        let mut led = vec![0.0; n];
        for &(i, r) in &self.0 {
            let (column, factor) = columns[i];
            led[column] += factor * r;
        }
        Self::new(&led)
    }

    /// r . u.
    pub(super) fn dot(&self, u: &[f64]) -> f64 {
        self.0.iter().map(|&(i, r)| r * u[i]).sum()
    }

    /// Adds c r^T.
    pub(super) fn add(&self, c: f64, out: &mut [f64]) {
        for &(i, r) in &self.0 {
            out[i] += c * r;
        }
    }

    /// Adds c r^T b to a matrix of `n` columns, to its upper triangle unless `full`.
    pub(super) fn add_outer(&self, c: f64, b: &Self, (n, full): (usize, bool), out: &mut [f64]) {
        for &(i, r) in &self.0 {
            let scaled = c * r;
            let from = if full { 0 } else { i };
            for &(j, b) in b.0.iter().filter(|(j, _)| *j >= from) {
                out[i * n + j] += scaled * b;
            }
        }
    }
}
