//! Conformance checks for everybody who writes a law or an element, and findings of tests.
//!
//! [`check_material`], [`check_isotropy`] and [`check_element`] drive random but reproducible paths and
//! hold the answers against the contracts of [`Material`](crate::material::Material) and
//! [`Element`](crate::element::Element). They need no test framework: call them in a `#[test]` and unwrap.
//!
//! ```
//! # use fe_core::kinematics::Axial;
//! # use fe_core::material::{Material, MaterialError, PointContext, Response, StateVar};
//! # use nalgebra::{Matrix1, Vector1};
//! use fe_core::testing::{MaterialCheck, check_material};
//!
//! #[derive(Debug)]
//! struct Spring(f64);
//!
//! impl Material<Axial> for Spring {
//!     fn name(&self) -> &'static str {
//!         "spring"
//!     }
//!     fn state_vars(&self) -> &[StateVar] {
//!         &[]
//!     }
//!     fn update(
//!         &self,
//!         strain: &Vector1<f64>,
//!         _committed: &[f64],
//!         _trial: &mut [f64],
//!         _ctx: &PointContext,
//!     ) -> Result<Response<Axial>, MaterialError> {
//!         Ok(Response { stress: self.0 * strain, tangent: Matrix1::new(self.0) })
//!     }
//! }
//!
//! let report = check_material(&Spring(200e3), &MaterialCheck::new(1e-3))?;
//! assert!(report.worst_tangent < 1e-9);
//! # Ok::<(), fe_core::testing::CheckFailure>(())
//! ```
//!
//! [`within`], [`within_share`], [`between`], [`below`], [`counted`] and [`Worst`] hold what a test found against its target and
//! print both on one line of a fixed form; [`curve`] prints points. The verification manual is written from these lines.
//!
//! ```
//! use fe_core::testing::within;
//!
//! within("circumference of the unit circle", std::f64::consts::TAU, 6.283, 5e-4);
//! ```

mod difference;
mod drive;
mod element;
mod failure;
mod finding;
mod isotropy;
mod material;
mod path;
mod random;
mod rigid;

mod settings;
mod together;
mod walk;
mod worst;

pub use element::check_element;
pub use failure::{CheckFailure, Place};
pub use finding::{below, between, counted, curve, within, within_share};
pub use isotropy::{IsotropyReport, check_isotropy};
pub use material::check_material;
pub use random::Random;
pub use settings::{ElementCheck, ElementReport, MaterialCheck, MaterialReport};
pub use worst::Worst;
