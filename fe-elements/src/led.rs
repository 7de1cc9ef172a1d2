//! Elements on nodes that follow others.

use std::borrow::Cow;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::followers::Followers;
use fe_core::material::Operator;
use fe_core::mesh::NodeId;

use crate::seen::{Seen, View};

/// An element on the DOFs of the leaders of its nodes: u = T u_led, f = T^T f, K = T^T K T, where each row of T has one
/// entry, the factor of a follower.
pub type Led = Seen<Fold>;

/// Where the DOFs of an element that is [`Led`] come from.
#[derive(Debug)]
pub struct Fold {
    nodes: Vec<NodeId>,
    /// Column and entry of every row of T.
    columns: Vec<(usize, f64)>,
}

impl Led {
    /// The element on leaders, or itself where none of its nodes follows another.
    pub fn by(element: Box<dyn Element>, followers: &Followers) -> Box<dyn Element> {
        if element.nodes().iter().all(|&n| followers.of(n).0 == n) {
            return element;
        }
        let (nodes, columns) = columns(element.nodes(), element.dofs(), followers);
        let view = Fold { nodes, columns };
        Box::new(Self { element, view })
    }
}

/// Whether an element fills the upper triangle only.
fn fills_upper(element: &dyn Element, ctx: &EvaluationContext) -> bool {
    let unsymmetric = element.unsymmetric() && ctx.operator == Operator::Tangent;
    !unsymmetric || (ctx.symmetric_part && element.fills_symmetric_part())
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
        self.columns.iter().map(|&(c, t)| t * u[c]).collect()
    }

    fn evaluate(
        &self,
        element: &dyn Element,
        u: &[f64],
        (committed, trial): (&[f64], &mut [f64]),
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        let (n, led) = (self.columns.len(), u.len());
        let mut force = vec![0.0; n];
        let mut stiffness = vec![0.0; if out.stiffness.is_empty() { 0 } else { n * n }];
        let own = ElementSystem {
            force: &mut force,
            stiffness: &mut stiffness,
        };
        element.evaluate(&self.own(u), committed, trial, ctx, own)?;
        for (f, &(c, t)) in force.iter().zip(&self.columns) {
            out.force[c] += t * f;
        }
        let upper = fills_upper(element, ctx);
        for (i, row) in stiffness.chunks_exact(n).enumerate() {
            let (a, s) = self.columns[i];
            for (j, &(b, t)) in self.columns.iter().enumerate() {
                let k = if upper && j < i {
                    stiffness[j * n + i]
                } else {
                    row[j]
                };
                out.stiffness[a * led + b] += s * t * k;
            }
        }
        Ok(())
    }
}
