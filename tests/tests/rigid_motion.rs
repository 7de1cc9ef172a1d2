//! Protects bodies that are moved without strain: rounding is no residual and no energy.

use fe_core::dof::Dof;
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_elements::HexRule;
use fe_materials::Elastic;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::recorder::Silent;
use fe_solver::secant::SecantAnderson;
use fe_solver::stage::Stage;
use fe_tests::mesh::{boxes, hexahedra, nodes_where};
use std::sync::Arc;

/// A block of two hexahedra whose ends, or all of whose nodes, go 1 mm along: every displacement is 1 mm.
#[test]
fn a_block_is_moved_as_a_whole() {
    let lines = [0.0, 100.0, 230.0];
    for all in [false, true] {
        let drivers: [Box<dyn Driver>; 2] = [
            Box::new(NewtonRaphson::new(NewtonSettings::default())),
            Box::new(SecantAnderson::default()),
        ];
        for mut driver in drivers {
            let mesh = boxes(&lines, &[0.0, 70.0], &[0.0, 90.0]).unwrap();
            let moved = nodes_where(&mesh, |x| all || x[0] == 0.0 || x[0] == 230.0);
            let law: Arc<dyn Material<_>> = Arc::new(Elastic::new(30e3, 0.2).unwrap());
            let elements = hexahedra(&mesh, HexRule::Full, &law).unwrap();
            let model = Model::new(mesh, elements).unwrap();
            let mut conditions = Conditions::new(&model);
            for node in moved {
                for (dof, rate) in [(Dof::Ux, 1.0), (Dof::Uy, 0.0), (Dof::Uz, 0.0)] {
                    conditions.prescribe(&model, node, dof, rate).unwrap();
                }
            }
            let mut state = StateStore::new(model.elements());
            let start = vec![0.0; model.dofs().len()];
            let mut stage = Stage::new(&model, conditions, &mut state, start).unwrap();
            let control = StepControl::new(0.3, 1.0);
            let end = control.run(&mut stage, driver.as_mut(), &mut Silent);
            assert!(end.is_ok(), "{} {all}: {end:?}", driver.name());
            for (d, u) in stage.displacement().iter().enumerate() {
                let along = f64::from(model.dofs().owner(d).1 == Dof::Ux);
                assert!((u - along).abs() < 1e-9, "{} {all}: {u}", driver.name());
            }
        }
    }
}
