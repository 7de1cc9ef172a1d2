//! The contract of an element.

use std::fmt::Debug;

use crate::dof::Dof;
use crate::material::{MaterialError, Operator, PointReport, StateVar};
use crate::mesh::{CellKind, NodeId};

/// What holds for every element in one evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EvaluationContext {
    /// Operator asked of the laws; [`Operator::None`] asks for forces only.
    pub operator: Operator,
    /// Share of growth of rate-dependent history, see
    /// [`PointContext::relaxation`](crate::material::PointContext::relaxation).
    pub relaxation: f64,
    /// Whether the symmetric part (K + K^T)/2 of the stiffness will do, see [`Element::fills_symmetric_part`].
    pub symmetric_part: bool,
}

impl EvaluationContext {
    /// Inviscid evaluation with the given operator.
    pub const fn new(operator: Operator) -> Self {
        Self {
            operator,
            relaxation: 1.0,
            symmetric_part: false,
        }
    }

    /// Evaluation with frozen rate-dependent history: stresses of a committed state.
    pub const fn frozen() -> Self {
        Self {
            operator: Operator::None,
            relaxation: 0.0,
            symmetric_part: false,
        }
    }
}

/// Where an element writes its contribution.
///
/// `n` is the number of element DOFs: nodes times DOFs per node, node-major.
#[derive(Debug)]
pub struct ElementSystem<'a> {
    /// Internal force (N), `n` entries, zeroed by the caller.
    pub force: &'a mut [f64],
    /// Stiffness (N/mm), `n x n` row-major, zeroed by the caller; empty when
    /// [`EvaluationContext::operator`] is [`Operator::None`]. A symmetric element
    /// ([`Element::unsymmetric`] false) needs to fill the upper triangle (j >= i) only, and so does one that
    /// [fills the symmetric part](Element::fills_symmetric_part) where that is asked for.
    pub stiffness: &'a mut [f64],
}

/// One integration point as seen from outside, for output, gauges and failure evidence.
#[derive(Debug, Clone, PartialEq)]
pub struct PointSample<'a> {
    /// Position (mm).
    pub position: [f64; 3],
    /// Volume the point stands for (mm3), or area (mm2) in an interface.
    pub volume: f64,
    /// Strain components, in the order of the law's kinematics.
    pub strain: &'a [f64],
    /// Stress components (MPa).
    pub stress: &'a [f64],
    /// Report of the law.
    pub report: PointReport,
    /// Names of the internal variables.
    pub state_vars: &'a [StateVar],
    /// Internal variables.
    pub state: &'a [f64],
}

/// Why an element could not be built or evaluated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ElementError {
    /// The law failed at an integration point.
    #[error("integration point {point}: {source}")]
    Material {
        /// Integration point, counted from 0.
        point: usize,
        /// What the law said.
        source: MaterialError,
    },
    /// The mapping is not invertible.
    #[error(
        "Jacobian determinant {determinant:.4e} at point {point} is not positive; \
         check the node order or the distortion of the element"
    )]
    Jacobian {
        /// Integration point, one of the 3x3x3 points of a cell with fewer, or corner, counted from 0.
        point: usize,
        /// Value found (mm of a line, mm2 of a face, mm3 of a cell), negative where it is turned over.
        determinant: f64,
    },
    /// A bar leaves the mesh.
    #[error(
        "bar {bar}: the point ({x:.3}, {y:.3}, {z:.3}) mm lies in no element that may host it; \
         move the bar inside the mesh or name the block that hosts it"
    )]
    NoHost {
        /// Name of the bar.
        bar: String,
        /// Position of the first point without host (mm).
        x: f64,
        /// Position of the first point without host (mm).
        y: f64,
        /// Position of the first point without host (mm).
        z: f64,
    },
    /// A host block is not there.
    #[error("no block of hexahedra is named {block}; the mesh has {known}")]
    NoSuchBlock {
        /// Name asked for.
        block: String,
        /// Blocks of hexahedra there are.
        known: String,
    },
    /// The energies of the element are no numbers.
    #[error(
        "the element has done work of {work} N mm and stores {stored} N mm, which is not finite; check its free energy and that \
         of its law"
    )]
    Energy {
        /// Work of its forces so far (N mm).
        work: f64,
        /// What it stores (N mm).
        stored: f64,
    },
    /// Some other impossible input.
    #[error("{what} = {value} is outside {allowed}; {remedy}")]
    Input {
        /// Quantity.
        what: String,
        /// Value given.
        value: f64,
        /// Allowed range.
        allowed: String,
        /// What to change.
        remedy: String,
    },
}

impl ElementError {
    /// A bar leaves the mesh at a point (mm).
    pub fn no_host(bar: &str, point: impl Into<[f64; 3]>) -> Self {
        let [x, y, z] = point.into();
        let bar = bar.into();
        Self::NoHost { bar, x, y, z }
    }

    /// Whether a shorter step may cure it.
    pub const fn is_recoverable(&self) -> bool {
        match self {
            Self::Material { source, .. } => source.is_recoverable(),
            Self::Energy { .. } => true,
            _ => false,
        }
    }
}

/// A finite element: geometry and parameters only, no mutable state.
pub trait Element: Debug + Send + Sync {
    /// Nodes, in the order of the element's DOFs.
    fn nodes(&self) -> &[NodeId];

    /// DOFs at each node; the element vector is node-major.
    fn dofs(&self) -> &'static [Dof];

    /// Length of the element's slice in the state store.
    fn state_len(&self) -> usize;

    /// Writes the virgin state.
    fn init_state(&self, state: &mut [f64]);

    /// Internal force and, if asked, stiffness, at the element displacement `u` (mm).
    ///
    /// # Errors
    ///
    /// [`ElementError`], naming the integration point.
    fn evaluate(
        &self,
        u: &[f64],
        committed: &[f64],
        trial: &mut [f64],
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError>;

    /// The cell to draw the element as, and its nodes; `None` for an element that draws [segments](Self::segments) or
    /// nothing.
    fn cell(&self) -> Option<(CellKind, &[NodeId])> {
        None
    }

    /// Nodes of the 8-node quadrilateral to draw an interface as, see
    /// [`interface_grid`](crate::output::interface_grid); `None` for everything that is no interface between faces. The
    /// [samples](Self::sample) of one that draws it have the three components of
    /// [`Interface`](crate::kinematics::Interface), others are drawn as NaN.
    fn interface_face(&self) -> Option<[NodeId; 8]> {
        None
    }

    /// Whether the stiffness for [`Operator::Tangent`] can be unsymmetric.
    fn unsymmetric(&self) -> bool {
        false
    }

    /// Whether an unsymmetric element fills the upper triangle of its symmetric part, which takes it less, where
    /// [`EvaluationContext::symmetric_part`] will do. The assembly takes that part itself from one that does not.
    fn fills_symmetric_part(&self) -> bool {
        false
    }

    /// Whether only the upper triangle (j >= i) of what [`evaluate`](Self::evaluate) fills counts.
    fn fills_upper(&self, ctx: &EvaluationContext) -> bool {
        let unsymmetric = self.unsymmetric() && ctx.operator == Operator::Tangent;
        !unsymmetric || (ctx.symmetric_part && self.fills_symmetric_part())
    }

    /// See [`Material::latch`](crate::material::Material::latch), for every integration point.
    fn latch(&self, _trial: &[f64], _base: &mut [f64]) -> bool {
        false
    }

    /// Recoverable energy (N mm) of the element, see [`free_energy`](crate::points::free_energy), which does it for elements
    /// of points. Without one the element is taken to unload to the origin, half the product of its forces and
    /// displacements: one that keeps permanent displacements, or stiffens as it is stretched, must give it, or reloading it
    /// counts as creating energy and is refused, and its dissipation is wrong.
    ///
    /// # Errors
    ///
    /// [`ElementError`], naming the integration point, where a law fails: that is no element without an energy.
    fn free_energy(&self, _u: &[f64], _state: &[f64]) -> Result<Option<f64>, ElementError> {
        Ok(None)
    }

    /// Calls `visit` for every integration point with the stresses of a committed state.
    ///
    /// # Errors
    ///
    /// [`ElementError`], naming the integration point.
    fn sample(
        &self,
        _u: &[f64],
        _state: &[f64],
        _visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        Ok(())
    }

    /// Nodes of the hexahedron that carries the element, in which the displacement of its
    /// [segments](Self::segments) is interpolated.
    fn host(&self) -> Option<&[NodeId; 20]> {
        None
    }

    /// Line segments to draw (mm), each with the axial stress (MPa) at `u` and `state`: bars.
    ///
    /// # Errors
    ///
    /// [`ElementError`], naming the integration point.
    fn segments(
        &self,
        _u: &[f64],
        _state: &[f64],
        _visit: &mut dyn FnMut([[f64; 3]; 2], f64),
    ) -> Result<(), ElementError> {
        Ok(())
    }
}
