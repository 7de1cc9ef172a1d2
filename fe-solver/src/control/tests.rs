//! Protects the step control from settings with which it would never end.

use super::*;
use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::grid::GridBuilder;
use fe_core::kinematics::Solid;
use fe_core::material::{Material, MaterialError, PointContext, Response, StateVar};
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::Elastic;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use nalgebra::Vector6;

use crate::driver::IterationLog;
use crate::newton::{NewtonRaphson, NewtonSettings};
use crate::recorder::{Continue, Silent, StepView};
use crate::secant::SecantAnderson;
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

/// Says that it has converged, after its answer has been spoilt.
#[derive(Debug)]
struct Spoilt(Never, fn(&mut Attempt));

impl Driver for Spoilt {
    fn name(&self) -> &'static str {
        "spoilt"
    }

    fn attempt(
        &mut self,
        stage: &mut Stage<'_>,
        request: Request,
        log: &mut IterationLog<'_>,
    ) -> Result<Attempt, SolverError> {
        let mut attempt = self.0.attempt(stage, request, log)?;
        attempt.converged = true;
        (self.1)(&mut attempt);
        Ok(attempt)
    }
}

/// What a driver gives back is looked at: no number is accepted as a step, and a worst DOF that is not there is told as such.
#[test]
fn answers_of_a_driver_that_are_none_are_refused() {
    let model = cube();
    let control = StepControl {
        on_failure: OnFailure::Flag,
        shortest: 0.5,
        ..StepControl::new(0.5, 0.5)
    };
    let numberless: [fn(&mut Attempt); 4] = [
        |a| a.lambda = f64::NAN,
        |a| a.displacement[3] = f64::NAN,
        |a| a.residual.relative = f64::NAN,
        |a| a.residual.relative = f64::INFINITY,
    ];
    for spoil in numberless {
        let end = end(&model, &control, Spoilt(Never(0, 0.0), spoil));
        assert!(matches!(end, Err(SolverError::NoNumber { .. })), "{end:?}");
    }
    let foreign = end(
        &model,
        &control,
        Spoilt(Never(0, 0.0), |a| a.displacement.truncate(3)),
    );
    assert!(
        matches!(foreign, Err(SolverError::Mismatch { .. })),
        "{foreign:?}"
    );
    let unconverged: [fn(&mut Attempt); 2] = [
        |a| (a.converged, a.lambda) = (false, f64::NAN),
        |a| (a.converged, a.displacement[3]) = (false, f64::NAN),
    ];
    for spoil in unconverged {
        let end = end(&model, &control, Spoilt(Never(0, 0.0), spoil));
        assert!(
            matches!(end, Err(SolverError::NoConvergence { .. })),
            "{end:?}"
        );
    }
    let nowhere: fn(&mut Attempt) = |a| {
        a.converged = false;
        a.residual.worst = 9999;
    };
    let stop = StepControl {
        on_failure: OnFailure::Stop,
        ..control
    };
    let end = end(&model, &stop, Spoilt(Never(0, 0.0), nowhere));
    let told = end.unwrap_err().to_string();
    assert!(
        told.contains("DOF 9999, which the model does not have"),
        "{told}"
    );
}

/// Fails to keep the given step; counts them. A journal to go on from may be given.
#[derive(Debug, Default)]
struct Keeper {
    fails_at: usize,
    kept: Vec<Entry>,
    earlier: Vec<Entry>,
    loads: Vec<f64>,
}

impl Recorder for Keeper {
    fn recall(&mut self) -> std::io::Result<Option<Entry>> {
        Ok(if self.earlier.is_empty() {
            None
        } else {
            Some(self.earlier.remove(0))
        })
    }

    fn keep(&mut self, entry: &Entry) -> std::io::Result<()> {
        self.kept.push(entry.clone());
        if self.kept.len() == self.fails_at {
            return Err(std::io::Error::other("the disk is full"));
        }
        Ok(())
    }

    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue> {
        self.loads.push(view.load);
        Ok(Continue::Yes)
    }
}

/// A step that could not be kept, or that a journal contradicts, has not happened: the stage goes on as one that never tried it.
#[test]
fn a_step_that_is_not_kept_is_taken_back() {
    let model = cracking_cube();
    let control = StepControl {
        criterion: 1e-8,
        ..StepControl::new(1e-4, 4e-4)
    };
    let mut whole = Keeper::default();
    run_twice(&model, &control, &mut whole, None);
    let full = Keeper {
        fails_at: 2,
        ..Keeper::default()
    };
    let mut contradicted = whole.kept[..2].to_vec();
    contradicted[1].check = Some([1.0, 1.0]);
    let spoilt = Keeper {
        earlier: contradicted,
        ..Keeper::default()
    };
    for mut keeper in [full, spoilt] {
        let rest = StepControl {
            end: 3e-4,
            ..control
        };
        run_twice(&model, &control, &mut keeper, Some(&rest));
        for (again, load) in keeper.loads.iter().zip(&whole.loads) {
            // At the onset of a crack a step started otherwise may end otherwise, by little.
            assert!((again / load - 1.0).abs() < 1e-3, "{again} {load}");
        }
        assert_eq!(keeper.loads.len(), whole.loads.len());
    }
}

/// Runs once, and if that is to fail after one step, a second time.
fn run_twice(
    model: &Model,
    control: &StepControl,
    keeper: &mut Keeper,
    again: Option<&StepControl>,
) {
    let mut state = StateStore::new(model.elements());
    let start = vec![0.0; model.dofs().len()];
    let mut conditions = Conditions::new(model);
    for node in 0..20 {
        let [x, ..] = model.mesh().nodes()[node];
        if x == 0.0 {
            for dof in Dof::DISPLACEMENTS {
                conditions.fix(model, node, dof).unwrap();
            }
        } else if x == 2.0 {
            conditions.prescribe(model, node, Dof::Ux, 1.0).unwrap();
        }
    }
    let mut stage = Stage::new(model, conditions, &mut state, start).unwrap();
    let mut driver = SecantAnderson::default();
    let end = control.run(&mut stage, &mut driver, keeper);
    let Some(again) = again else {
        end.unwrap();
        return;
    };
    assert!(end.is_err() && keeper.loads.len() == 1, "{end:?}");
    assert!(stage.state().base_changes().is_empty());
    assert!(!stage.holds_stable_tangent());
    again.run(&mut stage, &mut driver, keeper).unwrap();
}

/// A law whose free energy is no number.
#[derive(Debug)]
struct Numberless(Elastic);

impl Material<Solid> for Numberless {
    fn name(&self) -> &'static str {
        "numberless"
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        self.0.update(strain, committed, trial, ctx)
    }

    fn free_energy(&self, _: &Vector6<f64>, _: &[f64], _: &PointContext) -> Option<f64> {
        Some(f64::NAN)
    }
}

/// An energy that is no number cannot be held against the work: the element is named.
#[test]
fn a_step_whose_energy_is_no_number_is_refused() {
    let model = cube_of(Arc::new(Numberless(Elastic::new(30e3, 0.2).unwrap())));
    let newton = NewtonRaphson::new(NewtonSettings::default());
    let end = end(&model, &StepControl::new(0.5, 1.0), newton);
    let told = end.unwrap_err().to_string();
    assert!(
        told.contains("element 0") && told.contains("NaN N mm"),
        "{told}"
    );
}

/// A cube of 2 mm of concrete.
fn cracking_cube() -> Model {
    let parameters = FixedCrackParameters::from_strength(30.0, 2.5, 30e3);
    cube_of(Arc::new(FixedCrack::new(parameters, None).unwrap()))
}

/// An elastic cube of 2 mm.
fn cube() -> Model {
    cube_of(Arc::new(Elastic::new(30e3, 0.2).unwrap()))
}

/// A cube of 2 mm.
fn cube_of(law: Arc<dyn Material<Solid>>) -> Model {
    let mut grid = GridBuilder::new();
    grid.add_box("cube", &[0.0, 2.0], &[0.0, 2.0], &[0.0, 2.0]);
    let mesh = grid.finish().unwrap();
    let nodes = std::array::from_fn(|a| a);
    let (rule, band) = (HexRule::Full, BandWidth::CubeRoot);
    let coords = nodes.map(|n: usize| mesh.nodes()[n]);
    let cube = Hex20::new(nodes, &coords, rule, law, band).unwrap();
    Model::new(mesh, vec![Box::new(cube)]).unwrap()
}

/// How a run with a driver that never arrives ends, on a model held at its first eight nodes.
fn end(
    model: &Model,
    control: &StepControl,
    mut driver: impl Driver,
) -> Result<String, SolverError> {
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
