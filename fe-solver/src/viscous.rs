//! Newton-Raphson on laws whose history lags behind: artificial viscosity, with the work it swallows.

use fe_core::element::EvaluationContext;
use fe_core::material::Operator;

use crate::anderson::dot;
use crate::driver::{Attempt, Driver, IterationLog, Lag, Request};
use crate::error::SolverError;
use crate::newton::{NewtonRaphson, NewtonSettings};
use crate::stage::Stage;

/// Newton-Raphson under control of the load factor; histories grow by the share a = dl/(tau + dl) of what the law without
/// viscosity asks for, dl being the length of the step and tau the viscosity, both in units of the load factor
/// (backward Euler of k' = <k_inf - k>/tau, after Duvaut and Lions 1972).
///
/// Softening then never outruns the step: with short steps the tangent tends to the positive secant, and Newton-Raphson
/// passes snaps that have no static path. The price is strength and energy. Every step tells the residual of the law
/// without viscosity from the same history, and the share of the work that has gone into the excess of stress over it,
///
/// sum (f_viscous - f_inviscid) . du / sum f_viscous . du.
///
/// A share beyond a few per cent, or a peak that changes with tau, means that the viscosity carries the load.
#[derive(Debug)]
pub struct Viscous {
    viscosity: f64,
    newton: NewtonRaphson,
    /// Work and viscous work (N mm) of the accepted steps.
    total: [f64; 2],
    /// The same of the last attempt, not yet known to be accepted.
    pending: [f64; 2],
}

impl Viscous {
    /// A driver with the viscosity tau, in units of the load factor.
    ///
    /// # Errors
    ///
    /// [`SolverError::Setting`] for a viscosity that is no positive number.
    pub fn new(viscosity: f64, settings: NewtonSettings) -> Result<Self, SolverError> {
        SolverError::positive("viscosity", viscosity)?;
        Ok(Self {
            viscosity,
            newton: NewtonRaphson::new(settings),
            total: [0.0; 2],
            pending: [0.0; 2],
        })
    }

    fn sums(&self) -> [f64; 2] {
        [0, 1].map(|i| self.total[i] + self.pending[i])
    }
}

impl Driver for Viscous {
    fn name(&self) -> &'static str {
        "viscous Newton-Raphson"
    }

    fn balances(&self) -> bool {
        false
    }

    fn begin(&mut self) {
        (self.total, self.pending) = ([0.0; 2], [0.0; 2]);
    }

    fn attempt(
        &mut self,
        stage: &mut Stage<'_>,
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        let relaxation = request.length / (self.viscosity + request.length);
        let mut attempt = self.newton.relaxed(relaxation, stage, request, log)?;
        let u = &attempt.displacement;
        let du: Vec<f64> = u
            .iter()
            .zip(stage.displacement())
            .map(|(a, b)| a - b)
            .collect();
        let work = dot(stage.internal(), &du);
        let residual =
            stage.residual(u, attempt.lambda, &EvaluationContext::new(Operator::None))?;
        self.pending = [work, work - dot(stage.internal(), &du)];
        let [work, viscous] = self.sums();
        attempt.residual = stage.measure(&residual);
        attempt.lag = Some(Lag {
            relaxation,
            viscous: if work == 0.0 { 0.0 } else { viscous / work },
        });
        Ok(attempt)
    }

    fn accepted(&mut self) {
        (self.total, self.pending) = (self.sums(), [0.0; 2]);
    }

    fn memory(&self) -> Vec<f64> {
        self.total.to_vec()
    }

    fn recall(&mut self, memory: &[f64]) {
        if let [work, viscous] = *memory {
            self.total = [work, viscous];
            self.pending = [0.0; 2];
        }
    }
}
