//! Protects what another crate builds of these parts: an interpolation and a view of its own.

use std::borrow::Cow;
use std::sync::Arc;

use fe_core::mesh::NodeId;
use fe_core::shape::hex20::NODES;
use fe_core::testing::{ElementCheck, check_element};
use fe_elements::seen::View;
use fe_elements::solid::Interpolation;
use fe_elements::{BandWidth, Hex20, HexRule, Seen, SolidElement};
use fe_materials::Elastic;
use nalgebra::{Matrix6, Vector6};

/// A cube of 2 mm with mean strains only, from its faces: its linear part of a hexahedron with one point.
#[derive(Debug)]
struct MeanStrain {
    nodes: [NodeId; 20],
    volume: f64,
}

impl MeanStrain {
    /// Row i of B at node a: the mean of dN/dx over the cube, here of the corners alone.
    fn gradient(a: usize) -> [f64; 3] {
        if a < 8 {
            NODES[a].map(|x| x / 8.0)
        } else {
            [0.0; 3]
        }
    }

    fn b(a: usize) -> nalgebra::Matrix6x3<f64> {
        let [x, y, z] = Self::gradient(a);
        nalgebra::Matrix6x3::new(
            x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z, y, x, 0.0, 0.0, z, y, z, 0.0, x,
        )
    }
}

impl Interpolation for MeanStrain {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes[..8]
    }

    fn cell(&self) -> &[NodeId; 20] {
        &self.nodes
    }

    fn volumes(&self) -> impl Iterator<Item = f64> {
        std::iter::once(self.volume)
    }

    fn strains(&self, u: &[f64], out: &mut [Vector6<f64>]) {
        out[0] = (0..8)
            .map(|a| Self::b(a) * nalgebra::Vector3::from_column_slice(&u[3 * a..3 * a + 3]))
            .sum();
    }

    fn add_force(&self, stresses: &[Vector6<f64>], out: &mut [f64]) {
        for a in 0..8 {
            let force = self.volume * Self::b(a).transpose() * stresses[0];
            (0..3).for_each(|i| out[3 * a + i] += force[i]);
        }
    }

    fn add_stiffness(&self, tangents: &[Matrix6<f64>], _: bool, out: &mut [f64]) {
        for (a, b) in (0..8).flat_map(|a| (0..8).map(move |b| (a, b))) {
            let block = self.volume * Self::b(a).transpose() * tangents[0] * Self::b(b);
            for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
                out[(3 * a + i) * 24 + 3 * b + j] += block[(i, j)];
            }
        }
    }
}

fn law() -> Arc<Elastic> {
    Arc::new(Elastic::new(1e4, 0.2).unwrap())
}

fn nodes() -> [NodeId; 20] {
    std::array::from_fn(|a| a)
}

fn mean(volume: f64) -> MeanStrain {
    MeanStrain {
        nodes: nodes(),
        volume,
    }
}

#[test]
fn an_interpolation_of_ones_own_makes_an_element() {
    let element = SolidElement::of(mean(8.0), vec![[0.0; 3]], law(), 2.0).unwrap();
    check_element(&element, &NODES[..8], &ElementCheck::new(1e-3)).unwrap();
    assert_eq!(element.volume(), 8.0);
}

#[test]
fn points_without_a_place_or_a_volume_are_refused() {
    for (volume, places, says) in [
        (8.0, 2, "number of integration points"),
        (8.0, 0, "number of integration points"),
        (0.0, 1, "volume of an integration point"),
        (f64::NAN, 1, "volume of an integration point"),
    ] {
        let refused = SolidElement::of(mean(volume), vec![[0.0; 3]; places], law(), 2.0);
        let error = refused.unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
}

/// Displacements in another unit of length.
#[derive(Debug)]
struct As(f64);

impl View for As {
    fn own<'a>(&self, u: &'a [f64]) -> Cow<'a, [f64]> {
        u.iter().map(|u| self.0 * u).collect::<Vec<_>>().into()
    }
}

#[test]
fn a_view_of_ones_own_shows_an_element() {
    let seen = |unit: f64| {
        let coords = NODES;
        let hexahedron = Hex20::new(nodes(), &coords, HexRule::Full, law(), BandWidth::CubeRoot);
        Seen::through(Box::new(hexahedron.unwrap()), As(unit))
    };
    let check = ElementCheck::new(1e-3);
    check_element(&seen(1.0), &NODES, &check).unwrap();
    // Forces that are not scaled along make a stiffness that is no derivative.
    assert!(check_element(&seen(2.0), &NODES, &check).is_err());
}
