//! The verification manual: what its tests say of themselves, what they have found, and its figures.

pub mod figures;
pub mod findings;
pub mod manual;
pub mod overview;
