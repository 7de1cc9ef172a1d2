//! A quarter of the Scordelis-Lo roof in 4 x 4 shells under its weight, against the published deflection.

use std::sync::Arc;

use fe_core::assembly::{Assembled, Assembler};
use fe_core::dof::Dof::{self, Rx, Ry, Rz, Ux, Uy, Uz};
use fe_core::element::{Element, EvaluationContext};
use fe_core::material::Operator;
use fe_core::mesh::{CellKind, Mesh};
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_elements::loads::face_traction;
use fe_elements::{Layer, QuadRule, Shell8, ShellSection};
use fe_materials::Elastic;
use nalgebra::{DMatrix, DVector, Vector3};

const N: usize = 4;
const SIDE: usize = 2 * N + 1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Radius 25, length 50, opening 80 degrees; the middles of the cells belong to no element.
    let place = |k: usize| {
        let (i, j) = ((k % SIDE) as f64 / 8.0, (k / SIDE) as f64 / 8.0);
        let (sine, cosine) = (40.0_f64.to_radians() * j).sin_cos();
        [25.0 * i, 25.0 * sine, 25.0 * cosine]
    };
    let mut mesh = Mesh::new((0..SIDE * SIDE).map(place).collect())?;
    let corner = |c: usize| 2 * (c % N) + 2 * (c / N) * SIDE;
    let around = [
        0,
        2,
        2 * SIDE + 2,
        2 * SIDE,
        1,
        SIDE + 2,
        2 * SIDE + 1,
        SIDE,
    ];
    let cells = (0..N * N).flat_map(|c| around.map(|step| corner(c) + step));
    mesh.add_block("roof", CellKind::Quad8, cells.collect())?;

    let section = ShellSection::new(vec![Layer {
        thickness_mm: 0.25,
        angle_deg: 0.0,
        law: Arc::new(Elastic::new(4.32e8, 0.0)?),
        shear_mpa: [2.16e8; 2],
    }]);
    let along = [1.0, 0.0, 0.0];
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    for cell in mesh.blocks()[0].cells() {
        let nodes = std::array::from_fn(|a| cell[a]);
        let coords = nodes.map(|n| mesh.nodes()[n]);
        let shell = Shell8::new(nodes, &coords, &section, QuadRule::Reduced, along)?;
        elements.push(Box::new(shell));
    }
    let model = Model::new(mesh, elements);

    let mut conditions = Conditions::new(&model);
    let used = |n: usize| model.dof(n, Ux).is_ok();
    for n in (0..SIDE * SIDE).filter(|&n| used(n)) {
        let held: [(bool, &[Dof]); 3] = [
            (n % SIDE == SIDE - 1, &[Uy, Uz]), // diaphragm
            (n % SIDE == 0, &[Ux, Ry, Rz]),    // symmetry
            (n / SIDE == 0, &[Uy, Rx, Rz]),    // crown
        ];
        for &dof in held.iter().filter(|h| h.0).flat_map(|h| h.1) {
            conditions.fix(&model, n, dof)?;
        }
    }
    for element in model.elements() {
        let nodes: [usize; 8] = std::array::from_fn(|a| element.nodes()[a]);
        let coords = nodes.map(|n| model.mesh().nodes()[n]);
        for (n, f) in face_traction(&nodes, &coords, |_| Vector3::new(0.0, 0.0, -90.0)) {
            conditions.add_reference(&model, n, Uz, f[2])?;
        }
    }

    let mut assembler = Assembler::new(&model, &conditions);
    let mut out = Assembled::default();
    let mut state = StateStore::new(model.elements());
    let rest = vec![0.0; model.dofs().len()];
    let ctx = EvaluationContext::new(Operator::Tangent);
    assembler.evaluate(&model, &rest, &mut state, &ctx, &mut out)?;
    let (free, csc) = (assembler.free(), out.matrix.to_csc(assembler.pattern()));
    let k = DMatrix::from_fn(free.len(), free.len(), |i, j| {
        csc.get(i, j).copied().unwrap_or(0.0)
    });
    let f = DVector::from_fn(free.len(), |i, _| conditions.reference()[free[i] as usize]);
    let u = k.cholesky().ok_or("the model is not held")?.solve(&f);

    // The middle of the free edge: MacNeal and Harder (1985) give 0.3024.
    let edge = model.dof((SIDE - 1) * SIDE, Uz)? as u32;
    let row = free.iter().position(|&d| d == edge).ok_or("held")?;
    println!("{:.4}, published 0.3024", -u[row]);
    assert!((-u[row] / 0.3024 - 1.0).abs() < 5e-3);
    Ok(())
}
