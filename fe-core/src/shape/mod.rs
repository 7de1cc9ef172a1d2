//! Shape functions, inverse maps and quadrature on the reference cells, xi in [-1, 1]^d.

pub mod corners;
pub mod hex20;
pub mod line3;
pub mod quad8;
pub mod quadrature;
