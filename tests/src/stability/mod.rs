//! Where methods fail: scenes with a known path, each given to every method.
//!
//! A case ends in one of four ways. *Correct*: it arrived, and every figure is within its tolerance. *Stopped*: the
//! method gave up with an error, and says so. *Wrong, reported*: a figure is off, and the run itself said that it
//! jumped or missed its criterion. *Wrong and silent*: a figure is off and nothing was said: the only outcome that harms.

mod chart;
mod figures;
mod method;
mod paths;
mod scenarios;

pub use chart::chart;
pub use figures::{Figure, Target};
pub use method::Method;
pub use paths::{Scene, Steps};
pub use scenarios::{LONG, LONGER, SCENARIOS, STRIP, sheared};

use fe_solver::stage::Counters;

use crate::driven::Driven;

/// What keeps a scenario from being set up.
pub type Failure = Box<dyn std::error::Error>;

/// One scenario of the catalogue.
#[derive(Debug, Clone, Copy)]
pub struct Scenario {
    /// Name in the catalogue.
    pub id: &'static str,
    /// What happens.
    pub title: &'static str,
    /// What it leaves out of the catalogue, or holds otherwise; empty where there is nothing to say.
    pub remark: &'static str,
    /// Lengths of its steps over the usual ones at which it is run; empty where there are no steps.
    pub coarse: &'static [f64],
    /// Runs it by a method; none where the method does not apply. What depends on no method is run by the automatic one.
    pub run: fn(Method, f64) -> Option<Result<Case, Failure>>,
}

/// Lengths of steps of scenes that have a path.
pub const COARSE: &[f64] = &[0.5, 1.0, 2.0];

/// What came of a scenario by one method.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Figures beside their targets.
    pub figures: Vec<Figure>,
    /// The error it ended with, if it did.
    pub stopped: Option<String>,
    /// Steps of which the run itself said that they jumped or missed the criterion.
    pub marked: usize,
    /// Work done.
    pub counters: Counters,
}

/// How a case ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Arrived, every figure within tolerance.
    Correct,
    /// Gave up and said so.
    Stopped,
    /// Off, and said so.
    Reported,
    /// Off, and nothing was said.
    Silent,
}

impl Case {
    /// Figures without a path.
    pub fn checked(figures: Vec<Figure>) -> Self {
        Self {
            figures,
            stopped: None,
            marked: 0,
            counters: Counters::default(),
        }
    }

    /// Figures of a path under imposed displacements.
    pub fn driven(driven: Driven, figures: Vec<Figure>) -> Self {
        Self {
            figures,
            stopped: driven.stopped,
            marked: driven.marked,
            counters: driven.counters,
        }
    }

    /// How it ended.
    pub fn outcome(&self) -> Outcome {
        if self.stopped.is_some() {
            Outcome::Stopped
        } else if self.figures.iter().all(Figure::holds) {
            Outcome::Correct
        } else if self.marked > 0 {
            Outcome::Reported
        } else {
            Outcome::Silent
        }
    }
}

impl Outcome {
    /// All of them, from the best to the worst.
    pub const ALL: [Self; 4] = [Self::Correct, Self::Stopped, Self::Reported, Self::Silent];

    /// In words.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Correct => "correct",
            Self::Stopped => "stopped, says so",
            Self::Reported => "wrong, says so",
            Self::Silent => "wrong and silent",
        }
    }

    /// Colour in the chart, distinguishable without colour vision (Wong 2011).
    pub const fn colour(self) -> &'static str {
        match self {
            Self::Correct => "#009E73",
            Self::Stopped => "#56B4E9",
            Self::Reported => "#E69F00",
            Self::Silent => "#D55E00",
        }
    }
}
