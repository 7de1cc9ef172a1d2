//! Range checks of parameters and jumps.

use fe_core::material::MaterialError;
use nalgebra::Vector3;

/// The error of a parameter outside its range.
pub(crate) fn out_of_range(
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

/// Refuses parameters, given as name, value and unit, that are not positive finite numbers.
pub(crate) fn positive(
    law: &'static str,
    parameters: &[(&'static str, f64, &'static str)],
) -> Result<(), MaterialError> {
    for &(parameter, value, unit) in parameters {
        if !(value.is_finite() && value > 0.0) {
            let remedy = "give a positive number";
            return Err(out_of_range(
                law, parameter, value, unit, "(0, inf)", remedy,
            ));
        }
    }
    Ok(())
}

/// Refuses a jump that is not a number.
pub(crate) fn finite(law: &'static str, jump: &Vector3<f64>) -> Result<(), MaterialError> {
    match jump.iter().position(|d| !d.is_finite()) {
        Some(component) => Err(MaterialError::NotFinite { law, component }),
        None => Ok(()),
    }
}
