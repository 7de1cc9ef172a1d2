//! The contract of a constitutive law.

use std::fmt::Debug;

use crate::kinematics::Kinematics;

/// One internal variable of a law, as stored per integration point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StateVar {
    /// Name, as written to output files.
    pub name: &'static str,
    /// Unit, `"-"` if none.
    pub unit: &'static str,
    /// Number of components.
    pub len: usize,
}

impl StateVar {
    /// A scalar internal variable.
    pub const fn scalar(name: &'static str, unit: &'static str) -> Self {
        Self { name, unit, len: 1 }
    }

    /// An internal variable of `len` components.
    pub const fn vector(name: &'static str, unit: &'static str, len: usize) -> Self {
        Self { name, unit, len }
    }
}

/// One label per entry of the state slice: the name of a scalar, `name[i]` for the components of a vector.
pub fn state_labels(vars: &[StateVar]) -> Vec<String> {
    vars.iter()
        .flat_map(|v| {
            (0..v.len).map(move |i| match v.len {
                1 => v.name.to_owned(),
                _ => format!("{}[{i}]", v.name),
            })
        })
        .collect()
}

/// Which linearised operator a law is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Operator {
    /// Stress only; the tangent of the response is unspecified.
    None,
    /// The consistent algorithmic tangent, possibly indefinite or unsymmetric.
    #[default]
    Tangent,
    /// A symmetric positive-definite secant operator.
    Secant,
}

/// What an integration point knows beside its strain and its history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointContext {
    /// Crack-band width h (mm): the length over which a crack is smeared at this point.
    pub band_width: f64,
    /// Operator asked for.
    pub operator: Operator,
    /// Share a in [0, 1] of the growth of rate-dependent history variables admitted in this step:
    /// a = dt/(tau + dt) for a viscosity time tau. 1 is inviscid, 0 freezes the history.
    pub relaxation: f64,
}

impl PointContext {
    /// An inviscid point with the given crack-band width (mm), asking for the consistent tangent.
    pub const fn new(band_width: f64) -> Self {
        Self {
            band_width,
            operator: Operator::Tangent,
            relaxation: 1.0,
        }
    }

    /// The same point asking for another operator.
    #[must_use]
    pub const fn with_operator(self, operator: Operator) -> Self {
        Self { operator, ..self }
    }
}

/// Answer of a law at one integration point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response<K: Kinematics> {
    /// Stress (or traction) (MPa).
    pub stress: K::Vector,
    /// The operator that [`PointContext::operator`] asked for.
    pub tangent: K::Tangent,
}

/// What a law reports about a point for pictures and events; zero where it does not apply.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PointReport {
    /// Largest crack strain normal to a crack plane (-).
    pub crack_strain: f64,
    /// Unit normal of that crack, zero without a crack.
    pub crack_normal: [f64; 3],
    /// Plastic strain (-), component by component as the strain; a uniaxial law uses the first one.
    pub plastic_strain: [f64; 6],
    /// Share of the compressive capacity that crushing has consumed: 0 before the peak of the
    /// uniaxial curve, 1 at its residual stress.
    pub crushing: f64,
    /// Utilisation: stress over strength (lamina rupture) (-).
    pub utilisation: f64,
}

/// Why a law could not answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MaterialError {
    /// A parameter is impossible.
    #[error("{law}: {parameter} = {value} {unit} is outside {allowed}; {remedy}")]
    Parameter {
        /// The law.
        law: &'static str,
        /// Name of the parameter.
        parameter: &'static str,
        /// Value given.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// Allowed range, in words.
        allowed: String,
        /// What to change.
        remedy: String,
    },
    /// The element is too large for the softening branch: the stress would snap back.
    #[error(
        "{law}: crack-band width {band_width:.4} mm exceeds the largest allowed {limit:.4} mm \
         ({reason}); refine the mesh or raise the fracture energy"
    )]
    BandTooWide {
        /// The law.
        law: &'static str,
        /// Width of the point (mm).
        band_width: f64,
        /// Largest width allowed (mm).
        limit: f64,
        /// Which branch is violated.
        reason: &'static str,
    },
    /// A return mapping did not converge.
    #[error(
        "{law}: the stress return did not converge: residual {residual:.3e} after {iterations} iterations"
    )]
    Return {
        /// The law.
        law: &'static str,
        /// Final residual, relative to the strength.
        residual: f64,
        /// Iterations spent.
        iterations: usize,
    },
    /// The strain is not a number, or so large that its stress is none.
    #[error("{law}: strain component {component} is not finite, or beyond 1e90")]
    NotFinite {
        /// The law.
        law: &'static str,
        /// Offending component.
        component: usize,
    },
}

impl MaterialError {
    /// Whether a shorter step may cure it.
    pub const fn is_recoverable(&self) -> bool {
        matches!(self, Self::Return { .. } | Self::NotFinite { .. })
    }
}

/// A constitutive law: a pure function from strain and committed history to stress and new history.
///
/// # Contract
///
/// - `update` reads `committed`, writes **all** of `trial`, and touches nothing else; called twice
///   with the same input it gives the same output.
/// - At the same strain, from the state it has just written, it gives the same stress again, unless its histories lag
///   ([`PointContext::relaxation`] below 1, or a viscosity of its own).
/// - `Operator::Tangent` is the derivative of the stress this very update returns, once what the step
///   [latches](Material::latch) is held; `Operator::Secant` is symmetric positive definite.
///
/// [`crate::testing::check_material`] checks all of it.
pub trait Material<K: Kinematics>: Debug + Send + Sync {
    /// Name of the law, for messages and output.
    fn name(&self) -> &'static str;

    /// Internal variables, in the order of the state slice.
    fn state_vars(&self) -> &[StateVar];

    /// Writes the virgin state.
    fn init_state(&self, state: &mut [f64]) {
        state.fill(0.0);
    }

    /// Refuses a point the law cannot serve, before anything runs: a crack band too wide for the
    /// softening branch, for instance. Default: every point is admitted.
    ///
    /// # Errors
    ///
    /// [`MaterialError::BandTooWide`].
    fn admit(&self, _ctx: &PointContext) -> Result<(), MaterialError> {
        Ok(())
    }

    /// Stress and operator at a total strain, from the committed history.
    ///
    /// # Errors
    ///
    /// [`MaterialError`] when the law cannot answer; see [`MaterialError::is_recoverable`].
    fn update(
        &self,
        strain: &K::Vector,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<K>, MaterialError>;

    /// [`Self::update`] of the points of an element, whose states are slices of equal length, one after the other. Each
    /// response is shown to `take` with the number of its point. Laws override it to do together what can be done so; the
    /// responses are the same to the last bit.
    ///
    /// # Errors
    ///
    /// Number of the first point that fails, and why.
    fn update_many(
        &self,
        strains: &[K::Vector],
        (committed, trial): (&[f64], &mut [f64]),
        ctx: &PointContext,
        take: &mut dyn FnMut(usize, &Response<K>),
    ) -> Result<(), (usize, MaterialError)> {
        let n = self.state_len();
        for (p, strain) in strains.iter().enumerate() {
            let own = p * n..(p + 1) * n;
            // By reference: an operator is worth not copying.
            match &self.update(strain, &committed[own.clone()], &mut trial[own], ctx) {
                Ok(response) => take(p, response),
                Err(error) => return Err((p, error.clone())),
            }
        }
        Ok(())
    }

    /// Whether the consistent tangent can be unsymmetric.
    fn unsymmetric_tangent(&self) -> bool {
        false
    }

    /// Copies from `trial` into `base` what must not change any more within the step, once it has
    /// happened: the axes of a new crack. Returns whether there was any. Default: nothing.
    fn latch(&self, _trial: &[f64], _base: &mut [f64]) -> bool {
        false
    }

    /// Free energy density psi (MPa = N mm/mm3) at a strain and state, if the law promises
    /// non-negative dissipation: sigma_(n+1) : d_eps - d_psi >= 0 for every step. Without one the point is taken to unload to
    /// the origin: a law with permanent strains must give it, or steps that reload count as creating energy and are refused.
    fn free_energy(&self, _strain: &K::Vector, _state: &[f64], _ctx: &PointContext) -> Option<f64> {
        None
    }

    /// What the point shows: crack strain, plastic strain, utilisation.
    fn report(&self, _strain: &K::Vector, _state: &[f64]) -> PointReport {
        PointReport::default()
    }

    /// Length of the state slice.
    fn state_len(&self) -> usize {
        self.state_vars().iter().map(|v| v.len).sum()
    }
}
