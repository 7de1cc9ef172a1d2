//! Fronts: which columns are eliminated together, what they touch, and where everything goes.
//!
//! A front has the columns of one supernode and the rows in which they have entries: first its own, then those below.
//! A matrix of its columns, the panel, becomes part of the factor; what its elimination leaves on the rows below goes
//! to the parent (Duff and Reid 1983, ACM Trans. Math. Softw. 9).

use std::ops::Range;

use fe_core::sparsity::Sparsity;

use super::graph::Graph;
use super::tree::{ROOT, Tree};

/// One front.
#[derive(Debug, Clone)]
pub(super) struct Front {
    /// Columns, in the order of elimination.
    pub(super) columns: Range<usize>,
    /// Rows below, in [`Fronts::rows`].
    below: Range<usize>,
    /// Start of its panel in the factor.
    pub(super) panel: usize,
    /// Entries of the matrix in its columns, in [`Fronts::entries`].
    entries: Range<usize>,
    /// Runs of its rows below in the parent, in [`Fronts::runs`].
    runs: Range<usize>,
    /// First front of its subtree.
    pub(super) first: usize,
    /// Parent, [`ROOT`] for a root.
    pub(super) parent: usize,
    /// Operations of its subtree.
    pub(super) work: f64,
}

impl Front {
    /// Number of columns.
    pub(super) fn width(&self) -> usize {
        self.columns.len()
    }

    /// Number of rows.
    pub(super) fn height(&self) -> usize {
        self.columns.len() + self.below.len()
    }

    /// Entries of its panel.
    fn size(&self) -> usize {
        self.width() * self.height()
    }

    /// Where its panel is in the factor.
    pub(super) fn place(&self) -> Range<usize> {
        self.panel..self.panel + self.size()
    }

    /// Where the diagonal entry of one of its columns is in its panel.
    pub(super) fn diagonal(&self, column: usize) -> usize {
        column * (self.height() + 1)
    }
}

/// An entry of the matrix and its place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    /// Position in the panel.
    pub(super) target: u32,
    /// Position among the values of the matrix; with [`SWAPPED`] if the order of elimination swaps row and column.
    source: u32,
}

/// Set in the source of an entry of the lower triangle that elimination makes one of the upper. Patterns of more
/// than 2^31 entries are refused.
const SWAPPED: u32 = 1 << 31;

impl Entry {
    /// Position among the values of the matrix.
    pub(super) const fn source(self) -> usize {
        (self.source & !SWAPPED) as usize
    }

    /// Whether the order of elimination swaps row and column.
    pub(super) const fn is_swapped(self) -> bool {
        self.source & SWAPPED != 0
    }
}

/// Rows below of a front that follow one another in the parent too.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    /// First row, among the rows below.
    pub(super) from: u32,
    /// Where it is among all rows of the parent.
    pub(super) to: u32,
    /// Number of rows.
    pub(super) len: u32,
}

/// All fronts, children before parents and every subtree contiguous.
#[derive(Debug)]
pub(super) struct Fronts {
    pub(super) list: Vec<Front>,
    /// Equation of each column.
    pub(super) equation: Vec<u32>,
    rows: Vec<u32>,
    entries: Vec<Entry>,
    runs: Vec<Run>,
    /// Entries of all panels.
    pub(super) size: usize,
}

impl Fronts {
    /// Fronts of a tree; none if a panel has more entries than can be numbered.
    pub(super) fn new(pattern: &Sparsity, graph: &Graph, tree: &Tree) -> Option<Self> {
        if pattern.nnz() > SWAPPED as usize {
            return None;
        }
        let mut out = Self {
            list: Vec::new(),
            equation: Vec::new(),
            rows: Vec::new(),
            entries: Vec::new(),
            runs: Vec::new(),
            size: 0,
        };
        // First column of each position in the tree.
        let mut first = Vec::with_capacity(graph.len() + 1);
        for &v in &tree.order {
            first.push(out.equation.len());
            out.equation.extend(graph.equations(v).map(|e| e as u32));
        }
        first.push(out.equation.len());
        for node in supernodes(graph, tree) {
            out.add(graph, tree, &first, node);
        }
        if out.list.iter().any(|f| f.size() > u32::MAX as usize) {
            return None;
        }
        out.link();
        out.place(pattern);
        Some(out)
    }

    /// Entries of the factor: the trapezoids of the panels.
    pub(super) fn entries_of_factor(&self) -> usize {
        let trapezoid = |f: &Front| f.size() - f.width() * (f.width() - 1) / 2;
        self.list.iter().map(trapezoid).sum()
    }

    /// Most rows of a front.
    pub(super) fn height(&self) -> usize {
        self.list.iter().map(Front::height).max().unwrap_or(0)
    }

    /// Children of a front, last one first: each comes right before what follows it.
    pub(super) fn children(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        let before = move |front: usize| {
            let child = front.checked_sub(1)?;
            (self.list[child].parent == index).then_some(child)
        };
        std::iter::successors(before(index), move |&child| before(self.list[child].first))
    }

    /// Rows below of a front, as columns.
    pub(super) fn below(&self, front: &Front) -> &[u32] {
        &self.rows[front.below.clone()]
    }

    /// Entries of the matrix in the columns of a front.
    pub(super) fn entries(&self, front: &Front) -> &[Entry] {
        &self.entries[front.entries.clone()]
    }

    /// Where the rows below of a front are in its parent.
    pub(super) fn runs(&self, front: &Front) -> &[Run] {
        &self.runs[front.runs.clone()]
    }

    /// Adds the front of the positions `node` of the tree; its rows are those of the matrix and of its children.
    fn add(&mut self, graph: &Graph, tree: &Tree, first: &[usize], node: Range<usize>) {
        let columns = first[node.start]..first[node.end];
        let mut rows: Vec<u32> = Vec::new();
        for p in node.clone() {
            for &v in graph.neighbours(tree.order[p]) {
                let q = tree.position[v];
                if q >= node.end {
                    rows.extend((first[q]..first[q + 1]).map(|row| row as u32));
                }
            }
        }
        let me = self.list.len();
        let mut subtree = me;
        let mut work = 0.0;
        while let Some(child) = subtree.checked_sub(1) {
            let end = self.list[child].columns.end;
            // The parent of a front is that of its last position.
            let last = first.partition_point(|&c| c < end) - 1;
            if !node.contains(&tree.parent[last]) {
                break;
            }
            let beyond = self.below(&self.list[child]).iter();
            rows.extend(beyond.filter(|&&row| row as usize >= columns.end));
            self.list[child].parent = me;
            work += self.list[child].work;
            subtree = self.list[child].first;
        }
        rows.sort_unstable();
        rows.dedup();
        let (width, height) = (columns.len(), columns.len() + rows.len());
        let own: f64 = (0..width).map(|j| ((height - j) as f64).powi(2)).sum();
        let start = self.rows.len();
        self.rows.extend(rows);
        self.list.push(Front {
            columns,
            below: start..self.rows.len(),
            panel: self.size,
            entries: 0..0,
            runs: 0..0,
            first: subtree,
            parent: ROOT,
            work: work + own,
        });
        self.size += width * height;
    }

    /// Finds the rows of every front in its parent.
    fn link(&mut self) {
        for s in 0..self.list.len() {
            let start = self.runs.len();
            let front = &self.list[s];
            if let Some(parent) = self.list.get(front.parent) {
                let below = &self.rows[parent.below.clone()];
                let mut next = 0;
                let rows = self.rows[front.below.clone()].iter();
                for (from, &row) in (0_u32..).zip(rows) {
                    let to = if (row as usize) < parent.columns.end {
                        row as usize - parent.columns.start
                    } else {
                        while below[next] < row {
                            next += 1;
                        }
                        parent.width() + next
                    };
                    match self.runs[start..].last_mut() {
                        Some(run) if run.to + run.len == to as u32 => run.len += 1,
                        _ => self.runs.push(Run {
                            from,
                            to: to as u32,
                            len: 1,
                        }),
                    }
                }
            }
            self.list[s].runs = start..self.runs.len();
        }
    }

    /// Finds the place of every entry of the matrix.
    fn place(&mut self, pattern: &Sparsity) {
        let n = pattern.len();
        let mut column = vec![0_u32; n];
        for (c, &e) in self.equation.iter().enumerate() {
            column[e as usize] = c as u32;
        }
        let mut owner = vec![0_u32; n];
        for (s, front) in self.list.iter().enumerate() {
            owner[front.columns.clone()].fill(s as u32);
        }
        let front_of = |j: usize, k: usize| {
            let (a, b) = (column[j], column[pattern.row_idx()[k]]);
            (owner[a.min(b) as usize] as usize, a, b)
        };
        let mut next = vec![0; self.list.len() + 1];
        for j in 0..n {
            for k in pattern.column(j) {
                next[front_of(j, k).0 + 1] += 1;
            }
        }
        for s in 0..self.list.len() {
            next[s + 1] += next[s];
            self.list[s].entries = next[s]..next[s + 1];
        }
        let empty = Entry {
            target: 0,
            source: 0,
        };
        self.entries = vec![empty; pattern.nnz()];
        for j in 0..n {
            for k in pattern.column(j) {
                let (s, a, b) = front_of(j, k);
                let front = &self.list[s];
                let (left, row) = (a.min(b) as usize, a.max(b));
                let local = if (row as usize) < front.columns.end {
                    row as usize - front.columns.start
                } else {
                    front.width() + self.rows[front.below.clone()].partition_point(|&r| r < row)
                };
                self.entries[next[s]] = Entry {
                    target: ((left - front.columns.start) * front.height() + local) as u32,
                    source: k as u32 | if b < a { SWAPPED } else { 0 },
                };
                next[s] += 1;
            }
        }
    }
}

/// Positions of the tree that are eliminated together: those with the same rows below, and those so merged that few
/// zeros are stored, since wide fronts are eliminated at a higher rate.
fn supernodes(graph: &Graph, tree: &Tree) -> Vec<Range<usize>> {
    let mut nodes: Vec<Supernode> = Vec::new();
    for p in 0..tree.order.len() {
        let width = graph.weight(tree.order[p]);
        let mut node = Supernode {
            positions: p..p + 1,
            width,
            below: tree.below[p],
            zeros: 0,
        };
        while let Some(child) = nodes.last() {
            if !node
                .positions
                .contains(&tree.parent[child.positions.end - 1])
            {
                break;
            }
            let merged = child.merged(&node);
            if !merged.is_worthwhile() {
                break;
            }
            node = merged;
            nodes.pop();
        }
        nodes.push(node);
    }
    nodes.into_iter().map(|node| node.positions).collect()
}

struct Supernode {
    positions: Range<usize>,
    width: usize,
    below: usize,
    /// Entries stored that are zero.
    zeros: usize,
}

impl Supernode {
    /// With its parent.
    fn merged(&self, parent: &Self) -> Self {
        Self {
            positions: self.positions.start..parent.positions.end,
            width: self.width + parent.width,
            below: parent.below,
            zeros: self.zeros
                + parent.zeros
                + self.width * (parent.width + parent.below - self.below),
        }
    }

    fn is_worthwhile(&self) -> bool {
        let stored = self.width * self.width / 2 + self.width * self.below;
        let share = if self.width <= NARROW { MANY } else { FEW };
        self.zeros as f64 <= share * stored as f64
    }
}

/// Width up to which many zeros are stored for the sake of a wider front.
const NARROW: usize = 64;
/// Largest share of zeros in a narrow front.
const MANY: f64 = 0.2;
/// The same in a wide one.
const FEW: f64 = 0.02;
