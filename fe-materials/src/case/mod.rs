//! A material point as a text file: a law with its parameters and a program of strains and stresses.
//!
//! The types of this module are plain data for any format that serde reads. In RON (with the extension
//! `implicit_some`, so that an optional value stands for itself):
//!
//! ```ron
//! (
//!     law: Isochoric(concrete: (fck_mpa: 30)),
//!     program: [
//!         (strain: {"eps_xx": -0.0035}, steps: 35),
//!         (stress_mpa: {"sig_xx": 0}, steps: 5),
//!     ],
//! )
//! ```
//!
//! A segment ramps every component from its present value to the given one. Components are named as the
//! law's kinematics name them ([`Kinematics::STRAIN_LABELS`], [`Kinematics::STRESS_LABELS`]); those that a
//! segment does not name go to zero stress.

mod concrete;
mod error;
mod law;
mod program;

#[cfg(test)]
mod tests;

use fe_core::kinematics::Kinematics;
use fe_core::material::{Material, PointContext};
use fe_core::point::{PointDriver, PointError, PointHistory};
use serde::{Deserialize, Serialize};

pub use concrete::ConcreteCase;
pub use error::CaseError;
pub use law::{BuiltLaw, LawCase, PlyCase};
pub use program::SegmentCase;

/// A material point and what it goes through.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointCase {
    /// What the case shows.
    #[serde(default)]
    pub title: String,
    /// The law.
    pub law: LawCase,
    /// The segments, one after the other.
    pub program: Vec<SegmentCase>,
}

/// The path of a case, complete or up to where it had to stop.
#[derive(Debug, Clone, PartialEq)]
pub struct PointRun {
    /// The virgin state and every step that was reached.
    pub history: PointHistory,
    /// Whether the program was finished.
    pub result: Result<(), PointError>,
}

impl PointCase {
    /// Builds the law and drives it through the program.
    ///
    /// # Errors
    ///
    /// [`CaseError`] if the case is not valid; a program that cannot be finished is told by
    /// [`PointRun::result`].
    pub fn run(&self) -> Result<PointRun, CaseError> {
        let ctx = self.law.context();
        match self.law.build()? {
            BuiltLaw::Solid(law) => drive(law.as_ref(), ctx, &self.program),
            BuiltLaw::PlaneStress(law) => drive(law.as_ref(), ctx, &self.program),
            BuiltLaw::Axial(law) => drive(law.as_ref(), ctx, &self.program),
        }
    }
}

/// Drives a law of any kinematics through a program.
///
/// # Errors
///
/// As [`PointCase::run`].
pub fn drive<K: Kinematics>(
    law: &dyn Material<K>,
    ctx: PointContext,
    program: &[SegmentCase],
) -> Result<PointRun, CaseError> {
    if program.is_empty() {
        return Err(CaseError::NoSegments);
    }
    let segments = (1..)
        .zip(program)
        .map(|(number, segment)| segment.build::<K>(number))
        .collect::<Result<Vec<_>, _>>()?;
    let mut driver = PointDriver::new(law, ctx)?;
    let result = driver.run(&segments);
    Ok(PointRun {
        history: driver.history().clone(),
        result,
    })
}
