//! What can go wrong at a single point.

use super::MAX_STEPS;
use crate::material::MaterialError;

/// Why a program could not be finished; segments and steps are counted from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PointError {
    /// The law refuses the point itself.
    #[error("the point cannot be served: {0}")]
    Refused(MaterialError),
    /// A setting with which the driver would never arrive, or never end.
    #[error("{what} = {value}; allowed: {allowed}")]
    Setting {
        /// Setting.
        what: &'static str,
        /// Value given.
        value: f64,
        /// Allowed range.
        allowed: &'static str,
    },
    /// A segment has the wrong number of components.
    #[error(
        "segment {segment} prescribes {given} components, but the law has {expected}: {labels}; give one \
         strain or stress for each"
    )]
    Components {
        /// Segment.
        segment: usize,
        /// Components given.
        given: usize,
        /// Components of the law.
        expected: usize,
        /// Their names.
        labels: String,
    },
    /// A segment has no steps, or more than a history can hold.
    #[error(
        "segment {segment} has steps = {steps}, outside [1, {MAX_STEPS}]; a few hundred resolve most paths"
    )]
    Steps {
        /// Segment.
        segment: usize,
        /// Steps given.
        steps: usize,
    },
    /// A target is NaN or infinite.
    #[error("segment {segment}: the target of {component} is {value}, not a finite number")]
    NotFinite {
        /// Segment.
        segment: usize,
        /// Component.
        component: &'static str,
        /// Value given.
        value: f64,
    },
    /// The law could not answer.
    #[error("segment {segment}, step {step}: {source}")]
    Material {
        /// Segment.
        segment: usize,
        /// Step.
        step: usize,
        /// What the law said.
        source: MaterialError,
    },
    /// The prescribed stress was not reached, even in the shortest sub-step: past a peak, or with a tangent that is wrong or no
    /// number.
    #[error(
        "segment {segment}, step {step}: {component} misses its prescribed value by {residual:.4e} MPa \
         (allowed {tolerance:.1e} MPa) after {iterations} iterations; past a peak, prescribe the strain \
         of this component instead; otherwise check that the tangent of the law is finite and right"
    )]
    NoConvergence {
        /// Segment.
        segment: usize,
        /// Step.
        step: usize,
        /// Stress component with the largest residual.
        component: &'static str,
        /// Its residual (MPa).
        residual: f64,
        /// Residual allowed (MPa).
        tolerance: f64,
        /// Iterations of the last attempt.
        iterations: usize,
    },
}
