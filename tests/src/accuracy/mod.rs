//! Accuracy of the beams: what is run for `docs/accuracy.md`, and how its tables are written.

pub mod cases;
pub mod cost;
pub mod outcome;
pub mod scaled;
pub mod scatter;
pub mod source;
pub mod tables;
