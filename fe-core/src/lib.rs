//! Vocabulary of a nonlinear finite-element framework: meshes, laws, elements, and everything between them
//! that does not depend on which law or which element it is.
//!
//! # Flow
//!
//! A [`mesh::Mesh`] has nodes, blocks of cells and named node sets; [`grid::GridBuilder`] makes one of
//! boxes. Elements ([`element::Element`]) are built on its nodes with laws ([`material::Material`]) at
//! their integration points. A [`model::Model`] numbers their DOFs, [`model::Conditions`] hold and load
//! them. An [`assembly::Assembler`] turns a displacement and the history in a [`state::StateStore`] into
//! forces and a matrix on a fixed [`sparsity::Sparsity`] pattern: what a solver needs. A
//! [`output::FieldSeries`] writes what comes out.
//!
//! A law alone is driven by [`point::PointDriver`]. Whoever writes a law or an element finds its contract
//! as a check in [`testing`].
//!
//! # Contract
//!
//! Laws and elements hold parameters and geometry only. An update is a pure function: it reads the
//! committed state and writes all of the trial state. Only the step control of an analysis commits or rolls
//! back. Results have the same bits for any number of threads.
//!
//! # Conventions, stated once
//!
//! - Units: N, mm, MPa; fracture energy N/mm.
//! - Tension positive.
//! - Voigt order xx, yy, zz, xy, yz, xz with engineering shear strain, see [`voigt`].
//! - Node order of the VTK quadratic hexahedron and quadrilateral, see [`mesh::CellKind`].
//! - `f = internal force - external force` vanishes in equilibrium.

/// Vectors and matrices of laws, elements and meshes, in the version that this crate takes them from.
pub use nalgebra;

pub mod assembly;
pub mod check;
pub mod dof;
pub mod element;
pub mod energy;
pub mod followers;
pub mod grid;
pub mod kinematics;
pub mod limits;
pub mod material;
pub mod mesh;
pub mod model;
pub mod output;
mod places;
pub mod point;
pub mod points;
pub mod principal;
pub mod shape;
pub mod skin;
pub mod sparsity;
pub mod state;
pub mod testing;
pub mod voigt;
