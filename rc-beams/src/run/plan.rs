//! From the options of the command line to a model, steps and a driver.

use fe_elements::HexRule;
use fe_solver::automatic::Automatic;
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::explicit::Explicit;
use fe_solver::implex::Implex;
use fe_solver::newton::{NewtonRaphson, NewtonSettings, Refactor};
use fe_solver::secant::SecantAnderson;
use fe_solver::viscous::Viscous;

use super::case::Case;
use super::error::RunError;
use crate::analysis::Stepping;
use crate::build::{Beam, ModelSettings};
use crate::options::{self, Integration, RunOptions};
use crate::results::hash::fingerprint;
use crate::results::summary::Setup;
use crate::spec::Specimen;

/// First step of the load stage (mm of imposed deflection). The path passes bifurcations, and the step is among what decides
/// which branch it takes: `--band` tells what half the steps change.
const FIRST_STEP_MM: f64 = 0.01;
/// Share of the deflection reached that a step may take: beams that yield are followed in longer steps.
const LONGEST_SHARE: f64 = 0.01;
/// Without a final deflection the path is followed past its peak, at most to this multiple of the
/// deflection that the source imposed.
const FARTHEST: f64 = 4.0;
/// Viscosity of the viscous driver (mm of imposed deflection): a first step admits 95 % of the growth of histories
/// (prototype runs of A-SO3-1: 0.1 mm raises the peak by a fifth, 0.001 mm by nothing).
const VISCOSITY_MM: f64 = 1e-3;
/// Modified Newton-Raphson keeps the factor while an iteration divides the residual by this.
const KEEP_FACTOR: f64 = 3.0;

/// How a specimen is modelled.
pub(super) fn settings(options: &RunOptions, specimen: &Specimen) -> ModelSettings {
    let mut settings = ModelSettings::new(options.preset, specimen).with_cracks(&options.cracks);
    settings.law = options.law();
    settings.bond = options.bond;
    settings.soffit_fibre = options.soffit_fibre.unwrap_or(settings.soffit_fibre);
    settings.strip_bond = options.strip_bond.unwrap_or(settings.strip_bond);
    settings.sheet_shear = options.sheet_shear.unwrap_or(settings.sheet_shear);
    if let Some(mesh) = options.mesh {
        settings.mesh = mesh;
    }
    if let Some(integration) = options.integration {
        settings.integration = match integration {
            Integration::Reduced => HexRule::Reduced,
            Integration::Irons => HexRule::Irons,
            Integration::Full => HexRule::Full,
        };
    }
    if options.mesh.is_none() && settings.integration == HexRule::Reduced {
        // Its points are too few for a model that is uniform across.
        settings.mesh.nz = settings.mesh.nz.or(Some(1));
    }
    settings
}

/// How its path is stepped.
pub(super) fn stepping(specimen: &Specimen, options: &RunOptions) -> Stepping {
    let imposed = specimen.imposed.deflection_mm.get();
    let end = options.until_mm.unwrap_or(imposed);
    Stepping {
        initial_mm: options
            .steps
            .map_or(FIRST_STEP_MM.min(end), |n| end / f64::from(n)),
        longest_share: LONGEST_SHARE,
        until_mm: options.until_mm.unwrap_or(FARTHEST * imposed),
        to_the_end: options.until_mm.is_some(),
        criterion: options.criterion,
    }
}

/// How a step is solved.
///
/// # Errors
///
/// None for these settings.
pub(super) fn driver(
    specimen: &Specimen,
    options: &RunOptions,
) -> Result<Box<dyn Driver>, RunError> {
    let newton = NewtonSettings::default();
    Ok(match options.driver {
        options::Driver::Secant => Box::new(SecantAnderson::default()),
        options::Driver::Automatic => Box::new(Automatic::new(newton)),
        options::Driver::Explicit => Box::new(Explicit::default()),
        options::Driver::Implex => Box::new(Implex),
        options::Driver::Viscous => Box::new(viscous(newton).map_err(|e| RunError::Solver {
            specimen: specimen.name.clone(),
            reason: Box::new(e.into()),
        })?),
        options::Driver::Newton => Box::new(NewtonRaphson::new(newton)),
        options::Driver::ModifiedNewton => Box::new(NewtonRaphson::new(NewtonSettings {
            refactor: Refactor::Below(KEEP_FACTOR),
            ..newton
        })),
    })
}

fn viscous(newton: NewtonSettings) -> Result<Viscous, SolverError> {
    Viscous::new(VISCOSITY_MM, newton)
}

/// What was run, for the summary.
pub(super) fn setup(case: &Case<'_>, beam: &Beam, driver: &str) -> Setup {
    let (specimen, options, settings) = (case.specimen, case.options, &case.settings);
    Setup {
        specimen: specimen.name.clone(),
        preset: options::name(&settings.preset),
        law: options::name(&settings.law),
        driver: driver.into(),
        integration: match settings.integration {
            HexRule::Reduced => "reduced".into(),
            HexRule::Irons => "irons".into(),
            HexRule::Full => "full".into(),
        },
        mesh: settings.mesh.to_string(),
        elements: beam.model.elements().len(),
        dofs: beam.model.dofs().len(),
        options: options.changed(),
        version: env!("CARGO_PKG_VERSION").into(),
        input_hash: input_hash(specimen, options),
    }
}

/// Fingerprint of what the results depend on.
pub(super) fn input_hash(specimen: &Specimen, options: &RunOptions) -> String {
    let text = |value: Result<String, serde_json::Error>| value.unwrap_or_default();
    fingerprint(&[
        &text(serde_json::to_string(specimen)),
        &text(serde_json::to_string(options)),
    ])
}
