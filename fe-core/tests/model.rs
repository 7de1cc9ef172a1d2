//! Protects mesh, numbering, conditions and the state store.

mod common;

use std::sync::Arc;

use common::{Brick, Damage, Flaw, Truss};
use fe_core::assembly::Assembler;
use fe_core::check;
use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::followers::Followers;
use fe_core::grid::GridBuilder;
use fe_core::mesh::{Block, CellKind, Mesh, MeshError};
use fe_core::model::{Conditions, Model, ModelError};
use fe_core::state::StateStore;

fn bricks(mesh: &Mesh) -> Vec<Box<dyn Element>> {
    mesh.blocks()
        .iter()
        .flat_map(Block::cells)
        .map(|cell| Box::new(Brick::new(cell, mesh.nodes())) as Box<dyn Element>)
        .collect()
}

fn cube() -> Mesh {
    let mut grid = GridBuilder::new();
    grid.add_box("cube", &[0.0, 1.0], &[0.0, 1.0], &[0.0, 1.0]);
    grid.finish().unwrap()
}

/// Faces of boxes share their nodes however their coordinates were computed: 0.1 + 0.2 is not 0.3 in
/// binary, and 0.0000005 lies between two steps of the merging grid.
#[test]
fn boxes_share_the_nodes_of_a_common_face() {
    for face in [0.1 + 0.2, 0.1234565, 1.0 / 3.0, -2.0000005] {
        let mut grid = GridBuilder::new();
        let other = face * (1.0 + 2.0 * f64::EPSILON);
        grid.add_box("left", &[face - 1.0, face], &[0.0, face + 5.0], &[0.0, 1.0]);
        grid.add_box(
            "right",
            &[other, other + 1.0],
            &[0.0, other + 5.0],
            &[0.0, 1.0],
        );
        let mesh = grid.finish().unwrap();
        assert_eq!(mesh.nodes().len(), 20 + 12, "face at {face}");
        assert_eq!(mesh.blocks().len(), 2);
    }
}

#[test]
fn a_gap_of_a_hundredth_of_a_millimetre_stays_open() {
    let mut grid = GridBuilder::new();
    grid.add_box("left", &[0.0, 1.0], &[0.0, 1.0], &[0.0, 1.0]);
    grid.add_box("right", &[1.01, 2.0], &[0.0, 1.0], &[0.0, 1.0]);
    assert_eq!(grid.finish().unwrap().nodes().len(), 40);
}

#[test]
fn boxes_of_one_name_form_one_block_and_lines_must_be_numbers() {
    let mut grid = GridBuilder::new();
    grid.add_box("beam", &[0.0, 1.0, 2.0], &[0.0, 1.0], &[0.0, 1.0]);
    grid.add_box("beam", &[2.0, 4.0], &[0.0, 1.0], &[0.0, 1.0]);
    let mesh = grid.finish().unwrap();
    assert_eq!((mesh.blocks().len(), mesh.blocks()[0].len()), (1, 3));
    assert_eq!(mesh.bounding_box(), [[0.0; 3], [4.0, 1.0, 1.0]]);
    // After a sound cell, at whose nodes the others must not end.
    for lines in [[0.0, f64::NAN, 1.0], [0.0, 1.0, f64::NAN]] {
        let mut grid = GridBuilder::new();
        grid.add_box("first", &[0.0, 1.0], &[0.0, 1.0], &[0.0, 1.0]);
        grid.add_box("beam", &lines, &[0.0, 1.0], &[0.0, 1.0]);
        assert!(matches!(grid.finish(), Err(MeshError::NotFinite(_))));
    }
    let mut grid = GridBuilder::new();
    grid.add_box("flat", &[0.0, 1.0], &[0.0], &[0.0, 1.0]);
    assert_eq!(grid.finish(), Err(MeshError::NoCell("flat".into())));
    for lines in [[10.0, 0.0], [0.0, 1e-9]] {
        let mut grid = GridBuilder::new();
        grid.add_box("turned", &lines, &[0.0, 1.0], &[0.0, 1.0]);
        assert_eq!(grid.finish(), Err(MeshError::Lines("turned".into())));
    }
}

#[test]
fn impossible_blocks_and_sets_are_refused() {
    let mut mesh = cube();
    let hex = CellKind::Hex20;
    let cases = [
        (
            mesh.add_block("cube", hex, Vec::new()),
            "the name cube is used twice",
        ),
        (
            mesh.add_block("a", hex, vec![0; 21]),
            "block a: 21 node numbers are not a multiple of 20",
        ),
        (
            mesh.add_block("b", hex, vec![20; 20]),
            "block b: cell 0 refers to node 20",
        ),
    ];
    for (result, start) in cases {
        let error = result.unwrap_err().to_string();
        assert!(error.starts_with(start), "{error}");
    }
    assert_eq!(mesh.add_set("left", |x| x[0] == 0.0).unwrap().len(), 8);
    assert!(matches!(
        mesh.add_set("left", |_| true),
        Err(MeshError::DuplicateName(_))
    ));
}

/// The order in which equations are numbered is what keeps the factor of a slender beam small.
#[test]
fn dofs_are_numbered_along_the_longest_axis() {
    for longest in 0..3 {
        let mut lines = [vec![0.0, 1.0], vec![0.0, 2.0], vec![0.0, 3.0]];
        lines[longest] = (0..=6).map(|i| 2.5 * f64::from(i)).collect();
        let mut grid = GridBuilder::new();
        grid.add_box("beam", &lines[0], &lines[1], &lines[2]);
        let mesh = grid.finish().unwrap();
        let elements = bricks(&mesh);
        let model = Model::new(mesh, elements).unwrap();
        let dofs = model.dofs();
        assert_eq!(dofs.len(), 3 * model.mesh().nodes().len());
        let along: Vec<f64> = (0..dofs.len())
            .map(|i| model.mesh().nodes()[dofs.owner(i).0][longest])
            .collect();
        assert!(along.is_sorted());
        for i in 0..dofs.len() {
            let (node, dof) = dofs.owner(i);
            assert_eq!(dofs.index(node, dof), Some(i));
            assert_eq!(dof as usize, i % 3, "the DOFs of a node are consecutive");
        }
        assert_eq!(dofs.index(0, Dof::Rx), None);
        assert_eq!(dofs.index(usize::MAX, Dof::Ux), None);
    }
}

#[test]
fn a_plane_of_symmetry_holds_its_normal_displacement_only() {
    let mut mesh = cube();
    mesh.add_set("middle", |x| x[0] == 1.0).unwrap();
    let elements = bricks(&mesh);
    let model = Model::new(mesh, elements).unwrap();
    let mut conditions = Conditions::new(&model);
    conditions.fix_set(&model, "middle", Dof::Ux).unwrap();
    let assembler = Assembler::new(&model, &conditions).unwrap();
    assert_eq!(assembler.free().len(), 60 - 8);
    for i in 0..60 {
        let (node, dof) = model.dofs().owner(i);
        let held = dof == Dof::Ux && model.mesh().nodes()[node][0] == 1.0;
        assert_eq!(assembler.is_constrained(i), held);
    }
    let error = conditions.fix_set(&model, "midle", Dof::Ux).unwrap_err();
    assert_eq!(
        error.to_string(),
        "no node is in the set midle; the mesh has middle"
    );
}

#[test]
fn conditions_add_loads_and_refuse_what_is_not_there() {
    let mesh = cube();
    let elements = bricks(&mesh);
    let model = Model::new(mesh, elements).unwrap();
    let mut conditions = Conditions::new(&model);
    conditions.add_dead(&model, 3, Dof::Uy, 2.0).unwrap();
    conditions.add_reference(&model, 3, Dof::Uy, 10.0).unwrap();
    conditions.add_reference(&model, 3, Dof::Uy, 5.0).unwrap();
    let mut external = vec![0.0; 60];
    conditions.external(0.5, &mut external);
    let loaded = model.dof(3, Dof::Uy).unwrap();
    assert_eq!(external[loaded], 2.0 + 0.5 * 15.0);
    assert_eq!(external.iter().filter(|f| **f != 0.0).count(), 1);
    assert!(matches!(
        conditions.fix(&model, 20, Dof::Ux),
        Err(ModelError::NoSuchNode {
            node: 20,
            nodes: 20
        })
    ));
    assert!(matches!(
        conditions.prescribe(&model, 0, Dof::Rz, 1.0),
        Err(ModelError::UnusedDof { .. })
    ));
    for result in [
        conditions.prescribe(&model, 3, Dof::Uy, f64::NAN),
        conditions.add_dead(&model, 3, Dof::Uy, f64::INFINITY),
        conditions.add_reference(&model, 3, Dof::Uy, f64::NAN),
    ] {
        assert!(matches!(result, Err(ModelError::NotFinite { node: 3, .. })));
    }
    assert!(conditions.prescribed().is_empty());
}

#[test]
fn an_element_on_a_node_that_is_not_there_is_refused() {
    let places = [[0.0; 3], [5.0, 0.0, 0.0], [10.0, 0.0, 0.0]];
    let bar = Truss::new([0, 2], &places, Arc::new(Damage(Flaw::None)), Flaw::None);
    let mesh = Mesh::new(places[..2].to_vec()).unwrap();
    assert_eq!(
        Model::new(mesh, vec![Box::new(bar)]).unwrap_err(),
        ModelError::NoSuchNode { node: 2, nodes: 2 }
    );
}

/// Without a node an element has no place that an error could name.
#[test]
fn an_element_without_a_node_is_refused() {
    #[derive(Debug)]
    struct Nowhere;

    impl Element for Nowhere {
        fn nodes(&self) -> &[usize] {
            &[]
        }

        fn dofs(&self) -> &'static [Dof] {
            &[]
        }

        fn state_len(&self) -> usize {
            0
        }

        fn init_state(&self, _: &mut [f64]) {}

        fn evaluate(
            &self,
            _: &[f64],
            _: &[f64],
            _: &mut [f64],
            _: &EvaluationContext,
            _: ElementSystem<'_>,
        ) -> Result<(), ElementError> {
            Ok(())
        }
    }

    assert_eq!(
        Model::new(cube(), vec![Box::new(Nowhere)]).unwrap_err(),
        ModelError::NoNode { element: 0 }
    );
}

/// Conditions on a follower go to its leader; an element on it would have DOFs that nothing holds.
#[test]
fn an_element_on_a_follower_is_refused() {
    let places = [[0.0; 3], [0.0, 0.0, 5.0]];
    let bar = Truss::new([0, 1], &places, Arc::new(Damage(Flaw::None)), Flaw::None);
    let mesh = Mesh::new(places.to_vec()).unwrap();
    let followers = Followers::uniform_across(&mesh, [0, 1]);
    assert_eq!(
        Model::with_followers(mesh, vec![Box::new(bar)], followers).unwrap_err(),
        ModelError::OnFollower {
            element: 0,
            node: 0
        }
    );
}

/// A follower of a follower would move by neither.
#[test]
fn a_chain_of_followers_is_refused() {
    let places = [[0.0; 3], [0.0, 0.0, 5.0], [0.0, 0.0, 9.0], [9.0, 0.0, 0.0]];
    let bar = Truss::new([2, 3], &places, Arc::new(Damage(Flaw::None)), Flaw::None);
    let mesh = Mesh::new(places.to_vec()).unwrap();
    let mut followers = Followers::uniform_across(&mesh, [0, 1]);
    followers.extend(Followers::uniform_across(&mesh, [1, 2]));
    assert_eq!(
        Model::with_followers(mesh, vec![Box::new(bar)], followers).unwrap_err(),
        ModelError::Chain { node: 0, leader: 1 }
    );
}

/// Three nodes at one place, connected by two elements in series through the one in between, are no seam; without the second
/// element they are.
#[test]
fn elements_in_series_leave_no_seam() {
    let places = [[0.0; 3], [0.0; 3], [0.0; 3], [9.0, 0.0, 0.0]];
    let model = |ends: &[[usize; 2]]| {
        let law = Arc::new(Damage(Flaw::None));
        let bar = |&ends| Truss::new(ends, &places, law.clone(), Flaw::None);
        let elements = ends.iter().map(|e| Box::new(bar(e)) as Box<dyn Element>);
        Model::new(Mesh::new(places.to_vec()).unwrap(), elements.collect()).unwrap()
    };
    let bars = [[0, 3], [1, 3], [0, 2], [2, 1]];
    check::joined(&model(&bars)).unwrap();
    assert_eq!(
        check::joined(&model(&bars[..3])).unwrap_err(),
        ModelError::Seam {
            nodes: [0, 1],
            position: [0.0; 3]
        }
    );
}

/// Committed, base and trial through one step: a trial is taken or dropped as a whole, and what is
/// latched survives in the base until the step ends.
#[test]
fn the_state_store_commits_rolls_back_and_latches() {
    let ends = [[0.0; 3], [10.0, 0.0, 0.0]];
    let law = Arc::new(Damage(Flaw::Latches));
    let elements: Vec<Box<dyn Element>> = vec![
        Box::new(Truss::new([0, 1], &ends, law.clone(), Flaw::None)),
        Box::new(Truss::new([0, 1], &ends, law, Flaw::None)),
    ];
    let model = Model::new(Mesh::new(ends.to_vec()).unwrap(), elements).unwrap();
    let mut state = StateStore::new(model.elements());
    assert_eq!((state.range(1), state.all_committed().len()), (2..4, 4));
    let mut assembler = Assembler::new(&model, &Conditions::new(&model)).unwrap();
    let mut pull = |state: &mut StateStore, strain: f64| {
        let u: Vec<f64> = (0..6)
            .map(|i| {
                if model.dofs().owner(i) == (1, Dof::Ux) {
                    10.0 * strain
                } else {
                    0.0
                }
            })
            .collect();
        let ctx = fe_core::element::EvaluationContext::new(fe_core::material::Operator::None);
        let mut out = fe_core::assembly::Assembled::default();
        assembler
            .evaluate(&model, &u, state, &ctx, &mut out)
            .unwrap();
    };
    pull(&mut state, 2e-4);
    assert_eq!(
        (state.committed(1), state.trial(1)),
        (&[0.0; 2][..], &[2e-4; 2][..])
    );
    state.roll_back();
    assert_eq!(state.trial(1), [0.0; 2]);
    pull(&mut state, 2e-4);
    state.commit();
    assert_eq!(state.committed(0), [2e-4; 2]);

    // The law latches its first variable: the next trial of the step starts from it.
    pull(&mut state, 5e-4);
    assert!(state.latch(model.elements()));
    assert!(!state.latch(model.elements()), "nothing is left to latch");
    pull(&mut state, 1e-4);
    assert_eq!(state.trial(0), [5e-4, 1e-4]);
    assert_eq!(state.committed(0), [2e-4; 2]);
    state.roll_back();
    pull(&mut state, 1e-4);
    assert_eq!(
        state.trial(0),
        [2e-4, 1e-4],
        "a roll-back forgets what was latched"
    );

    // A state passed through is the base of the next evaluation, but is not accepted.
    pull(&mut state, 4e-4);
    state.advance();
    pull(&mut state, 0.0);
    assert_eq!(state.trial(1), [4e-4, 0.0]);
    assert_eq!(state.committed(1), [2e-4; 2]);

    // A larger model takes the state over; a smaller one, or one with other histories, does not.
    let law = Arc::new(Damage(Flaw::None));
    let truss =
        || -> Box<dyn Element> { Box::new(Truss::new([0, 1], &ends, law.clone(), Flaw::None)) };
    let mut larger = StateStore::new(&[truss(), truss(), truss()]);
    larger.adopt(&state).unwrap();
    assert_eq!(larger.committed(1), state.committed(1));
    assert_eq!(larger.committed(2), [0.0; 2]);
    let brick: Box<dyn Element> = Box::new(Brick::new(&[0; 20], &[[0.0; 3]; 20]));
    for mut other in [
        StateStore::new(&[truss()]),
        StateStore::new(&[truss(), brick, truss()]),
    ] {
        let before = other.clone();
        let refused = other.adopt(&state);
        assert!(matches!(refused, Err(ModelError::Foreign { .. })));
        assert_eq!(other, before);
    }
}

/// Beyond 9e12 mm nodes are not told apart any more, and would be merged.
#[test]
fn lines_too_far_from_the_origin_are_refused() {
    let mut grid = GridBuilder::new();
    grid.add_box("far", &[0.0, 8e12], &[0.0, 1.0], &[0.0, 1.0]);
    assert_eq!(grid.finish().unwrap().nodes().len(), 20);
    let mut grid = GridBuilder::new();
    grid.add_box("far", &[1e13, 2e13, 3e13], &[0.0, 1e13], &[0.0, 1e13]);
    assert!(matches!(grid.finish(), Err(MeshError::Far(0))));
}

#[test]
fn an_element_that_is_not_there_is_not_sampled() {
    let mesh = cube();
    let elements = bricks(&mesh);
    let model = Model::new(mesh, elements).unwrap();
    let state = StateStore::new(model.elements());
    let sampled = model.sample(7, &[0.0; 60], &state, &mut |_| ());
    let expected = ModelError::NoSuchElement {
        element: 7,
        elements: 1,
    };
    assert_eq!(sampled, Err(expected));
}

#[test]
fn a_constrained_dof_has_no_equation() {
    let mesh = cube();
    let elements = bricks(&mesh);
    let model = Model::new(mesh, elements).unwrap();
    let mut conditions = Conditions::new(&model);
    conditions.fix(&model, 3, Dof::Uy).unwrap();
    let fixed = model.dof(3, Dof::Uy).unwrap();
    let assembler = Assembler::new(&model, &conditions).unwrap();
    assert_eq!(assembler.equation(fixed), None);
    assert_eq!(assembler.equation(60), None);
    for (equation, &dof) in assembler.free().iter().enumerate() {
        assert_eq!(assembler.equation(dof as usize), Some(equation));
    }
}
