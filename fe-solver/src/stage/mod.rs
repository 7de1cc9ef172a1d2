//! One load stage as the drivers see it: residuals, operators, solves, and the accepted state.

mod measures;
mod solving;

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use fe_core::assembly::{Assembled, Assembler};
use fe_core::dof::Dof;
use fe_core::element::EvaluationContext;
use fe_core::energy::{Change, Ledger};
use fe_core::material::Operator;
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;

use crate::critical::Signs;
use crate::error::SolverError;
use crate::linear::{DirectSolver, LinearSolver};

pub use measures::{LEAST_FORCE, LEAST_SCALE, Residual};

/// Deterministic counts of the work done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Accepted steps.
    pub steps: usize,
    /// Iterations that recorders were told of, predictors and failed attempts included.
    pub iterations: usize,
    /// Attempts given up and repeated with a shorter step.
    pub cutbacks: usize,
    /// Numeric factorisations.
    pub factorisations: usize,
    /// Evaluations of the internal force, operator evaluations included.
    pub force_evaluations: usize,
    /// Negative pivots of the last factorisation.
    pub negative_pivots: usize,
}

/// Wall time by phase.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PhaseTimes {
    /// Force-only evaluations: laws and elements.
    pub forces: Duration,
    /// Operator evaluations: laws, elements and assembly.
    pub assembly: Duration,
    /// Numeric factorisation.
    pub factorise: Duration,
    /// Back-substitution.
    pub solve: Duration,
}

/// What the accepted state of a stage is built from.
#[derive(Debug)]
pub struct Stage<'m> {
    model: &'m Model,
    conditions: Conditions,
    assembler: Assembler,
    linear: DirectSolver,
    /// Whether the factor is that of a positive-definite tangent at the accepted state.
    stable_tangent: bool,
    state: &'m mut StateStore,
    assembled: Assembled,
    /// Where the last evaluation was made: displacement, load factor and relaxation, unless the history has changed since.
    evaluated: Option<(Vec<f64>, f64, f64)>,
    external: Vec<f64>,
    start: Vec<f64>,
    displacement: Vec<f64>,
    lambda: f64,
    previous: Option<(Vec<f64>, f64)>,
    accepted_load: f64,
    /// Signs of the tangent where they were counted last.
    signs: Signs,
    /// Steps accepted since.
    uncounted: usize,
    /// Largest norm of the reactions (N) of all accepted states.
    largest_reactions: f64,
    /// What divides the force of every DOF so that moments can be added to forces: 1, or the extent of the model (mm), if it has one, for
    /// rotations; empty where there are none.
    levers: Vec<f64>,
    counters: Counters,
    times: PhaseTimes,
    ledger: Ledger,
    /// Whether the ledger knows the state from which the stage starts.
    opened: bool,
}

/// The levers of a [`Stage`].
fn levers(model: &Model) -> Vec<f64> {
    let dofs = model.dofs();
    let kinds = (0..dofs.len()).map(|d| dofs.owner(d).1);
    let turns = |dof: Dof| !Dof::DISPLACEMENTS.contains(&dof);
    if !kinds.clone().any(turns) {
        return Vec::new();
    }
    let extent = model.mesh().extent();
    let extent = if extent > 0.0 { extent } else { 1.0 };
    kinds
        .map(|dof| if turns(dof) { extent } else { 1.0 })
        .collect()
}

impl<'m> Stage<'m> {
    /// Builds pattern and analysis for a stage that starts from displacement `start` (all DOFs, mm).
    ///
    /// # Errors
    ///
    /// [`SolverError::Mismatch`] for conditions, states or displacements of another model, [`SolverError::Linear`] when the
    /// analysis fails.
    pub fn new(
        model: &'m Model,
        conditions: Conditions,
        state: &'m mut StateStore,
        start: Vec<f64>,
    ) -> Result<Self, SolverError> {
        let dofs = model.dofs().len();
        let variables = model.elements().iter().map(|e| e.state_len()).sum();
        let history = state.all_committed().len();
        SolverError::length("displacement", start.len(), dofs)?;
        SolverError::length("conditions", conditions.reference().len(), dofs)?;
        SolverError::length("history variables", history, variables)?;
        // What an earlier stage had latched in a step that failed has not happened.
        state.roll_back();
        let assembler = Assembler::new(model, &conditions)?;
        let mut linear = DirectSolver::default();
        linear
            .analyze(assembler.pattern())
            .map_err(SolverError::Linear)?;
        // Nothing has been evaluated: no forces yet.
        let assembled = Assembled {
            internal: vec![0.0; dofs],
            coupling: vec![0.0; assembler.free().len()],
            ..Assembled::default()
        };
        Ok(Self {
            model,
            external: vec![0.0; dofs],
            displacement: start.clone(),
            start,
            conditions,
            assembler,
            linear,
            stable_tangent: false,
            state,
            assembled,
            evaluated: None,
            lambda: 0.0,
            previous: None,
            accepted_load: 0.0,
            signs: Signs::STABLE,
            uncounted: 0,
            largest_reactions: 0.0,
            levers: levers(model),
            counters: Counters::default(),
            times: PhaseTimes::default(),
            ledger: Ledger::default(),
            opened: false,
        })
    }

    /// Goes on with the energies of the stage before.
    #[must_use]
    pub fn with_ledger(mut self, ledger: Ledger) -> Self {
        self.ledger = ledger;
        self
    }

    /// Energies up to the accepted state.
    pub const fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// Energies of the last accepted step; none before the first step and after a snap.
    pub fn last_change(&self) -> Option<Change> {
        self.previous.as_ref().map(|_| self.ledger.last_change())
    }

    /// Energies up to the accepted state, for the stage that follows.
    pub fn into_ledger(self) -> Ledger {
        self.ledger
    }

    /// The model.
    pub const fn model(&self) -> &'m Model {
        self.model
    }

    /// Conditions of the stage.
    pub const fn conditions(&self) -> &Conditions {
        &self.conditions
    }

    /// Equation numbers and constraints.
    pub const fn assembler(&self) -> &Assembler {
        &self.assembler
    }

    /// Accepted displacement of all DOFs (mm).
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// Accepted load factor.
    pub const fn lambda(&self) -> f64 {
        self.lambda
    }

    /// Last accepted increment of displacement (all DOFs) and load factor; none before the first step and after a
    /// snap.
    pub fn previous(&self) -> Option<(&[f64], f64)> {
        self.previous.as_ref().map(|(du, dl)| (du.as_slice(), *dl))
    }

    /// [`Self::load`] of the accepted state; 0 before the first step.
    pub const fn accepted_load(&self) -> f64 {
        self.accepted_load
    }

    /// Signs of the tangent at the accepted state where they were counted last; those of a stable one before the first
    /// step.
    pub const fn signs(&self) -> Signs {
        self.signs
    }

    /// Steps accepted since the signs were counted.
    pub const fn uncounted(&self) -> usize {
        self.uncounted
    }

    /// Accepted states.
    pub const fn state(&self) -> &StateStore {
        self.state
    }

    /// Work counters.
    pub const fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Work counters, for drivers.
    pub const fn counters_mut(&mut self) -> &mut Counters {
        &mut self.counters
    }

    /// Wall time by phase.
    pub const fn times(&self) -> &PhaseTimes {
        &self.times
    }

    /// Displacement of all DOFs whose free part is `free` (mm) and whose constrained part belongs to
    /// the load factor `lambda`.
    pub fn compose(&self, free: &[f64], lambda: f64) -> Vec<f64> {
        let mut u: Vec<f64> = self
            .start
            .iter()
            .zip(self.assembler.rate())
            .map(|(s, r)| s + lambda * r)
            .collect();
        for (&d, v) in self.assembler.free().iter().zip(free) {
            u[d as usize] = *v;
        }
        u
    }

    /// Free part of a vector of all DOFs.
    ///
    /// # Panics
    ///
    /// For a vector that is shorter than that.
    pub fn restrict(&self, full: &[f64]) -> Vec<f64> {
        self.assembler
            .free()
            .iter()
            .map(|&d| full[d as usize])
            .collect()
    }

    /// Evaluates the internal force at `u` and returns the residual f_ext - f_int of the free
    /// equations. The trial state is that of `u`.
    ///
    /// # Errors
    ///
    /// [`SolverError::Mismatch`] for a `u` of another model, [`SolverError::NoNumber`] for a load factor that is none,
    /// [`SolverError::Model`].
    pub fn residual(
        &mut self,
        u: &[f64],
        lambda: f64,
        ctx: &EvaluationContext,
    ) -> Result<Vec<f64>, SolverError> {
        SolverError::length("displacement", u.len(), self.start.len())?;
        SolverError::number("load factor", lambda)?;
        let begin = Instant::now();
        self.counters.force_evaluations += 1;
        // An evaluation that fails has been made nowhere.
        let mut kept = self.evaluated.take().map_or_else(Vec::new, |at| at.0);
        let evaluated =
            self.assembler
                .evaluate(self.model, u, self.state, ctx, &mut self.assembled);
        if evaluated.is_err() && ctx.operator != Operator::None {
            // What has been added up so far is no stiffness.
            self.assembled.matrix.lower.clear();
        }
        evaluated?;
        if ctx.operator == Operator::None {
            self.times.forces += begin.elapsed();
        } else {
            self.times.assembly += begin.elapsed();
        }
        self.conditions.external(lambda, &mut self.external);
        kept.clear();
        kept.extend_from_slice(u);
        self.evaluated = Some((kept, lambda, ctx.relaxation));
        Ok(self.unbalanced().collect())
    }

    /// Makes the last evaluation one at `u` and `lambda` with the given relaxation of histories, unless it is that.
    ///
    /// # Errors
    ///
    /// [`SolverError::Model`].
    pub(crate) fn settle(
        &mut self,
        u: &[f64],
        lambda: f64,
        relaxation: f64,
    ) -> Result<(), SolverError> {
        let here = self.evaluated.as_ref();
        if here.is_some_and(|(v, l, r)| v == u && *l == lambda && *r == relaxation) {
            return Ok(());
        }
        let force = EvaluationContext {
            relaxation,
            ..EvaluationContext::new(Operator::None)
        };
        self.residual(u, lambda, &force).map(drop)
    }

    /// f_ext - f_int of the free equations in the last evaluation.
    fn unbalanced(&self) -> impl Iterator<Item = f64> {
        let (f, q) = (&self.external, &self.assembled.internal);
        let free = self.assembler.free().iter();
        free.map(|&d| f[d as usize] - q[d as usize])
    }

    /// Load per unit of the load factor on the free equations: f_ref - K_fc p, of the last operator.
    pub fn reference_load(&self) -> Vec<f64> {
        let f = self.conditions.reference();
        let free = self.assembler.free().iter();
        free.zip(&self.assembled.coupling)
            .map(|(&d, c)| f[d as usize] - c)
            .collect()
    }

    /// Internal force (N) of the last evaluation, all DOFs.
    pub(crate) fn internal(&self) -> &[f64] {
        &self.assembled.internal
    }

    /// Makes `internal` (N, all DOFs) the forces from which loads and reactions are read until the next evaluation.
    ///
    /// # Errors
    ///
    /// [`SolverError::Mismatch`] for forces of another model.
    pub(crate) fn read_off(&mut self, internal: &[f64]) -> Result<(), SolverError> {
        SolverError::length("mean internal force", internal.len(), self.start.len())?;
        self.assembled.internal.copy_from_slice(internal);
        self.evaluated = None;
        Ok(())
    }

    /// Evaluates the virgin model at rest with its secant operator and returns sum_j |K_ij| of the free equations (N/mm).
    /// Histories and displacement of the stage stay.
    pub(crate) fn virgin_row_sums(&mut self) -> Result<Vec<f64>, SolverError> {
        let mut virgin = StateStore::new(self.model.elements());
        let rest = vec![0.0; self.start.len()];
        let operator = EvaluationContext::new(Operator::Secant);
        self.counters.force_evaluations += 1;
        self.evaluated = None;
        let evaluated = self.assembler.evaluate(
            self.model,
            &rest,
            &mut virgin,
            &operator,
            &mut self.assembled,
        );
        if evaluated.is_err() {
            self.assembled.matrix.lower.clear();
        }
        evaluated?;
        Ok(self.absolute_row_sums())
    }

    /// sum_j |K_ij| of the free equations (N/mm) of the last operator, which must be symmetric.
    pub(crate) fn absolute_row_sums(&self) -> Vec<f64> {
        let pattern = self.assembler.pattern();
        let mut sums = vec![0.0; pattern.len()];
        for j in 0..pattern.len() {
            for k in pattern.column(j) {
                let (i, value) = (pattern.row_idx()[k], self.assembled.matrix.lower[k].abs());
                sums[i] += value;
                if i != j {
                    sums[j] += value;
                }
            }
        }
        sums
    }

    /// Lets laws latch new cracks found by the last evaluation.
    pub fn latch(&mut self) {
        if self.state.latch(self.model.elements()) {
            self.evaluated = None;
        }
    }

    /// Makes the trial state the history of the next evaluations without accepting it.
    pub fn advance(&mut self) {
        self.state.advance();
        self.evaluated = None;
    }

    /// Makes the accepted state with `changes` the history of the next evaluations. Returns whether they fit.
    pub(crate) fn set_base(&mut self, changes: &[(u32, f64)]) -> bool {
        self.evaluated = None;
        self.state.set_base(changes)
    }

    /// Forgets the trial state.
    pub fn roll_back(&mut self) {
        self.state.roll_back();
        self.evaluated = None;
    }

    /// Accepts displacement, load factor and the trial state of the last evaluation, which has been
    /// [weighed](Self::weigh). The increment of a `held` step, which passed a snap, says nothing about the next one and is
    /// forgotten. `signs` are those of the tangent there, if they were counted.
    ///
    /// # Errors
    ///
    /// [`SolverError::Mismatch`] for a `u` of another model.
    pub fn commit(
        &mut self,
        u: Vec<f64>,
        lambda: f64,
        held: bool,
        signs: Option<Signs>,
    ) -> Result<(), SolverError> {
        SolverError::length("displacement", u.len(), self.start.len())?;
        (self.signs, self.uncounted) = match signs {
            Some(signs) => (signs, 0),
            None => (self.signs, self.uncounted + 1),
        };
        let du = u
            .iter()
            .zip(&self.displacement)
            .map(|(a, b)| a - b)
            .collect();
        self.previous = (!held).then_some((du, lambda - self.lambda));
        self.displacement = u;
        self.lambda = lambda;
        self.accepted_load = self.load();
        self.largest_reactions = self.largest_reactions.max(self.reactions());
        self.state.commit();
        self.evaluated = None;
        self.ledger.settle();
        self.counters.steps += 1;
        Ok(())
    }

    /// Name of a DOF for messages.
    pub fn describe(&self, dof: usize) -> String {
        if dof >= self.model.dofs().len() {
            return format!("DOF {dof}, which the model does not have");
        }
        let (node, kind) = self.model.dofs().owner(dof);
        let x = self.model.mesh().nodes()[node];
        format!(
            "{kind} of node {node} at ({:.1}, {:.1}, {:.1}) mm",
            x[0], x[1], x[2]
        )
    }
}
