//! The single-point driver: one integration point of any law, each component under strain or stress
//! control.
//!
//! ```
//! # use fe_core::kinematics::Axial;
//! # use fe_core::material::{Material, MaterialError, Response, StateVar};
//! # use nalgebra::{Matrix1, Vector1};
//! # #[derive(Debug)]
//! # struct Spring(f64);
//! # impl Material<Axial> for Spring {
//! #     fn name(&self) -> &'static str {
//! #         "spring"
//! #     }
//! #     fn state_vars(&self) -> &[StateVar] {
//! #         &[]
//! #     }
//! #     fn update(
//! #         &self,
//! #         strain: &Vector1<f64>,
//! #         _: &[f64],
//! #         _: &mut [f64],
//! #         _: &PointContext,
//! #     ) -> Result<Response<Axial>, MaterialError> {
//! #         Ok(Response { stress: self.0 * strain, tangent: Matrix1::new(self.0) })
//! #     }
//! # }
//! use fe_core::material::PointContext;
//! use fe_core::point::{Control, PointDriver, Segment};
//!
//! let law = Spring(200e3);
//! let mut point = PointDriver::new(&law, PointContext::new(10.0))?;
//! point.run(&[
//!     Segment::new(vec![Control::Strain(1e-3)], 4),
//!     Segment::new(vec![Control::Stress(-100.0)], 5),
//! ])?;
//! let last = &point.history().rows()[9];
//! assert!((last.strain[0] + 0.5e-3).abs() < 1e-15);
//! point.history().write_csv(&mut std::io::sink())?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod driver;
mod error;
mod history;

pub use driver::{PointDriver, PointSettings};
pub use error::PointError;
pub use history::{PointHistory, PointRow};

/// Largest number of steps of a segment: the history holds them all.
pub const MAX_STEPS: usize = 1_000_000;

/// What is prescribed in one component at the end of a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Control {
    /// The strain (a jump in mm for an interface).
    Strain(f64),
    /// The stress (MPa).
    Stress(f64),
}

impl Control {
    const fn target(self) -> f64 {
        match self {
            Self::Strain(target) | Self::Stress(target) => target,
        }
    }
}

/// A linear ramp of every component from its present value to its target.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// What is prescribed, one entry per component of the law's kinematics.
    pub controls: Vec<Control>,
    /// Steps of the ramp, 1 to [`MAX_STEPS`].
    pub steps: usize,
}

impl Segment {
    /// A ramp in `steps` steps.
    pub const fn new(controls: Vec<Control>, steps: usize) -> Self {
        Self { controls, steps }
    }
}
