//! Scenes that the verification cases share: meshes, laws made for a test, and one-call solutions.
//!
//! The cases themselves are in `tests/`, one file per family, each named after its entry in the list of the
//! README.

pub mod accuracy;
pub mod beam;
pub mod calculix;
pub mod conditions;
pub mod cube;
pub mod delamination;
pub mod dense;
pub mod document;
pub mod driven;
pub mod figure;
pub mod follow;
pub mod hourglass;
pub mod journal;
pub mod laws;
pub mod mesh;
pub mod panel;
pub mod pardiso;
pub mod provenance;
pub mod sample;
pub mod shell;
pub mod softening_bar;
pub mod solve;
pub mod stability;
pub mod stress;
pub mod strip;
pub mod toronto;
pub mod verification;
