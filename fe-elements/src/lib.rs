//! Finite elements: the 20-node hexahedron, also uniform across its width, 8-node plane-stress quadrilaterals in a plane and in space, the 8-node
//! layered shell, and bars embedded in hexahedra of any shape, with consistent loads.

pub mod embedded_bar;
pub mod hex20;
mod input;
pub mod installed;
mod kernel;
pub mod led;
pub mod linear;
pub mod loads;
pub mod membrane8;
pub mod quad8;
pub mod seen;
pub mod sheet;
pub mod shell8;
pub mod solid;
mod surface;
pub mod truss3;
pub mod uniform;
mod vectors;

use fe_core::points;

pub use embedded_bar::{Bar, Dowel, EmbeddedBar, Hosts, Piece, embed};
pub use hex20::{BandWidth, Hex20, HexRule};
pub use installed::Installed;
pub use led::Led;
pub use linear::Linear;
pub use membrane8::Membrane8;
pub use quad8::{Quad8, QuadRule};
pub use seen::Seen;
pub use sheet::Sheet;
pub use shell8::{Layer, Shell8, ShellSection};
pub use solid::SolidElement;
pub use truss3::Truss3;
pub use uniform::UniformHex20;
