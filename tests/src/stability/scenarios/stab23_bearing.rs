//! STAB-23: a block of 20-node hexahedra on a unilateral bearing: faces without tensile strength, which press with their full
//! stiffness when closed and carry nothing when open.
//!
//! A uniform pressure has consistent forces of -1/12 at the corners, so that corners pull at the ground and would lift one
//! after the other if nodes were released by the sign of their forces. Here points of faces open and close, by their own
//! tractions: targets, 1 MPa at every point within 1e-6, in no more than three iterations, while the corner does pull.
//!
//! That the bearing is unilateral shows under a pressure on half of the block, out of the kern. Source: statics of a rigid
//! block on springs that take no tension: with the eccentricity b/4 it is in contact over 3 (b/2 - b/4) = 75 mm of 100 mm, and
//! presses by 2 N/(75 mm) = 4/3 MPa at its edge; faces that stay together would have 1.25 MPa there and 0.25 MPa of tension
//! at the other. Targets: no tension beyond the strength given, 1e-6 MPa; 3/4 of the points closed; the edge within 2 %
//! (the block is 60 times stiffer than the bearing, not rigid).

use std::sync::Arc;

use fe_contact::{Interface, Interface16, InterfaceRule, MixedMode, MixedModeParameters};
use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::material::Material;
use fe_core::mesh::{CellKind, Mesh, NodeId};
use fe_core::model::{Conditions, Model};
use fe_elements::HexRule;
use fe_elements::loads::face_traction;
use fe_solver::control::StepControl;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use nalgebra::Vector3;

use crate::conditions::push;
use crate::laws;
use crate::mesh::{BLOCK, boxes, faces, hexahedra, lines};
use crate::solve::run;
use crate::stability::{Case, Failure, Figure, Method, Scenario};

/// Side of the block (mm).
const SIDE: f64 = 100.0;
/// Its height (mm).
const HEIGHT: f64 = 50.0;
/// Tensile strength of the bearing (MPa), as good as none.
const STRENGTH: f64 = 1e-6;

/// Faces that press but do not pull.
fn bearing(stiffness: f64) -> Result<Arc<dyn Material<Interface>>, Failure> {
    let energy = STRENGTH * STRENGTH / stiffness;
    let law = MixedMode::new(MixedModeParameters {
        stiffness_mpa_per_mm: stiffness,
        normal_strength_mpa: STRENGTH,
        shear_strength_mpa: STRENGTH,
        mode_1_energy_n_per_mm: energy,
        mode_2_energy_n_per_mm: energy,
        exponent: 1.0,
        residual: 1e-6,
    })?;
    Ok(Arc::new(law))
}

/// What came of a block.
struct Stood {
    /// Least and largest normal traction (MPa) below it, compression negative.
    range: [f64; 2],
    /// Share of the points that are closed.
    closed: f64,
    /// Force (N) along z of the ground on the node at the origin.
    corner: f64,
    iterations: usize,
}

/// A block of `n` by two cells on a bearing of a stiffness (MPa/mm), under 1 MPa on its top from `from` (mm) on.
fn stand(n: usize, stiffness: f64, rule: InterfaceRule, from: f64) -> Result<Stood, Failure> {
    let [x, y] = [n, 2].map(|n| lines(0.0, SIDE, n));
    let block = boxes(&x, &y, &lines(0.0, HEIGHT, 1))?;
    let count = block.nodes().len();
    let mut nodes = block.nodes().to_vec();
    nodes.extend_from_slice(block.nodes());
    let mut mesh = Mesh::new(nodes)?;
    let connectivity: Vec<NodeId> = block.blocks()[0].cells().flatten().copied().collect();
    mesh.add_block(BLOCK, CellKind::Hex20, connectivity)?;
    let mut elements = hexahedra(&mesh, HexRule::Full, &laws::elastic(30_000.0, 0.0)?)?;
    let solid = elements.len();
    let law = bearing(stiffness)?;
    let mut ground = Vec::new();
    for face in faces(&block, |x| x[2] == 0.0) {
        let coords = face.map(|n| block.nodes()[n]);
        let pair = std::array::from_fn(|a| if a < 8 { face[a] } else { count + face[a - 8] });
        let contact = Interface16::new(pair, &coords, [1.0, 0.0, 0.0], rule, law.clone())?;
        elements.push(Box::new(contact) as Box<dyn Element>);
        ground.extend(face.map(|n| count + n));
    }
    let model = Model::new(mesh, elements)?;
    let mut conditions = Conditions::new(&model);
    for &node in &ground {
        for dof in Dof::DISPLACEMENTS {
            conditions.fix(&model, node, dof)?;
        }
    }
    for (node, x) in block.nodes().iter().enumerate() {
        conditions.fix(&model, node, Dof::Uy)?;
        if x[2] == 0.0 {
            conditions.fix(&model, node, Dof::Ux)?;
        }
    }
    for nodes in faces(&block, |x| x[2] == HEIGHT && x[0] >= from) {
        let coords = nodes.map(|n| block.nodes()[n]);
        let forces = face_traction(&nodes, &coords, |_| -Vector3::z());
        push(&model, &mut conditions, &forces)?;
    }
    let control = StepControl {
        criterion: 1e-9,
        ..StepControl::new(1.0, 1.0)
    };
    let mut driver = NewtonRaphson::new(NewtonSettings::default());
    let mut iterations = 0;
    let count = |_: &_| iterations += 1;
    let solution = run(&model, conditions, &control, &mut driver, count, |_| {})?;
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    let (mut points, mut closed) = (0.0, 0.0);
    for (e, element) in model.elements().iter().enumerate().skip(solid) {
        let u = model.gather(e, &solution.displacement);
        element.sample(&u, solution.state.committed(e), &mut |s| {
            range = [range[0].min(s.stress[2]), range[1].max(s.stress[2])];
            points += 1.0;
            closed += if s.stress[2] < 0.0 { 1.0 } else { 0.0 };
        })?;
    }
    let origin = ground
        .iter()
        .copied()
        .find(|&n| model.mesh().nodes()[n] == [0.0; 3])
        .ok_or("no corner")?;
    Ok(Stood {
        range,
        closed: closed / points,
        corner: solution.reaction(&model, &[origin], Dof::Uz),
        iterations,
    })
}

fn figures() -> Result<Vec<Figure>, Failure> {
    let mut figures = Vec::new();
    for rule in [InterfaceRule::Gauss3, InterfaceRule::Lobatto3] {
        let even = stand(2, 1e4, rule, 0.0)?;
        let name = |what: &str| format!("{what}, {rule:?}");
        let [least, largest] = even.range;
        figures.push(Figure::near(name("least traction, MPa"), least, -1.0, 1e-6));
        figures.push(Figure::near(
            name("largest traction, MPa"),
            largest,
            -1.0,
            1e-6,
        ));
        let face = 0.25 * SIDE * SIDE;
        figures.push(Figure::near(
            name("force at the corner over that on its face"),
            even.corner / face,
            -1.0 / 12.0,
            1e-6,
        ));
        figures.push(Figure::at_most(
            name("iterations"),
            even.iterations as f64,
            3.0,
        ));
        let aside = stand(8, 10.0, rule, 0.5 * SIDE)?;
        figures.push(Figure::at_most(
            name("tension under half a load, MPa"),
            aside.range[1],
            STRENGTH,
        ));
        // Points of Lobatto's rule lie where contact ends, a row of them twice.
        figures.push(Figure::near(
            name("points closed"),
            aside.closed,
            0.75,
            0.06,
        ));
        figures.push(Figure::near(
            name("largest pressure, MPa"),
            -aside.range[0],
            4.0 / 3.0,
            0.02,
        ));
        figures.push(Figure::at_most(
            name("iterations"),
            aside.iterations as f64,
            15.0,
        ));
    }
    Ok(figures)
}

/// The scenario.
pub const SCENARIO: Scenario = Scenario {
    id: "STAB-23",
    title: "unilateral bearing: lifts under half a pressure, not under a uniform one",
    remark: "",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| figures().map(Case::checked)),
};
