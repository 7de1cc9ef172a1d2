//! The 8-node plane-stress quadrilateral in the x-y plane.

use std::sync::Arc;

use fe_core::element::ElementError;
use fe_core::kinematics::PlaneStress;
use fe_core::material::Material;
use fe_core::mesh::NodeId;
use fe_core::shape::corners::corners_turn;
use fe_core::shape::{quad8, quadrature};
use nalgebra::Matrix2;

use crate::sheet::{Point, Sheet, admit_thickness};

/// Integration rule of a quadrilateral.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QuadRule {
    /// 2 x 2 Gauss points.
    Reduced,
    /// 3 x 3 Gauss points.
    Full,
}

impl QuadRule {
    /// Natural coordinates and weights.
    pub(crate) fn points(self) -> Vec<([f64; 2], f64)> {
        quadrature::square(match self {
            Self::Reduced => 2,
            Self::Full => 3,
        })
    }
}

/// Plane-stress element of constant thickness in the x-y plane, K = sum t w B^T D B.
pub type Quad8 = Sheet<16>;

impl Quad8 {
    /// An element at `coords` (mm) with `thickness` (mm).
    ///
    /// # Errors
    ///
    /// [`ElementError::Jacobian`], [`ElementError::Input`], or [`ElementError::Material`] when the law refuses
    /// the crack-band width, which is the square root of the area.
    pub fn new(
        nodes: [NodeId; 8],
        coords: &[[f64; 2]; 8],
        thickness: f64,
        rule: QuadRule,
        law: Arc<dyn Material<PlaneStress>>,
    ) -> Result<Self, ElementError> {
        admit_thickness(thickness)?;
        let jacobian = |slopes: [[f64; 2]; 8]| {
            Matrix2::from_fn(|r, c| (0..8).map(|a| slopes[a][r] * coords[a][c]).sum::<f64>())
        };
        let at = |xi| jacobian(quad8::shape(xi).1).determinant();
        corners_turn(quad8::NODES[..4].iter().map(|xi| at(*xi)), at([0.0; 2]))?;
        let mut points = Vec::new();
        for (point, (xi, w)) in rule.points().into_iter().enumerate() {
            let (values, slopes) = quad8::shape(xi);
            let (inverse, determinant) = invert(jacobian(slopes))
                .map_err(|determinant| ElementError::Jacobian { point, determinant })?;
            let mut b = [[0.0; 16]; 3];
            for (a, [x, y]) in gradients(&slopes, &inverse).into_iter().enumerate() {
                (b[0][2 * a], b[1][2 * a + 1]) = (x, y);
                (b[2][2 * a], b[2][2 * a + 1]) = (y, x);
            }
            let at = |k: usize| (0..8).map(|a| values[a] * coords[a][k]).sum();
            points.push(Point {
                position: [at(0), at(1), 0.0],
                volume: thickness * determinant * w,
                b,
            });
        }
        Self::of_points(nodes, points, thickness, law)
    }
}

/// Inverse and determinant of a Jacobian matrix dx_c/dxi_r; the determinant alone if it is not positive.
pub(crate) fn invert(jacobian: Matrix2<f64>) -> Result<(Matrix2<f64>, f64), f64> {
    let determinant = jacobian.determinant();
    let inverse = jacobian.try_inverse().filter(|_| determinant > 0.0);
    Ok((inverse.ok_or(determinant)?, determinant))
}

/// Derivatives along x_c from those along xi_r, by the inverse of the Jacobian matrix.
pub(crate) fn gradients(slopes: &[[f64; 2]; 8], inverse: &Matrix2<f64>) -> [[f64; 2]; 8] {
    slopes.map(|s| std::array::from_fn(|c| inverse[(c, 0)] * s[0] + inverse[(c, 1)] * s[1]))
}
