//! A column of single hexahedra amid cracked ones.

use fe_core::dof::Dof;
use fe_core::grid::GridBuilder;
use fe_core::model::{Conditions, Model};
use fe_elements::HexRule;

use crate::conditions::hold;
use crate::dense::{DenseModel, energy};
use crate::laws::elastic;
use crate::mesh::{boxes, hexahedra, hexahedra_of, lines, nodes_where};

/// What keeps the scene from being set up.
type Failure = Box<dyn std::error::Error>;

/// EL-03c: a sound column of one by one cells amid cracked neighbours, whose stiffness is `residual` of its own. Energy
/// of a mechanism of the column, the outer nodes at rest.
///
/// # Errors
///
/// Whatever element or model refuse.
pub fn energy_of_a_mechanism(rule: HexRule, residual: f64) -> Result<f64, Failure> {
    let side = lines(0.0, 50.0, 1);
    let mesh = boxes(&lines(0.0, 200.0, 4), &side, &side)?;
    let elements = hexahedra(&mesh, HexRule::Reduced, &elastic(30_000.0, 0.2)?)?;
    let alone = Model::new(mesh, elements)?;
    let mut clamped = Conditions::new(&alone);
    hold(&alone, &mut clamped, &Dof::DISPLACEMENTS, |x| x[0] == 0.0)?;
    let shape = DenseModel::new(&alone, &clamped)?
        .mechanism()
        .ok_or("no mechanism")?;

    let length = lines(0.0, 200.0, 4);
    let [low, middle, high] = [[-50.0, 0.0], [0.0, 50.0], [50.0, 100.0]];
    let mut grid = GridBuilder::new();
    grid.add_box("column", &length, &middle, &middle);
    for y in [low, middle, high] {
        for z in [low, middle, high] {
            if (y, z) != (middle, middle) {
                grid.add_box("cracked", &length, &y, &z);
            }
        }
    }
    let mesh = grid.finish()?;
    let mut elements = Vec::new();
    for (block, young) in mesh.blocks().iter().zip([30_000.0, 30_000.0 * residual]) {
        let law = elastic(young, 0.2)?;
        elements.extend(hexahedra_of(&mesh, block, rule, &law)?);
    }
    let model = Model::new(mesh, elements)?;
    let mut u = vec![0.0; model.dofs().len()];
    for (node, x) in alone.mesh().nodes().iter().enumerate() {
        let same = nodes_where(model.mesh(), |y| y == *x)[0];
        for dof in Dof::DISPLACEMENTS {
            u[model.dof(same, dof)?] = shape[alone.dof(node, dof)?];
        }
    }
    Ok(energy(&model, &u)?)
}
