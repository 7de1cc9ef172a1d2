//! Nonlinear drivers behind one step control, on sparse direct solvers.
//!
//! The crate knows systems of equations and steps, never concrete or steel. A [`stage::Stage`] holds a model
//! under given conditions; a [`driver::Driver`] ([`newton::NewtonRaphson`], [`automatic::Automatic`], [`secant::SecantAnderson`])
//! brings one step to equilibrium; [`control::StepControl`] chooses step lengths, accepts or repeats, and
//! tells a [`recorder::Recorder`].

pub mod anderson;
pub mod automatic;
pub mod capacity;
pub mod control;
pub mod critical;
pub mod descent;
pub mod driver;
pub mod error;
pub mod explicit;
pub mod implex;
pub mod journal;
pub mod linear;
pub mod newton;
pub mod path;
pub mod recorder;
pub mod secant;
pub mod stage;
pub mod viscous;
