//! From a specimen and settings to a model: mesh, laws, bars, conditions, and what to measure.

mod conditions;
mod gauges;
mod laws;
mod lines;
mod mesh;
mod reinforcement;
mod settings;
#[cfg(test)]
mod tests;

use std::ops::Range;

use fe_core::element::{Element, ElementError};
use fe_core::material::MaterialError;
use fe_core::mesh::{MeshError, NodeId};
use fe_core::model::{Conditions, Model, ModelError};
use fe_elements::{BandWidth, Hex20, HexRule, loads};

pub use conditions::{Line, Measures};
pub use gauges::Gauge;
pub use reinforcement::{BarKind, BarRecord};
pub use settings::ModelSettings;

use crate::spec::Specimen;

/// Why a model could not be built.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// Too few elements along the beam.
    #[error(
        "mesh: {nx} elements along the beam are too few for the plates of {specimen}; give more, for \
         example --mesh {example}x4x1"
    )]
    TooFewElements {
        /// Specimen.
        specimen: String,
        /// Elements asked for.
        nx: usize,
        /// A number that works.
        example: usize,
    },
    /// The mesh is impossible.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// An element is impossible.
    #[error(transparent)]
    Element(#[from] ElementError),
    /// A law is impossible.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A condition is impossible.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A point of the specimen has no node.
    #[error("no node of the mesh lies at {what} ({x:.1}, {y:.1}) mm")]
    NoNode {
        /// What should be there.
        what: String,
        /// Position (mm).
        x: f64,
        /// Position (mm).
        y: f64,
    },
}

/// A beam ready to run.
#[derive(Debug)]
pub struct Beam {
    /// Mesh, elements, numbering.
    pub model: Model,
    /// Elements of concrete, stubs included.
    pub concrete: Range<usize>,
    /// Bars and the elements they were cut into.
    pub bars: Vec<BarRecord>,
    /// What is measured.
    pub measures: Measures,
    /// Strain gauges.
    pub gauges: Vec<Gauge>,
    /// Stage 1: self weight, load factor 0 to 1.
    pub weight: Conditions,
    /// Stage 2: the load factor is the imposed deflection of the loads (mm).
    pub loading: Conditions,
}

impl Beam {
    /// Builds the half model of a specimen.
    ///
    /// # Errors
    ///
    /// [`BuildError`].
    pub fn new(specimen: &Specimen, settings: &ModelSettings) -> Result<Self, BuildError> {
        let mesh = mesh::mesh(specimen, settings)?;
        let concrete_laws = laws::concrete_laws(specimen, settings, &mesh)?;
        let mut elements: Vec<Box<dyn Element>> = Vec::new();
        let mut weight = Vec::new();
        let density = laws::weight_density(specimen);
        let band = settings.band_width();
        for (name, law) in &concrete_laws {
            for (nodes, coords) in cells(&mesh, name) {
                weight.extend(loads::body_force(&nodes, &coords, [0.0, -density, 0.0]));
                let law = law.clone();
                elements.push(Box::new(Hex20::new(
                    nodes,
                    &coords,
                    settings.integration,
                    law,
                    band,
                )?));
            }
        }
        let concrete = 0..elements.len();
        for (name, law) in laws::plates(specimen)? {
            for (nodes, coords) in cells(&mesh, &name) {
                let (rule, band) = (HexRule::Full, BandWidth::CubeRoot);
                elements.push(Box::new(Hex20::new(
                    nodes,
                    &coords,
                    rule,
                    law.clone(),
                    band,
                )?));
            }
        }
        let hosts: Vec<&str> = concrete_laws.iter().map(|(name, _)| *name).collect();
        let mut bars = Vec::new();
        for (bar, record) in reinforcement::bars(specimen, settings)? {
            let first = elements.len();
            let pieces = fe_elements::embed(&[bar], &mesh, &hosts)?;
            elements.extend(pieces.into_iter().map(|e| Box::new(e) as Box<dyn Element>));
            bars.push(BarRecord {
                elements: first..elements.len(),
                ..record
            });
        }
        let model = Model::new(mesh, elements);
        let measures = Measures::new(specimen, &model)?;
        let (weight, loading) = conditions::stages(specimen, &model, &measures, &weight)?;
        let gauges = gauges::gauges(specimen, &model, &bars);
        Ok(Self {
            model,
            concrete,
            bars,
            measures,
            gauges,
            weight,
            loading,
        })
    }
}

/// Nodes and coordinates (mm) of the cells of a block; none for an unknown name.
fn cells(
    mesh: &fe_core::mesh::Mesh,
    block: &str,
) -> impl Iterator<Item = ([NodeId; 20], [[f64; 3]; 20])> {
    let cells = mesh
        .block(block)
        .into_iter()
        .flat_map(fe_core::mesh::Block::cells);
    cells.map(|cell| {
        let nodes: [NodeId; 20] = std::array::from_fn(|a| cell[a]);
        (nodes, nodes.map(|n| mesh.nodes()[n]))
    })
}
