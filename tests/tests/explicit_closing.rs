//! A slow motion that begins on a cracked bar and closes its cracks.
//!
//! Source: the same way under secant iteration, each step in equilibrium. Target: mean load of the last step within 2 % of its end. With
//! masses from the cracked stiffness at the start the motion would be unstable as soon as the cracks close.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_elements::HexRule;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::explicit::{Explicit, ExplicitSettings};
use fe_solver::secant::SecantAnderson;
use fe_solver::stage::Stage;
use fe_tests::journal::Journal;
use fe_tests::mesh::{boxes, hexahedra, lines, nodes_where};

/// Loads (N) at the far end of a bar of 40 mm x 20 mm x 20 mm, drawn by 0.1 mm and then pushed back by 0.14 mm.
fn loads(pushing: &mut dyn Driver) -> Vec<f64> {
    let parameters = FixedCrackParameters::from_strength(30.0, 2.5, 30_000.0);
    let law: Arc<dyn Material<Solid>> = Arc::new(FixedCrack::new(parameters, None).unwrap());
    let across = lines(0.0, 20.0, 1);
    let mesh = boxes(&lines(0.0, 40.0, 2), &across, &across).unwrap();
    let elements = hexahedra(&mesh, HexRule::Full, &law).unwrap();
    let near = nodes_where(&mesh, |x| x[0] == 0.0);
    let far = nodes_where(&mesh, |x| x[0] == 40.0);
    let model = Model::new(mesh, elements).unwrap();
    let by = |way: f64| {
        let mut conditions = Conditions::new(&model);
        for &node in &near {
            for dof in Dof::DISPLACEMENTS {
                conditions.fix(&model, node, dof).unwrap();
            }
        }
        for &node in &far {
            conditions.prescribe(&model, node, Dof::Ux, way).unwrap();
        }
        conditions
    };
    let mut state = StateStore::new(model.elements());
    let mut at = vec![0.0; model.dofs().len()];
    let mut found = Vec::new();
    let mut drawing = SecantAnderson::default();
    for (way, driver) in [(0.1, &mut drawing as &mut dyn Driver), (-0.14, pushing)] {
        let mut stage = Stage::new(&model, by(way), &mut state, at).unwrap();
        found.clear();
        let mut journal = Journal::after(Vec::new(), |view| found.push(view.load));
        let control = StepControl::new(0.02, 1.0);
        control.run(&mut stage, driver, &mut journal).unwrap();
        at = stage.displacement().to_vec();
    }
    found
}

#[test]
fn a_motion_closes_cracks_that_it_began_with() {
    let statics = loads(&mut SecantAnderson::default());
    let settings = ExplicitSettings {
        periods: 40.0,
        ..ExplicitSettings::default()
    };
    let motion = loads(&mut Explicit::new(settings).unwrap());
    let [expected, found] = [&statics, &motion].map(|l| *l.last().unwrap());
    assert!(expected > 1000.0, "the bar is pushed together: {expected}");
    assert!(
        (found / expected - 1.0).abs() < 0.02,
        "{found} for {expected}"
    );
}
