//! Protects the step control from settings with which it would never end.

use super::*;
use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::grid::GridBuilder;
use fe_core::model::{Conditions, Model};
use fe_core::shape::hex20;
use fe_core::state::StateStore;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::Elastic;

use crate::driver::IterationLog;
use crate::recorder::Silent;
use crate::stage::Residual;

/// Never arrives, but moves all by this (mm) in the end; counts how often it is asked.
#[derive(Debug)]
struct Never(usize, f64);

impl Driver for Never {
    fn name(&self) -> &'static str {
        "never"
    }

    fn attempt(
        &mut self,
        stage: &mut Stage<'_>,
        request: Request,
        _: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        self.0 += 1;
        assert!(self.0 < 100, "asked again for {}", request.length);
        Ok(Attempt {
            displacement: stage.displacement().iter().map(|u| u + self.1).collect(),
            lambda: stage.lambda() + request.length,
            converged: false,
            residual: Residual {
                relative: 1.0,
                largest: 1.0,
                worst: 0,
            },
            iterations: 1,
            held: false,
            means: None,
            lag: None,
        })
    }
}

/// Whatever share a failed step is cut to, 0.7 being no power of the halves of the shortest, the attempts have an end.
#[test]
fn steps_that_never_converge_end() {
    let model = cube();
    for cut in [0.5, 0.7, 0.99] {
        let control = StepControl {
            cut,
            shortest: 0.5,
            ..StepControl::new(1.0, 1.0)
        };
        let end = end(&model, &control, Never(0, 0.0));
        assert!(
            matches!(end, Err(SolverError::NoConvergence { step, .. }) if step < 1.0),
            "{end:?}"
        );
    }
}

/// A step that misses the criterion is flagged, but not one that moves by more than the size of the model, 2 mm.
#[test]
fn what_has_come_off_the_model_is_no_step() {
    let model = cube();
    let control = StepControl {
        on_failure: OnFailure::Flag,
        shortest: 0.5,
        ..StepControl::new(0.5, 0.5)
    };
    for (way, refused) in [(1.9, false), (2.1, true)] {
        let end = end(&model, &control, Never(0, way));
        assert_eq!(end.is_err(), refused, "{end:?}");
    }
}

/// An elastic cube of 2 mm.
fn cube() -> Model {
    let mut grid = GridBuilder::new();
    grid.add_box("cube", &[0.0, 2.0], &[0.0, 2.0], &[0.0, 2.0]);
    let mesh = grid.finish().unwrap();
    let law = Arc::new(Elastic::new(30e3, 0.2).unwrap());
    let nodes = std::array::from_fn(|a| a);
    let (rule, band) = (HexRule::Full, BandWidth::CubeRoot);
    let cube = Hex20::new(nodes, &hex20::NODES, rule, law, band).unwrap();
    Model::new(mesh, vec![Box::new(cube)]).unwrap()
}

/// How a run with a driver that never arrives ends, on a model held at its first eight nodes.
fn end(model: &Model, control: &StepControl, mut driver: Never) -> Result<String, SolverError> {
    let mut state = StateStore::new(model.elements());
    let start = vec![0.0; model.dofs().len()];
    let mut conditions = Conditions::new(model);
    for node in 0..8 {
        for dof in [Dof::Ux, Dof::Uy, Dof::Uz] {
            conditions.fix(model, node, dof).unwrap();
        }
    }
    let mut stage = Stage::new(model, conditions, &mut state, start).unwrap();
    control.run(&mut stage, &mut driver, &mut Silent)
}

#[test]
fn lengths_that_lead_nowhere_are_refused_by_name() {
    let good = StepControl::new(0.1, 1.0);
    assert!(good.check().is_ok());
    for (what, bad) in [
        (
            "longest step over the load factor",
            StepControl {
                longest_share: f64::NAN,
                ..good
            },
        ),
        (
            "first step",
            StepControl {
                initial: 0.0,
                ..good
            },
        ),
        (
            "longest step",
            StepControl {
                longest: 0.0,
                ..good
            },
        ),
        (
            "longest step",
            StepControl {
                longest: f64::NAN,
                ..good
            },
        ),
        (
            "shortest step",
            StepControl {
                shortest: -1.0,
                ..good
            },
        ),
        ("cut of a failed step", StepControl { cut: 1.0, ..good }),
        (
            "growth of a step",
            StepControl {
                growth: f64::NAN,
                ..good
            },
        ),
        (
            "shrinkage of a step",
            StepControl {
                shrinkage: 0.0,
                ..good
            },
        ),
        (
            "shortest step over the end",
            StepControl {
                initial: 1e-18,
                shortest: 1e-18,
                ..good
            },
        ),
        (
            "end",
            StepControl {
                end: f64::INFINITY,
                ..good
            },
        ),
    ] {
        let message = bad.check().unwrap_err().to_string();
        assert!(message.contains(what), "{message}");
    }
}
