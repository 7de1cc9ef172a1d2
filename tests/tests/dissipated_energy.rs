//! Energy that a step dissipates: as what is controlled, and as what must not be negative.

use std::sync::Arc;

use fe_core::dof::Dof;
use fe_core::kinematics::Solid;
use fe_core::material::{Material, MaterialError, Operator, PointContext, Response, StateVar};
use fe_core::model::{Conditions, Model};
use fe_core::state::StateStore;
use fe_core::voigt::isotropic;
use fe_elements::HexRule;
use fe_materials::VonMises;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_solver::control::StepControl;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::path::{
    DissipatedEnergy, Dissipation, Energies, LoadFactor, LoadedDisplacement, PathConstraint,
};
use fe_solver::recorder::{Continue, Recorder, StepView};
use fe_solver::stage::Stage;
use fe_tests::conditions::{hold, push_faces};
use fe_tests::cube::cell;
use fe_tests::mesh::nodes_where;
use nalgebra::{Matrix6, Vector6};

const YOUNG: f64 = 200_000.0;
const YIELD: f64 = 400.0;
const HARDENING: f64 = 2000.0;
/// Side of the cube (mm).
const SIDE: f64 = 10.0;

/// A cube of a law, held as a bar along x.
fn cube(law: Arc<dyn Material<Solid>>) -> (Model, Conditions) {
    let model = cell(SIDE, HexRule::Full, law).unwrap();
    let mut conditions = Conditions::new(&model);
    for (axis, dof) in Dof::DISPLACEMENTS.into_iter().enumerate() {
        hold(&model, &mut conditions, &[dof], |x| x[axis] == 0.0).unwrap();
    }
    (model, conditions)
}

/// Under a force of 1 N per unit of the load factor.
fn pulled(law: Arc<dyn Material<Solid>>) -> (Model, Conditions) {
    let (model, mut conditions) = cube(law);
    let end = |x: [f64; 3]| x[0] == SIDE;
    push_faces(&model, &mut conditions, end, |n| n / SIDE.powi(2)).unwrap();
    (model, conditions)
}

fn drawn(law: Arc<dyn Material<Solid>>) -> (Model, Conditions) {
    let (model, mut conditions) = cube(law);
    for node in nodes_where(model.mesh(), |x| x[0] == SIDE) {
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

fn under<C: PathConstraint + Default + 'static>() -> NewtonRaphson {
    NewtonRaphson::with_constraint(NewtonSettings::default(), Box::<C>::default())
}

fn dissipating() -> NewtonRaphson {
    under::<DissipatedEnergy>()
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

/// An elastic path dissipates nothing but rounding, which is no derivative: it is refused, at rest and on the way, and no step is
/// taken to wherever rounding would have dissipated what was asked for.
#[test]
fn a_path_that_dissipates_nothing_is_refused() {
    let law = || Arc::new(VonMises::new(YOUNG, 0.3, YIELD, HARDENING).unwrap());
    for elastic in [0, 1, 5] {
        for (bar, first, control) in [
            (pulled(law()), 4_000.0, dissipating()),
            (drawn(law()), 0.002, dissipating()),
            (pulled(law()), 4_000.0, under::<Dissipation>()),
        ] {
            let legs = vec![(first, elastic, loaded()), (50.0, 1, control)];
            let path = follow(bar, legs.into_iter().filter(|leg| leg.1 > 0).collect());
            assert_eq!(path.stresses.len(), elastic, "{:?}", path.stresses);
            let stopped = path.stopped.unwrap_or_default();
            let says = ["path constraint controls", "nothing dissipates"];
            assert!(says.iter().any(|s| stopped.contains(s)), "{stopped}");
        }
    }
}

/// Protects the energies that forces tell where a part of them is dead load: those of the elements, which know nothing of forces.
/// A bar that cracks and unloads along its secant, under 300 N from a stage before; target 1e-6 of the work.
#[test]
fn forces_tell_the_same_energies_as_elements_under_dead_loads() {
    let parameters = FixedCrackParameters::from_strength(30.0, 2.5, 30_000.0);
    let law = Arc::new(FixedCrack::new(parameters, None).unwrap());
    let (model, alone) = pulled(law);
    let mut both = alone.clone();
    for (dof, share) in alone.reference().iter().enumerate() {
        let (node, kind) = model.dofs().owner(dof);
        both.add_dead(&model, node, kind, 100.0 * share).unwrap();
    }
    let mut state = StateStore::new(model.elements());
    let rest = vec![0.0; model.dofs().len()];
    let control = |length: f64, steps: f64| StepControl {
        criterion: 1e-10,
        ..StepControl::new(length, steps * length)
    };
    let mut dead = Stage::new(&model, alone, &mut state, rest).unwrap();
    let mut newton = under::<LoadFactor>();
    control(50.0, 2.0)
        .run(&mut dead, &mut newton, &mut Path::default())
        .unwrap();
    let at = dead.displacement().to_vec();
    let mut stage = Stage::new(&model, both, &mut state, at).unwrap();
    let (mut newton, mut dissipates) = (under::<LoadedDisplacement>(), 0.0_f64);
    for _ in 0..12 {
        control(2e-4, 1.0)
            .run(&mut stage, &mut newton, &mut Path::default())
            .unwrap();
        let (told, change) = (
            Energies::last(&stage).unwrap().unwrap(),
            stage.last_change(),
        );
        let measured = change.unwrap();
        let error = [
            told.work - measured.work,
            told.dissipated - measured.dissipated(),
        ];
        let small = error.iter().all(|e| e.abs() < 1e-6 * measured.work.abs());
        assert!(small, "{told:?} for {measured:?}");
        dissipates = dissipates.max(told.dissipated / told.work.abs());
    }
    assert!(dissipates > 0.3, "{dissipates}");
}

/// Protects against energies that forces do not tell: those of a model whose support has moved.
#[test]
fn a_displaced_support_is_refused_where_forces_are_to_tell_the_energy() {
    let law = Arc::new(VonMises::new(YOUNG, 0.3, YIELD, HARDENING).unwrap());
    let (model, conditions) = pulled(law);
    let mut moved = vec![0.0; model.dofs().len()];
    let (&held, _) = conditions.prescribed().first_key_value().unwrap();
    moved[held] = 0.01;
    let mut state = StateStore::new(model.elements());
    let stage = Stage::new(&model, conditions, &mut state, moved.clone()).unwrap();
    let refused = Energies::to(&stage, &moved, 0.0).unwrap_err().to_string();
    assert!(
        refused.contains("displacement (mm) of a held DOF"),
        "{refused}"
    );
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
