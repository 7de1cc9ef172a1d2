//! Concrete: mean properties, the Ottosen surface and the laws built on it.
//!
//! Stress and strength in MPa, fracture energy in N/mm, tension positive, Voigt order xx, yy, zz, xy,
//! yz, xz.

mod limits;
mod ottosen;
mod scalars;

pub use ottosen::{Calibration, Ottosen};
pub use scalars::ConcreteScalars;
