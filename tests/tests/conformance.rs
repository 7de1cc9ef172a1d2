//! Contract of every element with elastic, plastic and cracking laws: rigid-body motions, balance of the nodal forces,
//! repeatability, stiffness against finite differences.
//!
//! Source: the contract in `fe_core::element`. Targets: the tolerances of `fe_core::testing::ElementCheck`.

use std::sync::Arc;

use fe_core::element::{Element, ElementSystem, EvaluationContext, PointSample};
use fe_core::kinematics::{Axial, PlaneStress, Solid};
use fe_core::material::{Material, Operator};
use fe_core::mesh::{CellKind, Mesh};
use fe_core::shape::{hex20, quad8};
use fe_core::testing::{ElementCheck, check_element};
use fe_elements::{
    BandWidth, Bar, Dowel, Hex20, HexRule, Hosts, Layer, Led, Membrane8, Quad8, QuadRule, Shell8,
    ShellSection, Truss3, embed,
};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_materials::{Biso, Elastic, VonMises};
use fe_tests::laws::DamagedSheet;
use nalgebra::Matrix3;

/// A distorted hexahedron of about 50 mm.
fn hexahedron() -> [[f64; 3]; 20] {
    hex20::NODES.map(|[x, y, z]| {
        [
            25.0 * x + 2.0 * y * z,
            24.0 * y + 1.5 * x * x,
            26.0 * z - x * y,
        ]
    })
}

fn solids() -> [Arc<dyn Material<Solid>>; 3] {
    let concrete = FixedCrackParameters::from_strength(38.0, 2.9, 33_000.0);
    [
        Arc::new(Elastic::new(30_000.0, 0.2).unwrap()),
        Arc::new(VonMises::new(30_000.0, 0.2, 15.0, 20.0).unwrap()),
        Arc::new(FixedCrack::new(concrete, None).unwrap()),
    ]
}

/// Hexahedra with both rules.
#[test]
fn hexahedra() {
    let coords = hexahedron();
    for law in solids() {
        for rule in [HexRule::Reduced, HexRule::Full] {
            let nodes = std::array::from_fn(|a| a);
            let law = Arc::clone(&law);
            let name = law.name();
            let element = Hex20::new(nodes, &coords, rule, law, BandWidth::CubeRoot).unwrap();
            let check = ElementCheck {
                paths: 2,
                ..ElementCheck::new(0.05)
            };
            let report = check_element(&element, &coords, &check);
            assert_eq!(report.expect(name).motions, 6);
        }
    }
}

/// Bars without dowel action, with it, and with dowels that slide, in a distorted host.
#[test]
fn embedded_bars() {
    let coords = hexahedron();
    let mut mesh = Mesh::new(coords.to_vec()).unwrap();
    mesh.add_block("host", CellKind::Hex20, (0..20).collect())
        .unwrap();
    let laws: [Arc<dyn Material<Axial>>; 2] = [
        Arc::new(Elastic::new(200e3, 0.0).unwrap()),
        Arc::new(Biso::hot_rolled(200e3, 460.0, 2000.0).unwrap()),
    ];
    for law in laws {
        let dowel = Dowel::he_kwan(16.0, 38.0, 200e3, 50.0, [0.0, 0.0, 1.0]).unwrap();
        let weak = dowel.bounded(0.2, 38.0, 460.0).unwrap();
        for dowel in [None, Some(dowel), Some(weak)] {
            let bar = Bar {
                name: "bar".into(),
                polyline: vec![[-18.0, -15.0, -17.0], [3.0, 5.0, 1.0], [15.0, 4.0, 18.0]],
                area_mm2: 201.0,
                law: Arc::clone(&law),
                dowel,
            };
            let elements = embed(&[bar], &mesh, &["host"]).unwrap();
            assert_eq!(elements.len(), 1);
            let element: &dyn Element = &elements[0];
            check_element(element, &coords, &ElementCheck::new(0.1)).unwrap();
        }
    }
}

/// Bars that slip in a distorted host, without dowel action, with it, and with dowels that slide; with ends that are free
/// or held by the host.
#[test]
fn slipping_bars() {
    let mut coords = hexahedron().to_vec();
    let mut mesh = Mesh::new(coords.clone()).unwrap();
    mesh.add_block("host", CellKind::Hex20, (0..20).collect())
        .unwrap();
    let hosts = Hosts::new(&mesh, &["host"]).unwrap();
    let ends = [[-18.0, -15.0, -17.0], [3.0, 5.0, 1.0]];
    coords.extend([ends[0], ends[1], [-7.5, -5.0, -8.0]]);
    let natural = hex20::inverse_map(&hexahedron(), ends[0]).unwrap();
    let held: Vec<_> = (0..20).zip(hex20::shape(natural).0).collect();
    let law: Arc<dyn Material<Axial>> = Arc::new(Biso::hot_rolled(200e3, 460.0, 2000.0).unwrap());
    let dowel = Dowel::he_kwan(16.0, 38.0, 200e3, 50.0, [0.0, 0.0, 1.0]).unwrap();
    let weak = dowel.bounded(0.2, 38.0, 460.0).unwrap();
    for dowel in [None, Some(dowel), Some(weak)] {
        let bar = Bar {
            name: "bar".into(),
            polyline: ends.to_vec(),
            area_mm2: 201.0,
            law: Arc::clone(&law),
            dowel,
        };
        for hung in [false, true] {
            let piece = &hosts.cut(&bar).unwrap()[0];
            let mut element: Box<dyn Element> =
                Box::new(hosts.slipping(&bar, piece, [20, 21, 22]).unwrap());
            if hung {
                element = Led::hung(element, 20, &held).unwrap();
            }
            let places: Vec<_> = element.nodes().iter().map(|&n| coords[n]).collect();
            let check = ElementCheck {
                // A whole bar yields at one of two points: every yield is a kink.
                kink_share: 0.2,
                ..ElementCheck::new(0.1)
            };
            check_element(element.as_ref(), &places, &check).unwrap();
        }
    }
}

/// Bars with nodes of their own, straight and curved.
#[test]
fn trusses() {
    let laws: [Arc<dyn Material<Axial>>; 2] = [
        Arc::new(Elastic::new(200e3, 0.0).unwrap()),
        Arc::new(Biso::hot_rolled(200e3, 460.0, 2000.0).unwrap()),
    ];
    for law in laws {
        for middle in [[2.0, -1.0, 0.5], [3.0, 1.0, 0.0]] {
            let coords = [[-18.0, -15.0, -17.0], [22.0, 13.0, 18.0], middle];
            let element = Truss3::new([0, 1, 2], &coords, 201.0, Arc::clone(&law)).unwrap();
            let check = ElementCheck {
                // A whole bar yields at one of two points: every yield is a kink.
                kink_share: 0.2,
                ..ElementCheck::new(0.1)
            };
            check_element(&element, &coords, &check).unwrap();
        }
    }
}

/// Quadrilaterals with both rules.
#[test]
fn quadrilaterals() {
    let plane = quad8::NODES.map(|[x, y]| [25.0 * x + 2.0 * x * y, 24.0 * y + x]);
    let coords = plane.map(|[x, y]| [x, y, 0.0]);
    let law = Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
    for rule in [QuadRule::Reduced, QuadRule::Full] {
        let nodes = std::array::from_fn(|a| a);
        let element = Quad8::new(nodes, &plane, 10.0, rule, law.clone()).unwrap();
        let report = check_element(&element, &coords, &ElementCheck::new(0.05)).unwrap();
        assert_eq!(report.motions, 3);
    }
}

/// A membrane curved in both directions.
fn saddle() -> [[f64; 3]; 8] {
    quad8::NODES.map(|[x, y]| {
        [
            25.0 * x + 2.0 * x * y,
            24.0 * y + x,
            6.0 * x * x - 4.0 * x * y,
        ]
    })
}

fn sheet_laws() -> [Arc<dyn Material<PlaneStress>>; 2] {
    let damaged = DamagedSheet {
        stiffness: Matrix3::new(31e3, 6e3, 1e3, 6e3, 25e3, 0.0, 1e3, 0.0, 12e3),
        resistance: 1.0,
    };
    [
        Arc::new(Elastic::new(30_000.0, 0.2).unwrap()),
        Arc::new(damaged),
    ]
}

/// Curved membranes in space with both rules.
#[test]
fn membranes() {
    let coords = saddle();
    for law in sheet_laws() {
        for rule in [QuadRule::Reduced, QuadRule::Full] {
            let nodes = std::array::from_fn(|a| a);
            let axis = [0.0, 1.0, 1.0];
            let name = law.name();
            let element = Membrane8::new(nodes, &coords, 10.0, rule, axis, Arc::clone(&law));
            let report = check_element(&element.unwrap(), &coords, &ElementCheck::new(0.05));
            assert_eq!(report.expect(name).motions, 6);
        }
    }
}

/// Curved shells of three layers, with and without history, with both rules.
#[test]
fn layered_shells() {
    let coords = saddle();
    let [elastic, damaged] = sheet_laws();
    let layer = |law: &Arc<dyn Material<PlaneStress>>, thickness_mm, angle_deg| Layer {
        thickness_mm,
        angle_deg,
        law: Arc::clone(law),
        shear_mpa: [12e3, 9e3],
    };
    let layers = vec![
        layer(&damaged, 2.0, 30.0),
        layer(&elastic, 3.0, 0.0),
        layer(&damaged, 1.0, -80.0),
    ];
    for rule in [QuadRule::Reduced, QuadRule::Full] {
        let nodes = std::array::from_fn(|a| a);
        let section = ShellSection::new(layers.clone());
        let element = Shell8::new(nodes, &coords, &section, rule, [0.0, 1.0, 1.0]).unwrap();
        let points = if rule == QuadRule::Full { 9 } else { 4 };
        assert_eq!(element.state_len(), 2 * 2 * points);
        let translations = [0.05; 3];
        let rotations = [0.005; 3];
        let check = ElementCheck {
            amplitude: [translations, rotations].concat(),
            ..ElementCheck::new(0.05)
        };
        let report = check_element(&element, &coords, &check).unwrap();
        assert_eq!(report.motions, 6);
    }
}

/// Elastic elements: twice the free energy is the work of the nodal forces, and the sum over the sampled points of volume,
/// stress and strain. Target: equal within rounding.
#[test]
fn energies_agree() {
    let law = Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
    let coords = hexahedron();
    let mut mesh = Mesh::new(coords.to_vec()).unwrap();
    mesh.add_block("host", CellKind::Hex20, (0..20).collect())
        .unwrap();
    let nodes = std::array::from_fn(|a| a);
    let plane = quad8::NODES.map(|[x, y]| [25.0 * x + 2.0 * x * y, 24.0 * y + x]);
    let sheet = Quad8::new(
        std::array::from_fn(|a| a),
        &plane,
        10.0,
        QuadRule::Full,
        law.clone(),
    );
    let membrane = Membrane8::new(
        std::array::from_fn(|a| a),
        &saddle(),
        10.0,
        QuadRule::Full,
        [0.0, 1.0, 1.0],
        law.clone(),
    );
    let solid = Hex20::new(
        nodes,
        &coords,
        HexRule::Reduced,
        law.clone(),
        BandWidth::CubeRoot,
    );
    let bar = Bar {
        name: "bar".into(),
        polyline: vec![[-18.0, -15.0, -17.0], [3.0, 5.0, 1.0]],
        area_mm2: 201.0,
        law,
        dowel: None,
    };
    let mut elements: Vec<Box<dyn Element>> = vec![
        Box::new(solid.unwrap()),
        Box::new(sheet.unwrap()),
        Box::new(membrane.unwrap()),
    ];
    for element in embed(&[bar], &mesh, &["host"]).unwrap() {
        elements.push(Box::new(element));
    }
    for element in &elements {
        let n = element.nodes().len() * element.dofs().len();
        let u: Vec<f64> = (0..n)
            .map(|i| 0.01 * (1.3 * (i * i) as f64).sin())
            .collect();
        let mut force = vec![0.0; n];
        let out = ElementSystem {
            force: &mut force,
            stiffness: &mut [],
        };
        let ctx = EvaluationContext::new(Operator::None);
        element.evaluate(&u, &[], &mut [], &ctx, out).unwrap();
        let work: f64 = force.iter().zip(&u).map(|(f, u)| f * u).sum();
        let energy = element.free_energy(&u, &[]).unwrap().unwrap();
        let mut sampled = 0.0;
        let mut visit = |p: PointSample<'_>| {
            sampled += p.volume
                * p.stress
                    .iter()
                    .zip(p.strain)
                    .map(|(s, e)| s * e)
                    .sum::<f64>();
        };
        element.sample(&u, &[], &mut visit).unwrap();
        assert!((2.0 * energy / work - 1.0).abs() < 1e-12, "{element:?}");
        assert!((sampled / work - 1.0).abs() < 1e-12, "{element:?}");
    }
}
