//! Small models as dense matrices: eigenvalues and mechanisms.

use fe_core::assembly::{Assembled, Assembler};
use fe_core::element::EvaluationContext;
use fe_core::material::Operator;
use fe_core::model::{Conditions, Model, ModelError};
use fe_core::state::StateStore;
use nalgebra::{DMatrix, SymmetricEigen};

/// Eigenvalues below this share of the largest count as zero.
const ZERO: f64 = 1e-10;

/// Stiffness (N/mm) of the free equations in the virgin state.
///
/// # Errors
///
/// [`ModelError`].
pub fn stiffness(model: &Model, conditions: &Conditions) -> Result<DMatrix<f64>, ModelError> {
    let mut assembler = Assembler::new(model, conditions);
    let mut state = StateStore::new(model.elements());
    let mut out = Assembled::default();
    let rest = vec![0.0; model.dofs().len()];
    let ctx = EvaluationContext::new(Operator::Tangent);
    assembler.evaluate(model, &rest, &mut state, &ctx, &mut out)?;
    let pattern = assembler.pattern();
    let mut full = DMatrix::zeros(pattern.len(), pattern.len());
    for (&value, (i, j)) in &out.matrix.to_csc(pattern) {
        full[(i, j)] = value;
    }
    Ok(full)
}

/// Orthonormal modes without energy, one per column.
pub fn mechanisms(stiffness: DMatrix<f64>) -> DMatrix<f64> {
    let eigen = SymmetricEigen::new(stiffness);
    let largest = eigen.eigenvalues.amax();
    let zero = |i: &usize| eigen.eigenvalues[*i].abs() < ZERO * largest;
    let columns: Vec<usize> = (0..eigen.eigenvalues.len()).filter(zero).collect();
    eigen.eigenvectors.select_columns(&columns)
}
