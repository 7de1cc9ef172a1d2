//! The 8-node plane-stress quadrilateral in the x-y plane.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::kinematics::PlaneStress;
use fe_core::material::{Material, Operator, PointContext};
use fe_core::mesh::{CellKind, NodeId};
use fe_core::shape::{quad8, quadrature};
use nalgebra::{Matrix2, Matrix3, Vector3};

use crate::points;

/// Integration rule of a quadrilateral.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QuadRule {
    /// 2 x 2 Gauss points.
    Reduced,
    /// 3 x 3 Gauss points.
    Full,
}

/// One Gauss point.
#[derive(Debug, Clone)]
struct Point {
    position: [f64; 3],
    /// Gradients of the shape functions (1/mm).
    gradients: [[f64; 2]; 8],
    /// Volume the point stands for (mm3).
    volume: f64,
}

/// Plane-stress element of constant thickness, K = sum t w B^T D B.
#[derive(Debug)]
pub struct Quad8 {
    nodes: [NodeId; 8],
    points: Vec<Point>,
    band_width: f64,
    law: Arc<dyn Material<PlaneStress>>,
}

const DOFS: [Dof; 2] = [Dof::Ux, Dof::Uy];

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
        if !(thickness.is_finite() && thickness > 0.0) {
            return Err(ElementError::Input {
                what: "thickness_mm".into(),
                value: thickness,
                allowed: "(0, inf)".into(),
                remedy: "give a positive thickness".into(),
            });
        }
        let n = if rule == QuadRule::Reduced { 2 } else { 3 };
        let mut points = Vec::new();
        for (point, (xi, w)) in quadrature::square(n).into_iter().enumerate() {
            let (values, slopes) = quad8::shape(xi);
            let jacobian =
                Matrix2::from_fn(|r, c| (0..8).map(|a| slopes[a][r] * coords[a][c]).sum());
            let determinant: f64 = jacobian.determinant();
            let inverse = jacobian.try_inverse().filter(|_| determinant > 0.0);
            let Some(inverse) = inverse else {
                return Err(ElementError::Jacobian { point, determinant });
            };
            let gradients = slopes.map(|s| {
                [
                    inverse[(0, 0)] * s[0] + inverse[(0, 1)] * s[1],
                    inverse[(1, 0)] * s[0] + inverse[(1, 1)] * s[1],
                ]
            });
            let at = |k: usize| (0..8).map(|a| values[a] * coords[a][k]).sum();
            points.push(Point {
                position: [at(0), at(1), 0.0],
                gradients,
                volume: thickness * determinant * w,
            });
        }
        let area: f64 = points.iter().map(|p| p.volume / thickness).sum();
        let band_width = area.sqrt();
        law.admit(&PointContext::new(band_width))
            .map_err(|source| ElementError::Material { point: 0, source })?;
        Ok(Self {
            nodes,
            points,
            band_width,
            law,
        })
    }
}

impl Point {
    /// Strain rows xx, yy, xy of node `a`.
    const fn b(&self, a: usize) -> [[f64; 2]; 3] {
        let [x, y] = self.gradients[a];
        [[x, 0.0], [0.0, y], [y, x]]
    }

    fn strain(&self, u: &[f64]) -> Vector3<f64> {
        let mut strain = Vector3::zeros();
        for a in 0..8 {
            for (i, row) in self.b(a).iter().enumerate() {
                strain[i] += row[0] * u[2 * a] + row[1] * u[2 * a + 1];
            }
        }
        strain
    }
}

impl Element for Quad8 {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn dofs(&self) -> &'static [Dof] {
        &DOFS
    }

    fn state_len(&self) -> usize {
        self.points.len() * self.law.state_len()
    }

    fn init_state(&self, state: &mut [f64]) {
        points::init_state(self.law.as_ref(), state);
    }

    fn evaluate(
        &self,
        u: &[f64],
        committed: &[f64],
        trial: &mut [f64],
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        let n = self.law.state_len();
        let point_ctx = points::context(self.band_width, ctx);
        for (p, point) in self.points.iter().enumerate() {
            let range = p * n..(p + 1) * n;
            let response = self
                .law
                .update(
                    &point.strain(u),
                    &committed[range.clone()],
                    &mut trial[range],
                    &point_ctx,
                )
                .map_err(|source| ElementError::Material { point: p, source })?;
            let d: Matrix3<f64> = response.tangent * point.volume;
            for a in 0..8 {
                let ba = point.b(a);
                for k in 0..2 {
                    let column = Vector3::new(ba[0][k], ba[1][k], ba[2][k]);
                    out.force[2 * a + k] += point.volume * column.dot(&response.stress);
                    if ctx.operator == Operator::None {
                        continue;
                    }
                    let row = d.tr_mul(&column);
                    for c in 0..8 {
                        let bc = point.b(c);
                        for l in 0..2 {
                            out.stiffness[(2 * a + k) * 16 + 2 * c + l] +=
                                row[0] * bc[0][l] + row[1] * bc[1][l] + row[2] * bc[2][l];
                        }
                    }
                }
            }
        }
        Ok(())
    }

    fn cell(&self) -> Option<CellKind> {
        Some(CellKind::Quad8)
    }

    fn unsymmetric(&self) -> bool {
        self.law.unsymmetric_tangent()
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) {
        points::latch(self.law.as_ref(), trial, base);
    }

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Option<f64> {
        let points = self.points.iter().map(|p| (p.volume, p.strain(u)));
        points::free_energy(self.law.as_ref(), self.band_width, state, points)
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        let points = self
            .points
            .iter()
            .map(|p| (p.position, p.volume, p.strain(u)));
        points::sample(self.law.as_ref(), self.band_width, state, points, visit)
    }
}
