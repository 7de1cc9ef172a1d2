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

/// Largest strain (-) or jump (mm) of a component that laws answer: third powers of the stresses of larger ones leave the
/// range of numbers, and what comes out is none.
pub const LARGEST_STRAIN: f64 = 1e90;

/// Refuses a strain or jump that is not a number, or beyond [`LARGEST_STRAIN`].
///
/// # Errors
///
/// [`MaterialError::NotFinite`].
pub fn finite<const N: usize>(
    law: &'static str,
    strain: &SVector<f64, N>,
) -> Result<(), MaterialError> {
    match strain
        .iter()
        .position(|e| e.is_nan() || e.abs() > LARGEST_STRAIN)
    {
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

#[cfg(test)]
mod tests {
    //! Protects laws against strains whose powers are no numbers.
    use super::*;

    #[test]
    fn strains_without_stress_are_refused() {
        for good in [0.0, -1e-300, 1e60, -LARGEST_STRAIN] {
            assert_eq!(finite("law", &SVector::from([0.0, good])), Ok(()));
        }
        for bad in [f64::NAN, f64::INFINITY, -1.01 * LARGEST_STRAIN, 1e200] {
            let error = finite("law", &SVector::from([0.0, bad])).unwrap_err();
            let (law, component) = ("law", 1);
            assert_eq!(error, MaterialError::NotFinite { law, component });
        }
    }
}
