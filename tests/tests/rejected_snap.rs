//! Protects that states which were passed and rejected leave no damage behind: a step that is accepted although it did not
//! converge holds the history of the iterate that is accepted, no other.

use std::io;
use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::Solid;
use fe_core::material::{Material, MaterialError, PointContext, Response, StateVar};
use fe_core::mesh::Mesh;
use fe_core::model::{Conditions, Model};
use fe_core::shape::hex20;
use fe_core::state::StateStore;
use fe_core::voigt::isotropic;
use fe_elements::loads::face_pressure;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_solver::control::{OnFailure, StepControl};
use fe_solver::descent::DescentSettings;
use fe_solver::recorder::{Continue, Recorder, Silent, StepView};
use fe_solver::secant::{SecantAnderson, SecantSettings};
use fe_solver::stage::Stage;
use nalgebra::{Matrix6, Vector6};

const VARS: [StateVar; 1] = [StateVar::scalar("kappa", "-")];

/// Stiffness times exp(-kappa/1e-4), kappa being the largest norm of the strain.
#[derive(Debug)]
struct Softening(Matrix6<f64>);

impl Material<Solid> for Softening {
    fn name(&self) -> &'static str {
        "softening"
    }

    fn state_vars(&self) -> &[StateVar] {
        &VARS
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        committed: &[f64],
        trial: &mut [f64],
        _: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        trial[0] = committed[0].max(strain.norm());
        let left = (-trial[0] / 1e-4).exp();
        Ok(Response {
            stress: self.0 * strain * left,
            tangent: self.0 * left.max(1e-4),
        })
    }
}

/// Largest strain and largest kappa of the flagged steps.
#[derive(Default)]
struct Flagged([f64; 2], usize);

impl Recorder for Flagged {
    fn step(&mut self, view: &StepView<'_>) -> io::Result<Continue> {
        if view.flagged {
            self.1 += 1;
            let (u, state) = (view.stage.displacement(), view.stage.state());
            let sampled = view.stage.model().sample(0, u, state, &mut |s| {
                let strain = s.strain.iter().map(|x| x * x).sum::<f64>().sqrt();
                self.0 = [self.0[0].max(strain), self.0[1].max(s.state[0])];
            });
            sampled.map_err(io::Error::other)?;
        }
        Ok(Continue::Yes)
    }
}

/// A cube held on one face and pulled on the other by forces.
fn pulled() -> (Model, Conditions) {
    let law = Arc::new(Softening(isotropic(3e4, 0.0)));
    let nodes = std::array::from_fn(|a| a);
    let cube = Hex20::new(
        nodes,
        &hex20::NODES,
        HexRule::Full,
        law,
        BandWidth::CubeRoot,
    )
    .unwrap();
    let mesh = Mesh::new(hex20::NODES.to_vec()).unwrap();
    let model = Model::new(mesh, vec![Box::new(cube)]).unwrap();
    let mut conditions = Conditions::new(&model);
    for node in hex20::FACES[0] {
        for dof in Dof::DISPLACEMENTS {
            conditions.fix(&model, node, dof).unwrap();
        }
    }
    let face = hex20::FACES[1];
    for (node, force) in face_pressure(&face, &face.map(|a| hex20::NODES[a]), -1.0) {
        conditions
            .add_reference(&model, node, Dof::Ux, force[0])
            .unwrap();
    }
    (model, conditions)
}

/// Target: under forces beyond what the cube can carry steps are flagged, and kappa is the strain that is accepted, although
/// descents that found no rest went far beyond it.
#[test]
fn a_rejected_snap_leaves_no_damage() {
    let (model, conditions) = pulled();
    let mut state = StateStore::new(model.elements());
    let start = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, start).unwrap();
    let control = StepControl {
        shortest: 0.1,
        on_failure: OnFailure::Flag,
        ..StepControl::new(0.1, 1.5)
    };
    let mut flagged = Flagged::default();
    // A path that ends at its last flagged step is as good here as one that goes on.
    let _ = control.run(&mut stage, &mut SecantAnderson::default(), &mut flagged);
    let Flagged([strain, kappa], steps) = flagged;
    assert!(steps > 0);
    assert!(
        kappa < 1.5 * strain,
        "kappa {kappa} at a strain of {strain}"
    );
}

/// Target: settings with which no descent is possible are refused.
#[test]
fn descents_that_cannot_be_are_refused() {
    let good = DescentSettings::default();
    for descent in [
        DescentSettings {
            largest_factor: 0.5,
            ..good
        },
        DescentSettings {
            largest_factor: f64::NAN,
            ..good
        },
        DescentSettings {
            least_factor: f64::NAN,
            ..good
        },
        DescentSettings {
            overshoot: -1.0,
            ..good
        },
        DescentSettings {
            max_iterations: 0,
            ..good
        },
        DescentSettings {
            patience: 0,
            ..good
        },
    ] {
        let (model, conditions) = pulled();
        let mut state = StateStore::new(model.elements());
        let start = vec![0.0; model.dofs().len()];
        let mut stage = Stage::new(&model, conditions, &mut state, start).unwrap();
        let mut driver = SecantAnderson::new(SecantSettings {
            descent,
            ..SecantSettings::default()
        });
        let control = StepControl::new(0.1, 0.2);
        let refused = control
            .run(&mut stage, &mut driver, &mut Silent)
            .unwrap_err();
        assert!(refused.to_string().contains("descent"), "{refused}");
    }
}
