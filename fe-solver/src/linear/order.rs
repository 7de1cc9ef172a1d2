//! Orders of elimination, and the choice among them by counted operations. That of the numbering from one end alone is no
//! candidate: it takes the operations of both ends, and leaves nothing to be done at the same time.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

use super::LinearError;
use super::graph::Graph;
use super::tree::Tree;

/// Share of the operations below which another order is taken instead of that from both ends, which has wider fronts.
const WORTHWHILE: f64 = 0.5;

/// How equations are ordered.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Ordering {
    /// As they are numbered, from both ends towards the middle: on meshes numbered along a slender axis as little fill as
    /// any order, in wide fronts, and two halves that can be eliminated at the same time.
    #[default]
    TwoSided,
    /// Approximate minimum degree (Amestoy, Davis and Duff 1996).
    MinimumDegree,
}

/// Tree of the order with the fewest operations; from both ends unless minimum degree saves half of them.
pub(super) fn choose(graph: &Graph) -> Result<(Ordering, Tree), LinearError> {
    let two_sided = Tree::new(graph, &from_both_ends(graph.len()));
    let degree = Tree::new(graph, &minimum_degree(graph)?);
    if degree.flops(graph) < WORTHWHILE * two_sided.flops(graph) {
        Ok((Ordering::MinimumDegree, degree))
    } else {
        Ok((Ordering::TwoSided, two_sided))
    }
}

fn from_both_ends(n: usize) -> Vec<usize> {
    (0..n / 2).chain((n / 2..n).rev()).collect()
}

fn minimum_degree(graph: &Graph) -> Result<Vec<usize>, LinearError> {
    let n = graph.len();
    let (start, adjacency) = (graph.start(), graph.adjacency());
    let pattern = SymbolicSparseColMatRef::new_checked(n, n, start, None, adjacency);
    let request = amd::order_scratch::<usize>(n, adjacency.len());
    let mut memory = MemBuffer::try_new(request).map_err(|_| LinearError::OutOfMemory)?;
    let (mut order, mut position) = (vec![0; n], vec![0; n]);
    amd::order(
        &mut order,
        &mut position,
        pattern,
        amd::Control::default(),
        MemStack::new(&mut memory),
    )
    .map_err(|_| LinearError::OutOfMemory)?;
    Ok(order)
}
