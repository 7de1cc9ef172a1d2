//! Protects the half body that is uniform across its width: its hexahedra against the contract of elements and against the
//! hexahedron they come from, bars and interfaces on its nodes, and elements of constant stiffness.

use std::sync::Arc;

use fe_contact::envelope::{Bilinear, BilinearSlips};
use fe_contact::{BondSettings, Interface16, InterfaceRule, SlipDamage};
use fe_core::check;
use fe_core::dof::Dof;
use fe_core::element::{Element, ElementSystem, EvaluationContext};
use fe_core::followers::Followers;
use fe_core::kinematics::Solid;
use fe_core::material::{Material, Operator};
use fe_core::mesh::{CellKind, Mesh, NodeId};
use fe_core::model::{Conditions, Model, ModelError};
use fe_core::shape::hex20;
use fe_core::testing::{ElementCheck, check_element};
use fe_elements::{BandWidth, Bar, Dowel, Hex20, HexRule, Led, Linear, UniformHex20, embed};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_materials::{Biso, Elastic};

const CELL: [NodeId; 20] = {
    let mut cell = [0; 20];
    let mut a = 0;
    while a < 20 {
        cell[a] = a;
        a += 1;
    }
    cell
};

/// A prism between z = 0 and 30 mm on a distorted quadrilateral.
fn prism() -> Mesh {
    let place = |xi: &[f64; 3]| {
        let [x, y, z] = *xi;
        [
            20.0 * x + 3.0 * x * y + y,
            15.0 * y - 2.0 * x * x + x,
            15.0 * (1.0 + z),
        ]
    };
    let mut mesh = Mesh::new(hex20::NODES.iter().map(place).collect()).unwrap();
    mesh.add_block("host", CellKind::Hex20, CELL.into())
        .unwrap();
    mesh
}

fn coords(mesh: &Mesh) -> [[f64; 3]; 20] {
    std::array::from_fn(|a| mesh.nodes()[a])
}

fn in_plane() -> ElementCheck {
    ElementCheck {
        in_plane: true,
        ..ElementCheck::new(0.02)
    }
}

fn places(element: &dyn Element, mesh: &Mesh) -> Vec<[f64; 3]> {
    element.nodes().iter().map(|&n| mesh.nodes()[n]).collect()
}

fn force(element: &dyn Element, u: &[f64]) -> Vec<f64> {
    let mut state = vec![0.0; element.state_len()];
    element.init_state(&mut state);
    let mut force = vec![0.0; u.len()];
    let out = ElementSystem {
        force: &mut force,
        stiffness: &mut [],
    };
    let ctx = EvaluationContext::new(Operator::None);
    let mut trial = state.clone();
    element.evaluate(u, &state, &mut trial, &ctx, out).unwrap();
    force
}

#[test]
fn the_hexahedron_keeps_the_contract() {
    let mesh = prism();
    let followers = Followers::uniform_across(&mesh, 0..20);
    let concrete = FixedCrackParameters::from_strength(38.0, 2.9, 33_000.0);
    let laws: [Arc<dyn Material<Solid>>; 2] = [
        Arc::new(Elastic::new(30_000.0, 0.2).unwrap()),
        Arc::new(FixedCrack::new(concrete, None).unwrap()),
    ];
    for law in laws {
        for rule in [HexRule::Irons, HexRule::Full] {
            let (law, band) = (Arc::clone(&law), BandWidth::CubeRoot);
            let element =
                UniformHex20::new(CELL, &coords(&mesh), &followers, rule, law, band).unwrap();
            let report = check_element(&element, &places(&element, &mesh), &in_plane()).unwrap();
            assert_eq!(report.motions, 3);
            let law = Arc::new(Elastic::new(1.0, 0.2).unwrap());
            let whole = Hex20::new(CELL, &coords(&mesh), rule, law, band).unwrap();
            assert!((element.volume() / whole.volume() - 1.0).abs() < 1e-12);
        }
    }
}

/// Source: with w the same at all nodes the shear strains that the element leaves out vanish, and the hexahedron on the
/// same DOFs gives the same forces. Target: rounding.
#[test]
fn it_is_the_hexahedron_where_the_width_does_not_vary() {
    let mesh = prism();
    let followers = Followers::uniform_across(&mesh, 0..20);
    let law: Arc<dyn Material<Solid>> = Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
    for rule in [HexRule::Irons, HexRule::Full] {
        let band = BandWidth::CubeRoot;
        let own = UniformHex20::new(CELL, &coords(&mesh), &followers, rule, law.clone(), band);
        let own = own.unwrap();
        let whole = Hex20::new(CELL, &coords(&mesh), rule, law.clone(), band).unwrap();
        let led = Led::by(Box::new(whole), &followers);
        let value = |node: NodeId, k: usize| match k {
            2 => 0.01,
            _ => 0.02 * ((3 * node + k) as f64).sin(),
        };
        let u = |element: &dyn Element| -> Vec<f64> {
            let nodes = element.nodes().iter();
            nodes
                .flat_map(|&n| (0..3).map(move |k| value(n, k)))
                .collect()
        };
        let (a, b) = (force(&own, &u(&own)), force(led.as_ref(), &u(led.as_ref())));
        let largest = a.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        for (i, node) in own.nodes().iter().enumerate() {
            let j = led.nodes().iter().position(|n| n == node).unwrap();
            // The forces across come from the stress across alone.
            for k in 0..3 {
                let miss = a[3 * i + k] - b[3 * j + k];
                assert!(miss.abs() < 1e-9 * largest, "{node} {k}: {miss}");
            }
        }
    }
}

/// A cell that reaches beyond one element across, or does not begin at the plane of symmetry, is refused.
#[test]
fn other_cells_are_refused() {
    let mesh = prism();
    let coords = coords(&mesh);
    let followers = Followers::uniform_across(&mesh, 0..20);
    let law: Arc<dyn Material<Solid>> = Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
    let (own, band) = (law.clone(), BandWidth::CubeRoot);
    let reduced = UniformHex20::new(CELL, &coords, &followers, HexRule::Reduced, own, band);
    let error = reduced.unwrap_err().to_string();
    assert!(
        error.contains("integration points in the plane = 4"),
        "{error}"
    );
    let build = |coords: &[[f64; 3]; 20], followers: &Followers| {
        let (law, band) = (law.clone(), BandWidth::CubeRoot);
        UniformHex20::new(CELL, coords, followers, HexRule::Full, law, band)
    };
    let error = build(&coords, &Followers::default())
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("leading nodes of the hexahedron = 20"),
        "{error}"
    );
    let away = coords.map(|[x, y, z]| [x, y, z + 5.0]);
    let error = build(&away, &followers).unwrap_err().to_string();
    assert!(
        error.contains("z of node 0 of the hexahedron (mm) = 5"),
        "{error}"
    );
}

/// A bar across the width strains with w, one along the beam as in the hexahedron.
#[test]
fn bars_follow() {
    let mesh = prism();
    let followers = Followers::uniform_across(&mesh, 0..20);
    let law = Arc::new(Biso::hot_rolled(200e3, 460.0, 2000.0).unwrap());
    let dowel = Dowel::he_kwan(16.0, 38.0, 200e3, 50.0, [0.0, 0.0, 1.0]).unwrap();
    let bar = |ends: [[f64; 3]; 2]| Bar {
        name: "bar".into(),
        polyline: ends.into(),
        area_mm2: 201.0,
        law: law.clone(),
        dowel: Some(dowel),
    };
    for ends in [
        [[-12.0, -8.0, 20.0], [14.0, 5.0, 20.0]],
        [[0.0, 0.0, 2.0], [0.0, 0.0, 28.0]],
    ] {
        let element = embed(&[bar(ends)], &mesh, &["host"]).unwrap().remove(0);
        let element = element.led_by(&followers);
        let check = ElementCheck {
            // A bar within one element yields as a whole.
            kink_share: 0.3,
            ..in_plane()
        };
        check_element(&element, &places(&element, &mesh), &check).unwrap();
        let stretched: Vec<f64> = (0..24)
            .map(|d| if d % 3 == 2 { 0.03 } else { 0.0 })
            .collect();
        let mut state = vec![0.0; element.state_len()];
        element.init_state(&mut state);
        element
            .sample(&stretched, &state, &mut |s| {
                let along = if ends[0][0] == 0.0 { 1e-3 } else { 0.0 };
                assert!((s.strain[0] - along).abs() < 1e-15);
            })
            .unwrap();
    }
}

/// An interface on the face below, with a sheet that is uniform too: 3 nodes of concrete, 3 of sheet.
#[test]
fn interfaces_follow() {
    let mut mesh = prism();
    let face = hex20::FACES[2];
    let sheet = face.map(|a| mesh.add_node(mesh.nodes()[a]).unwrap());
    let mut followers = Followers::uniform_across(&mesh, 0..20);
    followers.extend(Followers::uniform_across(&mesh, sheet));
    let nodes = std::array::from_fn(|i| if i < 8 { face[i] } else { sheet[i - 8] });
    let corners = face.map(|a| mesh.nodes()[a]);
    let curve = Bilinear::from_slips(&BilinearSlips {
        strength_mpa: 3.0,
        peak_slip_mm: 0.05,
        final_slip_mm: 0.4,
    })
    .unwrap();
    let law = Arc::new(SlipDamage::new(curve, BondSettings::default()).unwrap());
    let rule = InterfaceRule::Gauss3;
    let interface = Interface16::new(nodes, &corners, [1.0, 0.0, 0.0], rule, law).unwrap();
    let led = Led::by(Box::new(interface), &followers);
    assert_eq!(led.nodes().len(), 6);
    check_element(led.as_ref(), &places(led.as_ref(), &mesh), &in_plane()).unwrap();
}

/// K u in place of the integral; anything with a history is refused.
#[test]
fn constant_stiffness() {
    let mesh = prism();
    let coords = coords(&mesh);
    let hex = |law: Arc<dyn Material<Solid>>| {
        let element = Hex20::new(CELL, &coords, HexRule::Full, law, BandWidth::CubeRoot);
        Box::new(element.unwrap())
    };
    let elastic = Linear::new(hex(Arc::new(Elastic::new(30_000.0, 0.2).unwrap()))).unwrap();
    check_element(&elastic, &coords, &ElementCheck::new(0.05)).unwrap();
    let concrete = FixedCrackParameters::from_strength(38.0, 2.9, 33_000.0);
    let refused = Linear::new(hex(Arc::new(FixedCrack::new(concrete, None).unwrap())));
    assert!(
        refused
            .unwrap_err()
            .to_string()
            .contains("history of a linear element")
    );
    assert_eq!(elastic.dofs(), &Dof::DISPLACEMENTS);
}

/// Conditions on followers pass to their leaders, and the plane of symmetry needs no support across.
#[test]
fn conditions_follow() {
    let mesh = prism();
    let followers = Followers::uniform_across(&mesh, 0..20);
    let law: Arc<dyn Material<Solid>> = Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
    let (rule, band) = (HexRule::Full, BandWidth::CubeRoot);
    let element = UniformHex20::new(CELL, &coords(&mesh), &followers, rule, law, band).unwrap();
    let model = Model::with_followers(mesh, vec![Box::new(element)], followers).unwrap();
    // Node 16 lies half-way between node 0 on the plane of symmetry and node 4, which leads both.
    let d = |dof| model.dof(4, dof).unwrap();
    assert_eq!(model.dof(16, Dof::Ux).unwrap(), d(Dof::Ux));
    assert!(model.dof(16, Dof::Uz).is_err());
    let mut conditions = Conditions::new(&model);
    conditions.add_dead(&model, 16, Dof::Uz, 3.0).unwrap();
    conditions.add_dead(&model, 0, Dof::Uy, 2.0).unwrap();
    let mut force = vec![0.0; model.dofs().len()];
    conditions.external(0.0, &mut force);
    assert_eq!([force[d(Dof::Uz)], force[d(Dof::Uy)]], [1.5, 2.0]);
    conditions.prescribe(&model, 16, Dof::Uz, 0.5).unwrap();
    conditions.fix(&model, 0, Dof::Uz).unwrap();
    assert_eq!(conditions.prescribed()[&d(Dof::Uz)], 1.0);
    let error = conditions.prescribe(&model, 0, Dof::Uz, 1.0).unwrap_err();
    assert!(matches!(error, ModelError::UnusedDof { node: 0, .. }));
    let mut u = vec![0.0; model.dofs().len()];
    (u[d(Dof::Ux)], u[d(Dof::Uz)]) = (0.2, 0.4);
    assert_eq!(model.displacement(16, &u), [0.2, 0.0, 0.2]);
    assert_eq!(model.displacement(0, &u), [0.2, 0.0, 0.0]);

    let mut held = Conditions::new(&model);
    for (node, dof) in [(4, Dof::Ux), (4, Dof::Uy)] {
        held.fix(&model, node, dof).unwrap();
    }
    let error = check::held(&model, &held).unwrap_err().to_string();
    assert!(error.contains("turn about an axis along z"), "{error}");
    held.fix(&model, 5, Dof::Uy).unwrap();
    check::held(&model, &held).unwrap();
}
