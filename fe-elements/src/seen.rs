//! Elements seen from outside otherwise than from within: wrappers that differ in little.

use std::borrow::Cow;
use std::fmt::Debug;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::mesh::{CellKind, NodeId};

/// How an element is seen.
pub trait View: Debug + Send + Sync {
    /// Nodes that the DOFs belong to.
    fn nodes<'a>(&'a self, own: &'a [NodeId]) -> &'a [NodeId] {
        own
    }

    /// Displacements of the element's own DOFs from those seen.
    fn own<'a>(&self, u: &'a [f64]) -> Cow<'a, [f64]> {
        Cow::Borrowed(u)
    }

    /// See [`Element::evaluate`].
    ///
    /// # Errors
    ///
    /// [`ElementError`], naming the integration point.
    fn evaluate(
        &self,
        element: &dyn Element,
        u: &[f64],
        (committed, trial): (&[f64], &mut [f64]),
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        element.evaluate(&self.own(u), committed, trial, ctx, out)
    }

    /// See [`Element::free_energy`].
    ///
    /// # Errors
    ///
    /// [`ElementError`], naming the integration point.
    fn free_energy(
        &self,
        element: &dyn Element,
        u: &[f64],
        state: &[f64],
    ) -> Result<Option<f64>, ElementError> {
        element.free_energy(&self.own(u), state)
    }
}

/// An element as a [`View`] shows it: [`Installed`](crate::Installed), [`Led`](crate::Led) or [`Linear`](crate::Linear).
#[derive(Debug)]
pub struct Seen<V> {
    pub(crate) element: Box<dyn Element>,
    pub(crate) view: V,
}

impl<V: View> Seen<V> {
    /// The element as the view shows it. Whether the view keeps the contract of elements is for
    /// [`check_element`](fe_core::testing::check_element) to find out.
    pub fn through(element: Box<dyn Element>, view: V) -> Self {
        Self { element, view }
    }
}

impl<V: View> Element for Seen<V> {
    fn nodes(&self) -> &[NodeId] {
        self.view.nodes(self.element.nodes())
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
        let element = self.element.as_ref();
        self.view.evaluate(element, u, (committed, trial), ctx, out)
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

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Result<Option<f64>, ElementError> {
        self.view.free_energy(self.element.as_ref(), u, state)
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        self.element.sample(&self.view.own(u), state, visit)
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
        self.element.segments(&self.view.own(u), state, visit)
    }
}
