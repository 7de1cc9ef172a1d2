//! STAB-11: tension until a crack opens, then strains that grow as 0.5 : 0.75 : 1 (xx, yy, xy), so that the principal
//! axes turn away from the crack (after Willam, Pramono and Sture 1987); E = 10 000 MPa, ft = 1 MPa, softening to 3e-3.
//! Targets: no principal stress above 1.05 ft; at the end none of a size above 0.05 ft, in tension or compression. (Law
//! `fixed-crack` keeps a floor of shear, 1e-4 G0 gamma, which STAB-12 is about: 0.017 MPa there.)

use fe_core::element::PointSample;
use fe_core::energy::Cracking;
use fe_core::kinematics::Solid;
use fe_core::material::{Material, Operator, PointContext};
use fe_core::voigt::{principal, stress_tensor};
use fe_materials::concrete::{ConcreteScalars, Objective};
use fe_materials::fixed_crack::{
    FixedCrack, FixedCrackParameters, ShearTransfer, TensionSoftening,
};
use fe_solver::capacity::LOCKING;
use nalgebra::Vector6;

use crate::stability::{Case, Failure, Figure, Method, Scenario};

/// Tensile strength (MPa).
pub(super) const FT: f64 = 1.0;
/// Crack-band width (mm).
pub(super) const BAND: f64 = 50.0;

/// The concrete of the scenario.
pub(super) fn concrete(shear_transfer: ShearTransfer) -> Result<FixedCrack, Failure> {
    let parameters = FixedCrackParameters {
        fracture_energy: 0.5 * 3e-3 * BAND,
        tension_softening: TensionSoftening::Linear,
        shear_transfer,
        ..FixedCrackParameters::from_strength(15.0, FT, 10_000.0)
    };
    Ok(FixedCrack::new(parameters, None)?)
}

/// A point that is driven through strains.
pub(super) struct Point {
    law: Box<dyn Material<Solid>>,
    state: Vec<f64>,
}

impl Point {
    pub(super) fn new(law: impl Material<Solid> + 'static) -> Self {
        let mut state = vec![0.0; law.state_len()];
        law.init_state(&mut state);
        Self {
            law: Box::new(law),
            state,
        }
    }

    pub(super) fn stress(&mut self, strain: &Vector6<f64>) -> Result<Vector6<f64>, Failure> {
        let ctx = PointContext::new(BAND).with_operator(Operator::None);
        let mut trial = vec![0.0; self.state.len()];
        let response = self.law.update(strain, &self.state, &mut trial, &ctx)?;
        self.state = trial;
        Ok(response.stress)
    }

    /// Free energy (MPa) at the strain it has been led to.
    pub(super) fn free_energy(&self, strain: &Vector6<f64>) -> Option<f64> {
        let ctx = PointContext::new(BAND);
        self.law.free_energy(strain, &self.state, &ctx)
    }

    /// The point as it is seen from outside.
    fn sample<'a>(&'a self, strain: &'a Vector6<f64>, stress: &'a Vector6<f64>) -> PointSample<'a> {
        PointSample {
            position: [0.0; 3],
            volume: 1.0,
            strain: strain.as_slice(),
            stress: stress.as_slice(),
            report: self.law.report(strain, &self.state),
            state_vars: self.law.state_vars(),
            state: &self.state,
        }
    }
}

/// Largest principal stress (MPa) on the way, largest size of one at the end, and whether a beam would report locked cracks.
fn turn(mut point: Point) -> Result<([f64; 2], bool), Failure> {
    let mut cracking = Cracking::default();
    let mut strain = Vector6::new(1.0001e-4, -0.2e-4, -0.2e-4, 0.0, 0.0, 0.0);
    point.stress(&strain)?;
    let (mut most, mut last, mut locked) = (0.0_f64, 0.0, false);
    for _ in 0..40_000 {
        strain += 1e-6 * Vector6::new(0.5, 0.75, 0.0, 1.0, 0.0, 0.0);
        let stress = point.stress(&strain)?;
        cracking.begin();
        cracking.point(&point.sample(&strain, &stress));
        locked |= cracking.largest_tension() > LOCKING * FT;
        let stresses = principal(&stress_tensor(&stress)).0;
        most = most.max(stresses[0]);
        last = stresses.amax();
    }
    Ok(([most, last], locked))
}

fn case(point: Result<Point, Failure>) -> Result<Case, Failure> {
    let ([largest, end], locked) = turn(point?)?;
    Ok(Case {
        marked: usize::from(locked),
        ..Case::checked(vec![
            Figure::at_most("largest principal stress, MPa", largest, 1.05),
            Figure::at_most(
                "largest size of a principal stress at the end, MPa",
                end,
                0.05,
            ),
        ])
    })
}

fn rotating() -> Result<Point, Failure> {
    let scalars = ConcreteScalars {
        fctm_mpa: FT,
        young_mpa: 10_000.0,
        eps_c1: 3e-3,
        eps_c_lim: 4e-3,
        fracture_energy: 0.5 * 3e-3 * BAND,
        ..ConcreteScalars::from_characteristic(12.0)?
    };
    Ok(Point::new(Objective::new(&scalars)?))
}

fn fixed(transfer: ShearTransfer) -> Result<Point, Failure> {
    Ok(Point::new(concrete(transfer)?))
}

/// Axes that turn with the strain: no more stress than ft, none at the end.
pub const ROTATING: Scenario = Scenario {
    id: "STAB-11",
    title: "stress locking: tension, then shear; law objective, rotating cracks",
    remark: "",
    coarse: &[],
    run: |method, _| (method == Method::Automatic).then(|| case(rotating())),
};

/// Axes that follow the strain until 0.7 of the strength is left, shear as far as the crack is bridged.
pub const DAMAGE: Scenario = Scenario {
    title: "the same, law fixed-crack, shear transfer by damage",
    run: |method, _| (method == Method::Automatic).then(|| case(fixed(ShearTransfer::Damage))),
    ..ROTATING
};

/// The same axes with interlock.
pub const INTERLOCK: Scenario = Scenario {
    title: "the same, law fixed-crack, shear transfer by interlock",
    run: |method, _| {
        let transfer = ShearTransfer::Interlock { aggregate_mm: 19.0 };
        (method == Method::Automatic).then(|| case(fixed(transfer)))
    },
    ..ROTATING
};
