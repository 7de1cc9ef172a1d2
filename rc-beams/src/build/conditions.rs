//! Supports, loads and what is measured on them; the two load stages.

use fe_core::dof::Dof;
use fe_core::mesh::NodeId;
use fe_core::model::{Conditions, Model};

use super::BuildError;
use crate::spec::{Held, LoadMeasure, Specimen};

/// Nodes closer than this (mm) to a line or plane lie on it.
const ON: f64 = 1e-6;

/// A line of nodes across the width, held or pushed vertically.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Position along the beam (mm).
    pub x: f64,
    /// Height above the soffit (mm).
    pub y: f64,
    /// Nodes.
    nodes: Vec<NodeId>,
    /// Vertical DOFs.
    pub vertical: Vec<usize>,
}

impl Line {
    fn new(model: &Model, what: &str, x: f64, y: f64) -> Result<Self, BuildError> {
        let nodes = nodes(model, |p| (p[0] - x).abs() < ON && (p[1] - y).abs() < ON);
        if nodes.is_empty() {
            let what = what.to_owned();
            return Err(BuildError::NoNode { what, x, y });
        }
        let vertical = nodes.iter().map(|&n| model.dof(n, Dof::Uy));
        let mut vertical: Vec<usize> = vertical.collect::<Result<_, _>>()?;
        // Nodes that follow one another have one DOF.
        vertical.dedup();
        Ok(Self {
            x,
            y,
            nodes,
            vertical,
        })
    }

    /// Force (N) on the line, half width, from the reaction of each DOF; positive upwards.
    pub fn force(&self, reaction: impl Fn(usize) -> f64) -> f64 {
        self.vertical.iter().map(|&d| reaction(d)).sum()
    }
}

/// Where loads and deflections are read.
#[derive(Debug, Clone, PartialEq)]
pub struct Measures {
    /// Supports, from left to right.
    pub supports: Vec<Line>,
    /// Loads, from left to right.
    pub loads: Vec<Line>,
    /// Vertical DOF whose downward displacement is the deflection.
    pub deflection: usize,
    /// Where it is (mm): the node nearest to the place that is asked for.
    pub deflection_at: [f64; 3],
    load: LoadMeasure,
}

impl Measures {
    pub(super) fn new(specimen: &Specimen, model: &Model) -> Result<Self, BuildError> {
        let height = specimen.beam.height_mm.get();
        let supports = specimen.supports.iter().map(|s| {
            let stub = s.stub.as_ref().map_or(0.0, |stub| stub.depth_mm.get());
            let y = -stub - s.plate.thickness_mm.get();
            Line::new(model, "the line of a support", s.x_mm.get(), y)
        });
        let loads = specimen.loads.iter().map(|l| {
            let y = height + l.plate.thickness_mm.get();
            Line::new(model, "the line of a load", l.x_mm.get(), y)
        });
        let p = &specimen.measuring.deflection;
        let at = [p.x_mm.get(), p.y_mm.get(), p.z_mm.get()];
        let distance = |n: &NodeId| -> f64 {
            let x = model.mesh().nodes()[*n];
            (0..3).map(|k| (x[k] - at[k]).powi(2)).sum()
        };
        let nearest = (0..model.mesh().nodes().len())
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .ok_or_else(|| BuildError::NoNode {
                what: "the gauge of the deflection".into(),
                x: at[0],
                y: at[1],
            })?;
        Ok(Self {
            supports: supports.collect::<Result<_, _>>()?,
            loads: loads.collect::<Result<_, _>>()?,
            deflection: model.dof(nearest, Dof::Uy)?,
            deflection_at: model.mesh().nodes()[nearest],
            load: specimen.measuring.load,
        })
    }

    /// Support reactions (N) of the half model, from the reaction of each DOF.
    pub fn reactions(&self, reaction: impl Fn(usize) -> f64 + Copy) -> Vec<f64> {
        self.supports.iter().map(|s| s.force(reaction)).collect()
    }

    /// Reported load of the whole width (kN) from the support reactions (N) of the half model, self
    /// weight included or not as the reactions are.
    ///
    /// All reactions together, or, for the shear force at an inner support, the load of one span (the sum
    /// of all reactions shared equally by the spans, as the tests report it) less the reaction of its end
    /// support.
    pub fn load_kn(&self, reactions: &[f64]) -> f64 {
        let total: f64 = reactions.iter().sum();
        let half = match self.load {
            LoadMeasure::TotalReactions => total,
            LoadMeasure::InnerShear { end_support } => {
                let spans = self.supports.len().saturating_sub(1) as f64;
                total / spans - reactions.get(end_support).copied().unwrap_or(0.0)
            }
        };
        2.0 * half / 1e3
    }
}

/// Conditions of the stages: self weight alone; the imposed deflection of all loads under constant self weight;
/// the same with the loads moving up.
pub(super) fn stages(
    specimen: &Specimen,
    model: &Model,
    measures: &Measures,
    weight: &[(NodeId, [f64; 3])],
) -> Result<[Conditions; 3], BuildError> {
    let mut held = Conditions::new(model);
    for node in nodes(model, |p| p[2].abs() < ON) {
        held.fix(model, node, Dof::Uz)?;
    }
    for (line, support) in measures.supports.iter().zip(&specimen.supports) {
        for &node in &line.nodes {
            for held_dof in &support.held {
                let dof = match held_dof {
                    Held::Ux => Dof::Ux,
                    Held::Uy => Dof::Uy,
                };
                held.fix(model, node, dof)?;
            }
        }
    }
    let (mut first, mut down) = (held.clone(), held);
    for &(node, f) in weight {
        first.add_reference(model, node, Dof::Uy, f[1])?;
        down.add_dead(model, node, Dof::Uy, f[1])?;
    }
    let mut up = down.clone();
    for line in &measures.loads {
        for &node in &line.nodes {
            down.prescribe(model, node, Dof::Uy, -1.0)?;
            up.prescribe(model, node, Dof::Uy, 1.0)?;
        }
    }
    Ok([first, down, up])
}

fn nodes(model: &Model, test: impl Fn(&[f64; 3]) -> bool) -> Vec<NodeId> {
    let all = model.mesh().nodes().iter().enumerate();
    all.filter(|(_, p)| test(p)).map(|(n, _)| n).collect()
}
