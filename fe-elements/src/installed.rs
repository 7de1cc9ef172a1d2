//! Elements installed in a deformed structure.

use std::borrow::Cow;

use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};

use crate::seen::{Seen, View};

/// An element that is free of stress at the displacement u_0 at which it was installed: it sees u - u_0.
///
/// So a sheet bonded to a loaded beam carries only what is loaded afterwards.
pub type Installed = Seen<Offset>;

/// The displacement u_0 of an [`Installed`] element.
#[derive(Debug)]
pub struct Offset(Vec<f64>);

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
            None => Ok(Self {
                element,
                view: Offset(origin),
            }),
        }
    }
}

impl View for Offset {
    fn own<'a>(&self, u: &'a [f64]) -> Cow<'a, [f64]> {
        u.iter().zip(&self.0).map(|(u, o)| u - o).collect()
    }

    /// Without one of its own, (1/2) f . (u - u_0) with the forces f of that state.
    fn free_energy(
        &self,
        element: &dyn Element,
        u: &[f64],
        state: &[f64],
    ) -> Result<Option<f64>, ElementError> {
        let own = self.own(u);
        let stated = element.free_energy(&own, state)?;
        if stated.is_some() {
            return Ok(stated);
        }
        let (mut force, mut trial) = (vec![0.0; own.len()], state.to_vec());
        let out = ElementSystem {
            force: &mut force,
            stiffness: &mut [],
        };
        let frozen = EvaluationContext::frozen();
        element.evaluate(&own, state, &mut trial, &frozen, out)?;
        let half = force.iter().zip(own.iter()).map(|(f, u)| 0.5 * f * u);
        Ok(Some(half.sum()))
    }
}
