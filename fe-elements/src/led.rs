//! Elements on nodes that follow others.

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::followers::Followers;
use fe_core::material::Operator;
use fe_core::mesh::{CellKind, NodeId};

/// An element on the DOFs of the leaders of its nodes: u = T u_led, f = T^T f, K = T^T K T, where each row of T has one
/// entry, the factor of a follower.
#[derive(Debug)]
pub struct Led {
    element: Box<dyn Element>,
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
        Box::new(Self {
            element,
            nodes,
            columns,
        })
    }

    fn full(&self, u: &[f64]) -> Vec<f64> {
        self.columns.iter().map(|&(c, t)| t * u[c]).collect()
    }

    /// Whether the element has filled the upper triangle only.
    fn fills_upper(&self, ctx: &EvaluationContext) -> bool {
        let unsymmetric = self.element.unsymmetric() && ctx.operator == Operator::Tangent;
        !unsymmetric || (ctx.symmetric_part && self.element.fills_symmetric_part())
    }
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
        let (leader, factors) = followers.of(node);
        let known = leaders.iter().position(|&n| n == leader);
        let at = known.unwrap_or(leaders.len());
        if known.is_none() {
            leaders.push(leader);
        }
        for (k, &dof) in dofs.iter().enumerate() {
            let factor = factors.get(dof as usize).copied().unwrap_or(1.0);
            columns.push((dofs.len() * at + k, factor));
        }
    }
    (leaders, columns)
}

impl Element for Led {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn dofs(&self) -> &'static [Dof] {
        self.element.dofs()
    }

    fn state_len(&self) -> usize {
        self.element.state_len()
    }

    fn init_state(&self, state: &mut [f64]) {
        self.element.init_state(state);
    }

    fn evaluate(
        &self,
        u: &[f64],
        committed: &[f64],
        trial: &mut [f64],
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
        self.element
            .evaluate(&self.full(u), committed, trial, ctx, own)?;
        for (f, &(c, t)) in force.iter().zip(&self.columns) {
            out.force[c] += t * f;
        }
        let upper = self.fills_upper(ctx);
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

    fn cell(&self) -> Option<(CellKind, &[NodeId])> {
        self.element.cell()
    }

    fn interface_face(&self) -> Option<[NodeId; 8]> {
        self.element.interface_face()
    }

    fn unsymmetric(&self) -> bool {
        self.element.unsymmetric()
    }

    fn fills_symmetric_part(&self) -> bool {
        self.element.fills_symmetric_part()
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        self.element.latch(trial, base)
    }

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Option<f64> {
        self.element.free_energy(&self.full(u), state)
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        self.element.sample(&self.full(u), state, visit)
    }

    fn host(&self) -> Option<&[NodeId; 20]> {
        self.element.host()
    }

    fn segments(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut([[f64; 3]; 2], f64),
    ) -> Result<(), ElementError> {
        self.element.segments(&self.full(u), state, visit)
    }
}
