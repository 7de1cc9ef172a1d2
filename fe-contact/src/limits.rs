//! Range checks of parameters and jumps.

use fe_core::limits;
use fe_core::material::MaterialError;

pub(crate) use fe_core::limits::{finite, out_of_range, relaxes};

/// Refuses parameters, given as name, value and unit, that are not positive finite numbers.
pub(crate) fn positive(
    law: &'static str,
    parameters: &[(&'static str, f64, &'static str)],
) -> Result<(), MaterialError> {
    parameters
        .iter()
        .try_for_each(|&(parameter, value, unit)| limits::positive(law, parameter, value, unit))
}
