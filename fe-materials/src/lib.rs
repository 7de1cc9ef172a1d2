//! Constitutive laws for reinforced concrete.

pub mod concrete;
mod elastic;
mod elasticity;
pub mod fixed_crack;
mod limits;
mod plastic_state;
mod von_mises;

pub use elastic::Elastic;
pub use von_mises::VonMises;
