//! Two arms of E = 120 000 MPa, 20 mm wide and 1.5 mm thick, held together by G_c = 0.28 N/mm: double cantilever beam and
//! end-notched flexure, with beam theory for both.

use std::sync::Arc;

use fe_contact::envelope::{Bilinear, BilinearSlips};
use fe_contact::{
    BondSettings, Interface, Interface16, InterfaceRule, MixedMode, MixedModeParameters, SlipDamage,
};
use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::material::Material;
use fe_core::mesh::{CellKind, Mesh, NodeId};
use fe_core::model::{Conditions, Model};
use fe_elements::HexRule;
use fe_materials::Elastic;

use crate::conditions::hold;
use crate::follow::Path;
use crate::mesh::{BLOCK, boxes, faces, hexahedra, lines, nodes_where};

/// Young's modulus of the arms (MPa).
pub const YOUNG: f64 = 120_000.0;
/// Width (mm).
pub const B: f64 = 20.0;
/// Thickness of an arm (mm).
pub const H: f64 = 1.5;
/// Fracture energy (N/mm).
pub const ENERGY: f64 = 0.28;
/// Half of the span L of the end-notched flexure specimen (mm), loaded in the middle.
pub const HALF_SPAN: f64 = 50.0;

/// Shear strength (MPa) of the delamination where nothing else is said.
pub const SHEAR_STRENGTH: f64 = 40.0;

/// Delamination in both modes, of a shear strength (MPa).
///
/// # Panics
///
/// For a strength that is not positive.
pub fn delamination(shear_strength_mpa: f64) -> Arc<dyn Material<Interface>> {
    let law = MixedMode::new(MixedModeParameters {
        stiffness_mpa_per_mm: 1e5,
        normal_strength_mpa: 15.0,
        shear_strength_mpa,
        mode_1_energy_n_per_mm: ENERGY,
        mode_2_energy_n_per_mm: ENERGY,
        exponent: 2.0,
        residual: 1e-6,
    });
    Arc::new(law.expect("a specimen"))
}

/// Faces that cannot part and hardly resist slip.
///
/// # Panics
///
/// Never for lengths that are positive.
pub fn slides() -> Arc<dyn Material<Interface>> {
    let curve = Bilinear::from_slips(&BilinearSlips {
        strength_mpa: 1e-6,
        peak_slip_mm: 1e-6,
        final_slip_mm: 2e-6,
    });
    let settings = BondSettings {
        normal_over_initial: 1e5,
        ..BondSettings::default()
    };
    Arc::new(SlipDamage::new(curve.expect("a specimen"), settings).expect("a specimen"))
}

/// Two arms with an interface whose law depends on the place of the face along x; none where there is no law.
///
/// # Panics
///
/// Never for lengths that are positive.
pub fn arms(x: &[f64], law: impl Fn(f64) -> Option<Arc<dyn Material<Interface>>>) -> Model {
    let lower = boxes(x, &[0.0, B], &[-H, 0.0]).expect("a specimen");
    let count = lower.nodes().len();
    let mut nodes = lower.nodes().to_vec();
    nodes.extend(lower.nodes().iter().map(|[x, y, z]| [*x, *y, z + H]));
    let mut mesh = Mesh::new(nodes).expect("a specimen");
    let mut cells: Vec<NodeId> = lower.blocks()[0].cells().flatten().copied().collect();
    cells.extend(cells.clone().iter().map(|n| n + count));
    mesh.add_block(BLOCK, CellKind::Hex20, cells)
        .expect("a specimen");

    let arm: Arc<dyn Material<_>> = Arc::new(Elastic::new(YOUNG, 0.0).expect("a specimen"));
    let mut elements = hexahedra(&mesh, HexRule::Reduced, &arm).expect("a specimen");
    let upper = nodes_where(&mesh, |x| x[2] == 0.0)
        .into_iter()
        .filter(|&n| n >= count);
    let upper: Vec<NodeId> = upper.collect();
    for face in faces(&lower, |x| x[2] == 0.0) {
        let coords = face.map(|n| mesh.nodes()[n]);
        let Some(law) = law(0.5 * (coords[0][0] + coords[2][0])) else {
            continue;
        };
        let above = |n: NodeId| {
            *upper
                .iter()
                .find(|&&u| mesh.nodes()[u] == mesh.nodes()[n])
                .expect("a specimen")
        };
        let nodes = std::array::from_fn(|a| if a < 8 { face[a] } else { above(face[a - 8]) });
        let rule = InterfaceRule::Gauss3;
        let element =
            Interface16::new(nodes, &coords, [1.0, 0.0, 0.0], rule, law).expect("a specimen");
        elements.push(Box::new(element) as Box<dyn Element>);
    }
    Model::new(mesh, elements).expect("a specimen")
}

/// Grid lines: 5 mm outside, 1 mm between `from` and `to`.
pub fn graded(from: f64, to: f64, end: f64) -> Vec<f64> {
    let mut x = lines(0.0, from, (from / 5.0).ceil() as usize);
    x.extend(
        lines(from, to, (to - from).round() as usize)
            .into_iter()
            .skip(1),
    );
    x.extend(
        lines(to, end, ((end - to) / 5.0).ceil() as usize)
            .into_iter()
            .skip(1),
    );
    x
}

/// Load and displacement of the double cantilever beam at a crack length (mm).
pub fn dcb(a: f64) -> [f64; 2] {
    let load = (ENERGY * B * B * YOUNG * H.powi(3) / 12.0).sqrt() / a;
    [load, 8.0 * load * a.powi(3) / (YOUNG * B * H.powi(3))]
}

/// Load and displacement of the end-notched flexure specimen.
pub fn enf(a: f64) -> [f64; 2] {
    let load = 4.0 * B / (3.0 * a) * (ENERGY * YOUNG * H.powi(3)).sqrt();
    let give = (2.0 * HALF_SPAN.powi(3) + 3.0 * a.powi(3)) / (8.0 * B * H.powi(3) * YOUNG);
    [load, load * give]
}

/// An end-notched specimen with its supports, and the nodes that are loaded. The faces of the notch slide.
///
/// # Panics
///
/// Never for lengths that are positive.
pub fn notched(notch: f64, shear_strength_mpa: f64) -> (Model, Conditions, Vec<NodeId>) {
    let [left, right] = [0.0, 2.0 * HALF_SPAN];
    let model = arms(&graded(notch, 52.0, right), |x| {
        Some(if x > notch {
            delamination(shear_strength_mpa)
        } else {
            slides()
        })
    });
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &[Dof::Uy], |_| true).expect("a specimen");
    hold(&model, &mut conditions, &[Dof::Uz], |x| {
        (x[0] == left || x[0] == right) && x[2] == -H
    })
    .expect("a specimen");
    hold(&model, &mut conditions, &[Dof::Ux], |x| {
        x[0] == right && x[2] == -H
    })
    .expect("a specimen");
    let loaded = nodes_where(model.mesh(), |x| x[0] == HALF_SPAN && x[2] == H);
    (model, conditions, loaded)
}

/// The path from its largest force on.
pub fn falling(path: &Path) -> &[[f64; 2]] {
    let points = &path.points;
    let peak = (0..points.len())
        .max_by(|&a, &b| points[a][0].total_cmp(&points[b][0]))
        .unwrap_or(0);
    &points[peak..]
}

/// Largest displacement (mm) up to where the path is at its smallest from the largest force on.
pub fn upper_turn(path: &Path) -> f64 {
    let falling = falling(path);
    let least = least(falling);
    let until =
        path.points.len() - falling.len() + falling.iter().position(|p| p[1] == least).unwrap_or(0);
    let before = path.points.iter().take(until + 1);
    before.map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max)
}

/// Smallest displacement (mm) of some points.
pub fn least(points: &[[f64; 2]]) -> f64 {
    points.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min)
}

/// Whether the displacement has turned twice.
pub fn turned(path: &Path) -> bool {
    let falling = falling(path);
    path.points.last().is_some_and(|[force, w]| {
        falling[0][0] > 300.0 && *force < 240.0 && *w > least(falling) + 0.05
    })
}

/// An end-notched specimen under a force.
///
/// # Panics
///
/// Never for lengths that are positive.
pub fn under_force(notch: f64, shear_strength_mpa: f64) -> (Model, Conditions) {
    let (model, mut conditions, loaded) = notched(notch, shear_strength_mpa);
    for node in loaded {
        let y = model.mesh().nodes()[node][1];
        let corner = y == 0.0 || y == B;
        let share = if corner { 1.0 / 6.0 } else { 4.0 / 6.0 };
        conditions
            .add_reference(&model, node, Dof::Uz, -share)
            .expect("a specimen");
    }
    (model, conditions)
}

/// Distance of a displacement (mm) from that of beam theory at the load (N), relative to it.
pub fn off(load: f64, w: f64) -> f64 {
    (w / enf(enf(1.0)[0] / load)[1] - 1.0).abs()
}
