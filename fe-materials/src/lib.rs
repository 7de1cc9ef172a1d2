//! Constitutive laws for reinforced concrete.

pub mod concrete;
pub mod fixed_crack;
