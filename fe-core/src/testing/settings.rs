//! Settings and results of the checks.

use super::failure::{CheckFailure, positive};
use crate::element::Element;
use crate::material::PointContext;

/// Settings of [`check_material`](super::check_material) and [`check_isotropy`](super::check_isotropy).
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialCheck {
    /// Seed of the paths: the same seed gives the same paths on every machine.
    pub seed: u64,
    /// Number of paths, each from the virgin state.
    pub paths: usize,
    /// Steps of a path.
    pub steps: usize,
    /// Largest strain of each component; a list that is too short is repeated, so that one entry
    /// serves all components.
    pub amplitude: Vec<f64>,
    /// The point the law is driven at.
    pub context: PointContext,
    /// Step of the finite differences, relative to the amplitude.
    pub difference_step: f64,
    /// Allowed disagreement of the tangent, relative to the larger of its own norm and that of the
    /// virgin tangent.
    pub tangent_tolerance: f64,
    /// Allowed share of steps at a kink, where differences cannot prove the tangent.
    pub kink_share: f64,
    /// Allowed change of stress by an update without strain increment, relative to the largest stress
    /// of the path so far; infinite for a law that is viscous by itself, whose stress changes with time.
    pub drift_tolerance: f64,
    /// Allowed negative dissipation, relative to the energies it is the difference of.
    pub dissipation_tolerance: f64,
    /// Allowed anisotropy, relative to the largest stress of the path so far.
    pub isotropy_tolerance: f64,
}

impl MaterialCheck {
    /// 250 paths of 40 steps, 10^4 in all, up to the given strain in every component, at an inviscid point with a
    /// crack-band width of 20 mm.
    pub fn new(amplitude: f64) -> Self {
        Self {
            seed: 1,
            paths: 250,
            steps: 40,
            amplitude: vec![amplitude],
            context: PointContext::new(20.0),
            difference_step: 1e-5,
            tangent_tolerance: 1e-6,
            kink_share: 0.05,
            drift_tolerance: 1e-10,
            dissipation_tolerance: 1e-12,
            isotropy_tolerance: 1e-13,
        }
    }

    /// Refuses settings that cannot drive a path.
    pub(super) fn validate(&self) -> Result<(), CheckFailure> {
        path(
            self.paths,
            self.steps,
            &self.amplitude,
            self.difference_step,
        )?;
        tolerances(&[
            ("tangent tolerance", self.tangent_tolerance),
            ("share of kinks", self.kink_share),
            ("drift tolerance", self.drift_tolerance),
            ("dissipation tolerance", self.dissipation_tolerance),
            ("isotropy tolerance", self.isotropy_tolerance),
        ])
    }
}

/// Without a path or a step nothing is checked, without amplitudes nothing moves.
fn path(
    paths: usize,
    steps: usize,
    amplitude: &[f64],
    difference_step: f64,
) -> Result<(), CheckFailure> {
    positive("number of paths", paths as f64)?;
    positive("number of steps", steps as f64)?;
    positive("number of amplitudes", amplitude.len() as f64)?;
    positive("difference step", difference_step)?;
    amplitude.iter().try_for_each(|&a| positive("amplitude", a))
}

/// Tolerances that are no numbers would let everything pass; infinite ones switch a demand off.
fn tolerances(all: &[(&'static str, f64)]) -> Result<(), CheckFailure> {
    match all.iter().find(|(_, value)| value.is_nan() || *value < 0.0) {
        None => Ok(()),
        Some(&(what, value)) => Err(CheckFailure::Setting {
            what,
            value,
            allowed: "[0, inf]",
        }),
    }
}

/// What [`check_material`](super::check_material) has seen; worst values are relative, as the tolerances are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MaterialReport {
    /// Steps checked.
    pub steps: usize,
    /// Steps at a kink, whose tangent could not be proved.
    pub kinks: usize,
    /// Worst disagreement of the tangent with differences.
    pub worst_tangent: f64,
    /// Worst change of stress by an update without strain increment.
    pub worst_drift: f64,
    /// Smallest pivot of the secant operator, relative to the norm of the virgin tangent.
    pub least_pivot: f64,
    /// Least dissipation of a step (N mm/mm3), if the law has a free energy.
    pub least_dissipation: Option<f64>,
}

/// Settings of [`check_element`](super::check_element).
#[derive(Debug, Clone, PartialEq)]
pub struct ElementCheck {
    /// Seed of the paths: the same seed gives the same paths on every machine.
    pub seed: u64,
    /// Number of paths, each from the virgin state.
    pub paths: usize,
    /// Steps of a path.
    pub steps: usize,
    /// Largest value of each DOF of a node (mm or rad); a list that is too short is repeated, so that
    /// one entry serves all.
    pub amplitude: Vec<f64>,
    /// See [`EvaluationContext::relaxation`](crate::element::EvaluationContext::relaxation).
    pub relaxation: f64,
    /// Step of the finite differences, relative to the amplitude.
    pub difference_step: f64,
    /// Allowed disagreement of the stiffness, relative to the larger of its own norm and that of the
    /// virgin stiffness.
    pub tangent_tolerance: f64,
    /// Allowed share of steps at a kink, where differences cannot prove the stiffness.
    pub kink_share: f64,
    /// Whether rigid-body motions in the plane x-y only are free of force, as in a half body that its plane of symmetry
    /// z = 0 holds.
    pub in_plane: bool,
    /// Allowed force of a rigid-body motion, relative to stiffness times displacement.
    pub rigid_tolerance: f64,
    /// Allowed resultant of the nodal forces, relative to the sum of the magnitudes of its terms.
    pub balance_tolerance: f64,
}

impl ElementCheck {
    /// 3 paths of 10 steps up to the given displacement (mm) of every DOF.
    pub fn new(amplitude: f64) -> Self {
        Self {
            seed: 1,
            paths: 3,
            steps: 10,
            amplitude: vec![amplitude],
            relaxation: 1.0,
            difference_step: 1e-5,
            tangent_tolerance: 1e-6,
            kink_share: 0.05,
            in_plane: false,
            rigid_tolerance: 1e-11,
            balance_tolerance: 1e-11,
        }
    }

    /// Refuses settings that cannot drive a path.
    pub(super) fn validate(
        &self,
        element: &dyn Element,
        coords: &[[f64; 3]],
    ) -> Result<(), CheckFailure> {
        path(
            self.paths,
            self.steps,
            &self.amplitude,
            self.difference_step,
        )?;
        tolerances(&[
            ("tangent tolerance", self.tangent_tolerance),
            ("share of kinks", self.kink_share),
            ("rigid tolerance", self.rigid_tolerance),
            ("balance tolerance", self.balance_tolerance),
        ])?;
        if coords.is_empty() || coords.len() != element.nodes().len() {
            return Err(CheckFailure::Setting {
                what: "number of coordinates",
                value: coords.len() as f64,
                allowed: "one per node of the element",
            });
        }
        if let Some(&value) = coords.iter().flatten().find(|x| !x.is_finite()) {
            return Err(CheckFailure::Setting {
                what: "coordinate",
                value,
                allowed: "finite numbers",
            });
        }
        Ok(())
    }
}

/// What [`check_element`](super::check_element) has seen; worst values are relative, as the tolerances are.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ElementReport {
    /// Rigid-body motions tried.
    pub motions: usize,
    /// Steps checked.
    pub steps: usize,
    /// Steps at a kink, whose stiffness could not be proved.
    pub kinks: usize,
    /// Worst force of a rigid-body motion.
    pub worst_rigid: f64,
    /// Worst resultant of the nodal forces.
    pub worst_balance: f64,
    /// Worst disagreement of the stiffness with differences.
    pub worst_tangent: f64,
}
