//! The 8-node plane-stress quadrilateral in the x-y plane.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
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

/// Plane-stress element of constant thickness, K = sum t w B^T D B.
#[derive(Debug)]
pub struct Quad8 {
    nodes: [NodeId; 8],
    /// Gradients (1/mm) and volume (mm3) of each point.
    points: Vec<([[f64; 2]; 8], f64)>,
    band_width: f64,
    law: Arc<dyn Material<PlaneStress>>,
}

const DOFS: [Dof; 2] = [Dof::Ux, Dof::Uy];

impl Quad8 {
    /// An element at `coords` (mm) with `thickness` (mm).
    ///
    /// # Errors
    ///
    /// [`ElementError::Jacobian`] or [`ElementError::Input`]; [`ElementError::Material`] when the law refuses
    /// the crack-band width, the square root of the area.
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
            let (_, slopes) = quad8::shape(xi);
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
            points.push((gradients, thickness * determinant * w));
        }
        let area: f64 = points.iter().map(|p| p.1 / thickness).sum();
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

    /// Strain rows xx, yy, xy of node `a`.
    fn b(g: &[[f64; 2]; 8], a: usize) -> [[f64; 2]; 3] {
        [[g[a][0], 0.0], [0.0, g[a][1]], [g[a][1], g[a][0]]]
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
        let point_ctx = PointContext {
            band_width: self.band_width,
            operator: ctx.operator,
            relaxation: ctx.relaxation,
        };
        for (p, (g, w)) in self.points.iter().enumerate() {
            let mut strain = Vector3::zeros();
            for a in 0..8 {
                for (i, row) in Self::b(g, a).iter().enumerate() {
                    strain[i] += row[0] * u[2 * a] + row[1] * u[2 * a + 1];
                }
            }
            let range = p * n..(p + 1) * n;
            let response = self
                .law
                .update(
                    &strain,
                    &committed[range.clone()],
                    &mut trial[range],
                    &point_ctx,
                )
                .map_err(|source| ElementError::Material { point: p, source })?;
            let d: Matrix3<f64> = response.tangent * *w;
            for a in 0..8 {
                let ba = Self::b(g, a);
                for k in 0..2 {
                    let column = Vector3::new(ba[0][k], ba[1][k], ba[2][k]);
                    out.force[2 * a + k] += w * column.dot(&response.stress);
                    if ctx.operator == Operator::None {
                        continue;
                    }
                    let row = d.tr_mul(&column);
                    for c in 0..8 {
                        let bc = Self::b(g, c);
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
}
