//! Methods that a scenario is given to.

use fe_solver::automatic::Automatic;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::implex::Implex;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::path::{ArcLength, Dissipation, LoadFactor, LoadedDisplacement, PathConstraint};
use fe_solver::secant::SecantAnderson;
use fe_solver::viscous::Viscous;

use super::Scene;
use crate::follow::{self, Path};

/// Viscosity of the viscous driver over the length of a step: 95 % of the growth of histories is admitted.
const LAG: f64 = 0.05;

/// A driver with a path constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Chooses for itself.
    Automatic,
    /// Newton-Raphson, the load factor growing: load control, or an imposed displacement.
    Load,
    /// Secant operator, the load factor growing.
    SecantLoad,
    /// Newton-Raphson, displacement control.
    Displacement,
    /// Newton-Raphson, cylindrical arc length.
    Cylindrical,
    /// Newton-Raphson, spherical arc length.
    Spherical,
    /// Newton-Raphson, dissipation control after displacement control up to a point given by hand.
    Dissipation,
    /// Newton-Raphson on laws that lag behind.
    Viscous,
    /// One linear solve a step.
    Implex,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Automatic,
        Self::Load,
        Self::SecantLoad,
        Self::Displacement,
        Self::Cylindrical,
        Self::Spherical,
        Self::Dissipation,
        Self::Viscous,
        Self::Implex,
    ];

    /// In words.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Automatic => "automatic",
            Self::Load => "Newton, load factor",
            Self::SecantLoad => "secant, load factor",
            Self::Displacement => "displacement control",
            Self::Cylindrical => "cylindrical arc length",
            Self::Spherical => "spherical arc length",
            Self::Dissipation => "dissipation control",
            Self::Viscous => "viscous Newton",
            Self::Implex => "IMPL-EX",
        }
    }

    /// Follows the path of a scenario in steps `coarse` times as long as its own.
    pub(super) fn follow(self, scene: &Scene, coarse: f64) -> Option<Result<Path, SolverError>> {
        let (model, conditions) = (scene.model)();
        let steps = scene.steps;
        let control = |length: f64| follow::steps(coarse * length, scene.criterion);
        let newton = |constraint: Box<dyn PathConstraint>| {
            NewtonRaphson::with_constraint(NewtonSettings::default(), constraint)
        };
        let arc = |constraint: ArcLength| -> (StepControl, Box<dyn Driver>) {
            (control(steps.arc), Box::new(newton(Box::new(constraint))))
        };
        let legs: Vec<(StepControl, Box<dyn Driver>)> = match self {
            Self::Automatic => vec![(
                control(steps.displacement),
                Box::new(Automatic::new(NewtonSettings::default())),
            )],
            Self::Load => vec![(
                control(steps.load),
                Box::new(newton(Box::<LoadFactor>::default())),
            )],
            Self::SecantLoad => vec![(control(steps.load), Box::<SecantAnderson>::default())],
            Self::Displacement => vec![(
                control(steps.displacement),
                Box::new(newton(Box::<LoadedDisplacement>::default())),
            )],
            Self::Cylindrical => vec![arc(ArcLength::cylindrical())],
            Self::Spherical => vec![arc(ArcLength::spherical(steps.arc / steps.load))],
            // Histories lag behind, or are extrapolated, along a displacement; under forces there is none to hold.
            Self::Viscous | Self::Implex => return None,
            Self::Dissipation => {
                let start = StepControl {
                    end: steps.start,
                    ..control(steps.displacement)
                };
                let displacement = newton(Box::<LoadedDisplacement>::default());
                let dissipation = newton(Box::<Dissipation>::default());
                vec![
                    (start, Box::new(displacement)),
                    (control(steps.energy), Box::new(dissipation)),
                ]
            }
        };
        Some(follow::follow((&model, conditions), legs, scene.arrived))
    }

    /// The driver of a path under an imposed displacement in steps of `step` (mm); none where the method does not apply.
    pub fn imposing(self, step: f64) -> Option<Box<dyn Driver>> {
        let newton = NewtonSettings::default();
        Some(match self {
            Self::Automatic => Box::new(Automatic::new(newton)),
            Self::Load => Box::new(NewtonRaphson::new(newton)),
            Self::SecantLoad => Box::<SecantAnderson>::default(),
            Self::Viscous => Box::new(Viscous::new(LAG * step, newton).ok()?),
            Self::Implex => Box::new(Implex),
            Self::Displacement | Self::Cylindrical | Self::Spherical | Self::Dissipation => {
                return None;
            }
        })
    }
}
