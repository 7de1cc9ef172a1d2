//! Self weight: a body force of 24.9 kN/m3 in a block.
//!
//! Source: equilibrium. Target: reactions equal to weight density times volume within 1e-10; the weight acts at the centre.

use fe_core::dof::Dof;
use fe_core::model::{Conditions, Model};
use fe_elements::HexRule;
use fe_elements::loads::body_force;
use fe_tests::conditions::{hold, push};
use fe_tests::laws::elastic;
use fe_tests::mesh::{boxes, cells, hexahedra, lines, mapped};
use fe_tests::solve::solve;

/// Weight per volume (N/mm3).
const DENSITY: f64 = 24.9e-6;

/// Protects consistent body forces, also in distorted cells: inner nodes of the block are moved, which leaves its volume
/// and centre as they are.
#[test]
fn reactions_carry_the_weight() {
    let size = [1000.0, 300.0, 150.0];
    let straight = boxes(
        &lines(0.0, size[0], 8),
        &lines(0.0, size[1], 3),
        &lines(0.0, size[2], 2),
    );
    let mesh = mapped(&straight.unwrap(), |x| {
        let inside = (0..3).all(|k| x[k] > 0.0 && x[k] < size[k]);
        let shift = |k: usize| 8.0 * (0.05 * x[(k + 1) % 3] + 0.03 * x[k]).sin();
        std::array::from_fn(|k| x[k] + if inside { shift(k) } else { 0.0 })
    })
    .unwrap();
    let law = elastic(30_000.0, 0.2).unwrap();
    let model = Model::new(
        mesh.clone(),
        hexahedra(&mesh, HexRule::Reduced, &law).unwrap(),
    )
    .unwrap();
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &Dof::DISPLACEMENTS, |x| {
        x[0] == 0.0
    })
    .unwrap();
    for (nodes, coords) in cells(&mesh, &mesh.blocks()[0]) {
        push(
            &model,
            &mut conditions,
            &body_force(&nodes, &coords, [0.0, -DENSITY, 0.0]),
        )
        .unwrap();
    }
    let weight = DENSITY * size.iter().product::<f64>();
    // 27 points integrate the volume of a distorted cell exactly, its first moment nearly.
    let load = |node: usize| conditions.reference()[model.dof(node, Dof::Uy).unwrap()];
    let moment: f64 = mesh
        .nodes()
        .iter()
        .enumerate()
        .map(|(n, x)| x[0] * load(n))
        .sum();
    assert!(
        (moment / (-0.5 * weight * size[0]) - 1.0).abs() < 1e-5,
        "{moment}"
    );
    let solution = solve(&model, conditions).unwrap();
    let root: Vec<usize> = (0..mesh.nodes().len())
        .filter(|&n| mesh.nodes()[n][0] == 0.0)
        .collect();
    let [x, y, z] = Dof::DISPLACEMENTS.map(|dof| solution.reaction(&model, &root, dof));
    assert!((y / weight - 1.0).abs() < 1e-10, "{y} {weight}");
    assert!(x.hypot(z) < 1e-8 * weight, "{x} {z}");
}
