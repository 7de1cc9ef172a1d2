//! Bilinear hardening of bars.

use fe_core::kinematics::Axial;
use fe_core::material::{
    Material, MaterialError, Operator, PointContext, PointReport, Response, StateVar,
};
use nalgebra::{Matrix1, Vector1};
use serde::{Deserialize, Serialize};

use crate::limits::{finite, out_of_range, positive};

const LAW: &str = "bilinear bar";

/// Yield strength of a cold-worked bar at the kink of its bilinear curve, relative to fy.
const COLD_WORKED_YIELD: f64 = 0.85;

/// Strain at which the bilinear curve of a cold-worked bar reaches fy (-).
const COLD_WORKED_STRAIN: f64 = 0.010;

/// How the elastic range of a bar moves with plastic strain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Hardening {
    /// The range grows: yielding in one direction raises the yield stress in both.
    #[default]
    Isotropic,
    /// The range keeps its size and moves: yielding in one direction lowers the yield stress in the
    /// other (Bauschinger effect).
    Kinematic,
}

/// Bilinear elastoplastic bar, the same in tension and compression, without rupture.
///
/// The tangent ET after yielding is a slope in **total** strain; the plastic modulus that goes with it is
///
/// $$ H = \frac{E E_T}{E - E_T}. $$
///
/// With the plastic strain eps_p, its accumulated length kappa and sigma = E (eps - eps_p), the yield
/// condition is |sigma| <= sigma_y + H kappa for isotropic and |sigma - H eps_p| <= sigma_y for kinematic
/// hardening. Backward Euler is exact for a step of one direction: with the excess f_tr of the elastic
/// predictor over the yield condition, dkappa = f_tr/(E + H), and the tangent is ET.
///
/// The law does not depend on rate: the relaxation of the context has no influence. The secant operator
/// is E. The free energy (1/2) E eps_e^2 + (1/2) H kappa^2 (isotropic) or + (1/2) H eps_p^2 (kinematic)
/// leaves a dissipation of sigma_y dkappa or more in every step.
///
/// Source: J. C. Simo and T. J. R. Hughes, "Computational Inelasticity" (1998), boxes 1.4 and 1.5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Biso {
    young: f64,
    yield_stress: f64,
    plastic_modulus: f64,
    hardening: Hardening,
}

/// Internal variables; see [`State`].
const STATE_VARS: [StateVar; 2] = [
    StateVar::scalar("plastic_strain", "-"),
    StateVar::scalar("kappa", "-"),
];

/// Plastic strain and its accumulated length.
struct State {
    plastic: f64,
    kappa: f64,
}

impl State {
    fn read(state: &[f64]) -> Self {
        Self {
            plastic: state[0],
            kappa: state[1],
        }
    }
}

impl Biso {
    /// A hot-rolled bar: Young's modulus E, yield stress fy and tangent ET in total strain (MPa).
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] unless E > 0, fy > 0 and 0 <= ET < E.
    pub fn hot_rolled(
        young_mpa: f64,
        yield_mpa: f64,
        tangent_mpa: f64,
    ) -> Result<Self, MaterialError> {
        positive(LAW, "young_mpa", young_mpa, "MPa")?;
        positive(LAW, "yield_mpa", yield_mpa, "MPa")?;
        if !(0.0..young_mpa).contains(&tangent_mpa) {
            return Err(out_of_range(
                LAW,
                "tangent_mpa",
                tangent_mpa,
                "MPa",
                format!("[0, {young_mpa})"),
                "give the slope of the stress-strain curve after yielding, in total strain",
            ));
        }
        Ok(Self {
            young: young_mpa,
            yield_stress: yield_mpa,
            plastic_modulus: young_mpa * tangent_mpa / (young_mpa - tangent_mpa),
            hardening: Hardening::Isotropic,
        })
    }

    /// A cold-worked bar of Young's modulus E and strength fy (MPa): it yields at 0.85 fy and reaches fy
    /// at a strain of 1 %, ET = 0.15 fy/(0.010 - 0.85 fy/E).
    ///
    /// # Errors
    ///
    /// [`MaterialError::Parameter`] unless E > 0 and fy > 0, with fy so that the bar yields before 1 %.
    pub fn cold_worked(young_mpa: f64, strength_mpa: f64) -> Result<Self, MaterialError> {
        positive(LAW, "young_mpa", young_mpa, "MPa")?;
        let limit = COLD_WORKED_STRAIN * young_mpa;
        if !(strength_mpa > 0.0 && strength_mpa < limit) {
            return Err(out_of_range(
                LAW,
                "strength_mpa",
                strength_mpa,
                "MPa",
                format!("(0, {limit})"),
                "the bar must yield before a strain of 1 %",
            ));
        }
        let kink = COLD_WORKED_YIELD * strength_mpa;
        let tangent = (strength_mpa - kink) / (COLD_WORKED_STRAIN - kink / young_mpa);
        Self::hot_rolled(young_mpa, kink, tangent)
    }

    /// The same bar with another kind of hardening.
    #[must_use]
    pub const fn with_hardening(self, hardening: Hardening) -> Self {
        Self { hardening, ..self }
    }

    /// Yield stress of the virgin bar (MPa).
    pub const fn yield_stress(&self) -> f64 {
        self.yield_stress
    }

    /// Plastic modulus H (MPa).
    pub const fn plastic_modulus(&self) -> f64 {
        self.plastic_modulus
    }

    /// Centre and half width of the elastic range of stress (MPa).
    fn elastic_range(&self, state: &State) -> (f64, f64) {
        match self.hardening {
            Hardening::Isotropic => (0.0, self.yield_stress + self.plastic_modulus * state.kappa),
            Hardening::Kinematic => (self.plastic_modulus * state.plastic, self.yield_stress),
        }
    }
}

impl Material<Axial> for Biso {
    fn name(&self) -> &'static str {
        LAW
    }

    fn state_vars(&self) -> &[StateVar] {
        &STATE_VARS
    }

    fn update(
        &self,
        strain: &Vector1<f64>,
        committed: &[f64],
        trial: &mut [f64],
        ctx: &PointContext,
    ) -> Result<Response<Axial>, MaterialError> {
        finite(LAW, strain)?;
        let mut state = State::read(committed);
        let (centre, half_width) = self.elastic_range(&state);
        let predictor = self.young * (strain[0] - state.plastic) - centre;
        let excess = predictor.abs() - half_width;
        let mut tangent = self.young;
        if excess > 0.0 {
            let stiffness = self.young + self.plastic_modulus;
            let increment = excess / stiffness;
            state.plastic += increment.copysign(predictor);
            state.kappa += increment;
            if ctx.operator == Operator::Tangent {
                tangent = self.young * self.plastic_modulus / stiffness;
            }
        }
        trial[..2].copy_from_slice(&[state.plastic, state.kappa]);
        Ok(Response {
            stress: Vector1::new(self.young * (strain[0] - state.plastic)),
            tangent: Matrix1::new(tangent),
        })
    }

    fn free_energy(&self, strain: &Vector1<f64>, state: &[f64], _: &PointContext) -> Option<f64> {
        let state = State::read(state);
        let elastic = strain[0] - state.plastic;
        let stored = match self.hardening {
            Hardening::Isotropic => state.kappa,
            Hardening::Kinematic => state.plastic,
        };
        Some(0.5 * (self.young * elastic * elastic + self.plastic_modulus * stored * stored))
    }

    /// Plastic strain, and as utilisation the stress over the yield stress of the virgin bar.
    fn report(&self, strain: &Vector1<f64>, state: &[f64]) -> PointReport {
        let plastic = State::read(state).plastic;
        let stress = self.young * (strain[0] - plastic);
        PointReport {
            plastic_strain: [plastic, 0.0, 0.0, 0.0, 0.0, 0.0],
            utilisation: stress.abs() / self.yield_stress,
            ..PointReport::default()
        }
    }
}

#[cfg(test)]
mod tests {
    //! Protects the bars of the beams: the two kinds of hardening, and what ET means.
    use approx::assert_abs_diff_eq;
    use fe_core::testing::{MaterialCheck, check_material, curve, within};

    use super::*;

    /// Stress at the turning points of a strain path, and the work done.
    fn drive(law: &Biso, path: &[f64]) -> (Vec<f64>, f64) {
        follow(law, path, |_, _| {})
    }

    /// The same; every strain and stress is shown.
    fn follow(law: &Biso, path: &[f64], mut see: impl FnMut(f64, f64)) -> (Vec<f64>, f64) {
        let steps = 4000;
        let (mut state, mut trial) = ([0.0; 2], [0.0; 2]);
        let (mut stresses, mut work) = (Vec::new(), 0.0);
        let (mut strain, mut stress) = (0.0, 0.0);
        for &target in path {
            let increment = (target - strain) / f64::from(steps);
            for _ in 0..steps {
                strain += increment;
                let response = law
                    .update(
                        &Vector1::new(strain),
                        &state,
                        &mut trial,
                        &PointContext::new(1.0),
                    )
                    .unwrap();
                work += 0.5 * (stress + response.stress[0]) * increment;
                stress = response.stress[0];
                see(strain, stress);
                state = trial;
            }
            stresses.push(stress);
        }
        (stresses, work)
    }

    /// Benchmark MAT-06: E = 200000, ET = 2000, fy = 460, strain 0, 0.01, -0.01, 0; solved by hand.
    /// Target: the printed digits. Taking ET for H would give 475.2 at the first turn.
    #[test]
    fn cycle_of_both_kinds_of_hardening() {
        let bar = Biso::hot_rolled(200e3, 460.0, 2e3).unwrap();
        let modulus = bar.plastic_modulus();
        within("MAT-06: plastic modulus (MPa)", modulus, 2020.202, 5e-4);
        let cases = [
            (Hardening::Kinematic, [475.4, -475.4, 455.4], 13.5026),
            (Hardening::Isotropic, [475.4, -505.892, 515.774], 14.1347),
        ];
        for (hardening, targets, work) in cases {
            let law = bar.with_hardening(hardening);
            let mut cycle = vec![[0.0; 2]];
            let see = |strain, stress| cycle.push([1e3 * strain, stress]);
            let (stresses, done) = follow(&law, &[0.01, -0.01, 0.0], see);
            for (i, (stress, target)) in stresses.iter().zip(targets).enumerate() {
                let what = format!("MAT-06: stress at turn {} (MPa), {hardening:?}", i + 1);
                within(&what, *stress, target, 5e-4);
            }
            let what = format!("MAT-06: work (N mm/mm3), {hardening:?}");
            within(&what, done, work, 5e-5);
            let name = format!("cycle, {hardening:?}");
            curve(&name, cycle.into_iter().step_by(40));
            // Backward Euler is exact for a step of one direction.
            let one_step = law
                .update(
                    &Vector1::new(0.01),
                    &[0.0; 2],
                    &mut [0.0; 2],
                    &PointContext::new(1.0),
                )
                .unwrap();
            assert_abs_diff_eq!(one_step.stress[0], targets[0], epsilon = 1e-9);
        }
    }

    /// A cold-worked bar reaches fy at 1 % strain, from a kink at 0.85 fy.
    #[test]
    fn cold_worked_bar_reaches_its_strength_at_one_percent() {
        let bar = Biso::cold_worked(200e3, 350.0).unwrap();
        assert_abs_diff_eq!(bar.yield_stress(), 297.5, epsilon = 1e-10);
        let (stresses, _) = drive(&bar, &[0.01]);
        assert_abs_diff_eq!(stresses[0], 350.0, epsilon = 1e-9);
    }

    /// Contract of a law, 10^4 random paths each: tangent, dissipation, repeatability.
    #[test]
    fn conforms() {
        let bar = Biso::hot_rolled(200e3, 460.0, 2e3).unwrap();
        for law in [
            bar,
            bar.with_hardening(Hardening::Kinematic),
            Biso::hot_rolled(200e3, 460.0, 0.0).unwrap(),
        ] {
            let check = MaterialCheck {
                paths: 10_000,
                steps: 10,
                ..MaterialCheck::new(2e-2)
            };
            let report = check_material(&law, &check).unwrap();
            assert!(report.least_dissipation.is_some());
        }
    }

    /// Gauges and output read the stress of a committed state from a frozen context.
    #[test]
    fn frozen_context_reproduces_the_committed_stress() {
        let law = Biso::hot_rolled(200e3, 460.0, 2e3).unwrap();
        let strain = Vector1::new(0.004);
        let mut state = [0.0; 2];
        let ctx = PointContext::new(1.0);
        let stress = law.update(&strain, &[0.0; 2], &mut state, &ctx).unwrap();
        let frozen = PointContext {
            operator: Operator::None,
            relaxation: 0.0,
            ..ctx
        };
        let again = law.update(&strain, &state, &mut [0.0; 2], &frozen).unwrap();
        assert_abs_diff_eq!(again.stress[0], stress.stress[0], epsilon = 1e-10);
        let report = law.report(&strain, &state);
        assert_abs_diff_eq!(report.utilisation, stress.stress[0] / 460.0);
        assert_eq!(report.plastic_strain[0], state[0]);
    }

    #[test]
    fn impossible_parameters_are_refused() {
        for (e, fy, et) in [
            (-200e3, 460.0, 2e3),
            (200e3, 0.0, 2e3),
            (200e3, 460.0, 200e3),
            (200e3, 460.0, -1.0),
            (200e3, 460.0, f64::NAN),
        ] {
            assert!(Biso::hot_rolled(e, fy, et).is_err(), "{e} {fy} {et}");
        }
        for fy in [0.0, f64::NAN, 2000.0] {
            assert!(Biso::cold_worked(200e3, fy).is_err(), "{fy}");
        }
    }
}
