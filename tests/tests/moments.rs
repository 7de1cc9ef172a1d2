//! Protects the size of a residual where there are moments: they are no forces, and must not hide what forces are missing.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::material::Operator;
use fe_core::mesh::{Mesh, NodeId};
use fe_core::model::{Conditions, Model};
use fe_core::shape::quad8;
use fe_core::state::StateStore;
use fe_elements::{Layer, QuadRule, Shell8, ShellSection};
use fe_materials::Elastic;
use fe_solver::stage::Stage;
use fe_tests::solve::solve;

/// Target: a cantilever shell of 3 m that takes half of the displacements of the solution misses half of its load, by a
/// relative residual of 0.2 at least; the moment at its root, 3000 times the load, once made that 3e-4.
#[test]
fn a_clamped_shell_out_of_equilibrium_is_seen() {
    let coords = quad8::NODES.map(|[x, y]| [1500.0 * (1.0 + x), 50.0 * y, 0.0]);
    let law = Arc::new(Elastic::new(2e5, 0.0).unwrap());
    let layer = Layer {
        thickness_mm: 20.0,
        angle_deg: 0.0,
        law,
        shear_mpa: [1e5, 1e5],
    };
    let section = ShellSection::new(vec![layer]);
    let nodes = std::array::from_fn(|a| a);
    let shell = Shell8::new(nodes, &coords, &section, QuadRule::Reduced, [1.0, 0.0, 0.0]).unwrap();
    let mesh = Mesh::new(coords.to_vec()).unwrap();
    let model = Model::new(mesh, vec![Box::new(shell)]).unwrap();
    let mut conditions = Conditions::new(&model);
    for node in [0, 3, 7] {
        for dof in Dof::ALL {
            conditions.fix(&model, node, dof).unwrap();
        }
    }
    for node in [1, 2] {
        conditions
            .add_reference(&model, node, Dof::Uz, 500.0)
            .unwrap();
    }
    let mut state = StateStore::new(model.elements());
    let start = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, start.clone()).unwrap();
    let tangent = EvaluationContext::new(Operator::Tangent);
    stage.residual(&start, 1.0, &tangent).unwrap();
    stage.factorise().unwrap();
    let mut solution = stage.reference_load();
    stage.solve(&mut solution).unwrap();
    let mut relative = |share: f64| {
        let free: Vec<f64> = solution.iter().map(|u| share * u).collect();
        let u = stage.compose(&free, 1.0);
        let force = EvaluationContext::new(Operator::None);
        let residual = stage.residual(&u, 1.0, &force).unwrap();
        stage.measure(&residual).relative
    };
    let whole = relative(1.0);
    assert!(whole < 1e-6, "{whole}");
    let half = relative(0.5);
    assert!(half > 0.2, "{half}");
}

/// M = k theta about z at one node.
#[derive(Debug)]
struct Grounded(f64);

impl Element for Grounded {
    fn nodes(&self) -> &[NodeId] {
        &[0]
    }

    fn dofs(&self) -> &'static [Dof] {
        &[Dof::Rz]
    }

    fn state_len(&self) -> usize {
        0
    }

    fn init_state(&self, _: &mut [f64]) {}

    fn evaluate(
        &self,
        u: &[f64],
        _: &[f64],
        _: &mut [f64],
        _: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        out.force[0] += self.0 * u[0];
        if let Some(k) = out.stiffness.first_mut() {
            *k += self.0;
        }
        Ok(())
    }
}

/// A model without extent offers no lever that would make forces of its moments. Target: theta = M/k.
#[test]
fn a_spring_at_one_node_finds_its_angle() {
    let mesh = Mesh::new(vec![[5.0, 0.0, 0.0]]).unwrap();
    let model = Model::new(mesh, vec![Box::new(Grounded(4e6))]).unwrap();
    let mut conditions = Conditions::new(&model);
    conditions.add_reference(&model, 0, Dof::Rz, 1e3).unwrap();
    let solution = solve(&model, conditions).unwrap();
    assert!((solution.at(&model, 0, Dof::Rz) / 2.5e-4 - 1.0).abs() < 1e-12);
}
