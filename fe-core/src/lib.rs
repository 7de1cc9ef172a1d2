//! Vocabulary of a nonlinear finite-element framework.
//!
//! # Conventions, stated once
//!
//! - Units: N, mm, MPa; fracture energy N/mm.
//! - Tension positive.
//! - Voigt order xx, yy, zz, xy, yz, xz with engineering shear strain, see [`voigt`].
//! - Node order of the VTK quadratic hexahedron and quadrilateral, see [`mesh::CellKind`].
//! - `f = internal force - external force` vanishes in equilibrium.

pub mod assembly;
pub mod dof;
pub mod element;
pub mod grid;
pub mod kinematics;
pub mod material;
pub mod mesh;
pub mod model;
pub mod output;
pub mod point;
pub mod shape;
pub mod sparsity;
pub mod state;
pub mod testing;
pub mod voigt;
