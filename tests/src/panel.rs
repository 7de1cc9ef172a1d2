//! Reinforced panels under pure shear: one hexahedron, bars that act as if smeared.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_core::model::{Conditions, Model};
use fe_core::shape::quadrature::gauss_legendre;
use fe_elements::{BandWidth, Bar, Hex20, HexRule, embed};
use fe_materials::Biso;
use fe_solver::automatic::Automatic;
use fe_solver::control::StepControl;
use fe_solver::newton::NewtonSettings;
use fe_solver::recorder::StepView;
use nalgebra::Vector3;

use crate::conditions::{hold, push_faces};
use crate::cube::Failure;
use crate::mesh::{BLOCK, boxes, cells};
use crate::solve::run;

/// Thickness (mm), over which nothing varies.
const THICKNESS: f64 = 10.0;
/// Young's modulus of the steel (MPa).
const STEEL: f64 = 200_000.0;

/// Reinforcement along one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smeared {
    /// Area over that of the concrete (-).
    pub ratio: f64,
    /// Yield stress (MPa).
    pub yield_mpa: f64,
}

/// A square panel with as much crack in it as its side is long.
#[derive(Debug)]
pub struct Panel {
    /// Side (mm), the width of its crack band.
    pub side_mm: f64,
    /// Law of the concrete.
    pub concrete: Arc<dyn Material<Solid>>,
    /// Reinforcement along x and y.
    pub steel: [Smeared; 2],
    /// Hardening modulus of the steel (MPa).
    pub hardening_mpa: f64,
}

/// Shear stress on the edges of a panel (MPa).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sheared {
    /// Largest.
    pub largest_mpa: f64,
    /// After the last step.
    pub last_mpa: f64,
}

impl Panel {
    fn model(&self) -> Result<Model, Failure> {
        let side = self.side_mm;
        let mesh = boxes(&[0.0, side], &[0.0, side], &[0.0, THICKNESS])?;
        let mut elements: Vec<Box<dyn Element>> = Vec::new();
        for (nodes, coords) in cells(&mesh, &mesh.blocks()[0]) {
            let law = Arc::clone(&self.concrete);
            let band = BandWidth::Fixed(side);
            let cell = Hex20::new(nodes, &coords, HexRule::Full, law, band)?;
            elements.push(Box::new(cell));
        }
        // At the Gauss points of the edges, in proportion to their weights, bars act as if smeared.
        let rule = gauss_legendre(3).into_iter();
        let points: Vec<_> = rule.map(|(xi, w)| (0.5 + 0.5 * xi, 0.5 * w)).collect();
        for (axis, steel) in self.steel.into_iter().enumerate() {
            if steel.ratio == 0.0 {
                continue;
            }
            let law = Arc::new(Biso::hot_rolled(
                STEEL,
                steel.yield_mpa,
                self.hardening_mpa,
            )?);
            for &(place, weight) in &points {
                for &(depth, share) in &points {
                    let mut ends = [[place * side, place * side, depth * THICKNESS]; 2];
                    (ends[0][axis], ends[1][axis]) = (0.0, side);
                    let bar = Bar {
                        name: "bar".into(),
                        polyline: ends.into(),
                        area_mm2: weight * share * steel.ratio * side * THICKNESS,
                        law: law.clone(),
                        dowel: None,
                    };
                    let pieces = embed(&[bar], &mesh, &[BLOCK])?;
                    elements.extend(pieces.into_iter().map(|e| Box::new(e) as Box<dyn Element>));
                }
            }
        }
        Ok(Model::new(mesh, elements)?)
    }

    /// Stress under shear tractions on the four edges, free to strain along both axes, until an edge has moved by `drift` times the
    /// side, or no step leads on from less than half the largest stress.
    ///
    /// # Errors
    ///
    /// What the model does not admit, and a path that ends before.
    pub fn shear(&self, drift: f64) -> Result<Sheared, Failure> {
        let model = self.model()?;
        let side = self.side_mm;
        let mut conditions = Conditions::new(&model);
        hold(&model, &mut conditions, &[Dof::Uz], |x| x[2] == 0.0)?;
        hold(&model, &mut conditions, &[Dof::Ux, Dof::Uy], |x| {
            x[0] == 0.0 && x[1] == 0.0
        })?;
        hold(&model, &mut conditions, &[Dof::Uy], |x| {
            x[0] == side && x[1] == 0.0
        })?;
        let traction = |n: Vector3<f64>| Vector3::new(n.y, n.x, 0.0);
        for (axis, place) in [(0, 0.0), (0, side), (1, 0.0), (1, side)] {
            push_faces(&model, &mut conditions, |x| x[axis] == place, traction)?;
        }
        let control = StepControl {
            criterion: 1e-4,
            longest: 5e-4 * side,
            shortest: 1e-7 * side,
            ..StepControl::new(2e-5 * side, drift * side)
        };
        let [mut largest_mpa, mut last_mpa] = [0.0_f64; 2];
        let record = |view: &StepView<'_>| {
            last_mpa = view.lambda;
            largest_mpa = largest_mpa.max(last_mpa);
        };
        let mut driver = Automatic::new(NewtonSettings::default());
        let end = run(&model, conditions, &control, &mut driver, |_| {}, record);
        if last_mpa >= 0.5 * largest_mpa {
            end?;
        }
        Ok(Sheared {
            largest_mpa,
            last_mpa,
        })
    }
}
