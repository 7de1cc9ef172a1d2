//! Small laws and elements that the tests of this crate share.
#![allow(dead_code)]

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use fe_core::kinematics::{Axial, Kinematics, Solid};
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use fe_core::mesh::{CellKind, NodeId};
use fe_core::shape::hex20;
use fe_core::voigt;
use nalgebra::{Matrix3, Matrix6, Vector1, Vector3, Vector6};

/// Linear elasticity with any stiffness and secant matrix.
#[derive(Debug)]
pub struct Elastic {
    pub tangent: Matrix6<f64>,
    pub secant: Matrix6<f64>,
}

impl Elastic {
    pub fn new(stiffness: &Matrix6<f64>) -> Self {
        Self {
            tangent: *stiffness,
            secant: *stiffness,
        }
    }

    pub fn isotropic(young: f64, poisson: f64) -> Self {
        Self::new(&voigt::isotropic(young, poisson))
    }
}

impl Material<Solid> for Elastic {
    fn name(&self) -> &'static str {
        "elastic"
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        _committed: &[f64],
        _trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        Ok(Response {
            stress: self.tangent * strain,
            tangent: match ctx.operator {
                Operator::Secant => self.secant,
                _ => self.tangent,
            },
        })
    }

    fn free_energy(&self, strain: &Vector6<f64>, _: &[f64], _: &PointContext) -> Option<f64> {
        Some(0.5 * strain.dot(&(self.tangent * strain)))
    }
}

/// What is special about a [`Damage`] law or a [`Truss`]: most are breaches of the contract.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flaw {
    None,
    TangentOffByOnePercent,
    ReadsTrial,
    ForgetsAnEntry,
    SoftensOnUnloading,
    /// Its free energy is infinite.
    EndlessEnergy,
    /// Its tangent at no strain is infinite.
    RigidAtRest,
    IndefiniteSecant,
    StressOfTheOldState,
    OtherStressWithoutOperator,
    Grounded,
    Unsymmetric,
    /// Unsymmetric, and promises a symmetric part that it does not fill.
    PromisesSymmetricPart,
    Refuses,
    Latches,
    /// Points together are answered otherwise than alone.
    OtherStressTogether,
    /// The last of several points is not answered.
    DropsAPoint,
}

/// Uniaxial damage: sigma = (1 - d(kappa)) E eps with kappa = max |eps|, d = 1 - (e0/kappa) exp((e0 - kappa)/ef),
/// and a second state variable that records the strain.
///
/// Its step dissipates E (d' - d) eps^2/2 + (1 - d') E (eps' - eps)^2/2 >= 0.
#[derive(Debug)]
pub struct Damage(pub Flaw);

pub const YOUNG: f64 = 30e3;
const ONSET: f64 = 1e-4;
const DECAY: f64 = 5e-4;
const VARS: [StateVar; 2] = [
    StateVar::scalar("kappa", "-"),
    StateVar::scalar("last", "-"),
];

impl Damage {
    fn integrity(kappa: f64) -> f64 {
        if kappa <= ONSET {
            1.0
        } else {
            ONSET / kappa * ((ONSET - kappa) / DECAY).exp()
        }
    }
}

impl Material<Axial> for Damage {
    fn name(&self) -> &'static str {
        "damage"
    }

    fn state_vars(&self) -> &[StateVar] {
        &VARS
    }

    fn update_many(
        &self,
        strains: &[Vector1<f64>],
        (committed, trial): (&[f64], &mut [f64]),
        ctx: &PointContext,
        take: &mut dyn FnMut(usize, &Response<Axial>),
    ) -> Result<(), (usize, MaterialError)> {
        for (p, strain) in strains.iter().enumerate() {
            let own = 2 * p..2 * p + 2;
            let answer = self.update(strain, &committed[own.clone()], &mut trial[own], ctx);
            let mut response = answer.map_err(|error| (p, error))?;
            if self.0 == Flaw::OtherStressTogether {
                response.stress *= 1.0 + 1e-15;
            }
            if self.0 != Flaw::DropsAPoint || p + 1 < strains.len() {
                take(p, &response);
            }
        }
        Ok(())
    }

    fn update(
        &self,
        strain: &Vector1<f64>,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Axial>, MaterialError> {
        let e = strain[0];
        if self.0 == Flaw::Refuses {
            return Err(MaterialError::NotFinite {
                law: self.name(),
                component: 0,
            });
        }
        let old = if self.0 == Flaw::ReadsTrial {
            committed[0].max(trial[0])
        } else {
            committed[0]
        };
        let kappa = old.max(e.abs());
        trial[0] = kappa;
        if self.0 != Flaw::ForgetsAnEntry {
            trial[1] = e;
        }
        let damage = Self::integrity(if self.0 == Flaw::StressOfTheOldState {
            old
        } else {
            kappa
        });
        let mut stress = damage * YOUNG * e;
        let mut tangent = damage * YOUNG;
        if ctx.operator == Operator::Tangent && kappa > ONSET && e.abs() > old {
            tangent -= stress.abs() * (1.0 / kappa + 1.0 / DECAY);
        }
        match self.0 {
            Flaw::TangentOffByOnePercent if ctx.operator == Operator::Tangent => tangent *= 1.01,
            Flaw::RigidAtRest if e == 0.0 => tangent = f64::INFINITY,
            Flaw::IndefiniteSecant if ctx.operator == Operator::Secant => tangent = -tangent,
            Flaw::OtherStressWithoutOperator if ctx.operator == Operator::None => {
                stress *= 1.0 + 1e-15;
            }
            Flaw::SoftensOnUnloading => {
                // Hypoelastic, half as stiff on the way back: a closed cycle yields energy.
                let step = e - committed[1];
                let sigma = committed[0];
                tangent = if sigma * step < 0.0 {
                    0.5 * YOUNG
                } else {
                    YOUNG
                };
                stress = sigma + tangent * step;
                trial[0] = stress;
            }
            _ => {}
        }
        Ok(Response {
            stress: Vector1::new(stress),
            tangent: Vector1::new(tangent),
        })
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        let latches = self.0 == Flaw::Latches && base[0] != trial[0];
        if latches {
            base[0] = trial[0];
        }
        latches
    }

    fn free_energy(&self, strain: &Vector1<f64>, state: &[f64], _: &PointContext) -> Option<f64> {
        Some(match self.0 {
            Flaw::SoftensOnUnloading => 0.5 * state[0] * state[0] / YOUNG,
            Flaw::EndlessEnergy => f64::INFINITY,
            _ => 0.5 * Self::integrity(state[0]) * YOUNG * strain[0] * strain[0],
        })
    }

    fn report(&self, _: &Vector1<f64>, state: &[f64]) -> PointReport {
        PointReport {
            crack_strain: (state[0] - ONSET).max(0.0),
            ..PointReport::default()
        }
    }
}

/// A straight bar of two nodes and 100 mm2, eps = t . (u_2 - u_1)/L.
#[derive(Debug)]
pub struct Truss {
    nodes: [NodeId; 2],
    ends: [[f64; 3]; 2],
    law: Arc<dyn Material<Axial>>,
    flaw: Flaw,
}

const AREA: f64 = 100.0;

impl Truss {
    pub fn new(
        nodes: [NodeId; 2],
        coords: &[[f64; 3]],
        law: Arc<dyn Material<Axial>>,
        flaw: Flaw,
    ) -> Self {
        Self {
            nodes,
            ends: nodes.map(|n| coords[n]),
            law,
            flaw,
        }
    }

    /// Length and strain per displacement.
    fn geometry(&self) -> (f64, [f64; 6]) {
        let d = Vector3::from(self.ends[1]) - Vector3::from(self.ends[0]);
        let length = d.norm();
        let b = d / (length * length);
        (length, [-b[0], -b[1], -b[2], b[0], b[1], b[2]])
    }
}

impl Element for Truss {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn dofs(&self) -> &'static [Dof] {
        &Dof::DISPLACEMENTS
    }

    fn state_len(&self) -> usize {
        self.law.state_len()
    }

    fn init_state(&self, state: &mut [f64]) {
        self.law.init_state(state);
    }

    fn evaluate(
        &self,
        u: &[f64],
        committed: &[f64],
        trial: &mut [f64],
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        let (length, b) = self.geometry();
        let strain = Vector1::new(b.iter().zip(u).map(|(b, u)| b * u).sum());
        let point = PointContext {
            band_width: length,
            operator: ctx.operator,
            relaxation: ctx.relaxation,
        };
        let response = self
            .law
            .update(&strain, committed, trial, &point)
            .map_err(|source| ElementError::Material { point: 0, source })?;
        let volume = AREA * length;
        for i in 0..6 {
            out.force[i] += volume * response.stress[0] * b[i];
            if self.flaw == Flaw::Grounded {
                out.force[i] += 1e3 * u[i];
            }
        }
        if ctx.operator != Operator::None {
            let unsymmetric = if self.unsymmetric() { 0.1 } else { 0.0 };
            for i in 0..6 {
                for j in 0..6 {
                    out.stiffness[6 * i + j] += volume * response.tangent[0] * b[i] * b[j]
                        + unsymmetric * (i as f64 - j as f64);
                }
            }
            match self.flaw {
                Flaw::TangentOffByOnePercent => out.stiffness.iter_mut().for_each(|k| *k *= 1.01),
                Flaw::Grounded => (0..6).for_each(|i| out.stiffness[7 * i] += 1e3),
                _ => {}
            }
        }
        Ok(())
    }

    /// The unsymmetric part of the stiffness is made up: it serves the tests of assembly.
    fn unsymmetric(&self) -> bool {
        matches!(self.flaw, Flaw::Unsymmetric | Flaw::PromisesSymmetricPart)
    }

    fn fills_symmetric_part(&self) -> bool {
        self.flaw == Flaw::PromisesSymmetricPart
    }

    fn latch(&self, trial: &[f64], base: &mut [f64]) -> bool {
        self.law.latch(trial, base)
    }

    fn sample(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        let (length, b) = self.geometry();
        let strain = Vector1::new(b.iter().zip(u).map(|(b, u)| b * u).sum());
        let mut scratch = vec![0.0; state.len()];
        let ctx = PointContext::new(length).with_operator(Operator::None);
        let response = self
            .law
            .update(&strain, state, &mut scratch, &ctx)
            .map_err(|source| ElementError::Material { point: 0, source })?;
        visit(PointSample {
            position: std::array::from_fn(|k| 0.5 * (self.ends[0][k] + self.ends[1][k])),
            volume: AREA * length,
            strain: Axial::components(&strain),
            stress: Axial::components(&response.stress),
            report: self.law.report(&strain, state),
            state_vars: self.law.state_vars(),
            state,
        });
        Ok(())
    }

    fn segments(
        &self,
        u: &[f64],
        state: &[f64],
        visit: &mut dyn FnMut([[f64; 3]; 2], f64),
    ) -> Result<(), ElementError> {
        self.sample(u, state, &mut |s| visit(self.ends, s.stress[0]))
    }
}

/// A 20-node hexahedron with one integration point at its centre, for tests of output and numbering.
///
/// It is seen as two points: a quarter of the volume with crack strain 1e-3, the rest with 3e-3; and it
/// draws a segment between two points of it.
#[derive(Debug)]
pub struct Brick {
    nodes: [NodeId; 20],
    gradients: [[f64; 3]; 20],
    volume: f64,
    law: Elastic,
    pub segment: Option<[[f64; 3]; 2]>,
}

impl Brick {
    pub fn new(nodes: &[NodeId], coords: &[[f64; 3]]) -> Self {
        let nodes: [NodeId; 20] = nodes.try_into().unwrap();
        let (_, gradients, determinant) = hex20::map(&nodes.map(|n| coords[n]), [0.0; 3]);
        Self {
            nodes,
            gradients,
            volume: 8.0 * determinant,
            law: Elastic::isotropic(30e3, 0.2),
            segment: None,
        }
    }

    /// Column of B for a node and direction.
    fn column(&self, i: usize) -> Vector6<f64> {
        let (g, k) = (Vector3::from(self.gradients[i / 3]), i % 3);
        let unit = Matrix3::identity().column(k).into_owned();
        voigt::strain_voigt(&(0.5 * (g * unit.transpose() + unit * g.transpose())))
    }

    fn strain(&self, u: &[f64]) -> Vector6<f64> {
        (0..60).map(|i| u[i] * self.column(i)).sum()
    }
}

impl Element for Brick {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn dofs(&self) -> &'static [Dof] {
        &Dof::DISPLACEMENTS
    }

    fn state_len(&self) -> usize {
        0
    }

    fn init_state(&self, _: &mut [f64]) {}

    fn evaluate(
        &self,
        u: &[f64],
        _: &[f64],
        _: &mut [f64],
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        let stress = self.law.tangent * self.strain(u);
        for i in 0..60 {
            out.force[i] += self.volume * self.column(i).dot(&stress);
            if ctx.operator != Operator::None {
                for j in i..60 {
                    out.stiffness[60 * i + j] +=
                        self.volume * self.column(i).dot(&(self.law.tangent * self.column(j)));
                }
            }
        }
        Ok(())
    }

    fn cell(&self) -> Option<(CellKind, &[NodeId])> {
        Some((CellKind::Hex20, self.nodes()))
    }

    fn sample(
        &self,
        u: &[f64],
        _: &[f64],
        visit: &mut dyn FnMut(PointSample<'_>),
    ) -> Result<(), ElementError> {
        let strain = self.strain(u);
        let stress = self.law.tangent * strain;
        for (share, crack_strain, normal) in
            [(0.25, 1e-3, [1.0, 0.0, 0.0]), (0.75, 3e-3, [0.0, 1.0, 0.0])]
        {
            visit(PointSample {
                position: [0.0; 3],
                volume: share * self.volume,
                strain: Solid::components(&strain),
                stress: Solid::components(&stress),
                report: PointReport {
                    crack_strain,
                    crack_normal: normal,
                    crushing: crack_strain,
                    ..PointReport::default()
                },
                state_vars: &[],
                state: &[],
            });
        }
        Ok(())
    }

    fn host(&self) -> Option<&[NodeId; 20]> {
        Some(&self.nodes)
    }

    fn segments(
        &self,
        _: &[f64],
        _: &[f64],
        visit: &mut dyn FnMut([[f64; 3]; 2], f64),
    ) -> Result<(), ElementError> {
        if let Some(ends) = self.segment {
            visit(ends, 5.0);
        }
        Ok(())
    }
}
