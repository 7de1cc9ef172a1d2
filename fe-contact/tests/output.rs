//! Protects the picture of interfaces in VTU files.
//!
//! Source: the documentation of `fe_core::output::interface_grid`. Targets: one cell per interface element, values of a
//! uniform slip of 0.1 mm exact within rounding.

use std::sync::Arc;

use fe_contact::envelope::LuJoint;
use fe_contact::{BondSettings, Interface16, InterfaceRule, SlipDamage};
use fe_core::assembly::Assembler;
use fe_core::element::{Element, EvaluationContext};
use fe_core::material::Operator;
use fe_core::mesh::Mesh;
use fe_core::model::{Conditions, Model};
use fe_core::output::{DataArray, interface_grid};
use fe_core::shape::quad8;
use fe_core::state::StateStore;

#[test]
fn slip_and_damage_are_drawn() {
    let joint = LuJoint {
        ft_mpa: 2.2,
        width_ratio: 0.5,
    };
    let law = SlipDamage::new(joint.bilinear().unwrap(), BondSettings::default()).unwrap();
    let stress = law.envelope().stress(0.1);
    let face = quad8::NODES.map(|[x, y]| [20.0 * x, 10.0 * y, 0.0]);
    let mesh = Mesh::new(face.into_iter().chain(face).collect()).unwrap();
    let nodes = std::array::from_fn(|a| a);
    let rule = InterfaceRule::Gauss3;
    let element = Interface16::new(nodes, &face, [1.0, 0.0, 0.0], rule, Arc::new(law)).unwrap();
    let model = Model::new(mesh, vec![Box::new(element) as Box<dyn Element>]).unwrap();
    let mut u = vec![0.0; model.dofs().len()];
    for node in 8..16 {
        u[model.dof(node, fe_core::dof::Dof::Uy).unwrap()] = 0.1;
    }
    let mut state = StateStore::new(model.elements());
    let mut assembler = Assembler::new(&model, &Conditions::new(&model)).unwrap();
    let ctx = EvaluationContext::new(Operator::None);
    let mut assembled = fe_core::assembly::Assembled::default();
    assembler
        .evaluate(&model, &u, &mut state, &ctx, &mut assembled)
        .unwrap();
    state.commit();

    let grid = interface_grid(&model, &u, &state).unwrap();
    assert_eq!((grid.cells(), grid.points.len()), (1, 8));
    let values = |name: &str| -> Vec<f64> {
        let named = |a: &&DataArray| a.name == name;
        grid.cell_data.iter().find(named).unwrap().values.clone()
    };
    for (name, targets) in [
        ("jump", vec![0.0, 0.1, 0.0]),
        ("traction", vec![0.0, stress, 0.0]),
        ("slip_max", vec![0.1]),
        ("damage", vec![1.0 - stress / (0.1 * 1.5 / 0.0195)]),
        ("utilisation", vec![stress / 3.3]),
    ] {
        let found = values(name);
        assert_eq!(found.len(), targets.len(), "{name}");
        for (f, t) in found.iter().zip(targets) {
            assert!((f - t).abs() < 1e-12, "{name}: {f}, {t}");
        }
    }
}
