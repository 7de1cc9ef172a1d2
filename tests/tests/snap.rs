//! A snap under displacement control: the bar of STR-03, 2000 mm long, longer than 2 E GF/ft^2 = 991.7 mm.
//!
//! Source: elastic bar and cohesive crack in series. The end reaches u = ft L/E = 0.14667 mm at the strength; beyond it
//! the only equilibrium is the open crack, since wc = 2 GF/ft = 0.0727 mm < u. A softer elastic bar beside it carries on.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::grid::GridBuilder;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::Elastic;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters, TensionSoftening};
use fe_solver::control::StepControl;
use fe_solver::secant::SecantAnderson;
use fe_tests::conditions::hold;
use fe_tests::mesh::{cells, lines};
use fe_tests::solve::run;

const YOUNG: f64 = 30_000.0;
const STRENGTH: f64 = 2.2;
const LENGTH: f64 = 2000.0;
const AREA: f64 = 100.0;

/// Young's modulus of the bar beside (MPa).
const SOFT: f64 = 3000.0;

/// Ten cells, the second of which cracks, and ten cells of the bar beside.
fn bars() -> Model {
    let mut grid = GridBuilder::new();
    let x = lines(0.0, LENGTH, 10);
    grid.add_box("bar", &x, &[0.0, 10.0], &[0.0, 10.0]);
    grid.add_box("beside", &x, &[20.0, 30.0], &[0.0, 10.0]);
    let mesh = grid.finish().unwrap();
    let parameters = FixedCrackParameters {
        poisson: 0.0,
        tension_softening: TensionSoftening::Linear,
        fracture_energy: 0.08,
        ..FixedCrackParameters::from_strength(30.0, STRENGTH, YOUNG)
    };
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    let both = mesh.blocks().iter().flat_map(|block| cells(&mesh, block));
    for (i, (nodes, coords)) in both.enumerate() {
        let law: Arc<dyn Material<Solid>> = match i {
            1 => Arc::new(FixedCrack::new(parameters, None).unwrap()),
            0..10 => Arc::new(Elastic::new(YOUNG, 0.0).unwrap()),
            _ => Arc::new(Elastic::new(SOFT, 0.0).unwrap()),
        };
        let band = BandWidth::Fixed(LENGTH / 10.0);
        elements.push(Box::new(
            Hex20::new(nodes, &coords, HexRule::Full, law, band).unwrap(),
        ));
    }
    Model::new(mesh, elements).unwrap()
}

/// Protects the descent over a snap and the balance of energy across it. Targets: the peak at ft and u = ft L/E within 1 %;
/// from the next step on the crack is open, without stress; every step within the criterion; external work equals the work of all parts within 1e-3, the elastic part gives back all it stored.
#[test]
fn a_long_bar_snaps_to_its_open_crack() {
    let model = bars();
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &[Dof::Uy, Dof::Uz], |_| true).unwrap();
    hold(&model, &mut conditions, &[Dof::Ux], |x| x[0] == 0.0).unwrap();
    for node in 0..model.mesh().nodes().len() {
        if model.mesh().nodes()[node][0] == LENGTH {
            conditions.prescribe(&model, node, Dof::Ux, 1.0).unwrap();
        }
    }
    let part = (0..20).map(|e| match e {
        1 => 1,
        0..10 => 0,
        _ => 2,
    });
    let part: Vec<usize> = part.collect();
    let mut books = (Vec::new(), 1.0);
    let mut path = Vec::new();
    let control = StepControl::new(0.002, 0.2);
    run(
        &model,
        conditions,
        &control,
        &mut SecantAnderson::default(),
        |_| {},
        |view| {
            let ledger = view.stage.ledger();
            books = (ledger.parts(&part, 3), ledger.gap());
            assert!(view.residual <= control.criterion && !view.flagged);
            let beside = SOFT * view.lambda / LENGTH;
            path.push((view.lambda, view.load / AREA - beside));
        },
    )
    .unwrap();
    let peak = (0..path.len())
        .max_by(|&a, &b| path[a].1.total_cmp(&path[b].1))
        .unwrap();
    let (u, stress) = path[peak];
    assert!((stress / STRENGTH - 1.0).abs() < 0.01, "{stress}");
    assert!((u / (STRENGTH * LENGTH / YOUNG) - 1.0).abs() < 0.01, "{u}");
    let after = path[peak + 1..].iter();
    assert!(after.clone().all(|p| p.1.abs() < 1e-3 * STRENGTH));
    assert!(after.count() > 20);
    let [elastic, cracked, beside] = books.0[..] else {
        panic!("three parts");
    };
    assert!(books.1.abs() < 1e-3, "{}", books.1);
    let work = 0.5 * STRENGTH * AREA * u;
    assert!((cracked.dissipated() / work - 1.0).abs() < 0.02);
    assert!(elastic.stored.abs() < 1e-3 * work && elastic.work.abs() < 1e-3 * work);
    assert!((beside.work / beside.stored - 1.0).abs() < 1e-9);
}
