//! Constitutive laws for reinforced concrete.

pub mod concrete;
