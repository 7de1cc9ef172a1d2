//! Fibre sheets on the faces of the concrete, and what bonds them.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use fe_contact::envelope::{Bilinear, LuJoint};
use fe_contact::{BondSettings, Interface16, InterfaceRule, SlipDamage};
use fe_core::element::Element;
use fe_core::followers::Followers;
use fe_core::mesh::{Mesh, NodeId};
use fe_core::skin::{self, Layers};
use fe_elements::{BandWidth, Hex20, HexRule, Linear, Membrane8, QuadRule};
use fe_materials::Elastic;
use fe_materials::concrete::ConcreteScalars;
use fe_materials::{Lamina, LaminaParameters, Laminate, Ply};

use super::laws::SolidLaw;
use super::{BuildError, ModelSettings};
use crate::options::{Bond, SheetShear, SoffitFibre, StripBond};
use crate::spec::{Adhesive, Cover, Face, SheetPly, Sheets, Specimen, Stretch, Wrap};

/// Axis 1 of the sheets, from which the fibres are measured: the beam axis.
const AXIS: [f64; 3] = [1.0, 0.0, 0.0];
/// Points closer than this (mm) to a plane lie in it.
const ON: f64 = 1e-6;

/// A stretch of sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    /// Name of its wrap, numbered from the left where there are several stretches.
    pub name: String,
    /// Left end (mm).
    pub x_from_mm: f64,
    /// Right end (mm).
    pub x_to_mm: f64,
    /// Lower and upper end on the side (mm); equal where it leaves the side bare.
    pub side_mm: [f64; 2],
    /// Height covered between them (mm), less where bands lie one above the other.
    pub covered_mm: f64,
}

/// One element of sheet with its bond.
#[derive(Debug, Clone)]
pub struct SheetCell {
    /// Index of the zone it belongs to.
    pub zone: usize,
    /// Face of the beam.
    pub face: Face,
    /// Plies.
    pub laminate: Arc<Laminate>,
    /// Curve of the bond.
    pub curve: Bilinear,
    /// Law of the bond, with that curve.
    pub bond: Arc<SlipDamage>,
    /// Element of the sheet.
    pub membrane: usize,
    /// Element of the interface, unless the bond is perfect.
    pub interface: Option<usize>,
}

/// Sheets of a model.
#[derive(Debug, Clone)]
pub struct SheetRecord {
    /// Stretches of sheet.
    pub zones: Vec<Zone>,
    /// Elements of sheet.
    pub cells: Vec<SheetCell>,
    /// Sheet elements.
    pub membranes: Range<usize>,
    /// Adhesive elements.
    pub adhesive: Range<usize>,
    /// Interface elements.
    pub interfaces: Range<usize>,
    /// Node of the concrete under every node of sheet and adhesive.
    pub below: BTreeMap<NodeId, NodeId>,
}

impl SheetRecord {
    /// The node of the concrete under a node, itself where it is one of the concrete.
    pub(super) fn carrier(&self, node: NodeId) -> NodeId {
        self.below.get(&node).copied().unwrap_or(node)
    }

    /// Sheets on soffit and top that are uniform across the width; their `elements` are counted from 0.
    pub(super) fn uniform_across(&self, mesh: &Mesh, elements: &[Box<dyn Element>]) -> Followers {
        let flat = self.cells.iter().filter(|cell| cell.face != Face::Side);
        let nodes = flat.flat_map(|cell| elements[cell.membrane].nodes());
        Followers::uniform_across(mesh, nodes.copied())
    }

    /// The same with all elements counted from `first`.
    pub(super) fn from(mut self, first: usize) -> Self {
        for range in [
            &mut self.membranes,
            &mut self.adhesive,
            &mut self.interfaces,
        ] {
            *range = range.start + first..range.end + first;
        }
        for cell in &mut self.cells {
            cell.membrane += first;
            cell.interface = cell.interface.map(|i| i + first);
        }
        self
    }
}

/// Lays the sheets of a specimen on the faces of the concrete `blocks`. Returns them with their elements,
/// counted from 0.
pub(super) fn lay(
    specimen: &Specimen,
    sheets: &Sheets,
    settings: &ModelSettings,
    (mesh, blocks): (&mut Mesh, &[&str]),
) -> Result<(SheetRecord, Vec<Box<dyn Element>>), BuildError> {
    let glue: SolidLaw = Arc::new(glue(&sheets.adhesive)?);
    let outer = skin::outer_faces(mesh, blocks);
    let mut parts = Parts::default();
    let mut record = SheetRecord {
        zones: Vec::new(),
        cells: Vec::new(),
        membranes: 0..0,
        adhesive: 0..0,
        interfaces: 0..0,
        below: BTreeMap::new(),
    };
    for wrap in &sheets.wraps {
        let curve = bond(specimen, wrap, settings)?;
        let law = Arc::new(SlipDamage::new(curve, BondSettings::default())?);
        let laminates = wrap
            .faces
            .iter()
            .map(|cover| Ok(Arc::new(laminate(&sheets.ply, cover, settings)?)))
            .collect::<Result<Vec<_>, BuildError>>()?;
        let (side_mm, covered_mm) = side(&wrap.faces);
        for (name, stretch) in wrap.sheet_names().zip(&wrap.stretches) {
            let zone = record.zones.len();
            record.zones.push(Zone {
                name,
                x_from_mm: stretch.x_from_mm.get(),
                x_to_mm: stretch.x_to_mm.get(),
                side_mm,
                covered_mm,
            });
            let covered: Vec<(skin::Face, &Cover, &Arc<Laminate>)> = wrap
                .faces
                .iter()
                .zip(&laminates)
                .flat_map(|(cover, laminate)| {
                    let faces = outer
                        .iter()
                        .filter(|f| lies_on(f, specimen, stretch, cover));
                    faces.map(move |f| (*f, cover, laminate))
                })
                .collect();
            let faces: Vec<skin::Face> = covered.iter().map(|(f, _, _)| *f).collect();
            let mut layers = Layers::over(&faces);
            for (face, cover, laminate) in covered {
                let below = face.nodes;
                let t = sheets.adhesive.layer_thickness_mm.get();
                let above = match settings.bond {
                    Bond::Perfect => below,
                    Bond::Cohesive => {
                        let above = layers.nodes(mesh, below, 0, 0.0)?;
                        parts.bond(mesh, below, above, &law)?;
                        above
                    }
                    Bond::Adhesive => {
                        let inner = layers.nodes(mesh, below, 1, t)?;
                        let outer = layers.nodes(mesh, below, 2, t)?;
                        let corners = [below[0], below[1], below[2], below[3]];
                        let middle = layers.nodes(mesh, corners, 3, 0.5 * t)?;
                        parts.glue(mesh, (below, inner, middle), &glue)?;
                        parts.bond(mesh, inner, outer, &law)?;
                        let above = layers.nodes(mesh, below, 4, 2.0 * t)?;
                        let middle = layers.nodes(mesh, corners, 5, 1.5 * t)?;
                        parts.glue(mesh, (outer, above, middle), &glue)?;
                        above
                    }
                };
                record.cells.push(SheetCell {
                    zone,
                    face: cover.face,
                    laminate: laminate.clone(),
                    curve,
                    bond: law.clone(),
                    membrane: parts.membranes.len(),
                    interface: parts.interfaces.len().checked_sub(1),
                });
                let coords = above.map(|n| mesh.nodes()[n]);
                let (t, rule) = (laminate.thickness_mm(), QuadRule::Full);
                let sheet = Membrane8::new(above, &coords, t, rule, AXIS, laminate.clone())?;
                parts
                    .membranes
                    .push(Box::new(Linear::new(Box::new(sheet))?));
            }
            record
                .below
                .extend(layers.pairs().map(|(below, above)| (above, below)));
        }
    }
    let mut elements = parts.membranes;
    record.membranes = 0..elements.len();
    elements.extend(parts.adhesive);
    record.adhesive = record.membranes.end..elements.len();
    elements.extend(parts.interfaces);
    record.interfaces = record.adhesive.end..elements.len();
    for cell in &mut record.cells {
        cell.interface = cell.interface.map(|i| i + record.interfaces.start);
    }
    Ok((record, elements))
}

/// Whether a face of the concrete lies under a cover.
fn lies_on(face: &skin::Face, specimen: &Specimen, stretch: &Stretch, cover: &Cover) -> bool {
    let [x, y, z] = face.centre;
    let within = |v: f64, from: f64, to: f64| from - ON < v && v < to + ON;
    let (on, across) = match cover.face {
        Face::Side => ((z - specimen.half_width_mm()).abs() < ON, y),
        Face::Soffit => (y.abs() < ON && face.normal[1] < 0.0, z),
        Face::Top => ((y - specimen.beam.height_mm.get()).abs() < ON, z),
    };
    on && within(x, stretch.x_from_mm.get(), stretch.x_to_mm.get())
        && within(across, cover.from_mm.get(), cover.to_mm.get())
}

/// Extent of the covers on the side and the height that they cover together (mm).
fn side(covers: &[Cover]) -> ([f64; 2], f64) {
    let on_side = covers.iter().filter(|c| c.face == Face::Side);
    let ends = on_side.map(|c| [c.from_mm.get(), c.to_mm.get()]);
    let covered = ends.clone().map(|[from, to]| to - from).sum();
    let extent = ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    (extent.unwrap_or_default(), covered)
}

/// Elements of the sheets by kind.
#[derive(Default)]
struct Parts {
    membranes: Vec<Box<dyn Element>>,
    adhesive: Vec<Box<dyn Element>>,
    interfaces: Vec<Box<dyn Element>>,
}

impl Parts {
    fn bond(
        &mut self,
        mesh: &Mesh,
        below: [NodeId; 8],
        above: [NodeId; 8],
        law: &Arc<SlipDamage>,
    ) -> Result<(), BuildError> {
        let nodes = std::array::from_fn(|i| if i < 8 { below[i] } else { above[i - 8] });
        let coords = below.map(|n| mesh.nodes()[n]);
        let rule = InterfaceRule::Gauss3;
        let element = Interface16::new(nodes, &coords, AXIS, rule, law.clone())?;
        self.interfaces.push(Box::new(element));
        Ok(())
    }

    /// A layer of adhesive between two faces, with the nodes half-way between their corners.
    fn glue(
        &mut self,
        mesh: &Mesh,
        (below, above, middle): ([NodeId; 8], [NodeId; 8], [NodeId; 4]),
        law: &SolidLaw,
    ) -> Result<(), BuildError> {
        let nodes: [NodeId; 20] = std::array::from_fn(|i| match i {
            0..4 => below[i],
            4..8 => above[i - 4],
            8..12 => below[i - 4],
            12..16 => above[i - 8],
            _ => middle[i - 16],
        });
        let coords = nodes.map(|n| mesh.nodes()[n]);
        let (rule, band) = (HexRule::Full, BandWidth::CubeRoot);
        let element = Hex20::new(nodes, &coords, rule, law.clone(), band)?;
        self.adhesive
            .push(Box::new(Linear::new(Box::new(element))?));
        Ok(())
    }
}

/// Bond after Lu, Teng, Ye and Jiang (2005), bilinear. The reported strength is read as the characteristic one,
/// fcm = reported + 8 MPa. The width ratio b_f/b_c is that of the wrap: 1 under a sheet, whatever part of the width it covers, and, under
/// strips, their width over their spacing, as Chen and Teng (2003) do for strips; the reference takes 1 there too, and so arrives at its table of bonds.
pub(super) fn bond(
    specimen: &Specimen,
    wrap: &Wrap,
    settings: &ModelSettings,
) -> Result<Bilinear, BuildError> {
    let strength = specimen.concrete.reported_strength_mpa.get();
    let fcm = ConcreteScalars::from_characteristic(strength)?.fcm_mpa;
    let ratio = match settings.strip_bond {
        StripBond::Sheet => 1.0,
        StripBond::Strip => wrap.width_ratio(specimen.beam.height_mm.get()),
    };
    Ok(LuJoint::from_cylinder_strength(fcm, ratio).bilinear()?)
}

fn glue(adhesive: &Adhesive) -> Result<Elastic, BuildError> {
    Ok(Elastic::new(
        adhesive.young_mpa.get(),
        adhesive.poisson.get(),
    )?)
}

/// Plies of a cover, as the settings read them.
fn laminate(
    ply: &SheetPly,
    cover: &Cover,
    settings: &ModelSettings,
) -> Result<Laminate, BuildError> {
    let young = ply.fibre_modulus_mpa.get();
    let lamina = Lamina::new(&LaminaParameters {
        young_1_mpa: young,
        young_2_mpa: ply.transverse_modulus_mpa.get(),
        shear_mpa: match settings.sheet_shear {
            SheetShear::Given => ply.shear_modulus_mpa.get(),
            SheetShear::Half => 0.5 * young,
        },
        poisson_12: ply.poisson.get(),
        strength_mpa: ply.rupture_mpa.get(),
    })?;
    let along = cover.face == Face::Soffit && settings.soffit_fibre == SoffitFibre::Along;
    let plies = cover.angles_deg.iter().map(|angle| Ply {
        lamina,
        angle_deg: if along { 0.0 } else { angle.get() },
        thickness_mm: ply.thickness_mm.get() * cover.smear(),
    });
    Ok(Laminate::new(plies.collect())?)
}
