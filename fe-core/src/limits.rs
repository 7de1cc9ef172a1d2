//! Range checks that laws share: parameters, strains and jumps.

use crate::material::MaterialError;
use nalgebra::SVector;

/// The error of a parameter outside its range.
pub fn out_of_range(
    law: &'static str,
    parameter: &'static str,
    value: f64,
    unit: &'static str,
    allowed: impl Into<String>,
    remedy: impl Into<String>,
) -> MaterialError {
    MaterialError::Parameter {
        law,
        parameter,
        value,
        unit,
        allowed: allowed.into(),
        remedy: remedy.into(),
    }
}

/// Refuses a parameter that is not a positive finite number.
///
/// # Errors
///
/// [`MaterialError::Parameter`].
pub fn positive(
    law: &'static str,
    parameter: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<(), MaterialError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    let remedy = "give a positive number";
    Err(out_of_range(
        law, parameter, value, unit, "(0, inf)", remedy,
    ))
}

/// Refuses a strain or jump that is not a number.
///
/// # Errors
///
/// [`MaterialError::NotFinite`].
pub fn finite<const N: usize>(
    law: &'static str,
    strain: &SVector<f64, N>,
) -> Result<(), MaterialError> {
    match strain.iter().position(|e| !e.is_finite()) {
        Some(component) => Err(MaterialError::NotFinite { law, component }),
        None => Ok(()),
    }
}

/// Refuses a relaxation, the share of its growth that a history takes up in a step, outside [0, 1].
///
/// # Errors
///
/// [`MaterialError::Parameter`].
pub fn relaxes(law: &'static str, relaxation: f64) -> Result<(), MaterialError> {
    if (0.0..=1.0).contains(&relaxation) {
        return Ok(());
    }
    let remedy = "give a value in that range";
    Err(out_of_range(
        law,
        "relaxation",
        relaxation,
        "-",
        "[0, 1]",
        remedy,
    ))
}
