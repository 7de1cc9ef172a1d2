//! Methods that a scenario is given to.

use fe_solver::automatic::Automatic;
use fe_solver::control::StepControl;
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::path::{ArcLength, Dissipation, LoadFactor, LoadedDisplacement, PathConstraint};
use fe_solver::secant::SecantAnderson;

use super::Scenario;
use crate::follow::{self, Path};

/// A driver with a path constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Chooses for itself.
    Automatic,
    /// Newton-Raphson, load control.
    Load,
    /// Secant operator, load control.
    SecantLoad,
    /// Newton-Raphson, displacement control.
    Displacement,
    /// Newton-Raphson, cylindrical arc length.
    Cylindrical,
    /// Newton-Raphson, spherical arc length.
    Spherical,
    /// Newton-Raphson, dissipation control after displacement control up to a point given by hand.
    Dissipation,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Automatic,
        Self::Load,
        Self::SecantLoad,
        Self::Displacement,
        Self::Cylindrical,
        Self::Spherical,
        Self::Dissipation,
    ];

    /// In words.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Automatic => "automatic",
            Self::Load => "load control",
            Self::SecantLoad => "secant, load control",
            Self::Displacement => "displacement control",
            Self::Cylindrical => "cylindrical arc length",
            Self::Spherical => "spherical arc length",
            Self::Dissipation => "dissipation control",
        }
    }

    /// Follows the path of a scenario in steps `coarse` times as long as its own.
    pub(super) fn follow(self, scenario: &Scenario, coarse: f64) -> Result<Path, SolverError> {
        let (model, conditions) = (scenario.scene)();
        let steps = scenario.steps;
        let control = |length: f64| follow::steps(coarse * length, scenario.criterion);
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
        follow::follow((&model, conditions), legs, follow::gone)
    }
}
