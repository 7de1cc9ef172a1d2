//! Cohesive laws and interface elements.
//!
//! A cohesive law is a [`Material`](material::Material) over the
//! [`Interface`] kinematics: the displacement jump (mm) along two tangents
//! and the normal (opening positive) goes in, the traction (MPa) comes out. One trait, one point driver
//! and one conformance suite serve it and the laws of solids alike, and the kinematics marker keeps a
//! lamina from being plugged into an interface.
//!
//! - [`SlipDamage`] is the law of bonded sheets: damage that grows with the slip, after one of the curves in
//!   [`envelope`]; [`PullOut`] is the closed form of what it does to a strip.
//! - [`MixedMode`] is the law of delamination in opening and shear.
//! - [`Viscous`] gives a law artificial viscosity, and counts what it costs.
//! - [`case::BondCase`] is one of the first two as text.
//! - [`Interface16`] is the element between two 8-node faces, [`BondSlip`] the one between a bar and the
//!   hexahedra around it.
//!
//! The traits of `fe-core` that a single point needs are re-exported: [`kinematics`], [`material`] and the driver [`point`].

mod bond_slip;
pub mod case;
pub mod envelope;
mod interface16;
mod limits;
mod mixed_mode;
mod normal;
mod pull_out;
mod slip_damage;
mod viscous;

pub use bond_slip::{BondSlip, BondSlipBar};
pub use envelope::Envelope;
pub use fe_core::kinematics::Interface;
pub use fe_core::{kinematics, material, point};
pub use interface16::{Interface16, InterfaceRule};
pub use mixed_mode::{MixedMode, MixedModeParameters};
pub use normal::{BondSettings, Normal};
pub use pull_out::PullOut;
pub use slip_damage::SlipDamage;
pub use viscous::Viscous;

/// Splits a jump (mm) into the length of its slip, sqrt(s_1^2 + s_2^2), and its opening (mm), negative in
/// contact.
///
/// ```
/// use fe_contact::{Interface, slip_and_opening};
/// use fe_contact::kinematics::Kinematics;
///
/// let (slip, opening) = slip_and_opening(&Interface::vector(&[0.3, 0.4, -0.1]));
/// assert!((slip - 0.5).abs() < 1e-15);
/// assert!((opening + 0.1).abs() < 1e-15);
/// ```
pub fn slip_and_opening(jump: &<Interface as kinematics::Kinematics>::Vector) -> (f64, f64) {
    (jump[0].hypot(jump[1]), jump[2])
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
