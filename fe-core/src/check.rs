//! What makes a model move freely or fall apart, found before anything is solved.

use nalgebra::{Matrix6, Vector3, Vector6};

use crate::dof::Dof;
use crate::mesh::NodeId;
use crate::model::{Conditions, Model, ModelError};

/// Nodes closer than this share of the diagonal of the mesh lie at the same place.
const COINCIDENT: f64 = 1e-9;
/// Eigenvalues below this share of the largest count as zero.
const RANK: f64 = 1e-8;

/// Rigid motions of a part, in words.
const MOTIONS: [&str; 6] = [
    "move along x",
    "move along y",
    "move along z",
    "turn about an axis along x",
    "turn about an axis along y",
    "turn about an axis along z",
];

/// Makes sure that the conditions hold every connected part of a model against rigid motion.
///
/// Parts are connected by the nodes that elements share. A part is held if the rows of its rigid motions that belong to
/// prescribed DOFs have the rank of all its rows. Mechanisms inside a part are left to the solver.
///
/// # Errors
///
/// [`ModelError::NotHeld`] for the first part that can move, [`ModelError::ForeignConditions`] for those of another model.
pub fn held(model: &Model, conditions: &Conditions) -> Result<(), ModelError> {
    conditions.admit(model)?;
    for part in parts(model) {
        free_motion(model, conditions, &part)?;
    }
    Ok(())
}

/// Makes sure that no two nodes that elements use lie at one place without an element between them, or others between nodes
/// there: a seam that was not meant. Models with slits or notches have such nodes on purpose.
///
/// # Errors
///
/// [`ModelError::Seam`] for the first pair.
pub fn joined(model: &Model) -> Result<(), ModelError> {
    let mesh = model.mesh();
    let [low, high] = mesh.bounding_box().map(Vector3::from);
    let near = COINCIDENT * (high - low).norm();
    let mut touching: Vec<Vec<usize>> = vec![Vec::new(); mesh.nodes().len()];
    for (e, element) in model.elements().iter().enumerate() {
        for &node in element.nodes() {
            touching[node].push(e);
        }
    }
    let mut order: Vec<NodeId> = (0..touching.len())
        .filter(|&n| !touching[n].is_empty())
        .collect();
    let x = |n: NodeId| mesh.nodes()[n];
    order.sort_by(|&a, &b| x(a)[0].total_cmp(&x(b)[0]).then(a.cmp(&b)));
    let pairs = order.iter().enumerate().flat_map(|(i, &a)| {
        let close = order[i + 1..]
            .iter()
            .take_while(move |&&b| x(b)[0] - x(a)[0] <= near);
        close
            .filter(move |&&b| (Vector3::from(x(b)) - Vector3::from(x(a))).norm() <= near)
            .map(move |&b| (a, b))
    });
    let mut root: Vec<usize> = (0..touching.len()).collect();
    let between = |(a, b): &(usize, usize)| touching[*a].iter().any(|e| touching[*b].contains(e));
    for (a, b) in pairs.clone().filter(between) {
        join(&mut root, a, b);
    }
    for (a, b) in pairs {
        if find(&mut root, a) != find(&mut root, b) {
            return Err(ModelError::Seam {
                nodes: [a.min(b), a.max(b)],
                position: x(a),
            });
        }
    }
    Ok(())
}

/// Nodes of every connected part, in the order of their first nodes.
fn parts(model: &Model) -> Vec<Vec<NodeId>> {
    let n = model.mesh().nodes().len();
    let mut root: Vec<usize> = (0..n).collect();
    let mut used = vec![false; n];
    for element in model.elements() {
        let nodes = element.nodes();
        for &node in nodes {
            used[node] = true;
            join(&mut root, nodes[0], node);
        }
    }
    let mut parts: Vec<Vec<NodeId>> = vec![Vec::new(); n];
    for node in (0..n).filter(|&node| used[node]) {
        let first = find(&mut root, node);
        parts[first].push(node);
    }
    parts.retain(|part| !part.is_empty());
    parts
}

fn join(root: &mut [usize], a: usize, b: usize) {
    let (a, b) = (find(root, a), find(root, b));
    root[a.max(b)] = a.min(b);
}

fn find(root: &mut [usize], mut node: usize) -> usize {
    while root[node] != node {
        root[node] = root[root[node]];
        node = root[node];
    }
    node
}

/// Row of a DOF in the rigid motions about `centre`: translations, and rotations times `size` (mm).
fn row(model: &Model, node: NodeId, dof: Dof, centre: Vector3<f64>, size: f64) -> Vector6<f64> {
    let r = (Vector3::from(model.mesh().nodes()[node]) - centre) / size;
    let row = match dof {
        Dof::Ux => [1.0, 0.0, 0.0, 0.0, r.z, -r.y],
        Dof::Uy => [0.0, 1.0, 0.0, -r.z, 0.0, r.x],
        Dof::Uz => [0.0, 0.0, 1.0, r.y, -r.x, 0.0],
        Dof::Rx => [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
        Dof::Ry => [0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
        Dof::Rz => [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    };
    row.into()
}

/// Refuses a part that can move as a rigid body.
fn free_motion(model: &Model, conditions: &Conditions, part: &[NodeId]) -> Result<(), ModelError> {
    let position = |n: NodeId| Vector3::from(model.mesh().nodes()[n]);
    let centre = part.iter().map(|&n| position(n)).sum::<Vector3<f64>>() / part.len() as f64;
    let reach = part.iter().map(|&n| (position(n) - centre).norm());
    let size = reach.fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    // Normal equations: R^T R of all DOFs of the part, and of those that are prescribed or that the part cannot take up.
    let (mut all, mut held) = (Matrix6::zeros(), Matrix6::zeros());
    for &node in part {
        for dof in Dof::ALL {
            let Some(d) = model.dofs().index(node, dof) else {
                continue;
            };
            let r = row(model, node, dof, centre, size);
            let square = r * r.transpose();
            all += square;
            if conditions.prescribed().contains_key(&d) {
                held += square;
            }
        }
    }
    for (node, leader, factors) in model.followers().iter() {
        if part.binary_search(&leader).is_err() {
            continue;
        }
        for (dof, factor) in Dof::DISPLACEMENTS.into_iter().zip(factors) {
            let tie = row(model, node, dof, centre, size)
                - factor * row(model, leader, dof, centre, size);
            held += tie * tie.transpose();
        }
    }
    let eigen = held.symmetric_eigen();
    let largest = eigen.eigenvalues.max().max(1.0);
    for k in 0..6 {
        if eigen.eigenvalues[k] > RANK * largest {
            continue;
        }
        // A motion the conditions do not see; it counts if it moves the part at all.
        let mode = eigen.eigenvectors.column(k);
        let moves = mode.dot(&(all * mode));
        if moves > RANK * part.len() as f64 {
            let largest = mode.iter().map(|m| m.abs()).enumerate();
            let motion = largest.fold(
                (0, 0.0),
                |best, (i, m)| {
                    if m > best.1 + 1e-9 { (i, m) } else { best }
                },
            );
            return Err(ModelError::NotHeld {
                node: part[0],
                position: model.mesh().nodes()[part[0]],
                nodes: part.len(),
                motion: MOTIONS[motion.0],
            });
        }
    }
    Ok(())
}
