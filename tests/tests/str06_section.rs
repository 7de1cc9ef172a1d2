//! STR-06: reinforced-concrete section of 200 mm x 400 mm, d = 360 mm, three bars of 16 mm, fc = 30 MPa (parabola-rectangle with
//! 2 and 3.5 permille), fy = 460 MPa, ft = 2.2 MPa, bent about one axis without normal force.
//!
//! Source: equilibrium of the section in closed form (c is the depth of the neutral axis, phi the curvature): cracking
//! 13.085 kNm; yielding 89.201 kNm, c = 109.97 mm, phi = 9.199e-6 per mm; ultimate 93.294 kNm, c = 57.125 mm,
//! phi = 6.127e-5 per mm.

use std::sync::Arc;

use fe_core::assembly::{Assembled, Assembler};
use fe_core::dof::Dof;
use fe_core::element::EvaluationContext;
use fe_core::kinematics::{Axial, Solid};
use fe_core::material::{Material, Operator};
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_core::testing::{within, within_share};
use fe_elements::{Bar, HexRule, embed};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_materials::{Biso, Elastic};
use fe_tests::laws::{Curve, Uniaxial};
use fe_tests::mesh::{BLOCK, boxes, hexahedra, lines, nodes_where};

const DEPTH: f64 = 400.0;
const COVER: f64 = 40.0;
const BARS: f64 = 3.0 * std::f64::consts::PI * 64.0;
/// Length of the piece of beam (mm).
const PIECE: f64 = 100.0;

/// A piece of the beam, cut into layers of cells; two Gauss points per layer and fibre.
struct Piece {
    model: Model,
}

impl Piece {
    fn new(
        layers: usize,
        concrete: &Arc<dyn Material<Solid>>,
        steel: Arc<dyn Material<Axial>>,
    ) -> Self {
        let mesh = boxes(&[0.0, PIECE], &lines(0.0, DEPTH, layers), &[0.0, 200.0]).unwrap();
        let mut elements = hexahedra(&mesh, HexRule::Reduced, concrete).unwrap();
        let bar = Bar {
            name: "bars".into(),
            polyline: vec![[0.0, COVER, 100.0], [PIECE, COVER, 100.0]],
            area_mm2: BARS,
            law: steel,
            dowel: None,
        };
        for element in embed(&[bar], &mesh, &[BLOCK]).unwrap() {
            elements.push(Box::new(element));
        }
        Self {
            model: Model::new(mesh, elements).unwrap(),
        }
    }

    /// Normal force (N) and sagging moment (N mm) about the top, under the strain phi (c - depth below the top):
    /// u_x = x e(y), u_y = -phi x^2/2.
    fn resultants(&self, phi: f64, neutral: f64) -> (f64, f64) {
        let model = &self.model;
        let mut u = vec![0.0; model.dofs().len()];
        for (node, [x, y, _]) in model.mesh().nodes().iter().copied().enumerate() {
            let strain = phi * (DEPTH - y - neutral);
            u[model.dof(node, Dof::Ux).unwrap()] = strain * x;
            u[model.dof(node, Dof::Uy).unwrap()] = 0.5 * phi * x * x;
        }
        let mut assembler = Assembler::new(model, &Conditions::new(model)).unwrap();
        let mut state = StateStore::new(model.elements());
        let mut out = Assembled::default();
        let ctx = EvaluationContext::new(Operator::None);
        assembler
            .evaluate(model, &u, &mut state, &ctx, &mut out)
            .unwrap();
        let face = nodes_where(model.mesh(), |x| x[0] == PIECE);
        face.iter().fold((0.0, 0.0), |(normal, moment), &node| {
            let force = out.internal[model.dof(node, Dof::Ux).unwrap()];
            (
                normal + force,
                moment + force * (DEPTH - model.mesh().nodes()[node][1]),
            )
        })
    }

    /// Moment (kNm) and depth of the neutral axis (mm) at a curvature, without normal force.
    fn bend(&self, phi: f64) -> (f64, f64) {
        let (mut low, mut high) = (0.0, DEPTH);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            // Less compression, more normal force, with a shallower neutral axis.
            if self.resultants(phi, middle).0 > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        (1e-6 * self.resultants(phi, low).1, low)
    }
}

fn cracked(layers: usize) -> Piece {
    let concrete: Arc<dyn Material<Solid>> = Arc::new(Uniaxial {
        curve: Curve::ParabolaRectangle {
            strength_mpa: 30.0,
            peak_strain: 2e-3,
        },
        young_mpa: 30_000.0,
        shear_mpa: 12_500.0,
    });
    Piece::new(
        layers,
        &concrete,
        Arc::new(Biso::hot_rolled(200e3, 460.0, 0.0).unwrap()),
    )
}

/// Elastic, the bar replacing concrete: moment at which the soffit reaches ft = 2.2 MPa. Target: 13.085 kNm.
#[test]
fn cracking_moment() {
    let concrete: Arc<dyn Material<Solid>> = Arc::new(Elastic::new(30e3, 0.0).unwrap());
    let piece = Piece::new(1, &concrete, Arc::new(Elastic::new(170e3, 0.0).unwrap()));
    let (moment, neutral) = piece.bend(1e-6);
    let soffit = 30e3 * 1e-6 * (DEPTH - neutral);
    within_share(
        "STR-06: cracking moment (kNm)",
        moment * 2.2 / soffit,
        13.085,
        5e-5,
    );
}

/// Yielding and ultimate state. Target: closed form within 0.05 % with 20 layers (40 fibres), the neutral axis within 0.5 %;
/// ultimate moment within 1 % with 4 layers (8 fibres), 0.05 % with 8 layers. The catalogue has -0.37, -0.07 and -0.03 % with 8, 16 and
/// 40 fibres of the same laws: its fibres are strips with the stress of their middle, by which these figures are found again. Here
/// they are Gauss points, two a layer: 0.78, -0.02 and 0.01 %, asserted within 0.01 % of the moment.
#[test]
fn yielding_and_ultimate_moment() {
    let ultimate = (6.127e-5, 93.294, 57.125);
    let piece = cracked(20);
    let yielding = (9.199e-6, 89.201, 109.97);
    for (name, (phi, moment, neutral)) in [("yield", yielding), ("ultimate", ultimate)] {
        let found = piece.bend(phi);
        within_share(
            &format!("STR-06: {name} moment (kNm)"),
            found.0,
            moment,
            5e-4,
        );
        within_share(
            &format!("STR-06: {name} neutral axis (mm)"),
            found.1,
            neutral,
            5e-3,
        );
    }
    for (layers, tolerance, measured) in [(4, 1e-2, 0.783), (8, 5e-4, -0.019), (20, 5e-4, 0.013)] {
        let found = cracked(layers).bend(ultimate.0).0;
        let what = format!("ultimate moment (kNm), {layers} layers");
        within_share(&what, found, ultimate.1, tolerance);
        let what = format!("ultimate moment, deviation (%), {} fibres", 2 * layers);
        within(&what, 100.0 * (found / ultimate.1 - 1.0), measured, 0.01);
    }
}

/// The default law of the beams in the same section, with so little fracture energy that cracks carry nothing at yielding; its
/// compression curve is that of the Model Code. Target: yielding within 1.5 %, ultimate moment within 1.5 %. With the fracture
/// energy of the concrete its cracks still carry 7 % at yielding.
#[test]
fn the_default_law_bends_the_section() {
    let concrete = FixedCrackParameters {
        poisson: 0.0,
        ..FixedCrackParameters::from_strength(30.0, 2.2, 30_000.0)
    };
    let brittle = FixedCrackParameters {
        fracture_energy: 0.006,
        ..concrete
    };
    let [brittle, concrete] = [brittle, concrete].map(|parameters| {
        let law: Arc<dyn Material<Solid>> = Arc::new(FixedCrack::new(parameters, None).unwrap());
        let steel = Arc::new(Biso::hot_rolled(200e3, 460.0, 0.0).unwrap());
        Piece::new(20, &law, steel)
    });
    let [yielding, ultimate] = [9.199e-6, 6.127e-5];
    let found = brittle.bend(yielding).0;
    within_share(
        "yield moment (kNm), default law, brittle",
        found,
        89.201,
        0.015,
    );
    let found = brittle.bend(ultimate).0;
    within_share(
        "ultimate moment (kNm), default law, brittle",
        found,
        93.294,
        0.015,
    );
    let found = concrete.bend(yielding).0 / 89.201;
    within_share(
        "yield moment over that without tension, default law",
        found,
        1.07,
        0.01,
    );
}
