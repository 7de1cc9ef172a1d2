//! Bar with nodes of its own: the 3-node truss.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::kinematics::Axial;
use fe_core::material::{Material, Operator, PointContext};
use fe_core::mesh::NodeId;
use fe_core::points;
use fe_core::shape::{line3, quadrature};
use nalgebra::{Vector1, Vector3};

use crate::input::positive;

/// One of the two Gauss points.
#[derive(Debug, Clone)]
struct Point {
    position: [f64; 3],
    /// Axial strain = `row` . u.
    row: [f64; 9],
    /// Volume the point stands for (mm3).
    volume: f64,
}

/// Quadratic bar in space, ends first, then the middle; axial strain only, 2 Gauss points:
///
/// $$ \varepsilon = \sum_a \frac{dN_a}{ds} t \cdot u_a, \qquad f = \int A B^T \sigma ds. $$
///
/// It has no stiffness across its axis: something else must hold it there, a bond element for instance.
#[derive(Debug)]
pub struct Truss3 {
    nodes: [NodeId; 3],
    coords: [[f64; 3]; 3],
    length: f64,
    points: Vec<Point>,
    law: Arc<dyn Material<Axial>>,
}

const DOFS: [Dof; 3] = Dof::DISPLACEMENTS;

impl Truss3 {
    /// A bar at `coords` (mm) of cross-section `area_mm2`.
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] for an area that is not positive, [`ElementError::Jacobian`] for a bar without length or whose
    /// middle node lies nearer to an end than a quarter, [`ElementError::Material`] when the law refuses the point.
    pub fn new(
        nodes: [NodeId; 3],
        coords: &[[f64; 3]; 3],
        area_mm2: f64,
        law: Arc<dyn Material<Axial>>,
    ) -> Result<Self, ElementError> {
        positive("area_mm2", area_mm2, "give a positive area")?;
        if let Some((point, determinant)) = line3::turns_back(coords) {
            return Err(ElementError::Jacobian { point, determinant });
        }
        let mut points = Vec::new();
        let mut length = 0.0;
        for (point, (xi, w)) in quadrature::gauss_legendre(2).into_iter().enumerate() {
            let (position, along, _, slopes) = line3::map(coords, xi);
            let determinant = along.norm();
            let chord = Vector3::from(coords[1]) - Vector3::from(coords[0]);
            if determinant.is_nan() || along.dot(&chord) <= 0.0 {
                let determinant = determinant.copysign(along.dot(&chord));
                return Err(ElementError::Jacobian { point, determinant });
            }
            let mut row = [0.0; 9];
            for (a, slope) in slopes.iter().enumerate() {
                for k in 0..3 {
                    row[3 * a + k] = slope * along[k] / determinant.powi(2);
                }
            }
            length += w * determinant;
            points.push(Point {
                position: position.into(),
                row,
                volume: area_mm2 * w * determinant,
            });
        }
        law.admit(&PointContext::new(length))
            .map_err(|source| ElementError::Material { point: 0, source })?;
        Ok(Self {
            nodes,
            coords: *coords,
            length,
            points,
            law,
        })
    }
}

impl Point {
    fn strain(&self, u: &[f64]) -> Vector1<f64> {
        Vector1::new(self.row.iter().zip(u).map(|(b, u)| b * u).sum())
    }
}

impl Element for Truss3 {
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
        let law = self.law.as_ref();
        let point_ctx = points::context(self.length, ctx);
        for (p, point) in self.points.iter().enumerate() {
            let states = (committed, &mut *trial);
            let response = points::answer(law, (p, &point.strain(u)), states, &point_ctx)?;
            for i in 0..9 {
                out.force[i] += point.volume * response.stress[0] * point.row[i];
                if ctx.operator != Operator::None {
                    let factor = point.volume * response.tangent[(0, 0)] * point.row[i];
                    for j in 0..9 {
                        out.stiffness[9 * i + j] += factor * point.row[j];
                    }
                }
            }
        }
        Ok(())
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        points::latch(self.law.as_ref(), trial, base)
    }

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Result<Option<f64>, ElementError> {
        let points = self.points.iter().map(|p| (p.volume, p.strain(u)));
        points::free_energy(self.law.as_ref(), self.length, state, points).map(Some)
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
        points::sample(self.law.as_ref(), self.length, state, points, visit)
    }

    fn segments(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut([[f64; 3]; 2], f64),
    ) -> Result<(), ElementError> {
        let [first, last, middle] = self.coords;
        let mut halves = [[first, middle], [middle, last]].into_iter();
        self.sample(u, state, &mut |s| {
            if let Some(half) = halves.next() {
                visit(half, s.stress[0]);
            }
        })
    }
}

#[cfg(test)]
mod tests {
    //! Protects bars from places that make none.
    use super::*;
    use fe_materials::Elastic;

    /// A middle node beyond a quarter turns an end back; one at infinity, or coincident ends, are no bar.
    #[test]
    fn impossible_bars_are_refused() {
        let build = |first, last, middle, area| {
            let law = Arc::new(Elastic::new(200e3, 0.0).unwrap());
            Truss3::new([0, 1, 2], &[first, last, middle], area, law)
        };
        let (first, last, middle) = ([0.0; 3], [8.0, 0.0, 0.0], [4.0, 1.0, 0.0]);
        assert!(build(first, last, middle, 1.0).is_ok());
        for (last, middle) in [
            (last, [1.5, 0.0, 0.0]),
            (last, [4.0, f64::INFINITY, 0.0]),
            (last, [f64::NAN, 0.0, 0.0]),
            (first, first),
        ] {
            let error = build(first, last, middle, 1.0).unwrap_err();
            assert!(matches!(error, ElementError::Jacobian { .. }), "{error}");
        }
        for area in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = build(first, last, middle, area).unwrap_err();
            assert!(error.to_string().contains("area_mm2"), "{error}");
        }
    }
}
