//! Runs specimens: model, analysis, files and the line on the terminal.

mod again;
mod case;
mod caveats;
mod conflicts;
mod end;
mod error;
mod evidence;
mod judgement;
mod pictures;
mod plan;
mod pull_out;
mod queue;
mod recording;
mod resume;
mod sheets;
mod walk;
mod watch;

use std::cmp::Reverse;
use std::time::{Duration, Instant};

use miette::Report;

use crate::analysis::Outcome;
use crate::exit::Exit;
use crate::options::RunOptions;
use crate::output;
use crate::results::checkpoint::Checkpoint;
use crate::results::error::ResultsError;
use crate::results::interrupt::Interrupt;
use crate::results::progress::Board;
use crate::results::resources::Resources;
use crate::results::summary::{Setup, Summary, WallTime, Work};
use crate::spec::Specimen;
use case::Case;
pub(crate) use case::buildable;
use caveats::unbalanced;
pub(crate) use conflicts::warnings;
use end::End;
pub use error::RunError;
use judgement::Judgement;
use plan::input_hash;
use resume::Beginning;
use walk::{Walk, walk};

/// Runs the specimens, as many at once as there are threads. All models are built and all folders tried before the
/// first one runs. Of several at once the largest models begin, so that no thread waits long for the last. What stops one of
/// them is told at once, and the others go on, unless their results could not be written either.
///
/// # Errors
///
/// [`RunError`], before the first one runs.
pub fn run_all(specimens: &[Specimen], options: &RunOptions) -> Result<Exit, RunError> {
    let interrupt = Interrupt::install()?;
    let board = Board::new();
    let mut queue = Vec::new();
    for specimen in specimens {
        let case = Case::new(specimen, options, (&interrupt, &board));
        if let Some(conflict) = conflicts::conflict(options, &case.settings, specimen) {
            return Err(RunError::Options(conflict));
        }
        queue.push((case.beam()?.model.dofs().len(), case));
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
    let (exit, left) = queue::run(&workers, &queue, |(_, case), worker| {
        let done = run(case, &worker.threads);
        done.unwrap_or_else(|error| {
            let exit = error.exit();
            board.tell(&format!("{:?}", Report::new(error)));
            exit
        })
    });
    for (_, case) in left {
        case.tell("not started");
    }
    // The results are in their folders, but who waits for them here should know.
    Ok(if board.has_lost() {
        exit.max(Exit::File)
    } else {
        exit
    })
}

/// Runs one beam, from the input to the line on the terminal.
fn run(case: &Case<'_>, threads: &str) -> Result<Exit, RunError> {
    let begin = Instant::now();
    let resources = Resources::start(threads);
    let beam = case.beam()?;
    let hash = input_hash(case.specimen, case.options);
    let (folder, checkpoint) = match resume::begin(&case.specimen.name, &hash, case.options)? {
        Beginning::From(folder, checkpoint) => (folder, *checkpoint),
        Beginning::Over(exit) => {
            case.tell(match exit {
                Exit::Done => "done before",
                _ => "stopped early before; without --resume it is run again",
            });
            return Ok(exit);
        }
    };
    let Some(mut walk) = walk(case, &beam, (&folder, checkpoint))? else {
        return Ok(Exit::Interrupted);
    };
    let mut end = End::of(&walk.outcome, case.interrupt);
    let beam = walk.outcome.ended_on.as_ref().unwrap_or(&beam);
    let outcome = &walk.outcome;
    let peak = outcome.peak.iter().filter(|peak| **peak != outcome.last);
    let states: Vec<_> = peak.chain([&outcome.last]).collect();
    let mut output = match walk.recording.finish(&beam.model, &states) {
        // Where nothing could be written before, that is the cause.
        Err(_) if end.exit == Exit::File => {
            case.tell(&end.told(&folder));
            return Ok(end.exit);
        }
        finished => finished?,
    };
    let Some(judgement) = Judgement::of(case, beam, &walk)? else {
        if end.is_final() {
            Checkpoint::remove(&folder)?;
        }
        case.tell(&end.told(&folder));
        return Ok(end.exit);
    };
    let stop_reason = end.reason.clone();
    let options = case.options;
    let varied = options.band || (options.counterfactual && beam.sheets.is_some());
    if end.is_final() && varied && case.interrupt.is_set() {
        end = End::by_user("stopped by the user in its runs with other steps, meshes or bonds");
    }
    let drawing = Instant::now();
    let setup = plan::setup(case, beam, walk.driver);
    pictures::draw((&folder, case.specimen, beam), &walk, (&setup, &judgement))?;
    output += drawing.elapsed();
    let summary = Summary {
        wall_s: wall_time(&walk.outcome, output, begin.elapsed()),
        cpu_s: resources.cpu_s(),
        max_rss_mb: resources.max_rss_mb(),
        ..summary(case, &walk, (setup, &judgement), (stop_reason, end.exit))
    };
    summary.write(&folder)?;
    if end.is_final() {
        Checkpoint::remove(&folder)?;
    }
    let mut told = vec![summary.line()];
    if end.exit != Exit::Done {
        told.push(end.told(&folder));
    } else if options.band && summary.numerical_error.is_none() && judgement.missing.is_empty() {
        told.push("no error bar, for not all paths go beyond a peak".into());
    }
    told.extend(judgement.missing);
    told.extend(summary.energy.as_ref().and_then(unbalanced));
    case.board.print_result(&told.join("  "));
    Ok(end.exit)
}

/// What is kept of a beam, but for what it cost.
fn summary(
    case: &Case<'_>,
    walk: &Walk<'_>,
    (setup, judgement): (Setup, &Judgement<'_>),
    (stop_reason, exit): (String, Exit),
) -> Summary {
    let outcome = &walk.outcome;
    let mut work = Work::default();
    for (counters, _) in &outcome.work {
        work.add(counters);
    }
    let test = case.specimen.test.as_ref().map(|t| t.load_kn.get());
    let told = test.filter(|_| judgement.is_peak);
    Summary {
        ratio_model_to_test: told.map(|t| judgement.figures.peak_load_kn / t),
        test_load_kn: test,
        setup,
        work,
        figures: judgement.figures.clone(),
        bonded_at_kn: outcome.before.last().map(|p| p.load),
        stop_reason,
        stopped_early: exit != Exit::Done,
        diagnosis: judgement.diagnosis.clone(),
        bond_error: walk.bond_error,
        tension_over_strength: judgement.tension_over_strength,
        numerical_error: judgement.numerical_error.clone(),
        self_weight_reaction_kn: outcome.self_weight_kn,
        energy: Some(walk.recording.watch().energy()),
        wall_s: WallTime::default(),
        cpu_s: None,
        max_rss_mb: None,
    }
}

fn wall_time(outcome: &Outcome, output: Duration, total: Duration) -> WallTime {
    let mut wall = WallTime {
        output: output.as_secs_f64(),
        total: total.as_secs_f64(),
        ..WallTime::default()
    };
    for (_, times) in &outcome.work {
        wall.add(times);
    }
    wall
}
