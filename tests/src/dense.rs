//! Small models as dense matrices: eigenvalues, mechanisms, solutions beside mechanisms.

use fe_core::assembly::{Assembled, Assembler};
use fe_core::element::EvaluationContext;
use fe_core::material::Operator;
use fe_core::model::{Conditions, Model, ModelError};
use fe_core::state::StateStore;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Eigenvalues below this share of the largest count as zero.
const ZERO: f64 = 1e-11;

/// A model in its virgin state.
#[derive(Debug)]
pub struct DenseModel {
    /// DOF of each free equation.
    pub free: Vec<usize>,
    dofs: usize,
    /// Eigenvalues (N/mm) and orthonormal eigenvectors of the stiffness of the free equations.
    eigen: SymmetricEigen<f64, nalgebra::Dyn>,
    /// The stiffness scaled to a unit diagonal.
    scaled: DMatrix<f64>,
}

impl DenseModel {
    /// Assembles and decomposes the stiffness.
    ///
    /// # Errors
    ///
    /// [`ModelError`].
    pub fn new(model: &Model, conditions: &Conditions) -> Result<Self, ModelError> {
        let mut assembler = Assembler::new(model, conditions)?;
        let mut state = StateStore::new(model.elements());
        let mut out = Assembled::default();
        let rest = vec![0.0; model.dofs().len()];
        let ctx = EvaluationContext::new(Operator::Tangent);
        assembler.evaluate(model, &rest, &mut state, &ctx, &mut out)?;
        let pattern = assembler.pattern();
        let mut stiffness = DMatrix::zeros(pattern.len(), pattern.len());
        for (&value, (i, j)) in &out.matrix.to_csc(pattern) {
            stiffness[(i, j)] = value;
        }
        let diagonal = stiffness.diagonal();
        let scaled = DMatrix::from_fn(stiffness.nrows(), stiffness.ncols(), |i, j| {
            stiffness[(i, j)] / (diagonal[i] * diagonal[j]).sqrt()
        });
        Ok(Self {
            free: assembler.free().iter().map(|&d| d as usize).collect(),
            dofs: rest.len(),
            eigen: SymmetricEigen::new(stiffness),
            scaled,
        })
    }

    /// Largest over least eigenvalue of the stiffness scaled to a unit diagonal.
    pub fn condition(&self) -> f64 {
        let eigenvalues = self.scaled.symmetric_eigenvalues();
        eigenvalues.max() / eigenvalues.min()
    }

    fn modes(&self, zero: bool) -> impl Iterator<Item = usize> + '_ {
        let limit = ZERO * self.eigen.eigenvalues.amax();
        let values = self.eigen.eigenvalues.iter().enumerate();
        values
            .filter(move |(_, w)| (w.abs() < limit) == zero)
            .map(|(i, _)| i)
    }

    /// Number of modes without energy.
    pub fn mechanisms(&self) -> usize {
        self.modes(true).count()
    }

    /// How far a free equation takes part in modes without energy: the largest entry of its row.
    pub fn freedom(&self, equation: usize) -> f64 {
        let entry = |mode| self.eigen.eigenvectors[(equation, mode)].abs();
        self.modes(true).map(entry).fold(0.0, f64::max)
    }

    /// Displacement of all DOFs in the first mode without energy, if there is one; unit norm.
    pub fn mechanism(&self) -> Option<Vec<f64>> {
        let first = self.modes(true).next()?;
        let mode = self.eigen.eigenvectors.column(first);
        Some(self.extend(mode.iter().copied()))
    }

    /// Displacement (mm) of all DOFs under the reference load, without any share of the modes without
    /// energy.
    pub fn solve(&self, conditions: &Conditions) -> Vec<f64> {
        let all = conditions.reference();
        let load = DVector::from_iterator(self.free.len(), self.free.iter().map(|&d| all[d]));
        let mut free = DVector::zeros(self.free.len());
        for i in self.modes(false) {
            let mode = self.eigen.eigenvectors.column(i);
            free += mode * (mode.dot(&load) / self.eigen.eigenvalues[i]);
        }
        self.extend(free.iter().copied())
    }

    /// All DOFs from the free ones.
    fn extend(&self, free: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut full = vec![0.0; self.dofs];
        for (&d, u) in self.free.iter().zip(free) {
            full[d] = u;
        }
        full
    }
}

/// Internal force (N) of all DOFs at a displacement (mm) from the virgin state.
///
/// # Errors
///
/// [`ModelError`].
pub fn internal(model: &Model, u: &[f64]) -> Result<Vec<f64>, ModelError> {
    let mut state = StateStore::new(model.elements());
    let mut out = Assembled::default();
    let ctx = EvaluationContext::new(Operator::None);
    let mut assembler = Assembler::new(model, &Conditions::new(model))?;
    assembler.evaluate(model, u, &mut state, &ctx, &mut out)?;
    Ok(out.internal)
}

/// Energy (1/2) u . f(u) (N mm) of a displacement (mm) of a linear model.
///
/// # Errors
///
/// [`ModelError`].
pub fn energy(model: &Model, u: &[f64]) -> Result<f64, ModelError> {
    let force = internal(model, u)?;
    Ok(0.5 * u.iter().zip(&force).map(|(u, f)| u * f).sum::<f64>())
}
