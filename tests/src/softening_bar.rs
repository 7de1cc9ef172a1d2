//! Bar in tension with one crack band at its fixed end; the rest is elastic.
//!
//! Elastic bar and cohesive crack in series: the peak is ft A, the critical opening wc = 2 GF/ft = 0.07273 mm, the work
//! GF A. The loaded end moves back where the bar is longer than 2 E GF/ft^2 = 991.7 mm.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::Elastic;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters, TensionSoftening};
use nalgebra::Vector3;

use crate::conditions::{hold, push_faces};
use crate::mesh::{boxes, cells, lines, nodes_where};

/// Young's modulus E (MPa).
pub const YOUNG: f64 = 30_000.0;
/// Tensile strength ft (MPa).
pub const STRENGTH: f64 = 2.2;
/// Fracture energy GF (N/mm), of linear softening.
pub const ENERGY: f64 = 0.08;
/// Critical opening (mm).
pub const OPENING: f64 = 2.0 * ENERGY / STRENGTH;
/// Section (mm2).
pub const AREA: f64 = 100.0;

/// Concrete of a tensile strength (MPa) without lateral contraction.
fn concrete(strength: f64, tension_softening: TensionSoftening) -> FixedCrack {
    let parameters = FixedCrackParameters {
        ft_mpa: strength,
        poisson: 0.0,
        tension_softening,
        fracture_energy: ENERGY,
        ..FixedCrackParameters::from_strength(30.0, STRENGTH, YOUNG)
    };
    FixedCrack::new(parameters, None).expect("a concrete")
}

/// A bar of `n` cells, the first of which cracks, pulled by 1 MPa per unit of the load factor.
///
/// # Panics
///
/// For a length that is not positive.
pub fn bar(length: f64, n: usize) -> (Model, Conditions) {
    banded(length, n, length / n as f64)
}

/// The same of which the law takes the crack band for `band` (mm) wide, whatever the cell.
///
/// # Panics
///
/// For a length that is not positive.
pub fn banded(length: f64, n: usize, band: f64) -> (Model, Conditions) {
    pulled(length, n, (0, band), TensionSoftening::Linear)
}

/// A bar of `n` cells, the first of which cracks, with exponential softening, sigma = ft exp(-(e - ft/E)/e_f) over the strain e of
/// that cell, e_f = GF/(ft h) - ft/(2 E).
///
/// # Panics
///
/// For a length that is not positive.
pub fn exponential(length: f64, n: usize) -> (Model, Conditions) {
    let first = (0, length / n as f64);
    pulled(length, n, first, TensionSoftening::Exponential)
}

/// A bar of which the cell `crack` cracks, in a band of a width (mm).
///
/// # Panics
///
/// For a length that is not positive.
pub fn pulled(
    length: f64,
    n: usize,
    (crack, band): (usize, f64),
    softening: TensionSoftening,
) -> (Model, Conditions) {
    let strengths: Vec<_> = (0..n).map(|i| (i == crack).then_some(STRENGTH)).collect();
    let model = cracking(length, &strengths, (band, softening));
    let mut conditions = held(&model);
    push_faces(
        &model,
        &mut conditions,
        |x| x[0] == length,
        |_| Vector3::x(),
    )
    .expect("a bar");
    (model, conditions)
}

/// A bar of which one end is moved by 1 mm per unit of the load factor; cells of the given tensile strengths (MPa).
///
/// # Panics
///
/// For a length that is not positive.
pub fn moved(length: f64, strengths: &[f64]) -> (Model, Conditions) {
    let strengths: Vec<_> = strengths.iter().map(|s| Some(*s)).collect();
    let band = length / strengths.len() as f64;
    let model = cracking(length, &strengths, (band, TensionSoftening::Linear));
    let mut conditions = held(&model);
    for node in nodes_where(model.mesh(), |x| x[0] == length) {
        conditions
            .prescribe(&model, node, Dof::Ux, 1.0)
            .expect("a bar");
    }
    (model, conditions)
}

/// Cells along x with crack bands of a width (mm) and a softening, elastic where there is no strength.
fn cracking(
    length: f64,
    strengths: &[Option<f64>],
    (width, softening): (f64, TensionSoftening),
) -> Model {
    let n = strengths.len();
    let mesh = boxes(&lines(0.0, length, n), &[0.0, 10.0], &[0.0, 10.0]).expect("a bar");
    let mut elements: Vec<Box<dyn Element>> = Vec::new();
    for ((nodes, coords), strength) in cells(&mesh, &mesh.blocks()[0]).zip(strengths) {
        let law: Arc<dyn Material<Solid>> = match strength {
            Some(strength) => Arc::new(concrete(*strength, softening)),
            None => Arc::new(Elastic::new(YOUNG, 0.0).expect("a bar")),
        };
        let band = BandWidth::Fixed(width);
        elements.push(Box::new(
            Hex20::new(nodes, &coords, HexRule::Full, law, band).expect("a bar"),
        ));
    }
    Model::new(mesh, elements).expect("a bar")
}

/// Supports of a bar without lateral contraction: one end held.
///
/// # Panics
///
/// For a model that is no bar.
pub fn held(model: &Model) -> Conditions {
    let mut conditions = Conditions::new(model);
    hold(model, &mut conditions, &[Dof::Uy, Dof::Uz], |_| true).expect("a bar");
    hold(model, &mut conditions, &[Dof::Ux], |x| x[0] == 0.0).expect("a bar");
    conditions
}
