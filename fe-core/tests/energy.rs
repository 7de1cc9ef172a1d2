//! Protects the recoverable energy of laws that do not state it.

use fe_core::kinematics::Axial;
use fe_core::material::{Material, MaterialError, PointContext, PointReport, Response, StateVar};
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
