//! An element of one's own: springs in a row, assembled and solved.

use fe_core::assembly::{Assembled, Assembler};
use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::material::Operator;
use fe_core::mesh::{Mesh, NodeId};
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use nalgebra::{DMatrix, DVector};

/// Spring along x: k (N/mm).
const K: f64 = 500.0;

#[derive(Debug)]
struct Spring([NodeId; 2]);

impl Element for Spring {
    fn nodes(&self) -> &[NodeId] {
        &self.0
    }

    fn dofs(&self) -> &'static [Dof] {
        &[Dof::Ux]
    }

    fn state_len(&self) -> usize {
        0
    }

    fn init_state(&self, _: &mut [f64]) {}

    fn evaluate(
        &self,
        u: &[f64],
        _committed: &[f64],
        _trial: &mut [f64],
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        let pull = K * (u[1] - u[0]);
        out.force.copy_from_slice(&[-pull, pull]);
        if ctx.operator != Operator::None {
            out.stiffness.copy_from_slice(&[K, -K, -K, K]);
        }
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mesh = Mesh::new((0..4).map(|i| [10.0 * f64::from(i), 0.0, 0.0]).collect())?;
    let springs = (0..3).map(|i| Box::new(Spring([i, i + 1])) as Box<dyn Element>);
    let model = Model::new(mesh, springs.collect())?;
    let mut conditions = Conditions::new(&model);
    conditions.fix(&model, 0, Dof::Ux)?;
    conditions.add_reference(&model, 3, Dof::Ux, 100.0)?;
    let mut assembler = Assembler::new(&model, &conditions)?;
    let mut state = StateStore::new(model.elements());
    let mut system = Assembled::default();
    let ctx = EvaluationContext::new(Operator::Tangent);
    assembler.evaluate(&model, &[0.0; 4], &mut state, &ctx, &mut system)?;

    // Three unknowns: a dense solution will do here.
    let sparse = system.matrix.to_csc(assembler.pattern());
    let matrix = DMatrix::from_row_iterator(3, 3, sparse.to_dense().iter().copied());
    let load = assembler
        .free()
        .iter()
        .map(|&d| conditions.reference()[d as usize]);
    let load = DVector::from_iterator(3, load);
    let solution = matrix
        .cholesky()
        .ok_or("the springs are not held")?
        .solve(&load);
    // F n/k = 100 N x 3/(500 N/mm) = 0.6 mm.
    assert!((solution[2] - 0.6).abs() < 1e-12);
    Ok(())
}
