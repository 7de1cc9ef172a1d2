//! Checks of what elements are built from.

use fe_core::element::ElementError;

/// Refuses a `value` of `what` that is not positive.
pub(crate) fn positive(what: &str, value: f64, remedy: &str) -> Result<(), ElementError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(ElementError::Input {
        what: what.into(),
        value,
        allowed: "(0, inf)".into(),
        remedy: remedy.into(),
    })
}
