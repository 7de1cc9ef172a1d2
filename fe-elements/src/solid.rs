//! What solid elements have in common: laws at integration points, whatever interpolates between them.

use std::fmt::Debug;
use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::kinematics::Solid;
use fe_core::material::{Material, Operator, PointContext, Response};
use fe_core::mesh::{CellKind, NodeId};
use nalgebra::{Matrix6, Vector6};

use crate::input::positive;
use crate::kernel::MAX_POINTS;
use crate::points;

/// Interpolation of a solid between the DOFs of its nodes, three displacements each, node-major.
pub trait Interpolation: Debug + Send + Sync {
    /// Nodes with DOFs.
    fn nodes(&self) -> &[NodeId];

    /// Nodes of the hexahedron to draw.
    fn cell(&self) -> &[NodeId; 20];

    /// Volumes (mm3) that the integration points stand for.
    fn volumes(&self) -> impl Iterator<Item = f64>;

    /// Strains B u at the points.
    fn strains(&self, u: &[f64], out: &mut [Vector6<f64>]);

    /// Adds the sum over the points of w B^T sigma.
    fn add_force(&self, stresses: &[Vector6<f64>], out: &mut [f64]);

    /// Adds the sum over the points of w B^T D B, the upper triangle at least if `symmetric`.
    fn add_stiffness(&self, tangents: &[Matrix6<f64>], symmetric: bool, out: &mut [f64]);
}

/// A solid element, K = sum w B^T D B, f = sum w B^T sigma.
#[derive(Debug)]
pub struct SolidElement<I> {
    interpolation: I,
    positions: Vec<[f64; 3]>,
    band_width: f64,
    law: Arc<dyn Material<Solid>>,
}

impl<I: Interpolation> SolidElement<I> {
    /// An element with integration points at `positions` (mm): one for each volume of the interpolation, 27 at most.
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] for another number of points, or a volume or a crack-band width (mm) that is not positive,
    /// [`ElementError::Material`] when the law refuses that width.
    pub fn of(
        interpolation: I,
        positions: Vec<[f64; 3]>,
        law: Arc<dyn Material<Solid>>,
        band_width: f64,
    ) -> Result<Self, ElementError> {
        let volumes = interpolation.volumes().count();
        if positions.len() != volumes || volumes > MAX_POINTS {
            return Err(ElementError::Input {
                what: "number of integration points with a position".into(),
                value: positions.len() as f64,
                allowed: format!("{volumes}, one for each volume, and {MAX_POINTS} at most"),
                remedy: "give every integration point its position".into(),
            });
        }
        for volume in interpolation.volumes() {
            positive(
                "volume of an integration point (mm3)",
                volume,
                "number the nodes so that the element is not turned inside out",
            )?;
        }
        positive(
            "crack-band width (mm)",
            band_width,
            "give a positive width or factor, and a normal of finite numbers that is not zero",
        )?;
        law.admit(&PointContext::new(band_width))
            .map_err(|source| ElementError::Material { point: 0, source })?;
        Ok(Self {
            interpolation,
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
        self.law
            .update_many(strains, states, &ctx, &mut take)
            .map_err(|(point, source)| ElementError::Material { point, source })
    }

    /// Forces and stiffness with room for `N` points.
    fn evaluate_in<const N: usize>(
        &self,
        u: &[f64],
        states: (&[f64], &mut [f64]),
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        let ElementSystem { force, stiffness } = out;
        let count = self.positions.len();
        let mut strains = [Vector6::zeros(); N];
        let strains = &mut strains[..count];
        self.interpolation.strains(u, strains);
        let mut stresses = [Vector6::zeros(); N];
        let stresses = &mut stresses[..count];
        if ctx.operator == Operator::None {
            self.respond(strains, states, ctx, |p, response| {
                stresses[p] = response.stress;
            })?;
        } else {
            let mut tangents = [Matrix6::zeros(); N];
            self.respond(strains, states, ctx, |p, response| {
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
            self.interpolation
                .add_stiffness(tangents, self.fills_upper(ctx), stiffness);
        }
        self.interpolation.add_force(stresses, force);
        Ok(())
    }

    /// Volume (mm3).
    pub fn volume(&self) -> f64 {
        self.interpolation.volumes().sum()
    }

    /// Crack-band width h (mm).
    pub const fn band_width(&self) -> f64 {
        self.band_width
    }
}

impl<I: Interpolation> Element for SolidElement<I> {
    fn nodes(&self) -> &[NodeId] {
        self.interpolation.nodes()
    }

    fn dofs(&self) -> &'static [Dof] {
        &Dof::DISPLACEMENTS
    }

    fn state_len(&self) -> usize {
        self.positions.len() * self.law.state_len()
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
        // Room for few points is cleared sooner.
        match self.positions.len() {
            0..=9 => self.evaluate_in::<9>(u, (committed, trial), ctx, out),
            10..=14 => self.evaluate_in::<14>(u, (committed, trial), ctx, out),
            _ => self.evaluate_in::<MAX_POINTS>(u, (committed, trial), ctx, out),
        }
    }

    fn cell(&self) -> Option<(CellKind, &[NodeId])> {
        Some((CellKind::Hex20, self.interpolation.cell()))
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

    fn free_energy(&self, u: &[f64], state: &[f64]) -> Result<Option<f64>, ElementError> {
        let mut strains = [Vector6::zeros(); MAX_POINTS];
        let strains = &mut strains[..self.positions.len()];
        self.interpolation.strains(u, strains);
        let law = self.law.as_ref();
        if points::unload_to_origin(law, self.band_width, state, strains) {
            return Ok(None);
        }
        let points = self.interpolation.volumes().zip(strains.iter().copied());
        points::free_energy(law, self.band_width, state, points).map(Some)
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        let mut strains = [Vector6::zeros(); MAX_POINTS];
        let strains = &mut strains[..self.positions.len()];
        self.interpolation.strains(u, strains);
        let places = self.positions.iter().zip(self.interpolation.volumes());
        let points = places
            .zip(strains.iter())
            .map(|((x, volume), strain)| (*x, volume, *strain));
        points::sample(self.law.as_ref(), self.band_width, state, points, visit)
    }
}
