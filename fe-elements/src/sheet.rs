//! The element behind the 8-node quadrilaterals in plane stress: strain in a tangent plane, one law.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::kinematics::PlaneStress;
use fe_core::material::{Material, Operator, PointContext, Response};
use fe_core::mesh::{CellKind, NodeId};
use nalgebra::Vector3;

use crate::input::positive;
use crate::points;

/// Plane-stress element of 8 nodes with N/8 displacements each,
///
/// K = sum w B^T D B, f = sum w B^T sigma, w being the volume of an integration point and B the 3 x N matrix
/// of the strains 11, 22, 12 (engineering shear).
///
/// Built as [`Quad8`](crate::Quad8) (N = 16) or [`Membrane8`](crate::Membrane8) (N = 24).
#[derive(Debug)]
pub struct Sheet<const N: usize> {
    nodes: [NodeId; 8],
    points: Vec<Point<N>>,
    band_width: f64,
    law: Arc<dyn Material<PlaneStress>>,
}

/// One Gauss point.
#[derive(Debug, Clone)]
pub(crate) struct Point<const N: usize> {
    pub(crate) position: [f64; 3],
    /// Volume the point stands for (mm3).
    pub(crate) volume: f64,
    /// Rows 11, 22, 12 of B (1/mm).
    pub(crate) b: [[f64; N]; 3],
}

impl<const N: usize> Point<N> {
    pub(crate) fn strain(&self, u: &[f64]) -> Vector3<f64> {
        let row = |b: &[f64; N]| b.iter().zip(u).map(|(b, u)| b * u).sum();
        Vector3::new(row(&self.b[0]), row(&self.b[1]), row(&self.b[2]))
    }

    /// Adds w B^T sigma and, if an operator is asked for, w B^T D B; of the latter the upper triangle unless
    /// `unsymmetric`.
    pub(crate) fn add(
        &self,
        response: &Response<PlaneStress>,
        operator: Operator,
        unsymmetric: bool,
        force: &mut [f64],
        stiffness: &mut [f64],
    ) {
        let [b0, b1, b2] = &self.b;
        let s = response.stress * self.volume;
        for (i, f) in force.iter_mut().enumerate().take(N) {
            *f += b0[i] * s[0] + b1[i] * s[1] + b2[i] * s[2];
        }
        if operator == Operator::None {
            return;
        }
        let d = response.tangent * self.volume;
        for (i, row) in stiffness.chunks_exact_mut(N).enumerate() {
            let r = d.tr_mul(&Vector3::new(b0[i], b1[i], b2[i]));
            for j in if unsymmetric { 0 } else { i }..N {
                row[j] += r[0] * b0[j] + r[1] * b1[j] + r[2] * b2[j];
            }
        }
    }
}

impl<const N: usize> Sheet<N> {
    /// The element of the given points; the crack-band width is the square root of the area.
    pub(crate) fn of_points(
        nodes: [NodeId; 8],
        points: Vec<Point<N>>,
        thickness: f64,
        law: Arc<dyn Material<PlaneStress>>,
    ) -> Result<Self, ElementError> {
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

/// Refuses a thickness (mm) that is not positive.
pub(crate) fn admit_thickness(thickness: f64) -> Result<(), ElementError> {
    positive("thickness_mm", thickness, "give a positive thickness")
}

impl<const N: usize> Element for Sheet<N> {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn dofs(&self) -> &'static [Dof] {
        const { Dof::DISPLACEMENTS.split_at(N / 8).0 }
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
        let law = self.law.as_ref();
        let point_ctx = points::context(self.band_width, ctx);
        let (operator, unsymmetric) = (ctx.operator, self.law.unsymmetric_tangent());
        for (p, point) in self.points.iter().enumerate() {
            let states = (committed, &mut *trial);
            let response = points::answer(law, (p, &point.strain(u)), states, &point_ctx)?;
            point.add(&response, operator, unsymmetric, out.force, out.stiffness);
        }
        Ok(())
    }

    fn cell(&self) -> Option<(CellKind, &[NodeId])> {
        Some((CellKind::Quad8, self.nodes()))
    }

    fn unsymmetric(&self) -> bool {
        self.law.unsymmetric_tangent()
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        points::latch(self.law.as_ref(), trial, base)
    }

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Result<Option<f64>, ElementError> {
        let points = self.points.iter().map(|p| (p.volume, p.strain(u)));
        points::free_energy(self.law.as_ref(), self.band_width, state, points).map(Some)
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
