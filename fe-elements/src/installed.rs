//! Elements installed in a deformed structure.

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::mesh::{CellKind, NodeId};

/// An element that is free of stress at the displacement u_0 at which it was installed: it sees u - u_0.
///
/// So a sheet bonded to a loaded beam carries only what is loaded afterwards.
#[derive(Debug)]
pub struct Installed {
    element: Box<dyn Element>,
    origin: Vec<f64>,
}

impl Installed {
    /// Installs an element at `origin`, the displacements (mm, rad) of its own DOFs, node-major.
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] unless there is one finite value per DOF.
    pub fn new(element: Box<dyn Element>, origin: Vec<f64>) -> Result<Self, ElementError> {
        let expected = element.nodes().len() * element.dofs().len();
        if origin.len() != expected {
            return Err(ElementError::Input {
                what: "displacements of the element".into(),
                value: origin.len() as f64,
                allowed: format!("{expected}"),
                remedy: "give one value per DOF, node by node".into(),
            });
        }
        match origin.iter().find(|u| !u.is_finite()) {
            Some(&value) => Err(ElementError::Input {
                what: "displacement at installation".into(),
                value,
                allowed: "(-inf, inf)".into(),
                remedy: "install the element in a state of equilibrium".into(),
            }),
            None => Ok(Self { element, origin }),
        }
    }

    fn relative(&self, u: &[f64]) -> Vec<f64> {
        u.iter().zip(&self.origin).map(|(u, o)| u - o).collect()
    }
}

impl Element for Installed {
    fn nodes(&self) -> &[NodeId] {
        self.element.nodes()
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
        let u = self.relative(u);
        self.element.evaluate(&u, committed, trial, ctx, out)
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
        self.element.free_energy(&self.relative(u), state)
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        self.element.sample(&self.relative(u), state, visit)
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
        self.element.segments(&self.relative(u), state, visit)
    }
}
