//! Constitutive laws for reinforced concrete.

mod biso;
pub mod case;
pub mod concrete;
mod elastic;
mod elasticity;
pub mod fixed_crack;
mod lamina;
mod limits;
mod plastic_state;
mod von_mises;

pub use biso::{Biso, Hardening};
pub use elastic::Elastic;
pub use fe_core::point;
pub use lamina::{Lamina, LaminaParameters, Laminate, Ply};
pub use von_mises::VonMises;
