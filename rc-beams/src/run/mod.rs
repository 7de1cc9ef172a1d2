//! Runs specimens: model, analysis, files and the line on the terminal.

mod evidence;
mod pictures;
mod recording;

use std::time::Instant;

use fe_core::model::ModelError;
use fe_elements::HexRule;
use fe_solver::capacity::{Capacity, Verdict};
use fe_solver::driver::Driver;
use fe_solver::error::SolverError;
use fe_solver::newton::{NewtonRaphson, NewtonSettings, Refactor};
use fe_solver::secant::SecantAnderson;

use crate::analysis::{Outcome, Stepping, analyse};
use crate::build::{Beam, BuildError, ModelSettings};
use crate::exit::Exit;
use crate::options::{self, Integration, RunOptions};
use crate::output;
use crate::results::error::ResultsError;
use crate::results::folder::Folder;
use crate::results::hash::fingerprint;
use crate::results::interrupt::Interrupt;
use crate::results::mode::Diagnosis;
use crate::results::progress::print_result;
use crate::results::resources::Resources;
use crate::results::summary::{Figures, Setup, Summary, WallTime, Work};
use crate::spec::Specimen;
use recording::Recording;

/// First step of the load stage (mm of imposed deflection). Steps from 0.006 to 0.06 mm put the peak of
/// A-SO3-1 between 138.5 and 140.7 kN, with the characteristic preset between 148.7 and 155.9 kN: the path
/// passes bifurcations, and the step decides which branch it takes.
const FIRST_STEP_MM: f64 = 0.02;
/// Without a final deflection the path is followed past its peak, at most to this multiple of the
/// deflection that the source imposed.
const FARTHEST: f64 = 4.0;
/// Relative residual that a step must meet.
const CRITERION: f64 = 1e-3;
/// Modified Newton-Raphson keeps the factor while an iteration divides the residual by this.
const KEEP_FACTOR: f64 = 3.0;

/// What stops the program before or between runs.
#[derive(Debug, thiserror::Error, miette::Diagnostic)]
#[non_exhaustive]
pub enum RunError {
    /// A model cannot be built.
    #[error("{specimen}: {reason}")]
    Build {
        /// Specimen.
        specimen: String,
        /// Why.
        reason: Box<BuildError>,
    },
    /// Results cannot be written.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Output(#[from] ResultsError),
    /// The threads cannot be started.
    #[error("cannot start the threads")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A beam cannot carry its own weight, or its model is singular.
    #[error("{specimen}: {reason}")]
    Solver {
        /// Specimen.
        specimen: String,
        /// Why.
        reason: Box<SolverError>,
    },
    /// A state cannot be read.
    #[error(transparent)]
    Model(#[from] ModelError),
}

impl RunError {
    /// How the program ends because of it.
    pub fn exit(&self) -> Exit {
        match self {
            Self::Build { reason, .. } => match **reason {
                BuildError::TooFewElements { .. } => Exit::Usage,
                _ => Exit::BadInput,
            },
            Self::Output(_) => Exit::File,
            Self::Threads(_) | Self::Solver { .. } | Self::Model(_) => Exit::StoppedEarly,
        }
    }
}

/// Runs the specimens one after the other. All models are built and all folders tried before the first one
/// runs.
///
/// # Errors
///
/// [`RunError`]; the results of the beams before are kept.
pub fn run_all(specimens: &[Specimen], options: &RunOptions) -> Result<Exit, RunError> {
    let interrupt = Interrupt::install()?;
    let settings = settings(options);
    let threads = options.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    for specimen in specimens {
        build(specimen, &settings)?;
    }
    output::prepare(&options.output).map_err(ResultsError::from)?;
    let folders = specimens.iter().map(|s| options.output.join(&s.name));
    for folder in folders.filter(|folder| folder.exists()) {
        output::prepare(&folder).map_err(ResultsError::from)?;
    }
    let mut exit = Exit::Done;
    for specimen in specimens {
        let one = pool.install(|| run(specimen, options, &settings, &interrupt))?;
        exit = exit.max(one);
        if one == Exit::Interrupted {
            break;
        }
    }
    Ok(exit)
}

fn build(specimen: &Specimen, settings: &ModelSettings) -> Result<Beam, RunError> {
    Beam::new(specimen, settings).map_err(|error| RunError::Build {
        specimen: specimen.name.clone(),
        reason: Box::new(error),
    })
}

fn settings(options: &RunOptions) -> ModelSettings {
    let mut settings = ModelSettings::new(options.preset);
    settings.law = options.law;
    if let Some(mesh) = options.mesh {
        settings.mesh = [mesh.nx, mesh.ny, mesh.nz];
    }
    if let Some(integration) = options.integration {
        settings.integration = match integration {
            Integration::Reduced => HexRule::Reduced,
            Integration::Full => HexRule::Full,
        };
    }
    settings
}

fn stepping(specimen: &Specimen, options: &RunOptions) -> Stepping {
    let imposed = specimen.imposed.deflection_mm.get();
    let end = options.until_mm.unwrap_or(imposed);
    Stepping {
        initial_mm: options
            .steps
            .map_or(FIRST_STEP_MM.min(end), |n| end / f64::from(n)),
        until_mm: options.until_mm.unwrap_or(FARTHEST * imposed),
        to_the_end: options.until_mm.is_some(),
        criterion: CRITERION,
    }
}

fn driver(options: &RunOptions) -> Box<dyn Driver> {
    match options.driver {
        options::Driver::Secant => Box::new(SecantAnderson::default()),
        options::Driver::Newton => Box::new(NewtonRaphson::new(NewtonSettings::default())),
        options::Driver::ModifiedNewton => Box::new(NewtonRaphson::new(NewtonSettings {
            refactor: Refactor::Below(KEEP_FACTOR),
            ..NewtonSettings::default()
        })),
    }
}

fn run(
    specimen: &Specimen,
    options: &RunOptions,
    settings: &ModelSettings,
    interrupt: &Interrupt,
) -> Result<Exit, RunError> {
    let begin = Instant::now();
    let resources = Resources::start();
    let beam = build(specimen, settings)?;
    let folder = Folder::create(&options.output, &specimen.name)?;
    let stepping = stepping(specimen, options);
    let mut driver = driver(options);
    let mut recording = Recording::start(
        &specimen.name,
        &beam,
        &folder,
        options.fields,
        (stepping.until_mm, stepping.criterion),
        interrupt,
    )?;
    let outcome = match analyse(&beam, &stepping, driver.as_mut(), &mut recording) {
        Ok(outcome) => outcome,
        Err(_) if interrupt.is_set() => {
            let kept = kept("stopped by the user", Exit::Interrupted, &folder);
            print_result(&format!("{:<8}  {kept}", specimen.name));
            return Ok(Exit::Interrupted);
        }
        Err(error) => {
            return Err(RunError::Solver {
                specimen: specimen.name.clone(),
                reason: Box::new(error),
            });
        }
    };
    let peak = outcome.peak.iter().filter(|peak| **peak != outcome.last);
    let states: Vec<_> = peak.chain([&outcome.last]).collect();
    let mut wall = WallTime {
        output: recording.finish(&states)?.as_secs_f64(),
        ..WallTime::default()
    };
    let drawing = Instant::now();
    let mut work = Work::default();
    for (counters, times) in &outcome.work {
        work.add(counters);
        wall.add(times);
    }
    let (stop_reason, exit) = end(&outcome, interrupt);
    let kept = kept(&stop_reason, exit, &folder);
    let figures = Capacity::of(&outcome.path).and_then(|capacity| {
        let verdict = Verdict::of(&outcome.path, &capacity);
        Some((
            Figures::of(&outcome.path, &capacity, &verdict)?,
            capacity,
            verdict,
        ))
    });
    let Some((figures, capacity, verdict)) = figures else {
        print_result(&format!("{:<8}  {kept}", specimen.name));
        return Ok(exit);
    };
    let layout = evidence::layout(specimen, &beam);
    let peak = evidence::snapshot(&beam, outcome.peak.as_ref().unwrap_or(&outcome.last))?;
    let last = evidence::snapshot(&beam, &outcome.last)?;
    let diagnosis = Diagnosis::of(&layout, &peak, &last, capacity.post_peak_drop);
    let setup = setup(specimen, options, settings, &beam, driver.name());
    pictures::curve(&folder, specimen, &setup, &outcome, (&capacity, &verdict))?;
    let title = format!(
        "cracks at the peak, {:.1} kN at {:.2} mm",
        figures.peak_load_kn, figures.deflection_at_peak_mm
    );
    pictures::crack(&folder, specimen, &beam, &peak, &title)?;
    wall.output += drawing.elapsed().as_secs_f64();
    wall.total = begin.elapsed().as_secs_f64();
    let test = specimen.test.as_ref().map(|t| t.load_kn.get());
    let summary = Summary {
        ratio_model_to_test: test.map(|t| figures.peak_load_kn / t),
        test_load_kn: test,
        setup,
        work,
        figures,
        stop_reason,
        diagnosis,
        self_weight_reaction_kn: outcome.self_weight_kn,
        wall_s: wall,
        cpu_s: resources.cpu_s(),
        max_rss_mb: resources.max_rss_mb(),
    };
    summary.write(&folder)?;
    print_result(&match exit {
        Exit::Done => summary.line(),
        _ => format!("{}  {kept}", summary.line()),
    });
    Ok(exit)
}

/// Why the path ended, and what that means for the exit code.
fn end(outcome: &Outcome, interrupt: &Interrupt) -> (String, Exit) {
    match &outcome.stop {
        Ok(reason) => (reason.clone(), Exit::Done),
        Err(_) if interrupt.is_set() => ("stopped by the user".into(), Exit::Interrupted),
        Err(error @ SolverError::Output(_)) => (error.to_string(), Exit::File),
        Err(error) => (error.to_string(), Exit::StoppedEarly),
    }
}

/// What is said of a run that does not reach its end.
fn kept(reason: &str, exit: Exit, folder: &Folder) -> String {
    let reason = match exit {
        Exit::Interrupted => reason.to_owned(),
        _ => format!("stopped: {reason}"),
    };
    let path = folder.path().display();
    format!("{reason}; the results up to the last accepted step are in {path}")
}

fn setup(
    specimen: &Specimen,
    options: &RunOptions,
    settings: &ModelSettings,
    beam: &Beam,
    driver: &str,
) -> Setup {
    let [nx, ny, nz] = settings.mesh;
    let text = |value: Result<String, serde_json::Error>| value.unwrap_or_default();
    Setup {
        specimen: specimen.name.clone(),
        preset: options::name(&settings.preset),
        law: options::name(&settings.law),
        driver: driver.into(),
        integration: match settings.integration {
            HexRule::Reduced => "reduced".into(),
            HexRule::Full => "full".into(),
        },
        mesh: format!("{nx}x{ny}x{nz}"),
        elements: beam.model.elements().len(),
        dofs: beam.model.dofs().len(),
        version: env!("CARGO_PKG_VERSION").into(),
        input_hash: fingerprint(&[
            &text(serde_json::to_string(specimen)),
            &text(serde_json::to_string(options)),
        ]),
    }
}
