//! Protects the element of a constant stiffness from one whose stiffness or forces are no numbers.

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::mesh::NodeId;
use fe_elements::Linear;

/// A spring between two nodes, with a force of its own besides.
#[derive(Debug)]
struct Spring {
    stiffness: f64,
    force: f64,
}

impl Element for Spring {
    fn nodes(&self) -> &[NodeId] {
        &[0, 1]
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
        _: &[f64],
        _: &mut [f64],
        _: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        let pull = 2.0 * (u[1] - u[0]) + self.force;
        out.force.copy_from_slice(&[-pull, pull]);
        if !out.stiffness.is_empty() {
            let k = self.stiffness;
            out.stiffness.copy_from_slice(&[k, -k, -k, k]);
        }
        Ok(())
    }
}

#[test]
fn what_is_no_number_is_refused() {
    let linear = |stiffness, force| Linear::new(Box::new(Spring { stiffness, force }));
    assert!(linear(2.0, 0.0).is_ok());
    for (stiffness, force) in [
        (f64::NAN, 0.0),
        (f64::INFINITY, 0.0),
        (2.0, f64::NAN),
        (2.0, f64::INFINITY),
        (f64::NAN, f64::NAN),
    ] {
        let refused = linear(stiffness, force);
        assert!(
            matches!(refused, Err(ElementError::Input { .. })),
            "{stiffness} {force}: {refused:?}"
        );
    }
}
