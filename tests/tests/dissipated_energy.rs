//! Energy that a step dissipates: as what is controlled, and as what must not be negative.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::element::Element;
use fe_core::grid::GridBuilder;
use fe_core::kinematics::Solid;
use fe_core::material::{Material, MaterialError, Operator, PointContext, Response, StateVar};
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_core::voigt::isotropic;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::VonMises;
use fe_solver::control::StepControl;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::path::DissipatedEnergy;
use fe_solver::recorder::{Continue, Recorder, StepView};
use fe_solver::stage::Stage;
use fe_tests::conditions::hold;
use fe_tests::mesh::cells;
use nalgebra::{Matrix6, Vector6};

const YOUNG: f64 = 200_000.0;
const YIELD: f64 = 400.0;
const HARDENING: f64 = 2000.0;
/// Side of the cube (mm).
const SIDE: f64 = 10.0;

/// A cube of a law, held as a bar along x.
fn cube(law: Arc<dyn Material<Solid>>) -> (Model, Conditions) {
    let mut grid = GridBuilder::new();
    let side = [0.0, SIDE];
    grid.add_box("cube", &side, &side, &side);
    let mesh = grid.finish().unwrap();
    let (nodes, coords) = cells(&mesh, &mesh.blocks()[0]).next().unwrap();
    let cube = Hex20::new(nodes, &coords, HexRule::Full, law, BandWidth::CubeRoot).unwrap();
    let model = Model::new(mesh, vec![Box::new(cube) as Box<dyn Element>]);
    let mut conditions = Conditions::new(&model);
    hold(&model, &mut conditions, &[Dof::Ux], |x| x[0] == 0.0).unwrap();
    hold(&model, &mut conditions, &[Dof::Uy], |x| x[1] == 0.0).unwrap();
    hold(&model, &mut conditions, &[Dof::Uz], |x| x[2] == 0.0).unwrap();
    (model, conditions)
}

/// The end nodes and the shares of a uniform tension: -1/12 at corners, 1/3 at midsides.
fn end(model: &Model) -> Vec<(usize, f64)> {
    let nodes = model.mesh().nodes().iter().enumerate();
    let end = nodes.filter(|(_, x)| x[0] == SIDE);
    let middle = |c: f64| c != 0.0 && c != SIDE;
    end.map(|(n, x)| {
        let midside = middle(x[1]) || middle(x[2]);
        (n, if midside { 1.0 / 3.0 } else { -1.0 / 12.0 })
    })
    .collect()
}

fn pulled(law: Arc<dyn Material<Solid>>) -> (Model, Conditions) {
    let (model, mut conditions) = cube(law);
    for (node, share) in end(&model) {
        conditions
            .add_reference(&model, node, Dof::Ux, share)
            .unwrap();
    }
    (model, conditions)
}

fn drawn(law: Arc<dyn Material<Solid>>) -> (Model, Conditions) {
    let (model, mut conditions) = cube(law);
    for (node, _) in end(&model) {
        conditions.prescribe(&model, node, Dof::Ux, 1.0).unwrap();
    }
    (model, conditions)
}

/// Stresses (MPa) and remarks along a path, and why it stopped.
#[derive(Debug, Default)]
struct Path {
    stresses: Vec<f64>,
    notes: Vec<String>,
    stopped: Option<String>,
}

impl Recorder for Path {
    fn note(&mut self, _: usize, text: &str) -> std::io::Result<()> {
        self.notes.push(text.into());
        Ok(())
    }

    fn step(&mut self, view: &StepView<'_>) -> std::io::Result<Continue> {
        let driven = view.load != 0.0;
        let force = if driven { view.load } else { view.lambda };
        self.stresses.push(force / SIDE.powi(2));
        Ok(Continue::Yes)
    }
}

/// Goes from driver to driver, `count` steps of a length with each.
fn follow(
    (model, conditions): (Model, Conditions),
    legs: Vec<(f64, usize, NewtonRaphson)>,
) -> Path {
    let mut state = StateStore::new(model.elements());
    let rest = vec![0.0; model.dofs().len()];
    let mut stage = Stage::new(&model, conditions, &mut state, rest).unwrap();
    let mut path = Path::default();
    for (length, count, mut newton) in legs {
        let control = StepControl {
            criterion: 1e-9,
            ..StepControl::new(length, count as f64 * length)
        };
        if let Err(error) = control.run(&mut stage, &mut newton, &mut path) {
            path.stopped = Some(error.to_string());
        }
    }
    path
}

fn loaded() -> NewtonRaphson {
    NewtonRaphson::new(NewtonSettings::default())
}

fn dissipating() -> NewtonRaphson {
    NewtonRaphson::with_constraint(
        NewtonSettings::default(),
        Box::<DissipatedEnergy>::default(),
    )
}

/// Protects the constraint under forces and under imposed displacements. A yielding bar dissipates sigma_y per unit of
/// plastic strain and volume (its hardening is stored), so steps of equal dissipation have equal plastic strains and the
/// stress grows by H tau/(sigma_y V); target 1e-6.
#[test]
fn a_yielding_bar_dissipates_as_much_as_it_is_told() {
    let law = || Arc::new(VonMises::new(YOUNG, 0.3, YIELD, HARDENING).unwrap());
    let energy = 4000.0;
    for (bar, first) in [(pulled(law()), 41_000.0), (drawn(law()), 0.025)] {
        let legs = vec![(first, 1, loaded()), (energy, 6, dissipating())];
        let path = follow(bar, legs);
        assert!(path.stopped.is_none(), "{:?}", path.stopped);
        assert_eq!(path.stresses.len(), 7);
        let rise = HARDENING * energy / (YIELD * SIDE.powi(3));
        for step in path.stresses.windows(2) {
            let found = step[1] - step[0];
            assert!((found / rise - 1.0).abs() < 1e-6, "{found} for {rise}");
        }
    }
}

/// A law that heals: its secant modulus grows with the strain, and it states no energy.
#[derive(Debug)]
struct Healing;

impl Material<Solid> for Healing {
    fn name(&self) -> &'static str {
        "healing"
    }

    fn state_vars(&self) -> &[StateVar] {
        &[]
    }

    fn update(
        &self,
        strain: &Vector6<f64>,
        _: &[f64],
        _: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Solid>, MaterialError> {
        let whole = isotropic(YOUNG, 0.0) * (1.0 + 1e3 * strain.norm());
        Ok(Response {
            stress: whole * strain,
            tangent: match ctx.operator {
                Operator::None => Matrix6::zeros(),
                Operator::Secant | Operator::Tangent => whole,
            },
        })
    }
}

/// Protects against paths on which a model gives back more than it has been given: refused at every length, and told.
#[test]
fn a_law_that_creates_energy_is_refused() {
    let path = follow(drawn(Arc::new(Healing)), vec![(0.01, 4, loaded())]);
    let stopped = path.stopped.unwrap_or_default();
    assert!(stopped.contains("creates energy"), "{stopped}");
    assert!(path.notes.iter().any(|n| n.contains("repeated shorter")));
}
