//! Simulates the reinforced-concrete beams of Khalifa (1999) from first crack to failure.

pub mod spec;
