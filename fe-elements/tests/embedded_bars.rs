//! Protects the cutting of embedded bars: whatever the mesh and the polyline, every stretch of a bar lies in
//! exactly one host, so that the pieces add up to the bar; a bar that leaves the mesh is named with the
//! place. Targets: geometry (length of the polyline).

use std::sync::Arc;

use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::grid::GridBuilder;
use fe_core::kinematics::Axial;
use fe_core::material::{Material, MaterialError, Operator, PointContext, Response, StateVar};
use fe_core::mesh::{CellKind, Mesh};
use fe_core::shape::hex20;
use fe_elements::{Bar, EmbeddedBar, Hosts, embed};
use nalgebra::{Vector1, Vector3};
use proptest::prelude::*;

/// sigma = E e with a modulus E (MPa) that may depend on the crack-band width (mm).
#[derive(Debug)]
struct Spring(fn(f64) -> f64);

impl Material<Axial> for Spring {
    fn name(&self) -> &'static str {
        "spring"
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        strain: &Vector1<f64>,
        _committed: &[f64],
        _trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Axial>, MaterialError> {
        let young = self.0(ctx.band_width);
        Ok(Response {
            stress: strain * young,
            tangent: nalgebra::Matrix1::new(young),
        })
    }

    fn free_energy(&self, e: &Vector1<f64>, _: &[f64], ctx: &PointContext) -> Option<f64> {
        Some(0.5 * self.0(ctx.band_width) * e[0] * e[0])
    }
}

/// Forces, stresses and energy are those of one crack-band width, the length of the bar in its host: 100 mm, so that at a
/// strain of 1e-3 the force is 0.1 N, the stress 0.1 MPa, the energy 0.005 N mm.
#[test]
fn the_law_is_told_one_crack_band_width() {
    let mut grid = GridBuilder::new();
    grid.add_box("block", &[0.0, 100.0], &[0.0, 100.0], &[0.0, 100.0]);
    let mesh = grid.finish().unwrap();
    let bar = Bar {
        law: Arc::new(Spring(|band_width| band_width)),
        ..bar(vec![[0.0, 50.0, 50.0], [100.0, 50.0, 50.0]])
    };
    let element = &embed(&[bar], &mesh, &["block"]).unwrap()[0];
    let along = |n: &usize| mesh.nodes()[*n][0];
    let stretch = |n| [1e-3 * along(n), 0.0, 0.0];
    let u: Vec<f64> = element.nodes().iter().flat_map(stretch).collect();
    let mut force = [0.0; 60];
    let system = ElementSystem {
        force: &mut force,
        stiffness: &mut [],
    };
    let ctx = EvaluationContext::new(Operator::None);
    element.evaluate(&u, &[], &mut [], &ctx, system).unwrap();
    // Per unit of the strain the forces work on the length of 100 mm.
    let resultant = u.iter().zip(force).map(|(u, f)| u * f).sum::<f64>() / 0.1;
    assert!((resultant - 0.1).abs() < 1e-12, "{resultant}");
    element
        .sample(&u, &[], &mut |s| assert!((s.stress[0] - 0.1).abs() < 1e-12))
        .unwrap();
    let energy = element.free_energy(&u, &[]).unwrap().unwrap();
    assert!((energy - 0.005).abs() < 1e-14, "{energy}");
}

fn bar(polyline: Vec<[f64; 3]>) -> Bar {
    Bar {
        name: "b".into(),
        polyline,
        area_mm2: 1.0,
        law: Arc::new(Spring(|_| 1.0)),
        dowel: None,
    }
}

const LINES: [f64; 4] = [0.0, 30.0, 50.0, 90.0];

/// 27 cells over a cube of 90 mm; nodes off the faces of the cube moved by `amplitude` mm, so that inner
/// faces are warped and curved.
fn block(amplitude: f64, seed: u64) -> Mesh {
    let mut grid = GridBuilder::new();
    grid.add_box("block", &LINES, &LINES, &LINES);
    let straight = grid.finish().unwrap();
    let mut state = seed;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        2.0 * (state >> 11) as f64 / (1u64 << 53) as f64 - 1.0
    };
    let nodes = straight.nodes().iter().map(|&x| {
        let inner = x.iter().all(|&c| c > 0.0 && c < 90.0);
        x.map(|c| c + if inner { amplitude * random() } else { 0.0 })
    });
    let mut mesh = Mesh::new(nodes.collect()).unwrap();
    let cells = straight.blocks()[0].cells().flatten().copied().collect();
    mesh.add_block("block", CellKind::Hex20, cells).unwrap();
    mesh
}

/// Sum of the pieces, after a check that each lies inside its host.
fn embedded_length(mesh: &Mesh, elements: &[EmbeddedBar]) -> f64 {
    let mut total = 0.0;
    for element in elements {
        let coords = std::array::from_fn(|a| mesh.nodes()[element.nodes()[a]]);
        let visit = &mut |ends: [[f64; 3]; 2], _| {
            let [a, b] = ends.map(Vector3::from);
            for end in [a, b, a.lerp(&b, 0.5)] {
                let xi = hex20::inverse_map(&coords, end.into()).unwrap();
                assert!(xi.iter().all(|c| c.abs() < 1.0 + 1e-7), "{end:?}: {xi:?}");
            }
        };
        element.segments(&[0.0; 60], &[], visit).unwrap();
        total += element.length();
    }
    total
}

/// Coordinates on grid lines and in between, so that corners fall on faces, edges and nodes.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        prop::sample::select(LINES.to_vec()),
        0.0..90.0_f64,
        (0..9_u8).prop_map(|i| 10.0 * f64::from(i)),
    ]
}

fn point() -> impl Strategy<Value = [f64; 3]> {
    [coordinate(), coordinate(), coordinate()]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    /// Boxes: bars along faces and edges, through corners, with corners on faces.
    #[test]
    fn pieces_add_up_in_boxes(polyline in prop::collection::vec(point(), 2..5)) {
        let mesh = block(0.0, 0);
        let bar = bar(polyline);
        prop_assume!(bar.length_mm() > 0.0);
        let elements = embed(std::slice::from_ref(&bar), &mesh, &["block"]).unwrap();
        let length = embedded_length(&mesh, &elements);
        prop_assert!((length - bar.length_mm()).abs() < 1e-12 * length.max(90.0));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// Cells with warped and curved faces.
    #[test]
    fn pieces_add_up_in_distorted_cells(
        polyline in prop::collection::vec(point(), 2..4),
        seed in any::<u64>(),
    ) {
        let mesh = block(1.5, seed);
        let bar = bar(polyline);
        prop_assume!(bar.length_mm() > 0.0);
        let elements = embed(std::slice::from_ref(&bar), &mesh, &["block"]).unwrap();
        let length = embedded_length(&mesh, &elements);
        prop_assert!((length - bar.length_mm()).abs() < 1e-12 * length.max(90.0));
    }
}

/// A long bar in short distorted cells: every cell it crosses is found.
#[test]
fn a_long_bar_finds_every_short_cell() {
    let cells = 400;
    let x: Vec<f64> = (0..=cells).map(f64::from).collect();
    let mut grid = GridBuilder::new();
    grid.add_box("rod", &x, &[0.0, 1.0], &[0.0, 1.0]);
    let straight = grid.finish().unwrap();
    // Inner faces bulge along the axis, the end faces stay plane.
    let wave = |x: f64| (std::f64::consts::PI * 127.0 * x / f64::from(cells)).sin();
    let bulge = |[x, y, z]: [f64; 3]| [x + 0.4 * y * (1.0 - y) * wave(x), y, z];
    let mut mesh = Mesh::new(straight.nodes().iter().copied().map(bulge).collect()).unwrap();
    let cells_of = straight.blocks()[0].cells().flatten().copied().collect();
    mesh.add_block("rod", CellKind::Hex20, cells_of).unwrap();
    let ends = vec![[0.0, 0.2, 0.3], [f64::from(cells), 0.7, 0.6]];
    let elements = embed(&[bar(ends)], &mesh, &["rod"]).unwrap();
    assert_eq!(elements.len(), cells as usize);
}

/// A bar along a face that hosts share, bent over by 3 mm at one edge, stays with the first of them up to its end, however
/// rounding takes it out and in.
#[test]
fn a_bar_along_a_shared_face_is_not_chopped() {
    let mut grid = GridBuilder::new();
    let lines = [0.0, 20.0, 40.0];
    grid.add_box("block", &lines, &lines, &lines[..2]);
    let straight = grid.finish().unwrap();
    let skewed = |[x, y, z]: [f64; 3]| {
        let by = if x == 20.0 { y * z * 3.0 / 400.0 } else { 0.0 };
        [x + by, y, z]
    };
    let mut mesh = Mesh::new(straight.nodes().iter().copied().map(skewed).collect()).unwrap();
    let cells = straight.blocks()[0].cells().flatten().copied().collect();
    mesh.add_block("block", CellKind::Hex20, cells).unwrap();
    let hosts = Hosts::new(&mesh, &["block"]).unwrap();
    for z in [7.0, 10.0] {
        let along = bar(vec![[5.0, 20.0, z], [35.0, 20.0, z]]);
        let pieces = hosts.cut(&along).unwrap();
        let ends = pieces.iter().map(|p| (p.host, p.ends.map(|x| x.x)));
        let [(0, [5.0, face]), (1, [_, 35.0])] = ends.collect::<Vec<_>>()[..] else {
            panic!("{pieces:?}")
        };
        assert!((face - 20.0 - 0.15 * z).abs() < 1e-6, "{face}");
    }
}

/// The first point without a host is named: the start, or the place where the bar leaves.
#[test]
fn a_bar_that_leaves_the_mesh_is_named_with_the_place() {
    for amplitude in [0.0, 1.5] {
        let mesh = block(amplitude, 1);
        for (polyline, place) in [
            (
                vec![[10.0, 10.0, 10.0], [130.0, 40.0, 10.0]],
                [90.0, 30.0, 10.0],
            ),
            (
                vec![[-5.0, 10.0, 10.0], [40.0, 10.0, 10.0]],
                [-5.0, 10.0, 10.0],
            ),
            (
                vec![[10.0, 10.0, 10.0], [90.0, 10.0, 10.0], [90.0, 10.0, 95.0]],
                [90.0, 10.0, 90.0],
            ),
        ] {
            match embed(&[bar(polyline)], &mesh, &["block"]) {
                Err(ElementError::NoHost { bar, x, y, z }) => {
                    assert_eq!(bar, "b");
                    let miss = Vector3::new(x, y, z) - Vector3::from(place);
                    assert!(miss.norm() < 1e-6, "{miss:?}");
                }
                other => panic!("{other:?}"),
            }
        }
    }
}

/// Bars find hosts in the named blocks only, and pass from one to the next.
#[test]
fn bars_are_hosted_by_the_named_blocks() {
    let mut grid = GridBuilder::new();
    grid.add_box("left", &[0.0, 10.0], &[0.0, 10.0], &[0.0, 10.0]);
    grid.add_box("right", &[10.0, 20.0], &[0.0, 10.0], &[0.0, 10.0]);
    let mesh = grid.finish().unwrap();
    let through = || bar(vec![[0.0, 5.0, 5.0], [20.0, 5.0, 5.0]]);
    assert_eq!(
        embed(&[through()], &mesh, &["left", "right"])
            .unwrap()
            .len(),
        2
    );
    let alone = embed(&[through()], &mesh, &["left"]);
    assert!(matches!(alone, Err(ElementError::NoHost { x, .. }) if (x - 10.0).abs() < 1e-6));
    let unknown = embed(&[through()], &mesh, &["middle"]);
    let message = unknown.unwrap_err().to_string();
    assert!(
        message.contains("middle") && message.contains("left, right"),
        "{message}"
    );
}

/// Pieces of a bar follow one another from its first end to its last, each inside the host it names.
#[test]
fn pieces_are_a_chain_along_the_bar() {
    let mesh = block(3.0, 7);
    let hosts = Hosts::new(&mesh, &["block"]).unwrap();
    let ends = [[1.0, 20.0, 40.0], [89.0, 70.0, 43.0]].map(Vector3::from);
    let pieces = hosts.cut(&bar(ends.map(Into::into).into())).unwrap();
    assert!(pieces.len() >= 3);
    let mut reached = ends[0];
    for piece in &pieces {
        assert!((piece.ends[0] - reached).norm() < 1e-12);
        assert!((piece.start - (reached - ends[0]).norm()).abs() < 1e-9);
        let (_, coords) = hosts.cell(piece.host).unwrap();
        let middle = 0.5 * (piece.ends[0] + piece.ends[1]);
        let xi = hex20::inverse_map(&coords, middle.into()).unwrap();
        assert!(xi.iter().all(|c| c.abs() <= 1.0), "{xi:?}");
        reached = piece.ends[1];
    }
    assert!((reached - ends[1]).norm() < 1e-9);
    assert!(hosts.cell(27).is_none());
}

/// Impossible bars are refused with the quantity and the remedy.
#[test]
fn impossible_bars_are_refused() {
    let mesh = block(0.0, 0);
    let sound = || bar(vec![[10.0; 3], [80.0; 3]]);
    let cases = [
        (
            Bar {
                area_mm2: -1.0,
                ..sound()
            },
            "area_mm2 = -1",
        ),
        (
            Bar {
                area_mm2: f64::NAN,
                ..sound()
            },
            "area_mm2 = NaN",
        ),
        (bar(vec![[10.0; 3]]), "number of points = 1"),
        (bar(vec![[10.0; 3], [10.0; 3]]), "length_mm = 0"),
        (bar(vec![[10.0; 3], [f64::INFINITY; 3]]), "coordinate = inf"),
    ];
    for (case, expected) in cases {
        let message = embed(&[case], &mesh, &["block"]).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
}

/// A piece made by hand, without length or direction, is refused by name.
#[test]
fn a_piece_without_a_direction_does_not_slip() {
    let mesh = block(0.0, 1);
    let hosts = Hosts::new(&mesh, &["block"]).unwrap();
    let bar = bar(vec![[5.0, 15.0, 15.0], [25.0, 15.0, 15.0]]);
    let piece = hosts.cut(&bar).unwrap().remove(0);
    assert!(hosts.slipping(&bar, &piece, [100, 101, 102]).is_ok());
    let mut numberless = piece.clone();
    numberless.direction[0] = f64::NAN;
    let mut long = piece.clone();
    long.direction *= 2.0;
    let mut empty = piece.clone();
    empty.ends[1] = empty.ends[0];
    for wrong in [numberless, long, empty] {
        let error = hosts.slipping(&bar, &wrong, [100, 101, 102]).unwrap_err();
        assert!(error.to_string().contains("length of a piece"), "{error}");
    }
}
