//! What is read off the last evaluation of a stage: residual, loads, stability.

use fe_core::element::EvaluationContext;
use fe_core::energy::{Change, ElementAt};
use fe_core::material::Operator;

use serde::{Deserialize, Serialize};

use super::Stage;
use crate::anderson::dot;
use crate::critical::Signs;
use crate::error::SolverError;

/// Share of the largest reactions of all accepted steps below which a residual is not measured against the present
/// ones: a body that has come off carries none, and no residual is small against them.
pub const LEAST_SCALE: f64 = 1e-3;

/// Force (N) against which a residual is measured where all others are less: a body moved without strain has reactions of
/// rounding, and no residual is small against them.
pub const LEAST_FORCE: f64 = 1e-6;

/// Size of a residual.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Residual {
    /// |f_ext - f_int| on the free equations over the norm of the reactions or that of the forces applied, whichever is more
    /// (2-norms, in which moments count as the couples that the largest extent of the model makes of them), which counts as [`LEAST_SCALE`] of the largest reactions of all accepted steps or [`LEAST_FORCE`] where it
    /// is less, and as 1 N where there has been none. Infinite if a force is not a number.
    pub relative: f64,
    /// Largest component (N).
    pub largest: f64,
    /// DOF of that component.
    pub worst: usize,
}

impl Residual {
    /// Where no force is known.
    pub(crate) const ENDLESS: Self = Self {
        relative: f64::INFINITY,
        largest: f64::INFINITY,
        worst: 0,
    };
}

impl Stage<'_> {
    /// Size of a residual, measured against the forces of the last evaluation.
    pub fn measure(&self, residual: &[f64]) -> Residual {
        let reactions = self.reactions();
        let (mut sum, mut largest, mut worst) = (0.0, 0.0, 0);
        for (&d, r) in self.assembler.free().iter().zip(residual) {
            let r = self.as_force(d as usize, *r);
            sum += r * r;
            // The first component that is not a number stays the worst.
            if r.abs() > largest || (r.is_nan() && !largest.is_nan()) {
                (largest, worst) = (r.abs(), d as usize);
            }
        }
        // Forces may balance one another and leave no reaction.
        let free = self.assembler.free().iter();
        let applied = free.map(|&d| self.as_force(d as usize, self.external[d as usize]).powi(2));
        let applied = applied.sum::<f64>().sqrt();
        let scale = reactions
            .max(applied)
            .max(LEAST_SCALE * self.largest_reactions);
        let scale = if scale > 0.0 {
            scale.max(LEAST_FORCE)
        } else {
            1.0
        };
        let relative = if sum == 0.0 { 0.0 } else { sum.sqrt() / scale };
        let finite = relative.is_finite() && reactions.is_finite();
        Residual {
            relative: if finite { relative } else { f64::INFINITY },
            largest,
            worst,
        }
    }

    /// Relative residual of the last evaluation.
    pub(crate) fn unbalance(&self) -> f64 {
        let residual: Vec<f64> = self.unbalanced().collect();
        self.measure(&residual).relative
    }

    /// A force (N), or a moment (N mm) as a couple of forces.
    fn as_force(&self, dof: usize, value: f64) -> f64 {
        self.levers.get(dof).map_or(value, |lever| value / lever)
    }

    /// Norm of the reactions (N) of the last evaluation.
    pub(super) fn reactions(&self) -> f64 {
        let prescribed = self.conditions.prescribed().keys();
        let squares = prescribed.map(|&d| self.as_force(d, self.reaction(d)).powi(2));
        squares.sum::<f64>().sqrt()
    }

    /// Work-conjugate load of the last evaluation (N, for a load factor in mm): (f_int - f_dead) . du / dlambda
    /// over all DOFs, where du leads from the accepted displacement to `u`. Equals [`Self::load`] in
    /// equilibrium where the factor drives displacements.
    pub fn work_conjugate_load(&self, u: &[f64], lambda: f64) -> f64 {
        let dl = lambda - self.lambda;
        let mut dead = vec![0.0; u.len()];
        self.conditions.external(0.0, &mut dead);
        let forces = self.assembled.internal.iter().zip(&dead);
        let ways = u.iter().zip(&self.displacement);
        let work: f64 = forces
            .zip(ways)
            .map(|((q, f), (to, from))| (q - f) * (to - from))
            .sum();
        work / dl
    }

    /// Load conjugate to the load factor of the last evaluation (N, for a load factor in mm): reactions times
    /// the prescribed pattern; 0 where the factor drives forces only.
    pub fn load(&self) -> f64 {
        let prescribed = self.conditions.prescribed().iter();
        prescribed.map(|(&d, r)| self.reaction(d) * r).sum()
    }

    /// Reaction (N) of a constrained DOF in the last evaluation.
    ///
    /// # Panics
    ///
    /// For a DOF that the model does not have.
    pub fn reaction(&self, dof: usize) -> f64 {
        self.assembled.internal[dof] - self.external[dof]
    }

    /// Energies of the step from the accepted state to the trial state of the last evaluation, at `u` and `lambda`.
    ///
    /// # Errors
    ///
    /// [`SolverError::NotEvaluated`] before an evaluation or after one that failed, [`SolverError::Model`] also for energies
    /// that are not finite, [`SolverError::NoNumber`] for a load factor that is not.
    pub fn weigh(&mut self, u: &[f64], lambda: f64) -> Result<Change, SolverError> {
        SolverError::number("load factor", lambda)?;
        let (model, conditions) = (self.model, &self.conditions);
        let (assembler, state) = (&self.assembler, &*self.state);
        let forces = &self.assembled.element_forces;
        let last = model.elements().len().checked_sub(1);
        if last.is_some_and(|e| forces.len() < assembler.force_range(e).end) {
            return Err(SolverError::NotEvaluated);
        }
        if !self.opened {
            let start = (self.lambda, self.displacement.as_slice());
            self.ledger.rebase(start.1);
            self.ledger.weigh(model, conditions, start, |e| ElementAt {
                dofs: assembler.element_dofs(e),
                state: state.committed(e),
                force: None,
            })?;
            self.ledger.settle();
            self.opened = true;
        }
        let here = (lambda, u);
        Ok(self.ledger.weigh(model, conditions, here, |e| ElementAt {
            dofs: assembler.element_dofs(e),
            state: state.trial(e),
            force: Some(&forces[assembler.force_range(e)]),
        })?)
    }

    /// Signs of the symmetric part (K + K^T)/2 of the consistent tangent at `u`: no negative pivots in
    /// an equilibrium that is stable under the constraints of the stage (positive second-order work, Hill
    /// 1958). A tangent that is singular counts as many as the one before,
    /// and one at least.
    ///
    /// Histories grow by the share `relaxation`, 1 without viscosity. The trial state is that of `u`, which is to be
    /// accepted; the factor replaces that of the driver.
    ///
    /// # Errors
    ///
    /// [`SolverError`].
    pub fn stability(
        &mut self,
        u: &[f64],
        lambda: f64,
        relaxation: f64,
    ) -> Result<Signs, SolverError> {
        let tangent = EvaluationContext {
            operator: Operator::Tangent,
            relaxation,
            symmetric_part: true,
        };
        self.residual(u, lambda, &tangent)?;
        self.linear.expect(self.signs.negative > 0);
        let factorised = self.inertia();
        // The next matrix is an operator of the driver.
        self.linear.expect(false);
        let singular = match factorised {
            Ok(()) => false,
            Err(SolverError::Singular { .. }) => true,
            Err(e) => return Err(e),
        };
        if singular {
            // Nothing has become stable again.
            self.counters.negative_pivots = self.signs.negative.max(1);
        }
        let negative = self.counters.negative_pivots;
        self.stable_tangent = negative == 0;
        let turned = if negative == 0 {
            false
        } else if singular {
            self.signs.turned
        } else {
            let load = self.reference_load();
            let mut response = load.clone();
            self.precondition(&mut response)?;
            dot(&load, &response) < 0.0
        };
        Ok(Signs { negative, turned })
    }
}
