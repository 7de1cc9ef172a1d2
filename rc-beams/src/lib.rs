//! Simulates the reinforced-concrete beams of Khalifa (1999) from first crack to failure.

pub mod analysis;
mod bound;
pub mod build;
pub mod cli;
mod column;
pub mod exit;
pub mod input;
pub mod list;
pub mod options;
pub mod output;
pub mod point;
pub mod results;
pub mod ronfile;
pub mod run;
pub mod spec;
mod suggest;
