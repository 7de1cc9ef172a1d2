//! Constitutive laws for reinforced concrete: concrete, reinforcing bars and fibre sheets.
//!
//! A law is a pure function from a strain and the committed history of a point to a stress, an operator
//! and the new history, [`Material`](material::Material); it holds parameters only. Units are N, mm and
//! MPa, tension is positive, Voigt order is xx, yy, zz, xy, yz, xz with engineering shear strain.
//!
//! | law | kinematics | for |
//! |---|---|---|
//! | [`Elastic`] | solid, plane stress, bar | plates, adhesive, verification |
//! | [`VonMises`] | solid | verification, metal |
//! | [`concrete::Associated`] | solid | concrete in compression, material points |
//! | [`concrete::Isochoric`] | solid | concrete in compression |
//! | [`concrete::Objective`] | solid | concrete that cracks and crushes, objective, rotating cracks |
//! | [`concrete::Reference`] | solid | published results of the beams |
//! | [`fixed_crack::FixedCrack`] | solid | concrete that cracks and crushes, objective, fixed cracks |
//! | [`Biso`] | bar | reinforcement |
//! | [`Lamina`], [`Laminate`] | plane stress | fibre sheets |
//!
//! The traits of `fe-core` that a single point needs are re-exported: [`kinematics`], [`material`] and
//! the driver [`point`]. A point can also be described by a text file, see [`case`].
//!
//! ```
//! use fe_materials::Biso;
//! use fe_materials::material::PointContext;
//! use fe_materials::point::{Control, PointDriver, Segment};
//!
//! let bar = Biso::hot_rolled(200e3, 460.0, 2e3)?;
//! let mut point = PointDriver::new(&bar, PointContext::new(0.0))?;
//! point.run(&[Segment::new(vec![Control::Strain(0.01)], 10)])?;
//! assert!((point.history().rows()[10].stress[0] - 475.4).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod biso;
pub mod case;
pub mod concrete;
mod elastic;
mod elasticity;
pub mod fixed_crack;
mod lamina;
mod plastic_state;
mod von_mises;

use fe_core::limits;

pub use biso::{Biso, Hardening};
pub use elastic::Elastic;
pub use fe_core::{kinematics, material, point};
pub use lamina::{Lamina, LaminaParameters, Laminate, Ply};
pub use von_mises::VonMises;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
