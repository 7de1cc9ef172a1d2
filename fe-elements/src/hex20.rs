//! The 20-node hexahedron with reduced, 14-point or full integration.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::kinematics::Solid;
use fe_core::material::{Material, Operator, PointContext, Response};
use fe_core::mesh::{CellKind, NodeId};
use fe_core::shape::{hex20, quadrature};
use nalgebra::{Matrix6, Vector3, Vector6};

use crate::kernel::{self, MAX_POINTS, PAD, Point};
use crate::points;

/// Integration rule of a hexahedron.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HexRule {
    /// 2 x 2 x 2 Gauss points: cheap, six spurious zero-energy modes per free element.
    Reduced,
    /// 14 points, see [`quadrature::irons`]: as exact as 27 Gauss points, without mechanisms.
    Irons,
    /// 3 x 3 x 3 Gauss points.
    Full,
}

impl HexRule {
    fn points(self) -> Vec<([f64; 3], f64)> {
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
        /// Normal of the plane of the cracks' traces, of any length.
        normal: [f64; 3],
        /// Factor on the side of the equivalent square.
        factor: f64,
    },
    /// The same for every point (mm).
    Fixed(f64),
}

impl BandWidth {
    fn of(self, coords: &[[f64; 3]; 20], volume: f64, points: usize) -> f64 {
        match self {
            Self::CubeRoot => (volume / points as f64).cbrt(),
            Self::InPlane { normal, factor } => {
                let n = Vector3::from(normal).normalize();
                let along = coords.map(|x| n.dot(&Vector3::from(x)));
                let extent = along.iter().fold(f64::MIN, |a, &b| a.max(b))
                    - along.iter().fold(f64::MAX, |a, &b| a.min(b));
                factor * (volume / extent).sqrt()
            }
            Self::Fixed(width) => width,
        }
    }
}

/// 20-node hexahedron, K = sum w B^T D B, f = sum w B^T sigma.
#[derive(Debug)]
pub struct Hex20 {
    nodes: [NodeId; 20],
    points: Vec<Point>,
    positions: Vec<[f64; 3]>,
    band_width: f64,
    law: Arc<dyn Material<Solid>>,
}

impl Hex20 {
    /// An element at node coordinates `coords` (mm).
    ///
    /// # Errors
    ///
    /// [`ElementError::Jacobian`] for a cell that is inverted or folded at one of the 3x3x3 points,
    /// [`ElementError::Input`] for a crack-band width that is not positive, [`ElementError::Material`] when the law
    /// refuses it.
    pub fn new(
        nodes: [NodeId; 20],
        coords: &[[f64; 3]; 20],
        rule: HexRule,
        law: Arc<dyn Material<Solid>>,
        band: BandWidth,
    ) -> Result<Self, ElementError> {
        let map = |point, xi| match hex20::map(coords, xi) {
            mapped @ (_, _, determinant) if determinant > 0.0 => Ok(mapped),
            (_, _, determinant) => Err(ElementError::Jacobian { point, determinant }),
        };
        if rule != HexRule::Full {
            // Fewer points see less of a fold.
            for (point, (xi, _)) in quadrature::cube(3).into_iter().enumerate() {
                map(point, xi)?;
            }
        }
        let mut points = Vec::new();
        let mut positions = Vec::new();
        for (point, (xi, w)) in rule.points().into_iter().enumerate() {
            let (position, gradients, determinant) = map(point, xi)?;
            let mut g = [[0.0; PAD]; 3];
            for (a, d) in gradients.iter().enumerate() {
                for k in 0..3 {
                    g[k][a] = d[k];
                }
            }
            points.push((g, w * determinant));
            positions.push(position.into());
        }
        let volume: f64 = points.iter().map(|p| p.1).sum();
        let band_width = band.of(coords, volume, points.len());
        if !(band_width.is_finite() && band_width > 0.0) {
            return Err(ElementError::Input {
                what: "crack-band width (mm)".into(),
                value: band_width,
                allowed: "(0, inf)".into(),
                remedy: "give a positive width, or a normal that is not zero".into(),
            });
        }
        law.admit(&PointContext::new(band_width))
            .map_err(|source| ElementError::Material { point: 0, source })?;
        Ok(Self {
            nodes,
            points,
            positions,
            band_width,
            law,
        })
    }

    /// Asks the law at every point and hands each answer to `take`.
    fn respond(
        &self,
        strains: &[Vector6<f64>],
        states: (&[f64], &mut [f64]),
        ctx: &EvaluationContext,
        mut take: impl FnMut(usize, &Response<Solid>),
    ) -> Result<(), ElementError> {
        let ctx = points::context(self.band_width, ctx);
        let strains = &strains[..self.points.len()];
        self.law
            .update_many(strains, states, &ctx, &mut take)
            .map_err(|(point, source)| ElementError::Material { point, source })
    }

    /// Volume (mm3).
    pub fn volume(&self) -> f64 {
        self.points.iter().map(|p| p.1).sum()
    }

    /// Crack-band width h (mm).
    pub const fn band_width(&self) -> f64 {
        self.band_width
    }
}

impl Element for Hex20 {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn dofs(&self) -> &'static [Dof] {
        &Dof::DISPLACEMENTS
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
        let count = self.points.len();
        let u = kernel::by_direction(u);
        let mut strains = [Vector6::zeros(); MAX_POINTS];
        kernel::strains(&self.points, &u, &mut strains[..count]);
        let mut stresses = strains;
        let stresses = &mut stresses[..count];
        if ctx.operator == Operator::None {
            self.respond(&strains, (committed, trial), ctx, |p, response| {
                stresses[p] = response.stress;
            })?;
        } else {
            let mut tangents = [Matrix6::zeros(); MAX_POINTS];
            self.respond(&strains, (committed, trial), ctx, |p, response| {
                stresses[p] = response.stress;
                tangents[p] = response.tangent;
            })?;
            let tangents = &mut tangents[..count];
            let unsymmetric = self.unsymmetric() && ctx.operator == Operator::Tangent;
            if unsymmetric && ctx.symmetric_part {
                for d in &mut *tangents {
                    *d = 0.5 * (*d + d.transpose());
                }
            }
            let symmetric = ctx.symmetric_part || !unsymmetric;
            kernel::stiffness(&self.points, tangents, symmetric, out.stiffness);
        }
        let force = kernel::force(&self.points, stresses);
        for a in 0..20 {
            for k in 0..3 {
                out.force[3 * a + k] += force[k][a];
            }
        }
        Ok(())
    }

    fn cell(&self) -> Option<CellKind> {
        Some(CellKind::Hex20)
    }

    fn unsymmetric(&self) -> bool {
        self.law.unsymmetric_tangent()
    }

    fn fills_symmetric_part(&self) -> bool {
        true
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        points::latch(self.law.as_ref(), trial, base)
    }

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Option<f64> {
        let u = kernel::by_direction(u);
        let mut strains = [Vector6::zeros(); MAX_POINTS];
        let strains = &mut strains[..self.points.len()];
        kernel::strains(&self.points, &u, strains);
        let law = self.law.as_ref();
        if points::unload_to_origin(law, self.band_width, state, strains) {
            return None;
        }
        let volumes = self.points.iter().map(|p| p.1);
        let points = volumes.zip(strains.iter().copied());
        points::free_energy(law, self.band_width, state, points)
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        let mut strains = [Vector6::zeros(); MAX_POINTS];
        kernel::strains(&self.points, &kernel::by_direction(u), &mut strains);
        let places = self.points.iter().zip(&self.positions);
        let points = places
            .zip(strains)
            .map(|((p, x), strain)| (*x, p.1, strain));
        points::sample(self.law.as_ref(), self.band_width, state, points, visit)
    }
}
