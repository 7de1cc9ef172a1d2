//! IMPL-EX: one linear solve a step, no iteration.

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;

use crate::driver::{Attempt, Driver, IterationLog, Request};
use crate::error::SolverError;
use crate::secant::SecantAnderson;
use crate::stage::Stage;

/// Implicit-explicit integration (Oliver, Huespe and Cante 2008): the histories are extrapolated, here through the
/// displacement u* = u_n + (dl/dl_n) (u_n - u_(n-1)), the secant operator D* of the laws there is positive
/// definite, and one solve
///
/// u = u* + K(D*)^-1 (f_ext - f_int(u*))
///
/// ends the step; histories are then updated at u by the laws as they are. A step never fails and is never in
/// equilibrium: each tells the unbalanced force of the true law, and the work-conjugate load P* beside the load P.
/// Where the two differ by more than a few per cent the path is not one of equilibria, however smooth it looks.
#[derive(Debug, Clone, Copy, Default)]
pub struct Implex;

impl Driver for Implex {
    fn name(&self) -> &'static str {
        "IMPL-EX"
    }

    fn balances(&self) -> bool {
        false
    }

    fn attempt(
        &mut self,
        stage: &mut Stage<'_>,
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        let lambda = stage.lambda() + request.length;
        let mut free = SecantAnderson::predict(stage, request.length)?;
        let predicted = stage.compose(&free, lambda);
        let secant = EvaluationContext::new(Operator::Secant);
        let mut correction = stage.residual(&predicted, lambda, &secant)?;
        stage.factorise()?;
        stage.solve(&mut correction)?;
        free.iter_mut().zip(&correction).for_each(|(u, c)| *u += c);
        let displacement = stage.compose(&free, lambda);
        let force = EvaluationContext::new(Operator::None);
        let unbalanced = stage.residual(&displacement, lambda, &force)?;
        let residual = stage.measure(&unbalanced);
        log(&residual, 1.0)?;
        Ok(Attempt {
            displacement,
            lambda,
            converged: residual.relative.is_finite(),
            residual,
            iterations: 1,
            held: false,
            means: None,
            lag: None,
        })
    }
}
