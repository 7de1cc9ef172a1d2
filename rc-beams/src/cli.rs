//! The command line: results go to standard output, messages to standard error.

use std::fmt::Display;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::{Parser, Subcommand};
use miette::{MietteHandlerOpts, Report, miette};

use crate::exit::Exit;
use crate::input::{InputError, each, load, load_all};
use crate::options::RunOptions;
use crate::{list, output, point, results, run};

/// Reinforced-concrete beams of Khalifa (1999), simulated from first crack to failure.
///
/// Units: N, mm, MPa. Exit codes: 0 done, 1 a run stopped early, 2 usage, 3 bad input, 4 file or
/// output, 130 interrupted.
#[derive(Debug, Parser)]
#[command(version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// List the beams that come with the program
    List {
        /// Write JSON
        #[arg(long)]
        json: bool,
    },
    /// Check specimen files; nothing is run
    Check {
        /// Specimen files, beams of the program, or `all` of these
        #[arg(required = true, value_name = "FILE")]
        files: Vec<String>,
    },
    /// Run beams and write curves, pictures and fields
    Run {
        /// Beams of the program, specimen files (.ron), or `all` beams of the program
        #[arg(required = true, value_name = "BEAM")]
        beams: Vec<String>,
        #[command(flatten)]
        options: Box<RunOptions>,
    },
    /// Report on the stored results of all beams of a folder: tables, curves, accuracy; nothing is run
    Report {
        /// Folder of the results; the report goes there, too
        #[arg(value_name = "DIR", default_value = "results")]
        folder: PathBuf,
    },
    /// Drive a material point and write strains, stresses and internal variables as CSV
    Point {
        /// Case file: a law and a program of strains and stresses
        #[arg(value_name = "CASE")]
        case: PathBuf,
        /// File to write, made anew; without it, standard output
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
}

/// Runs the program with the arguments of the process.
pub fn main() -> Exit {
    let hook = miette::set_hook(Box::new(|_| {
        Box::new(
            MietteHandlerOpts::new()
                .force_graphical(true)
                .wrap_lines(false)
                .build(),
        )
    }));
    // Fails only when a handler is already in place, which serves as well.
    drop(hook);
    let done = match Cli::parse().command {
        Command::List { json } => list_beams(json),
        Command::Check { files } => check(&files),
        Command::Run { beams, options } => run_beams(&beams, &options),
        Command::Report { folder } => report(&folder),
        Command::Point { case, output } => drive_point(&case, output.as_deref()),
    };
    done.unwrap_or_else(|Shown(exit)| exit)
}

/// An error that has been shown, and how the program ends because of it.
struct Shown(Exit);

fn list_beams(json: bool) -> Result<Exit, Shown> {
    let specimens = load_all(&["all".into()]).map_err(show_all)?;
    let rows: Vec<list::Row> = specimens.iter().map(list::Row::from).collect();
    let text = if json {
        let text = serde_json::to_string_pretty(&rows);
        text.map_err(|error| show(Exit::File, miette!("{error}")))? + "\n"
    } else {
        list::table(&rows)
    };
    print(text)
}

fn check(files: &[String]) -> Result<Exit, Shown> {
    let (mut count, mut bad) = (0, 0);
    let mut gravest = Exit::Done;
    for file in each(files) {
        count += 1;
        let checked = load(file).map_err(show_all).and_then(|specimen| {
            run::buildable(&specimen).map_err(|error| show(error.exit(), error))?;
            Ok(specimen)
        });
        match checked {
            Ok(specimen) => {
                print(format!("{file}: ok, beam {}\n", specimen.name))?;
            }
            Err(Shown(exit)) => {
                bad += 1;
                gravest = gravest.max(exit);
            }
        }
    }
    tell(format_args!("{count} checked, {bad} bad"));
    Ok(gravest)
}

fn run_beams(beams: &[String], options: &RunOptions) -> Result<Exit, Shown> {
    let specimens = load_all(beams).map_err(|errors| {
        let shown = show_all(errors);
        tell("nothing was run");
        shown
    })?;
    for warning in run::warnings(&specimens, options) {
        tell(format_args!("warning: {warning}"));
    }
    run::run_all(&specimens, options).map_err(|error| {
        let shown = show(error.exit(), error);
        tell("nothing was run");
        shown
    })
}

/// What is wrong with stored results goes to standard error, and the code tells of it.
fn report(folder: &Path) -> Result<Exit, Shown> {
    let report = results::report::write(folder).map_err(|error| show(Exit::File, error))?;
    for problem in &report.problems {
        tell(format_args!("warning: {problem}"));
    }
    print(report.line() + "\n")?;
    Ok(if report.problems.is_empty() {
        Exit::Done
    } else {
        Exit::File
    })
}

fn drive_point(case: &Path, output: Option<&Path>) -> Result<Exit, Shown> {
    let same = |path: &Path| Some(path.canonicalize().ok()? == case.canonicalize().ok()?);
    if let Some(path) = output.filter(|path| same(path) == Some(true)) {
        let path = path.display();
        let text =
            format!("--output {path} is the case itself and would replace it: give another file");
        return Err(show(Exit::Usage, miette!("{text}")));
    }
    let run = point::run(case).map_err(|error| show(error.exit(), error))?;
    let mut table = Vec::new();
    let written = run.history.write_csv(&mut table);
    written.map_err(|error| show(Exit::File, miette!("{error}")))?;
    match output {
        None => print(&table)?,
        Some(path) => {
            output::write(path, &table).map_err(|error| show(Exit::File, error))?;
            Exit::Done
        }
    };
    let stopped = |error| show(Exit::StoppedEarly, miette!("{error}"));
    run.result.map_err(stopped).map(|()| Exit::Done)
}

/// Writes to standard output; a reader that has gone away is no error.
fn print(text: impl AsRef<[u8]>) -> Result<Exit, Shown> {
    match io::stdout().lock().write_all(text.as_ref()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(show(
            Exit::File,
            miette!("cannot write to standard output: {error}"),
        )),
        _ => Ok(Exit::Done),
    }
}

/// A line to standard error; where that is closed, the exit code has to do.
fn tell(line: impl Display) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// Shows all errors; the program ends as the gravest asks for.
fn show_all(errors: Vec<InputError>) -> Shown {
    let exits = errors.into_iter().map(|error| show(error.exit(), error).0);
    Shown(exits.max().unwrap_or(Exit::BadInput))
}

fn show(exit: Exit, error: impl Into<Report>) -> Shown {
    tell(format_args!("{:?}", error.into()));
    Shown(exit)
}
