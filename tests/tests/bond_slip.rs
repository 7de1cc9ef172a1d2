//! A ribbed bar of 16 mm pulled out of a rigid block, 200 mm embedded, bond of the Model Code.
//!
//! Source: the differential equation E A s'' = pi phi tau(s), integrated from the free end by Runge-Kutta and shot at the
//! slip of the loaded end. Target: force within 0.05 %, slip of the free end within 0.05 % of that of the loaded end.

use std::f64::consts::PI;
use std::sync::Arc;

use fe_contact::envelope::{Bond, Confinement, ModelCode, ModelCodeParameters};
use fe_contact::{BondSettings, BondSlip, BondSlipBar, Envelope, SlipDamage};
use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::mesh::{CellKind, Mesh, NodeId};
use fe_core::model::{Conditions, Model};
use fe_core::testing::Worst;
use fe_elements::{HexRule, Truss3};
use fe_materials::Elastic;
use fe_solver::control::StepControl;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::recorder::StepView;
use fe_tests::conditions::hold;
use fe_tests::mesh::{BLOCK, boxes, cells, hexahedra, lines};
use fe_tests::solve::run;

const LENGTH: f64 = 200.0;
const DIAMETER: f64 = 16.0;
const YOUNG: f64 = 200_000.0;
const AREA: f64 = 0.25 * PI * DIAMETER * DIAMETER;

fn curve(confinement: Confinement) -> ModelCode {
    ModelCode::new(&ModelCodeParameters {
        fcm_mpa: 36.0,
        rib_spacing_mm: 8.0,
        bond: Bond::Good,
        confinement,
    })
    .unwrap()
}

/// Slip (mm) and force (N) at the loaded end for a slip of the free end.
fn shoot(curve: &ModelCode, free: f64) -> [f64; 2] {
    let n = 2000;
    let h = LENGTH / f64::from(n);
    let rate = |[s, f]: [f64; 2]| [f / (YOUNG * AREA), PI * DIAMETER * curve.stress(s)];
    let add = |a: [f64; 2], b: [f64; 2], c: f64| [a[0] + c * b[0], a[1] + c * b[1]];
    (0..n).fold([free, 0.0], |y, _| {
        let k1 = rate(y);
        let k2 = rate(add(y, k1, 0.5 * h));
        let k3 = rate(add(y, k2, 0.5 * h));
        let k4 = rate(add(y, k3, h));
        let sum = add(add(add(k1, k2, 2.0), k3, 2.0), k4, 1.0);
        add(y, sum, h / 6.0)
    })
}

/// Force and slip of the free end at a slip of the loaded end, which grows with that of the free end.
fn exact(curve: &ModelCode, slip: f64) -> [f64; 2] {
    let (mut low, mut high) = (0.0, slip);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if shoot(curve, middle)[0] < slip {
            low = middle;
        } else {
            high = middle;
        }
    }
    [shoot(curve, low)[1], low]
}

/// A block of `n` cells along x, the bar along its axis with three nodes of its own in every cell.
fn block(n: usize, curve: ModelCode) -> (Model, Vec<NodeId>) {
    let host = boxes(&lines(0.0, LENGTH, n), &[-50.0, 50.0], &[-50.0, 50.0]).unwrap();
    let first = host.nodes().len();
    let mut nodes = host.nodes().to_vec();
    nodes.extend(lines(0.0, LENGTH, 2 * n).into_iter().map(|x| [x, 0.0, 0.0]));
    let mut mesh = Mesh::new(nodes).unwrap();
    let connectivity = host.blocks()[0].cells().flatten().copied().collect();
    mesh.add_block(BLOCK, CellKind::Hex20, connectivity)
        .unwrap();
    let concrete = Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
    let mut elements = hexahedra(&mesh, HexRule::Full, &(concrete as _)).unwrap();
    let steel = Arc::new(Elastic::new(YOUNG, 0.0).unwrap());
    let bond = BondSlipBar {
        diameter_mm: DIAMETER,
        transverse_mpa_per_mm: 1e3,
        law: Arc::new(SlipDamage::new(curve, BondSettings::default()).unwrap()),
    };
    for (i, (around, coords)) in cells(&mesh, &mesh.blocks()[0]).enumerate() {
        let own = [0, 2, 1].map(|k| first + 2 * i + k);
        let places = own.map(|n| mesh.nodes()[n]);
        let all = std::array::from_fn(|a| if a < 3 { own[a] } else { around[a - 3] });
        let truss = Truss3::new(own, &places, AREA, steel.clone()).unwrap();
        elements.push(Box::new(truss) as Box<dyn Element>);
        elements.push(Box::new(
            BondSlip::new(all, &places, &coords, &bond).unwrap(),
        ));
    }
    (
        Model::new(mesh, elements).unwrap(),
        (first..=first + 2 * n).collect(),
    )
}

#[test]
fn pulled_bar_follows_the_differential_equation() {
    for (confinement, end, n) in [
        (Confinement::PullOut, 6.0, 10),
        (Confinement::Stirrups, 2.0, 10),
        (Confinement::None, 0.2, 20),
    ] {
        let curve = curve(confinement);
        let (model, bar) = block(n, curve);
        let mut conditions = Conditions::new(&model);
        hold(&model, &mut conditions, &Dof::DISPLACEMENTS, |x| {
            x[1] != 0.0 || x[2] != 0.0
        })
        .unwrap();
        conditions
            .prescribe(&model, bar[2 * n], Dof::Ux, 1.0)
            .unwrap();
        let free = model.dof(bar[0], Dof::Ux).unwrap();
        let control = StepControl {
            criterion: 1e-6,
            ..StepControl::new(end / 40.0, end)
        };
        let mut newton = NewtonRaphson::new(NewtonSettings::default());
        let mut path = Vec::new();
        let record = |view: &StepView<'_>| {
            path.push([view.lambda, view.load, view.stage.displacement()[free]]);
        };
        run(&model, conditions, &control, &mut newton, |_| {}, record).unwrap();
        let bond = format!("confinement {confinement:?}");
        let mut forces = Worst::new(&format!("force, relative error, {bond}"), 5e-4);
        let mut slips = Worst::new(
            &format!("slip of the free end, error over that of the loaded end, {bond}"),
            5e-4,
        );
        for [slip, force, at_free_end] in path {
            let [target, free] = exact(&curve, slip);
            forces.see(force / target - 1.0, slip);
            slips.see((at_free_end - free) / slip, slip);
        }
        forces.tell();
        slips.tell();
    }
}
