//! One beam and what it is run with.

use fe_solver::driver::Driver;

use super::RunError;
use super::plan;
use crate::analysis::{AnalysisError, Observer, Outcome, Staging, Stepping, analyse};
use crate::build::{Beam, ModelSettings};
use crate::options::{Preset, RunOptions};
use crate::results::interrupt::Interrupt;
use crate::results::progress::Board;
use crate::spec::Specimen;

/// A specimen, how it is modelled and stepped, and whom it is told.
#[derive(Clone, Copy)]
pub(super) struct Case<'a> {
    pub specimen: &'a Specimen,
    pub options: &'a RunOptions,
    pub settings: ModelSettings,
    pub stepping: Stepping,
    pub interrupt: &'a Interrupt,
    pub board: &'a Board,
}

impl<'a> Case<'a> {
    /// The case that the options ask for.
    pub(super) fn new(
        specimen: &'a Specimen,
        options: &'a RunOptions,
        (interrupt, board): (&'a Interrupt, &'a Board),
    ) -> Self {
        Self {
            specimen,
            options,
            settings: plan::settings(options, specimen),
            stepping: plan::stepping(specimen, options),
            interrupt,
            board,
        }
    }

    /// The model.
    pub(super) fn beam(&self) -> Result<Beam, RunError> {
        build(self.specimen, &self.settings)
    }

    /// How a step is solved.
    pub(super) fn driver(&self) -> Result<Box<dyn Driver>, RunError> {
        plan::driver(self.specimen, self.options)
    }

    /// Follows the load path of the model.
    pub(super) fn follow(
        &self,
        beam: &Beam,
        driver: &mut dyn Driver,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, AnalysisError> {
        let staging = self.specimen.staged.as_ref().map(|staged| Staging {
            specimen: self.specimen,
            settings: &self.settings,
            staged,
        });
        analyse(beam, staging.as_ref(), &self.stepping, driver, observer)
    }

    /// That the path cannot be followed at all.
    pub(super) fn failure(&self, reason: AnalysisError) -> RunError {
        RunError::Solver {
            specimen: self.specimen.name.clone(),
            reason: Box::new(reason),
        }
    }

    /// The line on the terminal when nothing more is said of the beam than this.
    pub(super) fn tell(&self, text: &str) {
        let name = &self.specimen.name;
        self.board.print_result(&format!("{name:<8}  {text}"));
    }
}

/// Whether the model of a specimen can be built with the default options: what laws and elements refuse comes out here.
pub(crate) fn buildable(specimen: &Specimen) -> Result<(), RunError> {
    build(specimen, &default_settings(specimen)).map(drop)
}

fn default_settings(specimen: &Specimen) -> ModelSettings {
    ModelSettings::new(Preset::default(), specimen)
}

fn build(specimen: &Specimen, settings: &ModelSettings) -> Result<Beam, RunError> {
    Beam::new(specimen, settings).map_err(|error| RunError::Build {
        specimen: specimen.name.clone(),
        reason: Box::new(error),
        by_options: Beam::new(specimen, &default_settings(specimen)).is_ok(),
    })
}
