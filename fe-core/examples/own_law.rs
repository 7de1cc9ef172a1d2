//! A law of one's own: uniaxial plasticity with linear hardening, checked against the contract and
//! driven as a single point.

use fe_core::kinematics::Axial;
use fe_core::material::{Material, MaterialError, PointContext, Response, StateVar};
use fe_core::point::{Control, PointDriver, Segment};
use fe_core::testing::{MaterialCheck, check_material};
use nalgebra::{Matrix1, Vector1};

const YOUNG: f64 = 200e3;
const HARDENING: f64 = 2e3;
const YIELD: f64 = 400.0;

/// sigma = E (eps - eps_p), |sigma| <= fy + H kappa.
#[derive(Debug)]
struct Steel;

const STATE: [StateVar; 2] = [
    StateVar::scalar("plastic_strain", "-"),
    StateVar::scalar("kappa", "-"),
];

impl Material<Axial> for Steel {
    fn name(&self) -> &'static str {
        "steel"
    }

    fn state_vars(&self) -> &[StateVar] {
        &STATE
    }

    fn update(
        &self,
        strain: &Vector1<f64>,
        committed: &[f64],
        trial: &mut [f64],
        _ctx: &PointContext,
    ) -> Result<Response<Axial>, MaterialError> {
        let (plastic, kappa) = (committed[0], committed[1]);
        let elastic = YOUNG * (strain[0] - plastic);
        let excess = elastic.abs() - (YIELD + HARDENING * kappa);
        let growth = excess.max(0.0) / (YOUNG + HARDENING);
        trial[0] = plastic + growth * elastic.signum();
        trial[1] = kappa + growth;
        let tangent = if excess > 0.0 {
            YOUNG * HARDENING / (YOUNG + HARDENING)
        } else {
            YOUNG
        };
        Ok(Response {
            stress: Vector1::new(YOUNG * (strain[0] - trial[0])),
            tangent: Matrix1::new(tangent),
        })
    }

    fn free_energy(&self, strain: &Vector1<f64>, state: &[f64], _: &PointContext) -> Option<f64> {
        let elastic = strain[0] - state[0];
        Some(0.5 * YOUNG * elastic * elastic + 0.5 * HARDENING * state[1] * state[1])
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let report = check_material(&Steel, &MaterialCheck::new(0.01))?;
    println!("{report:?}");

    let mut point = PointDriver::new(&Steel, PointContext::new(1.0))?;
    point.run(&[
        Segment::new(vec![Control::Stress(420.0)], 10),
        Segment::new(vec![Control::Stress(0.0)], 5),
    ])?;
    point.history().write_csv(&mut std::io::stdout())?;
    // 20 MPa beyond yield leave a plastic strain of 20/H.
    let left = point.history().rows()[15].strain[0];
    assert!((left - 0.01).abs() < 1e-12);
    Ok(())
}
