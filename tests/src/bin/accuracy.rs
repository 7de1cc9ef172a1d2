//! Runs the beams as `docs/accuracy.md` shows them and writes its tables and chart: some two hours on two idle cores. What
//! the folder holds is not run again: after a change of the program, take another one.
//!
//! Usage: `accuracy RC-BEAMS [FOLDER [tables]]`, the program to run and where its results go; with `tables` nothing is run, what
//! is missing stays blank, and tables of which all is missing stay as they are.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

use fe_tests::accuracy::cases::{
    COARSE, Case, DEFAULT, FINE, MOTION, NUMERICS, PARAMETERS, SOURCE, TWICE,
};
use fe_tests::accuracy::outcome::Outcome;
use fe_tests::accuracy::scaled::scaled;
use fe_tests::accuracy::tables::{Outcomes, beams, changes, coverage, sensitivities, statistics};
use fe_tests::accuracy::{cost, scatter, source};
use fe_tests::document::fill;
use fe_tests::provenance::commit;

const DOCUMENT: &str = "docs/accuracy.md";
const CHART: &str = "docs/accuracy.svg";

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1).map(PathBuf::from);
    let program = arguments
        .next()
        .ok_or("usage: accuracy RC-BEAMS [FOLDER]")?;
    let folder = arguments
        .next()
        .unwrap_or_else(|| Path::new("results").join("accuracy"));
    let runs: Vec<(&Case, &'static str)> = [&DEFAULT, &TWICE, &MOTION, &SOURCE]
        .into_iter()
        .chain(&NUMERICS)
        .chain(&COARSE)
        .chain(&FINE)
        .chain(&PARAMETERS)
        .flat_map(|case| case.beams.iter().map(move |beam| (case, *beam)))
        .collect();
    if arguments.next().is_none() {
        run_all(&program, &folder, &runs)?;
    }
    let mut outcomes = Outcomes::new();
    for (case, beam) in runs {
        if let Some(outcome) = Outcome::read(&folder.join(case.name).join(beam))? {
            outcomes.insert((case.name, beam), outcome);
        }
    }
    let written = format!("Written at commit {} by `tests/accuracy.sh`.\n", commit());
    let any = |cases: &[Case]| {
        let mut names = outcomes.keys().map(|(name, _)| name);
        names.any(|name| cases.iter().any(|case| case.name == *name))
    };
    let mut tables = vec![
        ("source", written),
        ("beams", beams(&outcomes)),
        ("statistics", statistics(&outcomes)),
    ];
    if any(&[TWICE]) {
        tables.push(("coverage", coverage(&outcomes)));
    }
    if any(&NUMERICS) {
        tables.push(("numerics", changes(&outcomes, &NUMERICS)));
        tables.push(("cost", cost::table(&outcomes)));
        fs::write(CHART, cost::chart(&outcomes)?)?;
    }
    if any(&[SOURCE]) {
        tables.push(("source-law", source::table(&outcomes)));
    }
    if any(&FINE) {
        tables.push(("scatter", scatter::table(&outcomes)));
    }
    if any(&PARAMETERS) {
        tables.push(("parameters", sensitivities(&outcomes, &PARAMETERS)));
    }
    fill(DOCUMENT, tables)
}

/// Runs all, as many at once as there are cores, the first of them first.
fn run_all(
    program: &Path,
    folder: &Path,
    runs: &[(&Case, &'static str)],
) -> Result<(), Box<dyn Error>> {
    let next = AtomicUsize::new(0);
    let work = || {
        while let Some((case, beam)) = runs.get(next.fetch_add(1, Ordering::Relaxed)) {
            run(program, folder, case, beam)?;
        }
        Ok::<_, String>(())
    };
    let workers = std::thread::available_parallelism()?.get();
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        let results = workers.into_iter().map(std::thread::ScopedJoinHandle::join);
        results
            .map(|result| result.unwrap_or_else(|_| Err("a worker stopped".into())))
            .collect::<Result<Vec<()>, String>>()
    })?;
    Ok(())
}

/// Runs one beam, unless its results are there.
fn run(program: &Path, folder: &Path, case: &Case, beam: &str) -> Result<(), String> {
    let results = folder.join(case.name);
    if results.join(beam).join("summary.json").exists() {
        return Ok(());
    }
    eprintln!("{beam} {}", case.name);
    let specimen = specimen(&results, case, beam)?;
    let mut command = Command::new(program);
    command.args(["run", &specimen, "--threads", "1", "--resume"]);
    command
        .args(case.options_of(beam))
        .arg("--output")
        .arg(results);
    // A run that stops early has said so in its summary.
    let status = command.stdout(Stdio::null()).stderr(Stdio::null()).status();
    status
        .map(|_| ())
        .map_err(|e| format!("{}: {e}", program.display()))
}

/// What is run: a beam by its name, or a file of it with another concrete, written beside its results.
fn specimen(results: &Path, case: &Case, beam: &str) -> Result<String, String> {
    let Some((property, factor)) = case.scaled else {
        return Ok(beam.into());
    };
    let known = Path::new("rc-beams/specimens").join(format!("{beam}.ron"));
    let text = fs::read_to_string(&known).map_err(|e| format!("{}: {e}", known.display()))?;
    let text = scaled(&text, property, factor)
        .ok_or_else(|| format!("{}: no {property} of the concrete", known.display()))?;
    let file = results.join(format!("{beam}.ron"));
    fs::create_dir_all(results)
        .and_then(|()| fs::write(&file, text))
        .map_err(|e| format!("{}: {e}", file.display()))?;
    Ok(file.to_string_lossy().into_owned())
}
