//! The specimen file: what a beam is, in the words of the test report.

mod builtin;
mod check;
mod quantity;
mod read;
mod reinforcement;
mod sheets;
mod specimen;

pub use builtin::BUILTIN;
pub use check::{Finding, check};
pub use quantity::*;
pub use read::read;
pub use reinforcement::*;
pub use sheets::*;
pub use specimen::*;
