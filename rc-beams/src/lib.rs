//! Simulates the reinforced-concrete beams of Khalifa (1999) from first crack to failure.

pub mod exit;
pub mod options;
pub mod run;
pub mod spec;
