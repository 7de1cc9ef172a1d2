//! STR-07: panel of 100 mm x 100 mm x 10 mm, concrete of 30 MPa with the default law, reinforced both ways, under pure shear.
//!
//! Source: limit analysis of a panel without tension: both reinforcements yield at v = sqrt(rho_x f_x rho_y f_y), the
//! cracks at tan^2(theta) = rho_y f_y/(rho_x f_x) to the x axis.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_elements::{BandWidth, Bar, Hex20, HexRule, embed};
use fe_materials::Biso;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_solver::automatic::Automatic;
use fe_solver::control::StepControl;
use fe_solver::newton::NewtonSettings;
use fe_tests::conditions::{hold, push_faces};
use fe_tests::mesh::{BLOCK, boxes, cells};
use fe_tests::solve::run;
use nalgebra::Vector3;

const SIDE: f64 = 100.0;
const THICKNESS: f64 = 10.0;
const YIELD: f64 = 400.0;

/// The panel with reinforcement ratios along x and y.
fn panel([along, across]: [f64; 2]) -> Model {
    let mesh = boxes(&[0.0, SIDE], &[0.0, SIDE], &[0.0, THICKNESS]).unwrap();
    let concrete = FixedCrackParameters::from_strength(30.0, 2.2, 30_000.0);
    let law: Arc<dyn Material<Solid>> = Arc::new(FixedCrack::new(concrete, None).unwrap());
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    for (nodes, coords) in cells(&mesh, &mesh.blocks()[0]) {
        let band = BandWidth::Fixed(SIDE);
        let cell = Hex20::new(nodes, &coords, HexRule::Full, law.clone(), band);
        elements.push(Box::new(cell.unwrap()));
    }
    let steel = Arc::new(Biso::hot_rolled(200_000.0, YIELD, 0.0).unwrap());
    // At the Gauss points of the edges, in proportion to their weights, bars act as if smeared.
    let points = [
        (0.5 - 0.15_f64.sqrt(), 5.0 / 18.0),
        (0.5, 8.0 / 18.0),
        (0.5 + 0.15_f64.sqrt(), 5.0 / 18.0),
    ];
    for (place, weight) in points {
        for (depth, share) in points {
            let (place, z) = (place * SIDE, depth * THICKNESS);
            let lines = [
                (along, [[0.0, place, z], [SIDE, place, z]]),
                (across, [[place, 0.0, z], [place, SIDE, z]]),
            ];
            for (ratio, ends) in lines {
                let bar = Bar {
                    name: "bar".into(),
                    polyline: ends.into(),
                    area_mm2: weight * share * ratio * SIDE * THICKNESS,
                    law: steel.clone(),
                    dowel: None,
                };
                let pieces = embed(&[bar], &mesh, &[BLOCK]).unwrap();
                elements.extend(pieces.into_iter().map(|e| Box::new(e) as Box<dyn Element>));
            }
        }
    }
    Model::new(mesh, elements)
}

/// Largest shear stress (MPa) under tractions on the edges, and that at the end.
fn shear(ratios: [f64; 2]) -> [f64; 2] {
    let model = panel(ratios);
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &[Dof::Uz], |x| x[2] == 0.0).unwrap();
    hold(&model, &mut conditions, &[Dof::Ux, Dof::Uy], |x| {
        x[0] == 0.0 && x[1] == 0.0
    })
    .unwrap();
    hold(&model, &mut conditions, &[Dof::Uy], |x| {
        x[0] == SIDE && x[1] == 0.0
    })
    .unwrap();
    let edge = |x: [f64; 3]| [x[0], x[1]].iter().any(|c| *c == 0.0 || *c == SIDE);
    let traction = |n: Vector3<f64>| Vector3::new(n.y, n.x, 0.0);
    for (axis, place) in [(0, 0.0), (0, SIDE), (1, 0.0), (1, SIDE)] {
        push_faces(
            &model,
            &mut conditions,
            |x| x[axis] == place && edge(x),
            traction,
        )
        .unwrap();
    }
    let control = StepControl {
        criterion: 1e-4,
        longest: 0.05,
        shortest: 1e-5,
        ..StepControl::new(0.002, 1.0)
    };
    let [mut largest, mut last] = [0.0_f64; 2];
    let mut driver = Automatic::new(NewtonSettings::default());
    let record = |view: &fe_solver::recorder::StepView<'_>| {
        last = view.lambda;
        largest = largest.max(last);
    };
    run(&model, conditions, &control, &mut driver, |_| {}, record).unwrap();
    [largest, last]
}

/// Cracks at 45 degrees stay where they are. Target: 4 MPa within 0.1 %, and it stays.
#[test]
fn equal_reinforcement_yields_both_ways() {
    let [largest, last] = shear([0.01, 0.01]);
    assert!((largest / 4.0 - 1.0).abs() < 1e-3, "{largest}");
    assert!((last / 4.0 - 1.0).abs() < 1e-3, "{last}");
}

/// With half as much across, the first cracks, at 45 degrees and fixed, are not those of the limit state: shear must
/// cross them. Target: the bound of 2.83 MPa is reached and exceeded by less than 8 %.
#[test]
fn unequal_reinforcement_exceeds_the_bound_by_what_crosses_fixed_cracks() {
    let [largest, _] = shear([0.01, 0.005]);
    let bound = 8.0_f64.sqrt();
    assert!((1.0..1.08).contains(&(largest / bound)), "{largest}");
}
