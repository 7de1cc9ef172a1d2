//! Elements on nodes that follow others or hang between them.

use std::borrow::Cow;
use std::cell::Cell;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::followers::Followers;
use fe_core::mesh::NodeId;

use crate::seen::{Seen, View};

/// An element on the DOFs of other nodes than its own: u = T u_led, f = T^T f, K = T^T K T.
pub type Led = Seen<Fold>;

/// Where the DOFs of an element that is [`Led`] come from.
#[derive(Debug)]
pub struct Fold {
    nodes: Vec<NodeId>,
    /// Column and value of every entry of T, row by row.
    entries: Vec<(usize, f64)>,
    /// Where each row begins, and the last one ends.
    begins: Vec<usize>,
}

impl Led {
    /// The element on the leaders of its nodes, or itself where none follows another. Each row of T has one entry, the factor
    /// of a follower.
    pub fn by(element: Box<dyn Element>, followers: &Followers) -> Box<dyn Element> {
        if element.nodes().iter().all(|&n| followers.of(n).0 == n) {
            return element;
        }
        let (nodes, entries) = columns(element.nodes(), element.dofs(), followers);
        let begins = (0..=entries.len()).collect();
        let view = Fold {
            nodes,
            entries,
            begins,
        };
        Box::new(Self { element, view })
    }

    /// The element with one of its nodes held where it lies between others, u = sum N_b u_b over the nodes and shape
    /// functions `held`; itself where it does not have that node.
    ///
    /// Meant for displacements: rotations are interpolated likewise.
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] unless the shape functions sum to 1.
    pub fn hung(
        element: Box<dyn Element>,
        node: NodeId,
        held: &[(NodeId, f64)],
    ) -> Result<Box<dyn Element>, ElementError> {
        let sum: f64 = held.iter().map(|(_, n)| n).sum();
        if sum.is_nan() || (sum - 1.0).abs() > 1e-6 {
            return Err(ElementError::Input {
                what: "sum of the shape functions that hold a node".into(),
                value: sum,
                allowed: "1".into(),
                remedy: "give the values of all shape functions at the place of the node".into(),
            });
        }
        let own = element.nodes();
        if !own.contains(&node) {
            return Ok(element);
        }
        let mut nodes: Vec<NodeId> = own.iter().copied().filter(|&n| n != node).collect();
        for (n, _) in held {
            if !nodes.contains(n) {
                nodes.push(*n);
            }
        }
        let place = |node: NodeId| nodes.iter().position(|&n| n == node);
        let per_node = element.dofs().len();
        let (mut entries, mut begins) = (Vec::new(), vec![0]);
        for &n in own {
            let itself = [(n, 1.0)];
            let sources = if n == node { held } else { &itself };
            for k in 0..per_node {
                let columns = sources
                    .iter()
                    .filter_map(|&(n, value)| Some((place(n)?, value)));
                entries.extend(columns.map(|(at, value)| (per_node * at + k, value)));
                begins.push(entries.len());
            }
        }
        let view = Fold {
            nodes,
            entries,
            begins,
        };
        Ok(Box::new(Self { element, view }))
    }
}

impl Fold {
    /// T u.
    fn displacements(&self, u: &[f64]) -> impl Iterator<Item = f64> {
        let row = |row: &[(usize, f64)]| row.iter().map(|&(c, t)| t * u[c]).sum();
        self.rows().map(row)
    }

    /// Columns and values of the rows of T.
    fn rows(&self) -> impl Iterator<Item = &[(usize, f64)]> {
        self.begins.windows(2).map(|w| &self.entries[w[0]..w[1]])
    }
}

thread_local! {
    /// Displacements, force and stiffness of the element within, for the next evaluation.
    static BUFFERS: Cell<[Vec<f64>; 3]> = const { Cell::new([const { Vec::new() }; 3]) };
}

/// Leaders of `nodes`, each once, and column and entry of every row of T, node-major.
pub(crate) fn columns(
    nodes: &[NodeId],
    dofs: &[Dof],
    followers: &Followers,
) -> (Vec<NodeId>, Vec<(usize, f64)>) {
    let mut leaders: Vec<NodeId> = Vec::new();
    let mut columns = Vec::new();
    for &node in nodes {
        let leader = followers.of(node).0;
        let known = leaders.iter().position(|&n| n == leader);
        let at = known.unwrap_or(leaders.len());
        if known.is_none() {
            leaders.push(leader);
        }
        for (k, &dof) in dofs.iter().enumerate() {
            columns.push((dofs.len() * at + k, followers.dof(node, dof).1));
        }
    }
    (leaders, columns)
}

impl View for Fold {
    fn nodes<'a>(&'a self, _: &'a [NodeId]) -> &'a [NodeId] {
        &self.nodes
    }

    fn own<'a>(&self, u: &'a [f64]) -> Cow<'a, [f64]> {
        self.displacements(u).collect()
    }

    fn evaluate(
        &self,
        element: &dyn Element,
        u: &[f64],
        (committed, trial): (&[f64], &mut [f64]),
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        let (n, led) = (self.begins.len() - 1, u.len());
        let [mut own, mut force, mut stiffness] = BUFFERS.take();
        own.clear();
        own.extend(self.displacements(u));
        let entries = if out.stiffness.is_empty() { 0 } else { n * n };
        for (zeros, len) in [(&mut force, n), (&mut stiffness, entries)] {
            zeros.clear();
            zeros.resize(len, 0.0);
        }
        let system = ElementSystem {
            force: &mut force,
            stiffness: &mut stiffness,
        };
        element.evaluate(&own, committed, trial, ctx, system)?;
        for (f, row) in force.iter().zip(self.rows()) {
            for &(c, t) in row {
                out.force[c] += t * f;
            }
        }
        let upper = element.fills_upper(ctx);
        for (i, (k, row)) in stiffness.chunks_exact(n).zip(self.rows()).enumerate() {
            for (j, column) in self.rows().enumerate() {
                let k = if upper && j < i {
                    stiffness[j * n + i]
                } else {
                    k[j]
                };
                for &(a, s) in row {
                    for &(b, t) in column {
                        out.stiffness[a * led + b] += s * t * k;
                    }
                }
            }
        }
        BUFFERS.set([own, force, stiffness]);
        Ok(())
    }
}
