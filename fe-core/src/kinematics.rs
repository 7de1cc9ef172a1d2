//! Work-conjugate pairs: what a constitutive law is fed with and what it answers.

use std::fmt::Debug;

use nalgebra::{SMatrix, SVector};

/// A work-conjugate pair of a generalised strain and a generalised stress.
///
/// The marker types [`Solid`], [`PlaneStress`], [`Axial`] and [`Interface`] implement it, so that a
/// law for one pair can never be plugged into an element of another.
pub trait Kinematics: Debug + Clone + Copy + Send + Sync + 'static {
    /// Generalised strain or stress, `LEN` components.
    type Vector: Debug + Clone + Copy + Send + Sync + PartialEq;
    /// Derivative of stress with respect to strain, `LEN` x `LEN`.
    type Tangent: Debug + Clone + Copy + Send + Sync + PartialEq;
    /// Number of components.
    const LEN: usize;
    /// Names of the strain components, in order.
    const STRAIN_LABELS: &'static [&'static str];
    /// Names of the stress components, in order.
    const STRESS_LABELS: &'static [&'static str];
    /// Builds a vector from the first `LEN` entries of a slice.
    ///
    /// # Panics
    ///
    /// For fewer entries.
    fn vector(components: &[f64]) -> Self::Vector;
    /// The components of a vector.
    fn components(vector: &Self::Vector) -> &[f64];
    /// Entry `(i, j)` of a tangent: the derivative of stress `i` with respect to strain `j`.
    fn entry(tangent: &Self::Tangent, i: usize, j: usize) -> f64;
    /// Sets entry `(i, j)` of a tangent.
    fn set_entry(tangent: &mut Self::Tangent, i: usize, j: usize, value: f64);
    /// A tangent of zeros.
    fn zero_tangent() -> Self::Tangent;
}

macro_rules! kinematics {
    ($(#[$doc:meta])* $name:ident, $len:literal, $strain:expr, $stress:expr) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub struct $name;

        impl Kinematics for $name {
            type Vector = SVector<f64, $len>;
            type Tangent = SMatrix<f64, $len, $len>;
            const LEN: usize = $len;
            const STRAIN_LABELS: &'static [&'static str] = &$strain;
            const STRESS_LABELS: &'static [&'static str] = &$stress;
            fn vector(components: &[f64]) -> Self::Vector {
                SVector::from_column_slice(&components[..$len])
            }
            fn components(vector: &Self::Vector) -> &[f64] {
                vector.as_slice()
            }
            fn entry(tangent: &Self::Tangent, i: usize, j: usize) -> f64 {
                tangent[(i, j)]
            }
            fn set_entry(tangent: &mut Self::Tangent, i: usize, j: usize, value: f64) {
                tangent[(i, j)] = value;
            }
            fn zero_tangent() -> Self::Tangent {
                SMatrix::zeros()
            }
        }
    };
}

kinematics!(
    /// Three-dimensional continuum: strain and stress in Voigt order xx, yy, zz, xy, yz, xz with
    /// engineering shear strain (-) and stress (MPa).
    Solid,
    6,
    ["eps_xx", "eps_yy", "eps_zz", "gamma_xy", "gamma_yz", "gamma_xz"],
    ["sig_xx", "sig_yy", "sig_zz", "tau_xy", "tau_yz", "tau_xz"]
);
kinematics!(
    /// Plane stress in the plane of a sheet: 11, 22, 12, with engineering shear strain; stress (MPa).
    PlaneStress,
    3,
    ["eps_11", "eps_22", "gamma_12"],
    ["sig_11", "sig_22", "tau_12"]
);
kinematics!(
    /// Uniaxial bar: axial strain (-) to axial stress (MPa).
    Axial,
    1,
    ["eps"],
    ["sig"]
);
kinematics!(
    /// Zero-thickness interface: jump (mm) along two tangents and the normal (opening positive) to
    /// traction (MPa).
    Interface,
    3,
    ["slip_1", "slip_2", "opening"],
    ["tau_1", "tau_2", "sig_n"]
);
