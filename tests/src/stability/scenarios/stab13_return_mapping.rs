//! STAB-13: stress returns from trial stresses of up to ten times the strength, in all directions. (10^6 of them are a test
//! of `fe-materials`; here are as many as the chart can wait for.)

use fe_core::kinematics::Solid;
use fe_core::material::{Material, Operator, PointContext};
use fe_core::testing::Random;
use fe_materials::concrete::{Associated, ConcreteScalars, Isochoric};
use nalgebra::Vector6;

use crate::stability::{Case, Failure, Figure, Method, Scenario};

const TRIALS: usize = 50_000;

fn figures() -> Result<Vec<Figure>, Failure> {
    let concrete = ConcreteScalars::from_characteristic(30.0)?;
    let laws: [(&str, Box<dyn Material<Solid>>); 2] = [
        ("isochoric", Box::new(Isochoric::new(&concrete)?)),
        ("associated", Box::new(Associated::new(&concrete)?)),
    ];
    let ctx = PointContext::new(50.0).with_operator(Operator::None);
    let mut figures = Vec::new();
    for (name, law) in laws {
        let mut random = Random::new(13);
        let mut virgin = vec![0.0; law.state_len()];
        law.init_state(&mut virgin);
        let mut trial = virgin.clone();
        let mut failures = 0;
        for _ in 0..TRIALS {
            let size = 10.0 * concrete.fcm_mpa / concrete.young_mpa * random.uniform(0.0, 1.0);
            let direction = Vector6::from_fn(|_, _| random.uniform(-1.0, 1.0));
            let strain = size * direction / direction.norm();
            let returned = law.update(&strain, &virgin, &mut trial, &ctx);
            failures += usize::from(returned.is_err());
        }
        figures.push(Figure::at_most(
            format!("failures, {name}"),
            failures as f64,
            0.0,
        ));
    }
    Ok(figures)
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-13",
    title: "return mapping to the Ottosen surface from up to 10 fcm",
    remark: "",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
