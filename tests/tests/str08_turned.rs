//! STR-08: two hexahedra of cracking concrete with an embedded bar, its dowel, and a bonded sheet on one face, pulled and sheared;
//! the same in a frame turned by 37 degrees about a skew axis.
//!
//! Source: frame indifference. Target: the same loads at all steps, to 1e-9 of the largest.

use std::sync::Arc;

use fe_contact::{BondSettings, Interface16, InterfaceRule, SlipDamage};
use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_core::skin::{Layers, outer_faces};
use fe_core::testing::{Worst, between};
use fe_elements::{BandWidth, Bar, Dowel, Hex20, HexRule, Membrane8, QuadRule, embed};
use fe_materials::concrete::{Calibration, Ottosen};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_materials::{Biso, Lamina, LaminaParameters};
use fe_solver::control::StepControl;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_tests::mesh::{BLOCK, boxes, cells, mapped, nodes_where};
use fe_tests::solve::run;
use fe_tests::strip::bond;
use nalgebra::{Rotation3, Unit, Vector3};

const LENGTH: f64 = 120.0;
/// Displacement (mm) of the far end per unit of the load factor.
const WAY: [f64; 3] = [0.16, 0.06, -0.03];

fn concrete() -> Arc<dyn Material<Solid>> {
    let p = FixedCrackParameters::from_strength(38.0, 2.9, 33_000.0);
    let onset = Ottosen::new(&Calibration::model_code(p.fcm_mpa, p.ft_mpa)).unwrap();
    Arc::new(FixedCrack::new(p, Some(onset)).unwrap())
}

/// Load factor and load (N) of every step; everything that has a direction is turned.
fn path(turn: Rotation3<f64>) -> Vec<[f64; 2]> {
    let turned = |x: [f64; 3]| -> [f64; 3] { (turn * Vector3::from(x)).into() };
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(turned);
    let straight = boxes(&[0.0, 50.0, LENGTH], &[0.0, 60.0], &[0.0, 50.0]).unwrap();
    let mut mesh = mapped(&straight, turned).unwrap();
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    let (law, band) = (
        concrete(),
        BandWidth::InPlane {
            normal: z,
            factor: 1.0,
        },
    );
    for (nodes, coords) in cells(&mesh, &mesh.blocks()[0]) {
        let cell = Hex20::new(nodes, &coords, HexRule::Full, law.clone(), band);
        elements.push(Box::new(cell.unwrap()));
    }
    let dowel = Dowel::he_kwan(8.0, 38.0, 200e3, 50.0, z).unwrap();
    let bar = Bar {
        name: "bar".into(),
        polyline: [[0.0, 20.0, 15.0], [LENGTH, 30.0, 35.0]].map(turned).into(),
        area_mm2: 50.0,
        law: Arc::new(Biso::hot_rolled(200e3, 500.0, 2e3).unwrap()),
        dowel: Some(dowel),
    };
    for piece in embed(&[bar], &mesh, &[BLOCK]).unwrap() {
        elements.push(Box::new(piece));
    }
    let mut faces = outer_faces(&mesh, &[BLOCK]);
    faces.retain(|f| Vector3::from(f.normal).dot(&Vector3::from(y)) < -0.9);
    let mut layers = Layers::over(&faces);
    let fibres = Lamina::new(&LaminaParameters {
        young_1_mpa: 228e3,
        young_2_mpa: 10e3,
        shear_mpa: 5e3,
        poisson_12: 0.3,
        strength_mpa: 3790.0,
    });
    let fibres = Arc::new(fibres.unwrap());
    let joint = Arc::new(SlipDamage::new(bond().unwrap(), BondSettings::default()).unwrap());
    for face in &faces {
        let sheet = layers.nodes(&mut mesh, face.nodes, 0, 0.0).unwrap();
        let coords = face.nodes.map(|n| mesh.nodes()[n]);
        let rule = QuadRule::Full;
        let membrane = Membrane8::new(sheet, &coords, 0.165, rule, x, fibres.clone());
        elements.push(Box::new(membrane.unwrap()));
        let pairs = std::array::from_fn(|a| if a < 8 { face.nodes[a] } else { sheet[a - 8] });
        let rule = InterfaceRule::default();
        let interface = Interface16::new(pairs, &coords, x, rule, joint.clone());
        elements.push(Box::new(interface.unwrap()));
    }
    let model = Model::new(mesh, elements).unwrap();
    let mut conditions = Conditions::new(&model);
    for (end, way) in [(0.0, [0.0; 3]), (LENGTH, turned(WAY))] {
        for node in nodes_where(&straight, |x| x[0] == end) {
            for (dof, rate) in Dof::DISPLACEMENTS.into_iter().zip(way) {
                conditions.prescribe(&model, node, dof, rate).unwrap();
            }
        }
    }
    let control = StepControl {
        criterion: 1e-6,
        ..StepControl::new(0.05, 1.0)
    };
    let mut newton = NewtonRaphson::new(NewtonSettings::default());
    let mut path = Vec::new();
    let step = |view: &fe_solver::recorder::StepView<'_>| path.push([view.lambda, view.load]);
    run(&model, conditions, &control, &mut newton, |_| {}, step).unwrap();
    path
}

/// Protects laws, elements and the solver from depending on the axes of the mesh, cracks and all.
#[test]
fn a_turned_model_takes_the_same_path() {
    let axis = Unit::new_normalize(Vector3::new(1.0, -2.0, 0.7));
    let straight = path(Rotation3::identity());
    let turned = path(Rotation3::from_axis_angle(&axis, 37.0_f64.to_radians()));
    assert_eq!(straight.len(), turned.len());
    let largest = straight.iter().fold(0.0_f64, |m, p| m.max(p[1].abs()));
    // Cracked: less than half of the first stiffness is left.
    let secant = |[factor, load]: [f64; 2]| load / factor;
    let [first, last] = [straight[0], straight[straight.len() - 1]];
    let left = secant(last) / secant(first);
    between("stiffness that is left", left, [0.0, 0.5]);
    let mut worst = Worst::new(
        "STR-08: loads of the turned model, error over the largest",
        1e-9,
    );
    for ([factor, a], [other, b]) in straight.iter().zip(&turned) {
        assert_eq!(factor, other);
        worst.see((a - b) / largest, factor);
    }
    worst.tell();
}
