//! A sound model spoilt at 180 places and in nine ways.
//!
//! Source: a prism under uniaxial tension, u = F L/(A E). Target: missing supports, elements without stiffness, inverted
//! and folded elements, doubled nodes, disconnected parts and numbers that are none end in an error that names the
//! place; what spoils nothing gives u within 1e-9. Never a panic, never a wrong answer.

use std::error::Error;
use std::sync::Arc;

use fe_core::check;
use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::mesh::{CellKind, Mesh, NodeId};
use fe_core::model::{Conditions, Model};
use fe_core::testing::Random;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::Elastic;
use fe_tests::mesh::{BLOCK, boxes, lines, nodes_where};
use fe_tests::solve::solve;

const LENGTH: f64 = 80.0;
const SIDE: f64 = 20.0;
const YOUNG: f64 = 30_000.0;
const FORCE: f64 = 1000.0;

/// What a model is made from, open to be spoilt.
struct Parts {
    nodes: Vec<[f64; 3]>,
    cells: Vec<[NodeId; 20]>,
    young: f64,
    /// Held DOFs with their rates.
    held: Vec<(NodeId, Dof, f64)>,
    forces: Vec<(NodeId, f64)>,
}

impl Parts {
    fn sound() -> Self {
        let across = lines(0.0, SIDE, 2);
        let mesh = boxes(&lines(0.0, LENGTH, 4), &across, &across).unwrap();
        let cells = mesh.block(BLOCK).unwrap().cells();
        let cells = cells.map(|c| std::array::from_fn(|a| c[a])).collect();
        let mut held: Vec<_> = nodes_where(&mesh, |x| x[0] == 0.0)
            .into_iter()
            .map(|n| (n, Dof::Ux, 0.0))
            .collect();
        let at = |p: [f64; 3]| nodes_where(&mesh, |x| x == p)[0];
        held.extend([
            (at([0.0; 3]), Dof::Uy, 0.0),
            (at([0.0; 3]), Dof::Uz, 0.0),
            (at([0.0, 0.0, SIDE]), Dof::Uy, 0.0),
        ]);
        // Consistent forces of a uniform stress on 8-node faces: -1/12 in a corner, 1/3 in the middle of an edge.
        let mut forces: Vec<(NodeId, f64)> = Vec::new();
        for face in fe_tests::mesh::faces(&mesh, |x| x[0] == LENGTH) {
            for (i, n) in face.into_iter().enumerate() {
                let share = if i < 4 { -1.0 / 12.0 } else { 1.0 / 3.0 };
                forces.push((n, FORCE / 4.0 * share));
            }
        }
        Self {
            nodes: mesh.nodes().to_vec(),
            cells,
            young: YOUNG,
            held,
            forces,
        }
    }

    /// Displacement (mm) of the loaded end, the same at all its nodes.
    fn solve(&self) -> Result<f64, Box<dyn Error>> {
        let mut mesh = Mesh::new(self.nodes.clone())?;
        let flat = self.cells.iter().flatten().copied().collect();
        mesh.add_block(BLOCK, CellKind::Hex20, flat)?;
        let law: Arc<dyn Material<Solid>> = Arc::new(Elastic::new(self.young, 0.2)?);
        let mut elements: Vec<Box<dyn Element>> = Vec::new();
        for &cell in &self.cells {
            let coords = cell.map(|n| mesh.nodes()[n]);
            let (law, band) = (Arc::clone(&law), BandWidth::CubeRoot);
            elements.push(Box::new(Hex20::new(
                cell,
                &coords,
                HexRule::Reduced,
                law,
                band,
            )?));
        }
        let model = Model::new(mesh, elements).unwrap();
        let mut conditions = Conditions::new(&model);
        for &(node, dof, rate) in &self.held {
            conditions.prescribe(&model, node, dof, rate)?;
        }
        for &(node, force) in &self.forces {
            conditions.add_reference(&model, node, Dof::Ux, force)?;
        }
        check::joined(&model)?;
        check::held(&model, &conditions)?;
        let solution = solve(&model, conditions)?;
        Ok(solution.at(&model, self.forces[0].0, Dof::Ux))
    }

    /// Node and cell of no choice.
    fn corner(&self, chance: &mut Random) -> (usize, usize) {
        (chance.below(self.cells.len()), chance.below(20))
    }
}

type Spoil = fn(&mut Parts, &mut Random);

/// Ways to spoil a model, and words of the message; none where a sound model may come out.
const WAYS: [(&str, Option<&str>, Spoil); 9] = [
    ("missing support", Some("can "), |p, c| {
        let dof = [Dof::Ux, Dof::Uy, Dof::Uz][c.below(3)];
        p.held.retain(|h| h.1 != dof);
    }),
    ("stiffness", Some("young_mpa"), |p, c| {
        p.young = [0.0, -1.0, f64::NAN, f64::INFINITY, -YOUNG][c.below(5)];
    }),
    ("inverted element", Some("Jacobian"), |p, c| {
        let (e, _) = p.corner(c);
        let a = c.below(4);
        for (i, j) in [(a, a + 4), (a + 8, a + 12)] {
            p.cells[e].swap(i, j);
        }
    }),
    ("node moved", None, |p, c| {
        // Inside of the prism only: its shape stays.
        let inside = |x: &[f64; 3]| {
            x[0] > 0.0 && x[0] < LENGTH && [x[1], x[2]].iter().all(|&t| t > 0.0 && t < SIDE)
        };
        let all: Vec<usize> = (0..p.nodes.len())
            .filter(|&n| inside(&p.nodes[n]))
            .collect();
        let node = all[c.below(all.len())];
        let size = c.uniform(0.0, 12.0);
        for k in 0..3 {
            p.nodes[node][k] += c.uniform(-size, size);
        }
    }),
    ("node doubled", Some("no element connects them"), |p, c| {
        let (mut e, mut a) = p.corner(c);
        let shared = |node| p.cells.iter().filter(|cell| cell.contains(&node)).count();
        while shared(p.cells[e][a]) == 1 {
            (e, a) = p.corner(c);
        }
        let node = p.cells[e][a];
        p.nodes.push(p.nodes[node]);
        p.cells[e][a] = p.nodes.len() - 1;
    }),
    ("part cut off", Some("can move along"), |p, c| {
        // Not at the ends, where its nodes are held or loaded.
        let mut e = p.corner(c).0;
        while p.cells[e]
            .iter()
            .any(|&n| [0.0, LENGTH].contains(&p.nodes[n][0]))
        {
            e = p.corner(c).0;
        }
        for a in 0..20 {
            let [x, y, z] = p.nodes[p.cells[e][a]];
            p.nodes.push([x, y + 100.0, z]);
            let copy = p.nodes.len() - 1;
            p.cells[e][a] = copy;
        }
    }),
    ("slice removed", Some("can move along"), |p, c| {
        let slice = LENGTH / 4.0 * (1 + c.below(2)) as f64;
        let nodes = p.nodes.clone();
        p.cells.retain(|cell| {
            let x = cell.iter().map(|&n| nodes[n][0]).sum::<f64>() / 20.0;
            x < slice || x > slice + LENGTH / 4.0
        });
    }),
    ("not a number", Some("finite"), |p, c| {
        let bad = [f64::NAN, f64::INFINITY][c.below(2)];
        match c.below(3) {
            0 => {
                let i = c.below(p.forces.len());
                p.forces[i].1 = bad;
            }
            1 => {
                let i = c.below(p.held.len());
                p.held[i].2 = bad;
            }
            _ => {
                let i = c.below(p.nodes.len());
                p.nodes[i][c.below(3)] = bad;
            }
        }
    }),
    ("no such node", Some("refers to node"), |p, c| {
        let (e, a) = p.corner(c);
        p.cells[e][a] = p.nodes.len() + c.below(1000);
    }),
];

#[test]
fn spoilt_models_are_refused_or_right() {
    let exact = FORCE * LENGTH / (SIDE * SIDE * YOUNG);
    let sound = Parts::sound().solve().unwrap();
    assert!((sound / exact - 1.0).abs() < 1e-9, "{sound} {exact}");
    let (mut refused, mut right) = (0, 0);
    for (way, words, spoil) in WAYS {
        for seed in 0..20 {
            let mut chance = Random::new(seed);
            let mut parts = Parts::sound();
            spoil(&mut parts, &mut chance);
            match (parts.solve(), words) {
                (Err(error), words) => {
                    refused += 1;
                    let message = error.to_string();
                    let words = words.unwrap_or("Jacobian");
                    assert!(message.contains(words), "{way} {seed}: {message}");
                }
                (Ok(u), None) => {
                    right += 1;
                    assert!(
                        (u / exact - 1.0).abs() < 1e-9,
                        "{way} {seed}: {u} for {exact}"
                    );
                }
                (Ok(u), Some(_)) => panic!("{way} {seed}: accepted, {u} for {exact}"),
            }
        }
    }
    assert!(
        refused >= 160 && right >= 5,
        "{refused} refused, {right} right"
    );
}
