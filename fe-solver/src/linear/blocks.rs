//! The blocks of B in L B L^T: pivots of one column or two.

/// Blocks of one front, from the diagonal of B by columns and its subdiagonal.
pub(super) struct Blocks<'a, D> {
    diagonal: D,
    subdiagonal: &'a [f64],
    column: usize,
}

/// One block.
pub(super) struct Block {
    /// First column, among those of the front.
    pub(super) column: usize,
    diagonal: [f64; 2],
    /// Off-diagonal entry of a block of two columns.
    off: Option<f64>,
}

impl<'a, D: Fn(usize) -> f64> Blocks<'a, D> {
    pub(super) const fn new(diagonal: D, subdiagonal: &'a [f64]) -> Self {
        Self {
            diagonal,
            subdiagonal,
            column: 0,
        }
    }
}

impl<D: Fn(usize) -> f64> Iterator for Blocks<'_, D> {
    type Item = Block;

    fn next(&mut self) -> Option<Block> {
        let column = self.column;
        let off = *self.subdiagonal.get(column)?;
        let single = off == 0.0 || column + 1 == self.subdiagonal.len();
        let last = if single { column } else { column + 1 };
        self.column = last + 1;
        Some(Block {
            column,
            diagonal: [(self.diagonal)(column), (self.diagonal)(last)],
            off: (!single).then_some(off),
        })
    }
}

impl Block {
    /// The pivot, or of a block of two columns the product of its eigenvalues over the largest entry.
    pub(super) fn size(&self) -> f64 {
        let [a, b] = self.diagonal;
        // Scaled by the off-diagonal entry, whose square may be beyond numbers.
        self.off
            .map_or(a, |off| off.abs() * ((a / off) * (b / off) - 1.0))
    }

    /// Number of negative eigenvalues.
    pub(super) fn negative(&self) -> usize {
        let [a, b] = self.diagonal;
        match self.off {
            Some(_) if self.size() < 0.0 => 1,
            // Of one sign, that of their sum.
            Some(_) => 2 * usize::from(a + b < 0.0),
            None => usize::from(a < 0.0),
        }
    }

    /// The inverse: of a block of two columns its diagonal and its off-diagonal entry.
    pub(super) fn inverse(&self) -> Inverse {
        let [a, b] = self.diagonal;
        self.off.map_or(Inverse::Single(1.0 / a), |off| {
            // Scaled by the off-diagonal entry, the largest.
            let (a, b) = (a / off, b / off);
            let scale = 1.0 / (off * (a * b - 1.0));
            Inverse::Double([b * scale, a * scale], -scale)
        })
    }
}

/// Inverse of a block.
pub(super) enum Inverse {
    Single(f64),
    Double([f64; 2], f64),
}
