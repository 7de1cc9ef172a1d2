//! A numeric factor on an analysis, and solutions with it.

use fe_core::sparsity::MatrixValues;

use super::LinearError;
use super::blocks::{Blocks, Inverse};
use super::elimination::{Failure, Job, Kind, Part, Pool};
use super::fronts::Fronts;
use super::triangular;

/// A factor and the memory to make it.
#[derive(Debug)]
pub(super) struct Factor {
    kind: Kind,
    lower: Vec<f64>,
    upper: Vec<f64>,
    subdiagonal: Vec<f64>,
    pivots: [Vec<usize>; 2],
    pool: Pool,
    /// Right-hand side in the order of elimination, and the part that a front sees.
    right: [Vec<f64>; 2],
}

impl Factor {
    /// Room for a factor.
    pub(super) fn new(fronts: &Fronts) -> Result<Self, LinearError> {
        let n = fronts.equation.len();
        let mut lower = Vec::new();
        lower
            .try_reserve_exact(fronts.size)
            .map_err(|_| LinearError::OutOfMemory)?;
        lower.resize(fronts.size, 0.0);
        Ok(Self {
            kind: Kind::Definite,
            lower,
            upper: Vec::new(),
            subdiagonal: vec![0.0; n],
            pivots: [vec![0; n], vec![0; n]],
            pool: Pool::default(),
            right: [vec![0.0; n], vec![0.0; fronts.height()]],
        })
    }

    /// Decomposes `values`; false if they are not positive definite and should be.
    pub(super) fn factorize(
        &mut self,
        fronts: &Fronts,
        values: &MatrixValues,
        diagonal: &[usize],
        kind: Kind,
    ) -> Result<bool, LinearError> {
        self.kind = kind;
        if kind == Kind::General {
            let more = self.lower.len() - self.upper.len();
            self.upper
                .try_reserve_exact(more)
                .map_err(|_| LinearError::OutOfMemory)?;
            self.upper.resize(self.lower.len(), 0.0);
        }
        let job = Job {
            fronts,
            kind,
            values,
            diagonal,
        };
        let [forward, backward] = &mut self.pivots;
        let upper = match kind {
            Kind::General => &mut self.upper[..],
            Kind::Definite | Kind::Indefinite => &mut [],
        };
        let part = Part {
            start: [0, 0],
            lower: &mut self.lower,
            upper,
            subdiagonal: &mut self.subdiagonal,
            pivots: [forward, backward],
        };
        match job.run(0..fronts.list.len(), part, &self.pool) {
            Ok(_) => Ok(true),
            Err(Failure::Indefinite) => Ok(false),
            Err(Failure::Error(error)) => Err(error),
        }
    }

    /// Whether it is L L^T.
    pub(super) fn is_definite(&self) -> bool {
        self.kind == Kind::Definite
    }

    /// Number of negative pivots of L B L^T, those of 2 x 2 blocks included.
    pub(super) fn negative(&self, fronts: &Fronts) -> usize {
        let mut negative = 0;
        for front in &fronts.list {
            let subdiagonal = &self.subdiagonal[front.columns.clone()];
            let panel = &self.lower[front.place()];
            let diagonal = |j| panel[front.diagonal(j)];
            let blocks = Blocks::new(diagonal, subdiagonal);
            negative += blocks.map(|block| block.negative()).sum::<usize>();
        }
        negative
    }

    /// Solves in place.
    pub(super) fn solve(&mut self, fronts: &Fronts, rhs: &mut [f64]) {
        let [x, seen] = &mut self.right;
        for (x, &e) in x.iter_mut().zip(&fronts.equation) {
            *x = rhs[e as usize];
        }
        let unit = self.kind != Kind::Definite;
        for front in &fronts.list {
            let (width, height) = (front.width(), front.height());
            let panel = &self.lower[front.place()];
            let (own, below) = seen[..height].split_at_mut(width);
            let pivots = &self.pivots[0][front.columns.clone()];
            let mine = &mut x[front.columns.clone()];
            if unit {
                for (v, &p) in own.iter_mut().zip(pivots) {
                    *v = mine[p];
                }
            } else {
                own.copy_from_slice(mine);
            }
            below.fill(0.0);
            triangular::forward(panel, unit, &mut seen[..height]);
            if self.kind == Kind::Indefinite {
                let subdiagonal = &self.subdiagonal[front.columns.clone()];
                for block in Blocks::new(|j| panel[front.diagonal(j)], subdiagonal) {
                    let j = block.column;
                    match block.inverse() {
                        Inverse::Single(a) => mine[j] = a * seen[j],
                        Inverse::Double([a, b], c) => {
                            let (u, v) = (seen[j], seen[j + 1]);
                            (mine[j], mine[j + 1]) = (a * u + c * v, c * u + b * v);
                        }
                    }
                }
            } else {
                mine.copy_from_slice(&seen[..width]);
            }
            for (&row, v) in fronts.below(front).iter().zip(&seen[width..height]) {
                x[row as usize] += v;
            }
        }
        for front in fronts.list.iter().rev() {
            let (width, height) = (front.width(), front.height());
            seen[..width].copy_from_slice(&x[front.columns.clone()]);
            for (v, &row) in seen[width..height].iter_mut().zip(fronts.below(front)) {
                *v = x[row as usize];
            }
            let (panel, unit) = match self.kind {
                Kind::General => (&self.upper[front.place()], false),
                Kind::Definite => (&self.lower[front.place()], false),
                Kind::Indefinite => (&self.lower[front.place()], true),
            };
            triangular::backward(panel, unit, &mut seen[..height]);
            let mine = &mut x[front.columns.clone()];
            if self.kind == Kind::Indefinite {
                let pivots = &self.pivots[0][front.columns.clone()];
                for (&p, v) in pivots.iter().zip(&seen[..width]) {
                    mine[p] = *v;
                }
            } else {
                mine.copy_from_slice(&seen[..width]);
            }
        }
        for (x, &e) in x.iter().zip(&fronts.equation) {
            rhs[e as usize] = *x;
        }
    }
}
