//! Elimination of all fronts of a matrix, independent subtrees in parallel.
//!
//! The same operations in the same order whatever the number of threads.

use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

use faer::dyn_stack::{MemBuffer, MemStack};
use fe_core::sparsity::MatrixValues;

use super::LinearError;
use super::blocks::Blocks;
use super::dense::{self, Panel};
use super::fronts::{Front, Fronts};

/// A pivot smaller than this share of its diagonal entry means that the equation can move freely. Measured:
/// rigid-body modes leave 1e-15 to 2e-12 (beams of 176 x 4 x 1 and 300 x 2 x 2 cells), a cantilever 300 times
/// longer than deep 3e-8.
const SINGULAR_PIVOT: f64 = 1e-11;

/// Operations of a subtree that are worth a thread.
const PARALLEL: f64 = 2e6;

/// What a matrix is decomposed into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// L L^T.
    Definite,
    /// L B L^T.
    Indefinite,
    /// L U.
    General,
}

/// Why there is no factor.
#[derive(Debug)]
pub(super) enum Failure {
    /// L L^T met a pivot that is not positive.
    Indefinite,
    /// A pivot is nothing beside its diagonal entry, or there is no memory.
    Error(LinearError),
}

/// Tools that threads take and give back, as many as ever work at the same time.
#[derive(Debug, Default)]
pub(super) struct Pool(Mutex<Vec<Tools>>);

impl Pool {
    fn take(&self, height: usize) -> Result<Tools, LinearError> {
        let kept = self.kept().pop();
        kept.map_or_else(|| Tools::new(height), Ok)
    }

    /// A panic of another thread leaves nothing half done in it.
    fn kept(&self) -> MutexGuard<'_, Vec<Tools>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Memory of one thread.
struct Tools {
    kernel: MemBuffer,
    spare: Vec<f64>,
}

impl std::fmt::Debug for Tools {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Tools").finish_non_exhaustive()
    }
}

impl Tools {
    fn new(height: usize) -> Result<Self, LinearError> {
        Ok(Self {
            kernel: MemBuffer::try_new(dense::scratch(height))
                .map_err(|_| LinearError::OutOfMemory)?,
            spare: Vec::new(),
        })
    }
}

/// What fronts have left on the rows below, last one last.
pub(super) type Updates = Vec<Vec<f64>>;

/// The part of a factor that a range of fronts writes.
pub(super) struct Part<'a> {
    /// First entry of the panels, first column.
    pub(super) start: [usize; 2],
    pub(super) lower: &'a mut [f64],
    pub(super) upper: &'a mut [f64],
    pub(super) subdiagonal: &'a mut [f64],
    pub(super) pivots: [&'a mut [usize]; 2],
}

impl Part<'_> {
    /// Splits before `front`.
    fn split(self, front: &Front) -> (Self, Self) {
        let at = front.panel - self.start[0];
        let column = front.columns.start - self.start[1];
        let (lower, lower_rest) = self.lower.split_at_mut(at);
        let (upper, upper_rest) = self.upper.split_at_mut(at.min(self.upper.len()));
        let (subdiagonal, subdiagonal_rest) = self.subdiagonal.split_at_mut(column);
        let [forward, backward] = self.pivots;
        let (forward, forward_rest) = forward.split_at_mut(column);
        let (backward, backward_rest) = backward.split_at_mut(column);
        (
            Self {
                start: self.start,
                lower,
                upper,
                subdiagonal,
                pivots: [forward, backward],
            },
            Self {
                start: [front.panel, front.columns.start],
                lower: lower_rest,
                upper: upper_rest,
                subdiagonal: subdiagonal_rest,
                pivots: [forward_rest, backward_rest],
            },
        )
    }

    /// The panel of one of its fronts.
    fn panel(&mut self, front: &Front) -> Panel<'_> {
        let place = front.place();
        let entries = place.start - self.start[0]..place.end - self.start[0];
        let column = front.columns.start - self.start[1];
        let columns = column..column + front.width();
        let upper = if self.upper.is_empty() {
            0..0
        } else {
            entries.clone()
        };
        let [forward, backward] = &mut self.pivots;
        Panel {
            height: front.height(),
            lower: &mut self.lower[entries],
            upper: &mut self.upper[upper],
            subdiagonal: &mut self.subdiagonal[columns.clone()],
            pivots: [&mut forward[columns.clone()], &mut backward[columns]],
        }
    }
}

/// What a factorisation reads.
pub(super) struct Job<'a> {
    pub(super) fronts: &'a Fronts,
    pub(super) kind: Kind,
    pub(super) values: &'a MatrixValues,
    /// Diagonal entries of the equations.
    pub(super) diagonal: &'a [usize],
}

impl Job<'_> {
    /// Eliminates a range of fronts, all descendants included; returns what its roots leave.
    pub(super) fn run(
        &self,
        range: Range<usize>,
        part: Part<'_>,
        pool: &Pool,
    ) -> Result<Updates, Failure> {
        let Some((middle, end)) = self.halves(&range) else {
            return self.sequence(range, part, Vec::new(), pool);
        };
        let list = &self.fronts.list;
        let (left, right) = part.split(&list[middle]);
        let (right, rest) = if end < range.end {
            let (right, rest) = right.split(&list[end]);
            (right, Some(rest))
        } else {
            (right, None)
        };
        let (a, b) = rayon::join(
            || self.run(range.start..middle, left, pool),
            || self.run(middle..end, right, pool),
        );
        let mut updates = a?;
        updates.append(&mut b?);
        match rest {
            Some(rest) => self.sequence(end..range.end, rest, updates, pool),
            None => Ok(updates),
        }
    }

    /// Where a range is best split in two that can be eliminated at the same time, and where the first front comes that
    /// needs both.
    fn halves(&self, range: &Range<usize>) -> Option<(usize, usize)> {
        let list = &self.fronts.list;
        let mut root = range.end.checked_sub(1)?;
        loop {
            let children = self.fronts.children(root);
            let mut heavy = children.filter(|&c| c >= range.start && list[c].work > PARALLEL);
            let last = heavy.next()?;
            if heavy.next().is_some() {
                // The last heavy child against all before it.
                return Some((list[last].first, root));
            }
            root = last;
        }
    }

    /// Eliminates fronts one after the other.
    fn sequence(
        &self,
        range: Range<usize>,
        mut part: Part<'_>,
        mut updates: Updates,
        pool: &Pool,
    ) -> Result<Updates, Failure> {
        let height = self.fronts.height();
        let mut tools = pool.take(height).map_err(Failure::Error)?;
        for front in range {
            self.eliminate(front, &mut part, &mut updates, &mut tools)?;
        }
        pool.kept().push(tools);
        Ok(updates)
    }

    fn eliminate(
        &self,
        index: usize,
        part: &mut Part<'_>,
        updates: &mut Updates,
        tools: &mut Tools,
    ) -> Result<(), Failure> {
        let front = &self.fronts.list[index];
        let (width, height) = (front.width(), front.height());
        let mut panel = part.panel(front);
        self.assemble(front, &mut panel);
        let general = self.kind == Kind::General;
        let first = updates.len() - self.fronts.children(index).count();
        for (child, update) in self
            .fronts
            .children(index)
            .zip(updates[first..].iter().rev())
        {
            self.fronts.extend_panel(child, update, &mut panel);
        }
        let rest = height - width;
        let mut update = vec![0.0; rest * rest];
        let stack = MemStack::new(&mut tools.kernel);
        match self.kind {
            Kind::Definite => dense::cholesky(&mut panel, &mut update, stack)?,
            Kind::Indefinite => {
                dense::bunch_kaufman(&mut panel, &mut update, &mut tools.spare, stack);
            }
            Kind::General => dense::lu(&mut panel, &mut update, &mut tools.spare, stack),
        }
        self.check(front, &panel)?;
        for (child, old) in self
            .fronts
            .children(index)
            .zip(updates.drain(first..).rev())
        {
            self.fronts.extend_update(child, &old, &mut update, general);
        }
        updates.push(update);
        Ok(())
    }

    /// Entries of the matrix in the columns of a front.
    fn assemble(&self, front: &Front, panel: &mut Panel<'_>) {
        let MatrixValues { lower, upper } = self.values;
        panel.lower.fill(0.0);
        panel.upper.fill(0.0);
        for entry in self.fronts.entries(front) {
            let (target, source) = (entry.target as usize, entry.source());
            if self.kind == Kind::General {
                let (below, above) = if entry.is_swapped() {
                    (upper, lower)
                } else {
                    (lower, upper)
                };
                panel.lower[target] = below[source];
                panel.upper[target] = above[source];
            } else {
                panel.lower[target] = lower[source];
            }
        }
    }

    /// Refuses a pivot that is nothing beside the diagonal entry it came from, or not finite.
    fn check(&self, front: &Front, panel: &Panel<'_>) -> Result<(), Failure> {
        let diagonal = |j: usize| panel.lower[front.diagonal(j)];
        let mut columns = 0..front.width();
        match self.kind {
            Kind::Definite => {
                columns.try_for_each(|j| self.check_pivot(front, j, diagonal(j).powi(2)))
            }
            Kind::Indefinite => Blocks::new(diagonal, panel.subdiagonal).try_for_each(|block| {
                self.check_pivot(front, panel.pivots[0][block.column], block.size())
            }),
            // A row pivot may be small beside a diagonal entry: see the probe.
            Kind::General => match columns.find(|&j| !diagonal(j).is_finite()) {
                Some(j) => Err(self.singular(front, j, 0.0)),
                None => Ok(()),
            },
        }
    }

    fn check_pivot(&self, front: &Front, column: usize, pivot: f64) -> Result<(), Failure> {
        let equation = self.fronts.equation[front.columns.start + column] as usize;
        let original = self.values.lower[self.diagonal[equation]].abs();
        let ratio = if original > 0.0 {
            pivot.abs() / original
        } else {
            pivot.abs()
        };
        let regular = ratio > SINGULAR_PIVOT || (original == 0.0 && ratio > 0.0);
        if regular && pivot.is_finite() {
            Ok(())
        } else {
            Err(self.singular(front, column, ratio))
        }
    }

    fn singular(&self, front: &Front, column: usize, pivot_ratio: f64) -> Failure {
        let equation = self.fronts.equation[front.columns.start + column] as usize;
        Failure::Error(LinearError::Singular {
            equation,
            pivot_ratio,
        })
    }
}
