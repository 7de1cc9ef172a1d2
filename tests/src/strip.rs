//! A fibre strip bonded to a rigid face.

use std::sync::Arc;

use fe_contact::envelope::{Bilinear, LuJoint};
use fe_contact::{BondSettings, Interface, Interface16, InterfaceRule, SlipDamage};
use fe_core::dof::Dof;
use fe_core::element::{Element, ElementError};
use fe_core::material::{Material, MaterialError};
use fe_core::mesh::{CellKind, Mesh, NodeId};
use fe_core::model::{Conditions, Model, ModelError};
use fe_core::shape::quad8;
use fe_elements::{Membrane8, QuadRule};
use fe_materials::Elastic;

use crate::mesh::lines;

/// Width b_f of the strip of the closed form (mm).
pub const WIDTH: f64 = 50.0;
/// Thickness t_f (mm).
pub const THICKNESS: f64 = 0.165;
/// Young's modulus E_f along the fibres (MPa).
pub const YOUNG: f64 = 228_000.0;

/// Bond of the strip of the closed form: f_t = 2.2 MPa, the strip half as wide as the concrete; tau_max = 3.30 MPa,
/// s0 = 0.0429 mm, s_f = 0.27687 mm, G_f = 0.45684 N/mm.
///
/// # Errors
///
/// None for these numbers.
pub fn bond() -> Result<Bilinear, MaterialError> {
    let joint = LuJoint {
        ft_mpa: 2.2,
        width_ratio: 0.5,
    };
    joint.bilinear()
}

/// A strip along x on the face z = 0, one element wide, without lateral contraction; its interface elements come
/// after the sheet's.
#[derive(Debug)]
pub struct Strip {
    /// Sheet and interface elements.
    pub model: Model,
    /// Nodes of the sheet.
    pub sheet: Vec<NodeId>,
    /// Nodes of the face it is bonded to, in the same order.
    pub face: Vec<NodeId>,
}

impl Strip {
    /// A strip of equal elements with the bond of the closed form, bonded along `length` (mm).
    ///
    /// # Panics
    ///
    /// For a length or a size of the elements that is not positive.
    pub fn uniform(length: f64, size: f64) -> Self {
        let bond = bond().expect("a bond");
        let law = SlipDamage::new(bond, BondSettings::default()).expect("a law");
        let x = lines(0.0, length, (length / size).round() as usize);
        Self::new(&x, InterfaceRule::Gauss3, &(Arc::new(law) as _)).expect("a strip")
    }

    /// A strip with one element between neighbouring lines `x` (mm), all of it bonded.
    ///
    /// # Errors
    ///
    /// [`ElementError`].
    ///
    /// # Panics
    ///
    /// For lines that are not numbers.
    pub fn new(
        x: &[f64],
        rule: InterfaceRule,
        law: &Arc<dyn Material<Interface>>,
    ) -> Result<Self, ElementError> {
        let mut places = Vec::new();
        for (i, &at) in x.iter().enumerate() {
            for y in [0.0, 0.5, 1.0] {
                places.push([at, y * WIDTH, 0.0]);
            }
            if let Some(next) = x.get(i + 1) {
                for y in [0.0, 1.0] {
                    places.push([at.midpoint(*next), y * WIDTH, 0.0]);
                }
            }
        }
        let count = places.len();
        let cells = (0..x.len() - 1).map(|i| {
            let first = 5 * i;
            [0, 5, 7, 2, 3, 6, 4, 1].map(|k| first + k)
        });
        let cells: Vec<[NodeId; 8]> = cells.collect();
        let fibres = Elastic::new(YOUNG, 0.0).map_err(material)?;
        let fibres = Arc::new(fibres);
        let mut elements: Vec<Box<dyn Element>> = Vec::new();
        for cell in &cells {
            elements.push(Box::new(Membrane8::new(
                *cell,
                &cell.map(|n| places[n]),
                THICKNESS,
                QuadRule::Full,
                [1.0, 0.0, 0.0],
                fibres.clone(),
            )?));
        }
        for cell in &cells {
            let coords = cell.map(|n| places[n]);
            let nodes = std::array::from_fn(|a| if a < 8 { count + cell[a] } else { cell[a - 8] });
            elements.push(Box::new(Interface16::new(
                nodes,
                &coords,
                [1.0, 0.0, 0.0],
                rule,
                Arc::clone(law),
            )?));
        }
        places.extend_from_within(..);
        let mut mesh = Mesh::new(places).expect("places are numbers");
        mesh.add_block("sheet", CellKind::Quad8, cells.concat())
            .expect("nodes are there");
        Ok(Self {
            model: Model::new(mesh, elements).expect("nodes are there"),
            sheet: (0..count).collect(),
            face: (count..2 * count).collect(),
        })
    }

    /// The face is held, the sheet moves along x only.
    ///
    /// # Errors
    ///
    /// [`ModelError`].
    pub fn held(&self) -> Result<Conditions, ModelError> {
        let mut conditions = Conditions::new(&self.model);
        for &node in &self.face {
            for dof in Dof::DISPLACEMENTS {
                conditions.fix(&self.model, node, dof)?;
            }
        }
        for &node in &self.sheet {
            conditions.fix(&self.model, node, Dof::Uy)?;
            conditions.fix(&self.model, node, Dof::Uz)?;
        }
        Ok(conditions)
    }

    /// Nodes of the sheet at a line, with their share of a force that acts uniformly over the width.
    pub fn line(&self, x: f64) -> Vec<(NodeId, f64)> {
        let at = |&&n: &&NodeId| (self.model.mesh().nodes()[n][0] - x).abs() < 1e-9;
        let shares = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];
        self.sheet.iter().filter(at).copied().zip(shares).collect()
    }
}

fn material(source: MaterialError) -> ElementError {
    ElementError::Material { point: 0, source }
}

/// Places of the nodes of an 8-node square of the given size (mm) in the plane z = 0.
pub fn square(size: f64) -> [[f64; 3]; 8] {
    quad8::NODES.map(|[x, y]| [0.5 * size * (1.0 + x), 0.5 * size * (1.0 + y), 0.0])
}
