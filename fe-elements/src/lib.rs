//! Finite elements: the 20-node hexahedron, the 8-node plane-stress quadrilateral and bars embedded in
//! hexahedra of any shape, with consistent loads.

pub mod embedded_bar;
pub mod hex20;
pub mod installed;
mod kernel;
pub mod loads;
pub mod quad8;

use fe_core::points;

pub use embedded_bar::{Bar, Dowel, EmbeddedBar, embed};
pub use hex20::{BandWidth, Hex20, HexRule};
pub use installed::Installed;
pub use quad8::{Quad8, QuadRule};
