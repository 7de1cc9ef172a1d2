//! Protects the hexahedron that is uniform across from cells that are not straight across: its volume is half the width
//! times the area only there. Targets: the volume of [`Hex20`], or a refusal by name.

use std::sync::Arc;

use fe_core::element::ElementError;
use fe_core::followers::Followers;
use fe_core::mesh::Mesh;
use fe_core::shape::hex20::NODES;
use fe_elements::{BandWidth, Hex20, HexRule, UniformHex20};
use fe_materials::Elastic;

type Cell = [[f64; 3]; 20];

/// A box of 20 mm x 20 mm x 20 mm with its mid-depth nodes at a share of the depth.
fn cell(share: f64) -> Cell {
    NODES.map(|[x, y, z]| {
        let z = if z == 0.0 { share } else { 0.5 * (z + 1.0) };
        [10.0 * x, 10.0 * y, 20.0 * z]
    })
}

fn uniform(coords: &Cell, rule: HexRule) -> Result<UniformHex20, ElementError> {
    let mesh = Mesh::new(coords.to_vec()).unwrap();
    let followers = Followers::uniform_across(&mesh, 0..20);
    let (nodes, band) = (std::array::from_fn(|a| a), BandWidth::CubeRoot);
    let law = Arc::new(Elastic::new(1e4, 0.2).unwrap());
    UniformHex20::new(nodes, coords, &followers, rule, law, band)
}

fn plain(coords: &Cell, rule: HexRule) -> Result<Hex20, ElementError> {
    let (nodes, band) = (std::array::from_fn(|a| a), BandWidth::CubeRoot);
    let law = Arc::new(Elastic::new(1e4, 0.2).unwrap());
    Hex20::new(nodes, coords, rule, law, band)
}

/// A width that tapers along x is one of straight lines across; nodes off mid-depth are refused.
#[test]
fn the_volume_is_that_of_the_cell() {
    let taper = cell(0.5).map(|[x, y, z]| [x, y, z * (1.0 - 0.025 * x)]);
    for coords in [cell(0.5), taper] {
        let volumes = [
            uniform(&coords, HexRule::Full).unwrap().volume(),
            plain(&coords, HexRule::Full).unwrap().volume(),
        ];
        assert!((volumes[0] - volumes[1]).abs() < 1e-9, "{volumes:?}");
    }
    for share in [0.45, 0.55, 0.3] {
        let error = uniform(&cell(share), HexRule::Full).unwrap_err();
        assert!(error.to_string().contains("z of node 16"), "{error}");
    }
}

/// What a slip in a list of nodes makes of a cell is refused, whatever the rule, as is a cell folded in its plane.
#[test]
fn exchanged_nodes_are_refused() {
    for a in 0..20 {
        for b in a + 1..20 {
            let mut coords = cell(0.5);
            coords.swap(a, b);
            for rule in [HexRule::Irons, HexRule::Full] {
                assert!(uniform(&coords, rule).is_err(), "{a} {b} {rule:?}");
            }
        }
    }
    // The mid-side node at x = 0, y = -10 moved across the opposite side.
    let folded = cell(0.5).map(|[x, y, z]| {
        if x == 0.0 && y == -10.0 {
            [x, 25.0, z]
        } else {
            [x, y, z]
        }
    });
    assert_ne!(folded, cell(0.5));
    for rule in [HexRule::Irons, HexRule::Full] {
        assert!(uniform(&folded, rule).is_err(), "folded, {rule:?}");
    }
}

/// A cell whose third axis leads to the plane instead of away from it is refused with the direction.
#[test]
fn a_depth_that_shrinks_is_refused() {
    let reversed = cell(0.5).map(|[x, y, z]| [x, -y, 20.0 - z]);
    let error = uniform(&reversed, HexRule::Full).unwrap_err().to_string();
    assert!(
        error.contains("z of node 0") && error.contains("grows from 0"),
        "{error}"
    );
}
