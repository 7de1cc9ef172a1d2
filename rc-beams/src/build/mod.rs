//! From a specimen and settings to a model: mesh, laws, bars, conditions, and what to measure.

mod conditions;
mod gauges;
mod laws;
mod lines;
mod mesh;
mod reinforcement;
mod settings;
#[cfg(test)]
mod sheet_tests;
mod sheets;
mod slipping;
#[cfg(test)]
mod slipping_tests;
#[cfg(test)]
mod tests;

use std::ops::Range;

use fe_core::check;
use fe_core::element::{Element, ElementError};
use fe_core::followers::Followers;
use fe_core::material::MaterialError;
use fe_core::mesh::{MeshError, NodeId};
use fe_core::model::{Conditions, Model, ModelError};
use fe_core::state::StateStore;
use fe_elements::{BandWidth, Hex20, HexRule, Installed, Led, Linear, UniformHex20, loads};

pub use conditions::{Line, Measures};
pub use gauges::Gauge;
pub(crate) use laws::has_law;
pub use mesh::default_mesh;
pub use reinforcement::{BarKind, BarRecord};
pub use settings::ModelSettings;
pub use sheets::{SheetCell, SheetRecord, Zone};

use crate::options::Bond;
use crate::spec::{Sheets, Specimen};

/// Why a model could not be built.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// Too few elements in one direction.
    #[error(
        "mesh: {elements} elements {along} the beam are too few for the plates and sheets of {specimen}; {}",
        least.map_or_else(|| "nor would any more do".into(), |n| format!("with --mesh give {n} or more as the {} count", nth(along)))
    )]
    TooFewElements {
        /// Specimen.
        specimen: String,
        /// Direction: along, up or across.
        along: &'static str,
        /// Elements asked for.
        elements: usize,
        /// The least number that will do, if any does.
        least: Option<usize>,
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
    /// Two gauges would share a column.
    #[error(
        "{column:?} would be two columns of gauges.csv, where bars have gauges named BAR_xPLACE and stirrups stirrup_xPLACE; \
         give the gauge or the bar another name"
    )]
    TwoGauges {
        /// The column.
        column: String,
    },
}

/// Which count of a mesh is that in a direction.
fn nth(along: &str) -> &'static str {
    match along {
        "along" => "first",
        "up" => "second",
        _ => "third",
    }
}

/// A beam ready to run.
#[derive(Debug)]
pub struct Beam {
    /// Mesh, elements, numbering.
    pub model: Model,
    /// Elements of concrete, stubs included.
    pub concrete: Range<usize>,
    /// Crack-band width of every element of concrete (mm).
    pub bands: Vec<f64>,
    /// Mean tensile strength of the concrete (MPa).
    pub tensile_mpa: f64,
    /// Elements of the plates.
    pub plates: Range<usize>,
    /// Bars and the elements they were cut into.
    pub bars: Vec<BarRecord>,
    /// Sheets, if any.
    pub sheets: Option<SheetRecord>,
    /// What is measured.
    pub measures: Measures,
    /// Strain gauges.
    pub gauges: Vec<Gauge>,
    /// Stage 1: self weight, load factor 0 to 1.
    pub weight: Conditions,
    /// Stage 2: the load factor is the imposed deflection of the loads (mm).
    pub loading: Conditions,
    /// The same with the loads moving up.
    pub unloading: Conditions,
}

impl Beam {
    /// Builds the half model of a specimen, with the sheets bonded before it is loaded.
    ///
    /// # Errors
    ///
    /// [`BuildError`].
    pub fn new(specimen: &Specimen, settings: &ModelSettings) -> Result<Self, BuildError> {
        Self::build(specimen, settings, specimen.sheets.as_ref(), None)
    }

    /// Builds the half model without its sheets, on the mesh it has with them.
    ///
    /// # Errors
    ///
    /// [`BuildError`].
    pub fn bare(specimen: &Specimen, settings: &ModelSettings) -> Result<Self, BuildError> {
        Self::build(specimen, settings, None, None)
    }

    /// Bonds the sheets of a specimen to its [`bare`](Self::bare) model displaced by `u`, free of stress in
    /// that state. Returns the model, the displacement of all its DOFs in that state, and the states of its
    /// elements.
    ///
    /// # Errors
    ///
    /// [`BuildError`].
    pub fn strengthened(
        &self,
        specimen: &Specimen,
        settings: &ModelSettings,
        (u, state): (&[f64], &StateStore),
    ) -> Result<(Self, Vec<f64>, StateStore), BuildError> {
        let displaced = |node: NodeId| self.model.displacement(node, u);
        let sheets = specimen.sheets.as_ref();
        let mut beam = Self::build(specimen, settings, sheets, Some(&displaced))?;
        let start: Vec<f64> = (0..beam.model.dofs().len())
            .map(|d| {
                let (node, dof) = beam.model.dofs().owner(d);
                let sheets = beam.sheets.as_ref();
                let node = sheets.map_or(node, |sheets| sheets.carrier(node));
                displaced(node).get(dof as usize).copied().unwrap_or(0.0)
            })
            .collect();
        let mut states = StateStore::new(beam.model.elements());
        states.adopt(state)?;
        for gauge in &mut beam.gauges {
            gauge.zero_at(&start);
        }
        Ok((beam, start, states))
    }

    fn build(
        specimen: &Specimen,
        settings: &ModelSettings,
        sheets: Option<&Sheets>,
        displaced: Option<&Displaced<'_>>,
    ) -> Result<Self, BuildError> {
        let mut mesh = mesh::mesh(specimen, settings)?;
        let concrete_laws = laws::concrete_laws(specimen, settings, &mesh)?;
        let mut followers = match settings.mesh.nz {
            Some(_) => Followers::default(),
            None => Followers::uniform_across(&mesh, 0..mesh.nodes().len()),
        };
        let mut elements: Vec<Box<dyn Element>> = Vec::new();
        let mut weight = Vec::new();
        let mut bands = Vec::new();
        let density = laws::weight_density(specimen);
        let band = settings.band_width();
        for (name, law) in &concrete_laws {
            for (nodes, coords) in cells(&mesh, name) {
                weight.extend(loads::body_force(&nodes, &coords, [0.0, -density, 0.0]));
                let (law, rule) = (law.clone(), settings.integration);
                if followers.is_empty() {
                    let element = Hex20::new(nodes, &coords, rule, law, band)?;
                    bands.push(element.band_width());
                    elements.push(Box::new(element));
                } else {
                    let element = UniformHex20::new(nodes, &coords, &followers, rule, law, band)?;
                    bands.push(element.band_width());
                    elements.push(Box::new(element));
                }
            }
        }
        let concrete = 0..elements.len();
        for (name, law) in laws::plates(specimen)? {
            for (nodes, coords) in cells(&mesh, &name) {
                let (rule, band) = (HexRule::Full, BandWidth::CubeRoot);
                let plate = Hex20::new(nodes, &coords, rule, law.clone(), band)?;
                let plate = Led::by(Box::new(plate), &followers);
                elements.push(Box::new(Linear::new(plate)?));
            }
        }
        let plates = concrete.end..elements.len();
        let hosts: Vec<&str> = concrete_laws.iter().map(|(name, _)| *name).collect();
        let carrier = (&mut mesh, hosts.as_slice());
        let bars = reinforcement::lay(specimen, settings, carrier, &followers, &mut elements)?;
        let sheets = match sheets {
            Some(sheets) => {
                let carrier = (&mut mesh, hosts.as_slice());
                let (record, added) = sheets::lay(specimen, sheets, settings, carrier)?;
                if !followers.is_empty() && settings.bond == Bond::Cohesive {
                    followers.extend(record.uniform_across(&mesh, &added));
                }
                let first = elements.len();
                for element in added {
                    let element = match displaced {
                        Some(displaced) => install(element, &record, displaced)?,
                        None => element,
                    };
                    elements.push(Led::by(element, &followers));
                }
                Some(record.from(first))
            }
            None => None,
        };
        let model = Model::with_followers(mesh, elements, followers)?;
        let measures = Measures::new(specimen, &model)?;
        let [weight, loading, unloading] =
            conditions::stages(specimen, &model, &measures, &weight)?;
        check::joined(&model)?;
        for conditions in [&weight, &loading] {
            check::held(&model, conditions)?;
        }
        let gauges = gauges::gauges(specimen, &model, &bars, sheets.as_ref())?;
        Ok(Self {
            model,
            concrete,
            bands,
            tensile_mpa: laws::tensile_strength(specimen, settings)?,
            plates,
            bars,
            sheets,
            measures,
            gauges,
            weight,
            loading,
            unloading,
        })
    }
}

/// Displacement (mm) of a node of the bare model.
type Displaced<'a> = dyn Fn(NodeId) -> [f64; 3] + 'a;

/// Installs an element of sheet, adhesive or interface free of stress over displaced concrete.
fn install(
    element: Box<dyn Element>,
    record: &SheetRecord,
    displaced: &Displaced<'_>,
) -> Result<Box<dyn Element>, ElementError> {
    let nodes = element.nodes().iter();
    let origin = nodes.flat_map(|&n| displaced(record.carrier(n))).collect();
    Ok(Box::new(Installed::new(element, origin)?))
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
