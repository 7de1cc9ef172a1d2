//! Elimination tree, postorder and fill of a graph in a given order (Liu 1990, SIAM J. Matrix Anal. Appl. 11).

use super::graph::Graph;

/// No parent.
pub(super) const ROOT: usize = usize::MAX;

/// The elimination tree in postorder.
#[derive(Debug)]
pub(super) struct Tree {
    /// Vertex eliminated at each position.
    pub(super) order: Vec<usize>,
    /// Position of each vertex.
    pub(super) position: Vec<usize>,
    /// Parent of each position, [`ROOT`] for a root.
    pub(super) parent: Vec<usize>,
    /// Equations below those of each position in its columns of the factor.
    pub(super) below: Vec<usize>,
}

impl Tree {
    /// Tree of `graph` eliminated in `order`, which it keeps up to a postorder.
    pub(super) fn new(graph: &Graph, order: &[usize]) -> Self {
        let position = inverse(order);
        let parent = parents(graph, order, &position);
        let post = postorder(&parent);
        let rank = inverse(&post);
        let order: Vec<usize> = post.iter().map(|&p| order[p]).collect();
        let position = inverse(&order);
        let parent: Vec<usize> = post
            .iter()
            .map(|&p| rank.get(parent[p]).copied().unwrap_or(ROOT))
            .collect();
        let below = fill(graph, &order, &position, &parent);
        Self {
            order,
            position,
            parent,
            below,
        }
    }

    /// Multiplications and additions of L L^T: sum over the columns of the square of their entries.
    pub(super) fn flops(&self, graph: &Graph) -> f64 {
        let columns = self.order.iter().zip(&self.below);
        columns
            .flat_map(|(&v, &below)| {
                (1..=graph.weight(v)).map(move |k| ((below + k) as f64).powi(2))
            })
            .sum()
    }
}

fn inverse(order: &[usize]) -> Vec<usize> {
    let mut position = vec![0; order.len()];
    for (p, &v) in order.iter().enumerate() {
        position[v] = p;
    }
    position
}

/// Neighbours of the vertex at position `p` that are eliminated before it.
fn earlier<'a>(
    graph: &'a Graph,
    order: &[usize],
    position: &'a [usize],
    p: usize,
) -> impl Iterator<Item = usize> + 'a {
    let neighbours = graph.neighbours(order[p]).iter();
    neighbours.map(|&v| position[v]).filter(move |&q| q < p)
}

/// Parent of each position: the first row below the diagonal in its column of the factor.
fn parents(graph: &Graph, order: &[usize], position: &[usize]) -> Vec<usize> {
    let n = order.len();
    let mut parent = vec![ROOT; n];
    let mut ancestor = vec![ROOT; n];
    for p in 0..n {
        for mut q in earlier(graph, order, position, p) {
            // Every vertex on the way is led to p at once the next time.
            while q != p {
                let up = std::mem::replace(&mut ancestor[q], p);
                if up == ROOT {
                    parent[q] = p;
                    break;
                }
                q = up;
            }
        }
    }
    parent
}

/// Positions in an order in which every subtree is contiguous and ends with its root.
fn postorder(parent: &[usize]) -> Vec<usize> {
    let n = parent.len();
    // Children as linked lists, first child first.
    let (mut head, mut next) = (vec![ROOT; n], vec![ROOT; n]);
    for p in (0..n).rev() {
        if let Some(h) = head.get_mut(parent[p]) {
            next[p] = std::mem::replace(h, p);
        }
    }
    let mut post = Vec::with_capacity(n);
    let mut stack = Vec::new();
    for root in (0..n).filter(|&p| parent[p] == ROOT) {
        stack.push(root);
        while let Some(&p) = stack.last() {
            match std::mem::replace(&mut head[p], ROOT) {
                ROOT => {
                    post.push(p);
                    stack.pop();
                    if let (Some(&up), true) = (stack.last(), next[p] != ROOT) {
                        head[up] = next[p];
                    }
                }
                child => stack.push(child),
            }
        }
    }
    post
}

/// Equations below each position: row i of the factor has entries in the columns on the way from the entries of
/// row i of the matrix up the tree to i.
fn fill(graph: &Graph, order: &[usize], position: &[usize], parent: &[usize]) -> Vec<usize> {
    let n = order.len();
    let mut below = vec![0; n];
    let mut seen = vec![ROOT; n];
    for p in 0..n {
        seen[p] = p;
        for mut q in earlier(graph, order, position, p) {
            while seen[q] != p {
                seen[q] = p;
                below[q] += graph.weight(order[p]);
                q = parent[q];
            }
        }
    }
    below
}
