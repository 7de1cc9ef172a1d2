//! The 20-node hexahedron with reduced, 14-point or full integration.

use std::sync::Arc;

use fe_core::element::ElementError;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::mesh::NodeId;
use fe_core::shape::corners::corners_turn;
use fe_core::shape::{hex20, quadrature};
use nalgebra::{Matrix6, Vector3, Vector6};

use crate::kernel::{self, PAD, Point};
use crate::solid::{Interpolation, SolidElement};
use crate::vectors::{add_by_node, by_direction};

/// Integration rule of a hexahedron.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HexRule {
    /// 2 x 2 x 2 Gauss points: cheap, six spurious zero-energy modes per free element.
    Reduced,
    /// 14 points, see [`quadrature::irons`]: as exact as 27 Gauss points where edges are straight, without mechanisms. Edges that
    /// bulge by a tenth of their length leave a constant stress off by some 1e-3; 8 or 27 points keep it.
    Irons,
    /// 3 x 3 x 3 Gauss points.
    Full,
}

impl HexRule {
    pub(crate) fn points(self) -> Vec<([f64; 3], f64)> {
        match self {
            Self::Reduced => quadrature::cube(2),
            Self::Irons => quadrature::irons(),
            Self::Full => quadrature::cube(3),
        }
    }
}

/// How the crack-band width h (mm) of an element follows from its shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BandWidth {
    /// Cube root of the volume a point stands for.
    CubeRoot,
    /// factor sqrt(V/extent along the normal): sqrt(hx hy) of a box for normal z and factor 1.
    InPlane {
        /// Normal of the plane of the cracks' traces, of any length but zero.
        normal: [f64; 3],
        /// Factor on the side of the equivalent square.
        factor: f64,
    },
    /// The same for every point (mm).
    Fixed(f64),
}

impl BandWidth {
    pub(crate) fn of(self, coords: &[[f64; 3]; 20], volume: f64, points: usize) -> f64 {
        match self {
            Self::CubeRoot => (volume / points as f64).cbrt(),
            Self::InPlane { normal, factor } => {
                let n = Vector3::from(normal);
                // Squares of what is very large or very small are no numbers, or none at all.
                let n = (n / n.amax()).normalize();
                let along = coords.map(|x| n.dot(&Vector3::from(x)));
                let extent = along.iter().fold(f64::MIN, |a, &b| a.max(b))
                    - along.iter().fold(f64::MAX, |a, &b| a.min(b));
                factor * (volume / extent).sqrt()
            }
            Self::Fixed(width) => width,
        }
    }
}

/// 20-node hexahedron.
pub type Hex20 = SolidElement<Brick>;

/// Interpolation of the 20-node hexahedron.
#[derive(Debug)]
pub struct Brick {
    nodes: [NodeId; 20],
    points: Vec<Point>,
}

impl Hex20 {
    /// An element at node coordinates `coords` (mm).
    ///
    /// # Errors
    ///
    /// [`ElementError::Jacobian`] for a cell that is inverted or folded at one of the 3x3x3 points or turned over at a corner,
    /// [`ElementError::Input`] for a crack-band width that is not positive, [`ElementError::Material`] when the law
    /// refuses it.
    pub fn new(
        nodes: [NodeId; 20],
        coords: &[[f64; 3]; 20],
        rule: HexRule,
        law: Arc<dyn Material<Solid>>,
        band: BandWidth,
    ) -> Result<Self, ElementError> {
        refuse_folds(coords)?;
        let mut points = Vec::new();
        let mut positions = Vec::new();
        for (point, (xi, w)) in rule.points().into_iter().enumerate() {
            let (position, gradients, determinant) = map(coords, point, xi)?;
            let mut g = [[0.0; PAD]; 3];
            for (a, d) in gradients.iter().enumerate() {
                for k in 0..3 {
                    g[k][a] = d[k];
                }
            }
            points.push(Point {
                gradients: g,
                volume: w * determinant,
            });
            positions.push(position.into());
        }
        let volume: f64 = points.iter().map(|p| p.volume).sum();
        let band = band.of(coords, volume, points.len());
        Self::of(Brick { nodes, points }, positions, law, band)
    }
}

/// Refuses a cell that is folded at one of the 3x3x3 points, of which a rule may see fewer, or turned over at a corner.
pub(crate) fn refuse_folds(coords: &[[f64; 3]; 20]) -> Result<(), ElementError> {
    for (point, (xi, _)) in quadrature::cube(3).into_iter().enumerate() {
        map(coords, point, xi)?;
    }
    let at = |xi| hex20::map(coords, xi).2;
    corners_turn(hex20::NODES[..8].iter().map(|xi| at(*xi)), at([0.0; 3]))
}

/// Position (mm), gradients (1/mm) and Jacobian determinant (mm3) at a point.
type Mapped = (Vector3<f64>, [[f64; 3]; 20], f64);

/// The map at a point, unless it is folded there.
pub(crate) fn map(
    coords: &[[f64; 3]; 20],
    point: usize,
    xi: [f64; 3],
) -> Result<Mapped, ElementError> {
    match hex20::map(coords, xi) {
        mapped @ (_, _, determinant) if determinant > 0.0 => Ok(mapped),
        (_, _, determinant) => Err(ElementError::Jacobian { point, determinant }),
    }
}

impl Interpolation for Brick {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn cell(&self) -> &[NodeId; 20] {
        &self.nodes
    }

    fn volumes(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|p| p.volume)
    }

    fn strains(&self, u: &[f64], out: &mut [Vector6<f64>]) {
        kernel::strains(&self.points, &by_direction(u), out);
    }

    fn add_force(&self, stresses: &[Vector6<f64>], out: &mut [f64]) {
        add_by_node(&kernel::force(&self.points, stresses), out);
    }

    fn add_stiffness(&self, tangents: &[Matrix6<f64>], symmetric: bool, out: &mut [f64]) {
        kernel::stiffness(&self.points, tangents, symmetric, out);
    }
}
