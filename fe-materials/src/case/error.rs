//! What can be wrong with a case.

use fe_core::material::MaterialError;
use fe_core::point::PointError;

/// Why a case cannot be run; segments are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CaseError {
    /// A parameter of the law is impossible.
    #[error("law: {0}")]
    Law(#[from] MaterialError),
    /// The strength of a concrete is missing or given twice.
    #[error(
        "concrete: {given} of fck_mpa (characteristic strength) and fcm_mpa (mean strength) are given; \
         give exactly one"
    )]
    Strength {
        /// How many are given.
        given: usize,
    },
    /// A property of the concrete is given that the law makes no use of.
    #[error("concrete: the law {law} makes no use of {property}; remove it")]
    Unused {
        /// Name of the law.
        law: &'static str,
        /// Name of the property.
        property: &'static str,
    },
    /// A segment names a component that the law does not have.
    #[error("program, segment {segment}: {field} has no component {name:?}; it has {allowed}")]
    Component {
        /// Segment.
        segment: usize,
        /// Field of the segment.
        field: &'static str,
        /// Name given.
        name: String,
        /// Names of the components.
        allowed: String,
    },
    /// A segment prescribes strain and stress of the same component.
    #[error(
        "program, segment {segment}: both {strain} and {stress} are prescribed; they belong to one \
         component, prescribe one of them"
    )]
    Overdetermined {
        /// Segment.
        segment: usize,
        /// Name of the strain.
        strain: &'static str,
        /// Name of the stress.
        stress: &'static str,
    },
    /// The program is empty.
    #[error("program: no segment is given; give at least one")]
    NoSegments,
    /// The law does not admit the point.
    #[error(transparent)]
    Point(#[from] PointError),
}
