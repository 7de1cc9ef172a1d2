//! The command line: results go to standard output, messages to standard error.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::{Parser, Subcommand};
use miette::{MietteHandlerOpts, Report};

use crate::exit::Exit;
use crate::input::{InputError, load, load_all};
use crate::options::RunOptions;
use crate::spec::BUILTIN;
use crate::{list, output, point, run};

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
        /// Specimen files, or beams of the program
        #[arg(required = true, value_name = "FILE")]
        files: Vec<String>,
    },
    /// Run beams and write curves, pictures and fields
    Run {
        /// Beams of the program, specimen files (.ron), or `all` beams of the program
        #[arg(required = true, value_name = "BEAM")]
        beams: Vec<String>,
        #[command(flatten)]
        options: RunOptions,
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
    match Cli::parse().command {
        Command::List { json } => list_beams(json),
        Command::Check { files } => check(&files),
        Command::Run { beams, options } => run_beams(&beams, &options),
        Command::Point { case, output } => drive_point(&case, output.as_deref()),
    }
}

fn list_beams(json: bool) -> Exit {
    let all: Vec<String> = BUILTIN.iter().map(|(name, _)| (*name).into()).collect();
    let specimens = match load_all(&all) {
        Ok(specimens) => specimens,
        Err(errors) => return report_all(errors),
    };
    let rows: Vec<list::Row> = specimens.iter().map(list::Row::from).collect();
    if !json {
        return print(list::table(&rows));
    }
    match serde_json::to_string_pretty(&rows) {
        Ok(text) => print(format!("{text}\n")),
        Err(error) => fail(Exit::File, miette::miette!("{error}")),
    }
}

fn check(files: &[String]) -> Exit {
    let mut bad = 0;
    let mut exit = Exit::Done;
    for file in files {
        exit = exit.max(match load(file) {
            Ok(specimen) => print(format!("{file}: ok, beam {}\n", specimen.name)),
            Err(errors) => {
                bad += 1;
                report_all(errors)
            }
        });
    }
    eprintln!("{} checked, {bad} bad", files.len());
    exit
}

fn run_beams(beams: &[String], options: &RunOptions) -> Exit {
    let specimens = match load_all(beams) {
        Ok(specimens) => specimens,
        Err(errors) => {
            let exit = report_all(errors);
            eprintln!("nothing was run");
            return exit;
        }
    };
    if let Err(error) = output::prepare(&options.output) {
        return fail(Exit::File, error);
    }
    match run::run_all(&specimens, options) {
        Ok(exit) => exit,
        Err(error) => fail(error.exit(), error),
    }
}

fn drive_point(case: &Path, output: Option<&Path>) -> Exit {
    let run = match point::run(case) {
        Ok(run) => run,
        Err(error) => return fail(error.exit(), error),
    };
    let mut table = Vec::new();
    let written = match (run.history.write_csv(&mut table), output) {
        (Err(error), _) => fail(Exit::File, miette::miette!("{error}")),
        (Ok(()), None) => print(&table),
        (Ok(()), Some(path)) => match output::write(path, &table) {
            Ok(()) => Exit::Done,
            Err(error) => fail(Exit::File, error),
        },
    };
    let driven = match run.result {
        Ok(()) => Exit::Done,
        Err(error) => fail(Exit::StoppedEarly, miette::miette!("{error}")),
    };
    written.max(driven)
}

/// Writes to standard output; a reader that has gone away is no error.
fn print(text: impl AsRef<[u8]>) -> Exit {
    match io::stdout().lock().write_all(text.as_ref()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => fail(
            Exit::File,
            miette::miette!("cannot write to standard output: {error}"),
        ),
        _ => Exit::Done,
    }
}

/// Shows all errors; ends as the gravest asks for.
fn report_all(errors: Vec<InputError>) -> Exit {
    errors
        .into_iter()
        .map(|error| fail(error.exit(), error))
        .max()
        .unwrap_or(Exit::BadInput)
}

fn fail(exit: Exit, error: impl Into<Report>) -> Exit {
    eprintln!("{:?}", error.into());
    exit
}
