//! Concrete: mean properties, the Ottosen surface and the laws built on it.
//!
//! Stress and strength in MPa, fracture energy in N/mm, tension positive, Voigt order xx, yy, zz, xy,
//! yz, xz.

mod associated;
mod elastic_bound;
mod hardening;
mod isochoric;
mod objective;
mod ottosen;
mod plastic_state;
mod reference;
mod root;
mod scalars;
mod spectral;

pub use associated::Associated;
pub use hardening::{CompressionCurve, CurvePoint};
pub use isochoric::Isochoric;
pub use objective::Objective;
pub use ottosen::{Calibration, Ottosen};
pub use reference::{Reference, ReferenceParameters, ShearRetention, TensionStiffening};
pub use scalars::ConcreteScalars;
pub(crate) use scalars::{STRENGTH_MARGIN, peak_strain};
