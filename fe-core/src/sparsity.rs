//! The fixed sparsity pattern of a system and its values.

/// Pattern of the lower triangle (diagonal included), compressed by columns, rows ascending.
///
/// Finite-element matrices are structurally symmetric, so this serves unsymmetric values too.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sparsity {
    col_ptr: Vec<usize>,
    row_idx: Vec<usize>,
}

impl Sparsity {
    /// Pattern in which the equations of every group are coupled with one another.
    pub fn from_groups<'a>(n: usize, groups: impl Iterator<Item = &'a [u32]> + Clone) -> Self {
        // Adjacency through the groups of each equation keeps memory proportional to the result.
        let mut start = vec![0usize; n + 1];
        for g in groups.clone() {
            for &i in g.iter().filter(|&&i| (i as usize) < n) {
                start[i as usize + 1] += 1;
            }
        }
        for i in 0..n {
            start[i + 1] += start[i];
        }
        let mut fill = start.clone();
        let mut member_of = vec![0u32; start[n]];
        for (k, g) in groups.clone().enumerate() {
            for &i in g.iter().filter(|&&i| (i as usize) < n) {
                member_of[fill[i as usize]] = k as u32;
                fill[i as usize] += 1;
            }
        }
        let groups: Vec<&[u32]> = groups.collect();
        let mut col_ptr = Vec::with_capacity(n + 1);
        let mut row_idx = Vec::new();
        let mut mark = vec![u32::MAX; n];
        col_ptr.push(0);
        for j in 0..n {
            let first = row_idx.len();
            mark[j] = j as u32;
            row_idx.push(j);
            for &k in &member_of[start[j]..start[j + 1]] {
                for &i in groups[k as usize] {
                    let i = i as usize;
                    if i > j && i < n && mark[i] != j as u32 {
                        mark[i] = j as u32;
                        row_idx.push(i);
                    }
                }
            }
            row_idx[first..].sort_unstable();
            col_ptr.push(row_idx.len());
        }
        Self { col_ptr, row_idx }
    }

    /// Number of equations.
    pub fn len(&self) -> usize {
        self.col_ptr.len() - 1
    }

    /// Whether there is no equation.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Stored entries of the lower triangle.
    pub fn nnz(&self) -> usize {
        self.row_idx.len()
    }

    /// Start of each column in [`Self::row_idx`]; `len() + 1` entries.
    pub fn col_ptr(&self) -> &[usize] {
        &self.col_ptr
    }

    /// Row of each stored entry.
    pub fn row_idx(&self) -> &[usize] {
        &self.row_idx
    }

    /// Positions of the entries of column `j`, from the diagonal on, in [`Self::row_idx`] and in arrays of values.
    pub fn column(&self, j: usize) -> std::ops::Range<usize> {
        self.col_ptr[j]..self.col_ptr[j + 1]
    }

    /// Position of entry (i, j), `i >= j`, in the value array; `None` where nothing is stored.
    pub fn position(&self, i: usize, j: usize) -> Option<usize> {
        let column = *self.col_ptr.get(j)?..*self.col_ptr.get(j + 1)?;
        self.row_idx[column.clone()]
            .binary_search(&i)
            .ok()
            .map(|k| column.start + k)
    }
}

/// Values on a [`Sparsity`] pattern.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MatrixValues {
    /// Entry (i, j), i >= j, at the position of (i, j).
    pub lower: Vec<f64>,
    /// Entry (j, i) at the position of (i, j), for an unsymmetric matrix; empty for a symmetric one.
    pub upper: Vec<f64>,
}

impl MatrixValues {
    /// Whether the values are stored as symmetric.
    pub fn is_symmetric(&self) -> bool {
        self.upper.is_empty()
    }

    /// y = A x on the given pattern.
    ///
    /// # Panics
    ///
    /// For values of another pattern, or vectors shorter than its number of equations.
    pub fn multiply(&self, pattern: &Sparsity, x: &[f64], y: &mut [f64]) {
        let upper = if self.is_symmetric() {
            &self.lower
        } else {
            &self.upper
        };
        y.fill(0.0);
        for j in 0..pattern.len() {
            let mut sum = 0.0;
            for k in pattern.column(j) {
                let i = pattern.row_idx[k];
                y[i] += self.lower[k] * x[j];
                if i != j {
                    sum += upper[k] * x[i];
                }
            }
            y[j] += sum;
        }
    }

    /// The full matrix, for export and for libraries that take compressed columns.
    ///
    /// # Panics
    ///
    /// For values of another pattern.
    pub fn to_csc(&self, pattern: &Sparsity) -> sprs::CsMat<f64> {
        let upper = if self.is_symmetric() {
            &self.lower
        } else {
            &self.upper
        };
        let n = pattern.len();
        let mut triplets = sprs::TriMat::with_capacity((n, n), 2 * pattern.nnz());
        for j in 0..n {
            for k in pattern.column(j) {
                let i = pattern.row_idx[k];
                triplets.add_triplet(i, j, self.lower[k]);
                if i != j {
                    triplets.add_triplet(j, i, upper[k]);
                }
            }
        }
        triplets.to_csc()
    }
}

#[cfg(test)]
mod tests {
    //! Protects the storage scheme that assembly and factorisation share.
    use super::*;

    #[test]
    fn pattern_and_product_agree_with_a_general_sparse_matrix() {
        let groups: [&[u32]; 3] = [&[0, 2, 1], &[3, 1], &[2, u32::MAX]];
        let pattern = Sparsity::from_groups(4, groups.into_iter());
        assert_eq!(pattern.row_idx(), &[0, 1, 2, 1, 2, 3, 2, 3]);
        assert_eq!(pattern.position(3, 1), Some(5));
        assert_eq!(pattern.position(3, 0), None);
        assert_eq!(pattern.position(4, 4), None);
        let a = MatrixValues {
            lower: (1..=8).map(f64::from).collect(),
            upper: (1..=8).map(|k| f64::from(k) - 0.5).collect(),
        };
        let x = [1.0, -2.0, 0.5, 3.0];
        let mut y = [0.0; 4];
        a.multiply(&pattern, &x, &mut y);
        let full = a.to_csc(&pattern);
        let expected = &full * &sprs::CsVec::new(4, vec![0, 1, 2, 3], x.to_vec());
        // The diagonal is stored once, from `lower`.
        for i in 0..4 {
            assert!((y[i] - expected[i]).abs() < 1e-14, "{i}");
        }
    }
}
