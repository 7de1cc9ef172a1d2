//! Protects what the beams rely on: energies, envelopes, irreversible shear factor, latching, refusals.

mod axes;
mod compression;
mod contract;
mod shear;
mod tension;

use fe_core::material::{Material, Operator, PointContext};
use nalgebra::Vector6;

use super::{FixedCrack, FixedCrackParameters};
use crate::concrete::{Calibration, Ottosen};

/// Wider than the spacing of cracks.
const WIDTH: f64 = 60.0;

fn parameters() -> FixedCrackParameters {
    FixedCrackParameters::from_strength(38.0, 2.9, 33_000.0)
}

fn law(poisson: f64) -> FixedCrack {
    build(FixedCrackParameters {
        poisson,
        ..parameters()
    })
}

fn build(p: FixedCrackParameters) -> FixedCrack {
    let onset = Ottosen::new(&Calibration::model_code(p.fcm_mpa, p.ft_mpa)).unwrap();
    FixedCrack::new(p, Some(onset)).unwrap()
}

/// A point that is driven through strains.
#[derive(Clone)]
struct Point {
    law: FixedCrack,
    state: Vec<f64>,
}

impl Point {
    fn new(law: FixedCrack) -> Self {
        let mut state = vec![0.0; law.state_len()];
        law.init_state(&mut state);
        Self { law, state }
    }

    fn stress(&mut self, strain: Vector6<f64>) -> Vector6<f64> {
        let mut trial = vec![0.0; self.state.len()];
        let ctx = PointContext::new(WIDTH).with_operator(Operator::None);
        let response = self
            .law
            .update(&strain, &self.state, &mut trial, &ctx)
            .unwrap();
        self.state = trial;
        response.stress
    }

    fn energy(&self, strain: &Vector6<f64>) -> f64 {
        let ctx = PointContext::new(WIDTH);
        self.law.free_energy(strain, &self.state, &ctx).unwrap()
    }
}

fn axial(e: f64) -> Vector6<f64> {
    Vector6::new(e, 0.0, 0.0, 0.0, 0.0, 0.0)
}
