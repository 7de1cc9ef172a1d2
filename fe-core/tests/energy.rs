//! Protects the recoverable energy of laws that do not state it, and what the books say of laws that fail.

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::energy::{ElementAt, Ledger};
use fe_core::kinematics::Axial;
use fe_core::limits::finite;
use fe_core::material::{Material, MaterialError, PointContext, PointReport, Response, StateVar};
use fe_core::mesh::{Mesh, NodeId};
use fe_core::model::{Conditions, Model, ModelError};
use fe_core::points::free_energy;
use nalgebra::{Matrix1, Vector1};

const YOUNG: f64 = 2e5;

/// Unloads along its elastic line from a plastic strain, its only history.
#[derive(Debug)]
struct Plastic;

impl Material<Axial> for Plastic {
    fn name(&self) -> &'static str {
        "plastic"
    }

    fn state_vars(&self) -> &[StateVar] {
        const VARS: [StateVar; 1] = [StateVar::scalar("plastic_strain", "-")];
        &VARS
    }

    fn update(
        &self,
        strain: &Vector1<f64>,
        committed: &[f64],
        trial: &mut [f64],
        _: &PointContext,
    ) -> Result<Response<Axial>, MaterialError> {
        finite("plastic", strain)?;
        trial.copy_from_slice(committed);
        Ok(Response {
            stress: Vector1::new(YOUNG * (strain[0] - committed[0])),
            tangent: Matrix1::new(YOUNG),
        })
    }

    fn report(&self, _: &Vector1<f64>, state: &[f64]) -> PointReport {
        let mut report = PointReport::default();
        report.plastic_strain[0] = state[0];
        report
    }
}

/// What a law of fewer components than a solid says of its plastic strain counts: 1/2 E (e - p)^2 is left, in tension and
/// beyond zero.
#[test]
fn plastic_strain_of_a_bar_is_not_recovered() {
    for (strain, plastic) in [(3e-3, 2e-3), (1e-3, 2e-3), (2e-3, 0.0)] {
        let points = [(7.0, Vector1::new(strain))].into_iter();
        let energy = free_energy(&Plastic, 1.0, &[plastic], points).unwrap();
        let left = 7.0 * 0.5 * YOUNG * (strain - plastic) * (strain - plastic);
        assert!(
            (energy - left).abs() < 1e-12 * 7.0 * YOUNG,
            "{energy} {left}"
        );
    }
}

/// A law that fails is no law without an energy: the point is named.
#[test]
fn a_law_that_fails_is_told_with_its_point() {
    let points = [0.0, 1e-3, f64::NAN].map(|e| (7.0, Vector1::new(e)));
    let error = free_energy(&Plastic, 1.0, &[0.0; 3], points.into_iter()).unwrap_err();
    assert!(
        matches!(error, ElementError::Material { point: 2, .. }),
        "{error}"
    );
}

/// What an element stores, of its displacements and its state.
type Stored = fn(&[f64], &[f64]) -> Result<Option<f64>, ElementError>;

/// An element of one node that stores what it is given.
#[derive(Debug)]
struct Storing(Stored);

impl Element for Storing {
    fn nodes(&self) -> &[NodeId] {
        &[0]
    }

    fn dofs(&self) -> &'static [Dof] {
        &[Dof::Ux]
    }

    fn state_len(&self) -> usize {
        1
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
        out.force.copy_from_slice(u);
        Ok(())
    }

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Result<Option<f64>, ElementError> {
        self.0(u, state)
    }
}

/// An energy that is no number is refused with its element: no sum of it could be held against anything.
#[test]
fn an_energy_that_is_no_number_is_told_with_its_element() {
    let mesh = Mesh::new(vec![[0.0; 3]]).unwrap();
    let model = Model::new(mesh, vec![Box::new(Storing(|_, _| Ok(Some(f64::NAN))))]).unwrap();
    let (conditions, mut ledger) = (Conditions::new(&model), Ledger::default());
    let weighed = ledger.weigh(&model, &conditions, (0.0, &[1.0]), |_| ElementAt {
        dofs: &[0],
        state: &[0.0],
        force: Some(&[0.0]),
    });
    let error = weighed.unwrap_err();
    assert!(error.is_recoverable(), "{error}");
    let told = error.to_string();
    assert!(
        told.contains("element 0") && told.contains("stores NaN N mm"),
        "{told}"
    );
}

/// The books tell which element failed instead of taking half the product of its forces and displacements, and refuse
/// displacements and conditions of another model.
#[test]
fn the_ledger_tells_what_it_cannot_weigh() {
    let mesh = Mesh::new(vec![[0.0; 3]]).unwrap();
    let failing = Storing(|u, state| {
        let points = [(1.0, Vector1::new(u[0]))].into_iter();
        free_energy(&Plastic, 1.0, state, points).map(Some)
    });
    let model = Model::new(mesh.clone(), vec![Box::new(failing)]).unwrap();
    let conditions = Conditions::new(&model);
    let mut ledger = Ledger::default();
    let mut weigh = |conditions: &Conditions, u: &[f64]| {
        ledger.weigh(&model, conditions, (0.0, u), |_| ElementAt {
            dofs: &[0],
            state: &[0.0],
            force: Some(&[0.0]),
        })
    };
    assert!(weigh(&conditions, &[1e-3]).is_ok());
    assert!(matches!(
        weigh(&conditions, &[f64::NAN]),
        Err(ModelError::Element { element: 0, .. })
    ));
    assert!(matches!(
        weigh(&conditions, &[]),
        Err(ModelError::Foreign { .. })
    ));
    let nothing = Model::new(mesh, Vec::new()).unwrap();
    assert!(matches!(
        weigh(&Conditions::new(&nothing), &[0.0]),
        Err(ModelError::ForeignConditions { .. })
    ));
}
