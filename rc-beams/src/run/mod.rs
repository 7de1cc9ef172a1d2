//! Runs specimens: model, analysis, files and the line on the terminal.

mod again;
mod caveats;
mod conflicts;
mod error;
mod evidence;
mod pictures;
mod plan;
mod pull_out;
mod queue;
mod recording;
mod resume;
mod sheets;
mod watch;

use std::cmp::Reverse;
use std::time::Instant;

use fe_solver::capacity::{Capacity, Verdict};
use fe_solver::error::SolverError;
use miette::Report;

use crate::analysis::{AnalysisError, Outcome, Staging, analyse};
use crate::build::{Beam, ModelSettings};
use crate::exit::Exit;
use crate::options::{Bond, Preset, RunOptions};
use crate::output;
use crate::results::checkpoint::{Checkpoint, CheckpointError};
use crate::results::error::ResultsError;
use crate::results::evidence::{Layout, Snapshot};
use crate::results::folder::Folder;
use crate::results::interrupt::Interrupt;
use crate::results::mode::Diagnosis;
use crate::results::mode::strengthened::BOND_GOVERNS;
use crate::results::progress::Board;
use crate::results::resources::Resources;
use crate::results::sheets::{MapState, SheetDrop, end_of_drop};
use crate::results::summary::{Figures, Summary, WallTime, Work};
use crate::spec::Specimen;
use caveats::{broken, pulls, read_elsewhere, unbalanced};
pub(crate) use conflicts::warnings;
pub use error::RunError;
use plan::{driver, input_hash, settings, setup, stepping};
use recording::Recording;
use resume::Beginning;
use watch::Watch;

/// Runs the specimens, as many at once as there are threads. All models are built and all folders tried before the
/// first one runs. Of several at once the largest models begin, so that no thread waits long for the last. What stops one of
/// them is told at once, and the others go on, unless their results could not be written either.
///
/// # Errors
///
/// [`RunError`], before the first one runs.
pub fn run_all(specimens: &[Specimen], options: &RunOptions) -> Result<Exit, RunError> {
    let interrupt = Interrupt::install()?;
    let mut queue = Vec::new();
    for specimen in specimens {
        let settings = settings(options, specimen);
        if let Some(conflict) = conflicts::conflict(options, &settings, specimen) {
            return Err(RunError::Options(conflict));
        }
        let beam = build(specimen, &settings)?;
        queue.push((beam.model.dofs().len(), specimen));
    }
    output::prepare(&options.output).map_err(ResultsError::from)?;
    let folders = specimens.iter().map(|s| options.output.join(&s.name));
    for folder in folders.filter(|folder| folder.exists()) {
        output::prepare(&folder).map_err(ResultsError::from)?;
    }
    for specimen in specimens {
        resume::check(&specimen.name, &input_hash(specimen, options), options)?;
    }
    let workers = queue::workers(specimens.len(), options.threads.map_or(0, usize::from))?;
    if workers.len() > 1 {
        queue.sort_by_key(|(dofs, _)| Reverse(*dofs));
    }
    let board = Board::new();
    let (exit, left) = queue::run(&workers, &queue, |(_, specimen), worker| {
        let done = run(specimen, options, (&interrupt, &board, &worker.threads));
        done.unwrap_or_else(|error| {
            let exit = error.exit();
            board.tell(&format!("{:?}", Report::new(error)));
            exit
        })
    });
    for (_, specimen) in left {
        board.print_result(&format!("{:<8}  not started", specimen.name));
    }
    // The results are in their folders, but who waits for them here should know.
    Ok(if board.has_lost() {
        exit.max(Exit::File)
    } else {
        exit
    })
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

fn run(
    specimen: &Specimen,
    options: &RunOptions,
    (interrupt, board, threads): (&Interrupt, &Board, &str),
) -> Result<Exit, RunError> {
    let begin = Instant::now();
    let resources = Resources::start(threads);
    let settings = settings(options, specimen);
    let beam = build(specimen, &settings)?;
    let hash = input_hash(specimen, options);
    let (folder, checkpoint) = match resume::begin(&specimen.name, &hash, options)? {
        Beginning::From(folder, checkpoint) => (folder, *checkpoint),
        Beginning::Over(exit) => {
            let how = match exit {
                Exit::Done => "done before",
                _ => "stopped early before; without --resume it is run again",
            };
            board.print_result(&format!("{:<8}  {how}", specimen.name));
            return Ok(exit);
        }
    };
    let stepping = stepping(specimen, options);
    let bond_error = match &beam.sheets {
        Some(sheets) => pull_out::error(&beam.model, sheets)?,
        None => None,
    };
    let mut driver = driver(specimen, options)?;
    let layout = evidence::layout(specimen, &beam);
    let mut recording = Recording::start(
        (board, &specimen.name),
        (&beam, &layout),
        (&folder, checkpoint),
        options.fields,
        (stepping.until_mm, stepping.criterion),
        interrupt,
    )?;
    if let Some(error) = &bond_error {
        recording.note(&error.to_string());
    }
    if let Some(text) = read_elsewhere(specimen, beam.measures.deflection_at) {
        recording.note(&text);
    }
    let staging = specimen.staged.as_ref().map(|staged| Staging {
        specimen,
        settings: &settings,
        staged,
    });
    let done = analyse(
        &beam,
        staging.as_ref(),
        &stepping,
        driver.as_mut(),
        &mut recording,
    );
    let failure = match &done {
        Ok(outcome) => outcome.stop.as_ref().err(),
        Err(error) => Some(error),
    };
    let unfinished = recording.is_resuming() && failure.is_some();
    if let Some(error) = failure.filter(|_| unfinished && !interrupt.is_set()) {
        let reason = match error {
            AnalysisError::Solver(SolverError::Output(table)) => table.to_string(),
            other => other.to_string(),
        };
        return Err(CheckpointError::of(&folder, reason).into());
    }
    let outcome = match done {
        _ if interrupt.is_set() && (unfinished || done.is_err()) => {
            let kept = kept("stopped by the user", Exit::Interrupted, &folder);
            board.print_result(&format!("{:<8}  {kept}", specimen.name));
            return Ok(Exit::Interrupted);
        }
        Ok(outcome) => outcome,
        Err(error) => {
            // Nothing to go on with.
            Checkpoint::remove(&folder)?;
            return Err(RunError::Solver {
                specimen: specimen.name.clone(),
                reason: Box::new(error),
            });
        }
    };
    let beam = outcome.ended_on.as_ref().unwrap_or(&beam);
    let peak = outcome.peak.iter().filter(|peak| **peak != outcome.last);
    let states: Vec<_> = peak.chain([&outcome.last]).collect();
    let (stop_reason, exit) = end(&outcome, interrupt);
    let kept = kept(&stop_reason, exit, &folder);
    let writing = match recording.finish(&beam.model, &states) {
        // Where nothing could be written before, that is the cause.
        Err(_) if exit == Exit::File => {
            board.print_result(&format!("{:<8}  {kept}", specimen.name));
            return Ok(exit);
        }
        finished => finished?,
    };
    let watch = recording.watch();
    let mut wall = WallTime {
        output: writing.as_secs_f64(),
        ..WallTime::default()
    };
    let mut work = Work::default();
    for (counters, times) in &outcome.work {
        work.add(counters);
        wall.add(times);
    }
    let capacity = Capacity::of(&outcome.path);
    // A beam that is to be strengthened under load and fails before is none that was tested.
    let strengthened = specimen.staged.is_none() || !outcome.before.is_empty();
    let reached = capacity.filter(|c| strengthened && c.is_reached());
    let mut missing = Vec::new();
    let numerical_error = match reached.and_then(|c| outcome.path.get(c.peak)) {
        Some(peak) if options.band => {
            let run = (specimen, &settings, &stepping);
            let found = again::numerical_error(peak.load, run, options, interrupt);
            found_or(found, "no error bar", &mut missing)
        }
        _ => None,
    };
    let tension = |capacity: &Capacity| {
        // Also before the sheets were bonded.
        let before = outcome.before.len();
        watch.largest_tension(before + outcome.path.len(), before + capacity.peak)
    };
    let at_peak = outcome.peak.as_ref().unwrap_or(&outcome.last);
    let peak = evidence::snapshot(beam, at_peak)?;
    let figures = capacity.and_then(|capacity| {
        // What has led to the bonding of the sheets counts as well.
        let whole = [outcome.before.as_slice(), &outcome.path].concat();
        let mut verdict = Verdict::of(&whole, &capacity.behind(outcome.before.len()));
        verdict.limit_by_locking(tension(&capacity));
        let torn = watch.largest_utilisation(outcome.path.len(), capacity.peak);
        if torn >= 1.0 {
            verdict.distrust(&format!(
                "sheets carry up to {torn:.2} times their strength: none tears in this model"
            ));
        }
        if let Some(text) = pulls(watch.backward(outcome.path.len(), capacity.peak)) {
            verdict.limit(&text);
        }
        for bar in broken(specimen, &peak) {
            verdict.distrust(&bar);
        }
        if let Some(error) = &numerical_error {
            verdict.limit_by_change("half the steps", error.half_steps.change);
            verdict.limit_by_change("a finer mesh", error.finer_mesh.change);
        }
        Some((
            Figures::of(&outcome.path, &capacity, &verdict)?,
            capacity,
            verdict,
        ))
    });
    let Some((figures, capacity, verdict)) = figures else {
        if over(exit) {
            Checkpoint::remove(&folder)?;
        }
        board.print_result(&format!("{:<8}  {kept}", specimen.name));
        return Ok(exit);
    };
    let at_end = outcome.fallen.as_ref().unwrap_or(&outcome.last);
    let last = evidence::snapshot(beam, at_end)?;
    let ratio = match &beam.sheets {
        Some(_) if options.counterfactual && capacity.is_reached() => {
            let perfect = ModelSettings {
                bond: Bond::Perfect,
                ..settings
            };
            let found = again::peak_of(specimen, &perfect, &stepping, options, interrupt);
            let peak = found_or(found, "no peak with perfect bond", &mut missing);
            // A lower bound proves that bond governs, never that it does not.
            let told = peak.map(|p| (p.kn / figures.peak_load_kn, p.reached));
            told.filter(|(ratio, reached)| *reached || *ratio >= BOND_GOVERNS)
                .map(|(ratio, _)| ratio)
        }
        _ => None,
    };
    let varied = options.band || (options.counterfactual && beam.sheets.is_some());
    let (kept, exit) = if over(exit) && varied && interrupt.is_set() {
        let reason = "stopped by the user in its runs with other steps, meshes or bonds";
        (
            self::kept(reason, Exit::Interrupted, &folder),
            Exit::Interrupted,
        )
    } else {
        (kept, exit)
    };
    let diagnosis = diagnosis(&layout, (&peak, &last), &outcome, (&capacity, ratio), watch);
    let setup = setup(specimen, options, &settings, beam, driver.name());
    let drawing = Instant::now();
    pictures::curve(&folder, specimen, &setup, &outcome, (&capacity, &verdict))?;
    let title = format!(
        "cracks at the peak, {:.1} kN at {:.2} mm",
        figures.peak_load_kn, figures.deflection_at_peak_mm
    );
    pictures::crack(&folder, specimen, beam, &peak, &title)?;
    if let Some(record) = &beam.sheets {
        let states = [(MapState::Peak, at_peak), (MapState::End, at_end)];
        pictures::sheets(
            &folder,
            specimen,
            (beam, record),
            watch.sheet_layout(),
            states,
            (figures.peak_load_kn, figures.deflection_at_peak_mm),
        )?;
    }
    wall.output += drawing.elapsed().as_secs_f64();
    wall.total = begin.elapsed().as_secs_f64();
    let test = specimen.test.as_ref().map(|t| t.load_kn.get());
    let summary = Summary {
        ratio_model_to_test: reached.and(test).map(|t| figures.peak_load_kn / t),
        test_load_kn: test,
        setup,
        work,
        figures,
        bonded_at_kn: outcome.before.last().map(|p| p.load),
        stop_reason,
        stopped_early: exit != Exit::Done,
        diagnosis,
        bond_error,
        tension_over_strength: tension(&capacity),
        numerical_error,
        self_weight_reaction_kn: outcome.self_weight_kn,
        energy: Some(watch.energy()),
        wall_s: wall,
        cpu_s: resources.cpu_s(),
        max_rss_mb: resources.max_rss_mb(),
    };
    summary.write(&folder)?;
    if over(exit) {
        Checkpoint::remove(&folder)?;
    }
    let mut line = summary.line();
    if exit != Exit::Done {
        line = format!("{line}  {kept}");
    } else if options.band && summary.numerical_error.is_none() && missing.is_empty() {
        missing.push("no error bar, for not all paths go beyond a peak".into());
    }
    missing.extend(summary.energy.as_ref().and_then(unbalanced));
    for text in missing {
        line = format!("{line}  {text}");
    }
    board.print_result(&line);
    Ok(exit)
}

/// What a further run has found; that it cannot be run takes nothing away from what has been, and is added to what is `missing`.
fn found_or<T>(
    found: Result<Option<T>, RunError>,
    what: &str,
    missing: &mut Vec<String>,
) -> Option<T> {
    found.unwrap_or_else(|error| {
        missing.push(format!("{what}: {error}"));
        None
    })
}

fn diagnosis(
    layout: &Layout,
    (peak, last): (&Snapshot, &Snapshot),
    outcome: &Outcome,
    (capacity, ratio): (&Capacity, Option<f64>),
    watch: &Watch,
) -> Diagnosis {
    let rows = watch.rows(outcome.path.len());
    let drop = SheetDrop::of(watch.sheet_layout(), rows, &outcome.path, capacity);
    let mut diagnosis = match drop {
        Some(sheets) if !watch.sheet_layout().zones.is_empty() => {
            let states = (peak, last);
            Diagnosis::strengthened(layout, states, capacity, &sheets, ratio)
        }
        _ => Diagnosis::of(layout, peak, last, capacity),
    };
    let end = end_of_drop(&outcome.path, capacity);
    let end = end.map_or(outcome.path.last(), |i| outcome.path.get(i));
    if let Some(end) = end.filter(|end| end.flagged) {
        let told = format!(
            "; at the end of the drop the residual is {:.1e}: the beam moves there, no equilibrium was found",
            end.residual
        );
        diagnosis.mode_evidence += &told;
    }
    diagnosis
}

/// Why the path ended, and what that means for the exit code.
fn end(outcome: &Outcome, interrupt: &Interrupt) -> (String, Exit) {
    match &outcome.stop {
        Ok(reason) => (reason.clone(), Exit::Done),
        Err(_) if interrupt.is_set() => ("stopped by the user".into(), Exit::Interrupted),
        Err(error @ AnalysisError::Solver(SolverError::Output(_))) => {
            (error.to_string(), Exit::File)
        }
        Err(error) => (error.to_string(), Exit::StoppedEarly),
    }
}

/// Whether there is nothing left to go on with: only a run that was stopped from outside can.
const fn over(exit: Exit) -> bool {
    matches!(exit, Exit::Done | Exit::StoppedEarly)
}

/// What is said of a run that does not reach its end.
fn kept(reason: &str, exit: Exit, folder: &Folder) -> String {
    let reason = match exit {
        Exit::Interrupted => reason.to_owned(),
        _ => format!("stopped: {reason}"),
    };
    let path = folder.path().display();
    let remedy = match exit {
        Exit::Interrupted => "; --resume goes on from there",
        Exit::File => "; make room there, and --resume goes on from there",
        _ => "",
    };
    format!("{reason}; the results up to the last accepted step are in {path}{remedy}")
}
