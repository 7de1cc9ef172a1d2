//! What a conformance check can find.

use std::fmt;

use crate::element::ElementError;
use crate::material::MaterialError;

/// Where on its random paths a check stands; both counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Path.
    pub path: usize,
    /// Step of the path.
    pub step: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "path {}, step {}", self.path, self.step)
    }
}

/// A breach of the contract of a law or an element.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CheckFailure {
    /// The check itself was set up wrongly.
    #[error("the check cannot run: {what} = {value}; allowed: {allowed}")]
    Setting {
        /// Quantity.
        what: &'static str,
        /// Value given.
        value: f64,
        /// Allowed range.
        allowed: &'static str,
    },
    /// The law refused to answer.
    #[error("{place}: {source}")]
    Material {
        /// Where.
        place: Place,
        /// What the law said.
        source: Box<MaterialError>,
    },
    /// The element refused to answer.
    #[error("{place}: {source}")]
    Element {
        /// Where.
        place: Place,
        /// What the element said.
        source: Box<ElementError>,
    },
    /// An answer is NaN or infinite; for the state this is what an entry left unwritten looks like.
    #[error(
        "{place}: {quantity} is {value}, not finite (the state was NaN before the update: write every \
         entry, read none)"
    )]
    NotFinite {
        /// Where.
        place: Place,
        /// Quantity and component.
        quantity: String,
        /// Value found.
        value: f64,
    },
    /// Two calls that must agree to the last bit do not.
    #[error("{place}: {quantity} is {first} and then {second}, {between}")]
    NotRepeatable {
        /// Where.
        place: Place,
        /// Quantity and component.
        quantity: String,
        /// Answer of the first call.
        first: f64,
        /// Answer of the second call.
        second: f64,
        /// What differed between the calls.
        between: &'static str,
    },
    /// An update at the same strain, from the state just written or latched, changes the stress.
    #[error(
        "{place}: {component} changes from {first} to {second} MPa by an update at the same strain \
         {between} (allowed {limit:.3e}); that state is not the one the stress belongs to"
    )]
    Drift {
        /// Where.
        place: Place,
        /// Stress component.
        component: &'static str,
        /// Stress of the first update (MPa).
        first: f64,
        /// Stress of the second update (MPa).
        second: f64,
        /// Where the second update started.
        between: &'static str,
        /// Allowed change (MPa).
        limit: f64,
    },
    /// An evaluation at the same displacements, from the state just written, changes the force.
    #[error(
        "{place}: force {component} changes from {first} to {second} N by an evaluation at the same displacements from \
         the state just written (allowed {limit:.3e}); that state is not the one the force belongs to"
    )]
    ForceDrift {
        /// Where.
        place: Place,
        /// DOF and node.
        component: String,
        /// Force of the first evaluation (N).
        first: f64,
        /// Force of the second evaluation (N).
        second: f64,
        /// Allowed change (N).
        limit: f64,
    },
    /// The secant operator of an element has a negative eigenvalue.
    #[error(
        "{place}: the secant operator has the eigenvalue {least:.3e} beside a largest of {largest:.3e}: it must not be negative"
    )]
    SecantNegative {
        /// Where.
        place: Place,
        /// Least eigenvalue.
        least: f64,
        /// Largest magnitude of an eigenvalue.
        largest: f64,
    },
    /// The tangent is not the derivative of the stress (or force).
    #[error(
        "{place}: the tangent entry d({row})/d({column}) is {given}, but differences give {difference} \
         (allowed disagreement {limit:.3e})"
    )]
    Tangent {
        /// Where.
        place: Place,
        /// Stress or force component.
        row: String,
        /// Strain or displacement component.
        column: String,
        /// Entry of the tangent.
        given: f64,
        /// Central difference.
        difference: f64,
        /// Allowed disagreement.
        limit: f64,
    },
    /// An operator that must be symmetric is not: the secant always, the tangent of a law that does not
    /// announce it as unsymmetric.
    #[error(
        "{place}: the {operator} has {upper} at ({row}, {column}) but {lower} mirrored (allowed \
         disagreement {limit:.3e})"
    )]
    Unsymmetric {
        /// Where.
        place: Place,
        /// Which operator.
        operator: &'static str,
        /// Row.
        row: usize,
        /// Column.
        column: usize,
        /// Entry at (row, column).
        upper: f64,
        /// Entry at (column, row).
        lower: f64,
        /// Allowed disagreement.
        limit: f64,
    },
    /// An element fills something else than the symmetric part it was asked for.
    #[error(
        "{place}: the symmetric part of the tangent has {given} at ({row}, {column}), but the tangent gives \
         {expected}"
    )]
    SymmetricPart {
        /// Where.
        place: Place,
        /// Row.
        row: usize,
        /// Column.
        column: usize,
        /// Entry filled.
        given: f64,
        /// That of (K + K^T)/2.
        expected: f64,
    },
    /// The secant operator is not positive definite.
    #[error("{place}: pivot {index} of the secant operator is {pivot:.3e}, not positive")]
    SecantIndefinite {
        /// Where.
        place: Place,
        /// Pivot, counted from 0.
        index: usize,
        /// Its value.
        pivot: f64,
    },
    /// The step creates energy.
    #[error(
        "{place}: the step dissipates {dissipation:.6e} N mm/mm3 (least allowed {limit:.3e}): it creates \
         energy"
    )]
    Dissipation {
        /// Where.
        place: Place,
        /// sigma_(n+1) : d_eps - d_psi.
        dissipation: f64,
        /// Least value allowed.
        limit: f64,
    },
    /// Too many steps could not be compared with differences.
    #[error(
        "{kinks} of {steps} steps lie at a kink, where no difference can prove the tangent (allowed \
         share {limit}); a wrong tangent may hide there"
    )]
    TooManyKinks {
        /// Steps at a kink.
        kinks: usize,
        /// Steps in all.
        steps: usize,
        /// Allowed share.
        limit: f64,
    },
    /// The answer to a rotated strain path is not the rotated answer.
    #[error(
        "{place}: {component} is {rotated} MPa in rotated axes, but the rotated stress is {expected} MPa \
         (allowed disagreement {limit:.3e})"
    )]
    Anisotropic {
        /// Where.
        place: Place,
        /// Stress component.
        component: &'static str,
        /// Answer to the rotated path (MPa).
        rotated: f64,
        /// Rotated answer (MPa).
        expected: f64,
        /// Allowed disagreement (MPa).
        limit: f64,
    },
    /// A rigid-body motion gives a force.
    #[error(
        "{motion} of the virgin element gives the force {force} N in {component} (allowed {limit:.3e})"
    )]
    RigidBody {
        /// The motion.
        motion: &'static str,
        /// Node and direction.
        component: String,
        /// Force found (N).
        force: f64,
        /// Allowed force (N).
        limit: f64,
    },
    /// The nodal forces are not in balance.
    #[error(
        "{place}: the {resultant} of the nodal forces is {value}, not zero (allowed {limit:.3e})"
    )]
    Unbalanced {
        /// Where.
        place: Place,
        /// Which sum.
        resultant: &'static str,
        /// Its value (N, N mm).
        value: f64,
        /// Allowed value.
        limit: f64,
    },
}

impl CheckFailure {
    pub(super) fn material(place: Place, source: MaterialError) -> Self {
        Self::Material {
            place,
            source: Box::new(source),
        }
    }

    pub(super) fn element(place: Place, source: ElementError) -> Self {
        Self::Element {
            place,
            source: Box::new(source),
        }
    }
}

/// Refuses a setting that is not positive and finite.
pub(super) fn positive(what: &'static str, value: f64) -> Result<(), CheckFailure> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(CheckFailure::Setting {
            what,
            value,
            allowed: "(0, inf)",
        })
    }
}

/// Refuses values that are NaN or infinite.
pub(super) fn finite(
    place: Place,
    values: &[f64],
    label: impl Fn(usize) -> String,
) -> Result<(), CheckFailure> {
    match values.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(i) => Err(CheckFailure::NotFinite {
            place,
            quantity: label(i),
            value: values[i],
        }),
    }
}

/// Refuses two answers that are not the same numbers.
pub(super) fn equal(
    place: Place,
    first: &[f64],
    second: &[f64],
    between: &'static str,
    label: impl Fn(usize) -> String,
) -> Result<(), CheckFailure> {
    match (0..first.len()).find(|&i| first[i] != second[i]) {
        None => Ok(()),
        Some(i) => Err(CheckFailure::NotRepeatable {
            place,
            quantity: label(i),
            first: first[i],
            second: second[i],
            between,
        }),
    }
}

/// Refuses too large a share of steps at a kink.
pub(super) fn few_kinks(kinks: usize, steps: usize, limit: f64) -> Result<(), CheckFailure> {
    if kinks as f64 > limit * steps as f64 {
        return Err(CheckFailure::TooManyKinks {
            kinks,
            steps,
            limit,
        });
    }
    Ok(())
}
