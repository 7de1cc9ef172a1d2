//! One-call solutions.

use fe_core::dof::Dof;
use fe_core::mesh::NodeId;
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::recorder::{Continue, IterationRecord, Recorder, StepView};
use fe_solver::stage::Stage;

/// Equilibrium reached at the end of a stage.
#[derive(Debug)]
pub struct Solution {
    /// Displacement of all DOFs (mm).
    pub displacement: Vec<f64>,
    /// Internal minus external force (N) on all DOFs: the reactions where a DOF is held, else the
    /// residual.
    pub reactions: Vec<f64>,
    /// History of every element.
    pub state: StateStore,
}

impl Solution {
    /// Displacement (mm) of a DOF.
    ///
    /// # Panics
    ///
    /// When no element uses the DOF.
    pub fn at(&self, model: &Model, node: NodeId, dof: Dof) -> f64 {
        self.displacement[index(model, node, dof)]
    }

    /// Sum of the reactions (N) of a DOF over nodes.
    ///
    /// # Panics
    ///
    /// When no element uses the DOF.
    pub fn reaction(&self, model: &Model, nodes: &[NodeId], dof: Dof) -> f64 {
        nodes
            .iter()
            .map(|&n| self.reactions[index(model, n, dof)])
            .sum()
    }
}

fn index(model: &Model, node: NodeId, dof: Dof) -> usize {
    model.dofs().index(node, dof).expect("a DOF of the model")
}

/// Watches iterations and accepted steps.
struct Watch<I, S> {
    iteration: I,
    step: S,
}

impl<I: FnMut(&IterationRecord), S: FnMut(&StepView<'_>)> Recorder for Watch<I, S> {
    fn iteration(&mut self, record: &IterationRecord) -> std::io::Result<()> {
        (self.iteration)(record);
        Ok(())
    }

    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue> {
        (self.step)(view);
        Ok(Continue::Yes)
    }
}

/// Runs a stage from the virgin state, showing every iteration and every accepted step.
///
/// # Errors
///
/// [`SolverError`].
pub fn run(
    model: &Model,
    conditions: Conditions,
    control: &StepControl,
    driver: &mut dyn Driver,
    iteration: impl FnMut(&IterationRecord),
    step: impl FnMut(&StepView<'_>),
) -> Result<Solution, SolverError> {
    let mut state = StateStore::new(model.elements());
    let virgin = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(model, conditions, &mut state, virgin)?;
    control.run(&mut stage, driver, &mut Watch { iteration, step })?;
    let displacement = stage.displacement().to_vec();
    let reactions = (0..displacement.len()).map(|d| stage.reaction(d)).collect();
    Ok(Solution {
        displacement,
        reactions,
        state,
    })
}

/// Full load in one step of Newton-Raphson to a relative residual of 1e-9: the solution of a linear model.
///
/// # Errors
///
/// [`SolverError`].
pub fn solve(model: &Model, conditions: Conditions) -> Result<Solution, SolverError> {
    solve_to(1e-9, model, conditions)
}

/// The same to another relative residual: rounding leaves more of it in thin shells.
///
/// # Errors
///
/// [`SolverError`].
pub fn solve_to(
    criterion: f64,
    model: &Model,
    conditions: Conditions,
) -> Result<Solution, SolverError> {
    let control = StepControl {
        criterion,
        ..StepControl::new(1.0, 1.0)
    };
    let mut driver = NewtonRaphson::new(NewtonSettings::default());
    run(model, conditions, &control, &mut driver, |_| {}, |_| {})
}
