//! Writes `docs/stability.md` and its chart: which method survives what.
//!
//! `cargo run --release -p fe-tests --bin stability`

use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use fe_tests::stability::{Case, Figure, Method, Outcome, SCENARIOS, Scenario, Target, chart};

const COMMAND: &str = "cargo run --release -p fe-tests --bin stability";
/// Lengths of the steps over those of the scene.
const COARSE: [f64; 3] = [0.5, 1.0, 2.0];

/// Name of a scene, with the outcome by every method.
type Row = (String, Vec<Outcome>);

/// Short name of the commit that is checked out.
fn commit() -> String {
    let output = Command::new("git")
        .args(["rev-parse", "--short", "HEAD"])
        .output();
    let name = output.ok().filter(|o| o.status.success());
    name.map_or_else(
        || "unknown".into(),
        |o| String::from_utf8_lossy(&o.stdout).trim().to_owned(),
    )
}

fn figure(figure: &Figure) -> String {
    let target = match figure.target {
        Target::Near(value, relative) => {
            format!("{} +- {} %", (1e6 * value).round() / 1e6, 100.0 * relative)
        }
        Target::AtMost(bound) => format!("at most {bound}"),
        Target::AtLeast(bound) => format!("at least {bound}"),
    };
    format!("{} {:.5} ({target})", figure.name, figure.found)
}

/// A row of outcomes and a table of figures of one scene.
fn section(scenario: &Scenario, coarse: f64, text: &mut String) -> Result<Row, Box<dyn Error>> {
    let name = format!("{}: {}, steps x {coarse}", scenario.id, scenario.title);
    writeln!(text, "\n### {name}\n")?;
    writeln!(
        text,
        "| method | outcome | figures (targets) | steps | iterations | factorisations | evaluations | said |"
    )?;
    writeln!(text, "|---|---|---|---|---|---|---|---|")?;
    let mut outcomes = Vec::new();
    for method in Method::ALL {
        let case = Case::run(scenario, method, coarse)?;
        let outcome = case.outcome();
        outcomes.push(outcome);
        let figures: Vec<String> = case.figures.iter().map(figure).collect();
        let said = case.stopped.clone().unwrap_or_else(|| match case.marked {
            0 => String::new(),
            n => format!("{n} steps jump or miss the criterion"),
        });
        let c = case.counters;
        writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {said} |",
            method.label(),
            outcome.label(),
            figures.join("; "),
            c.steps,
            c.iterations,
            c.factorisations,
            c.force_evaluations,
        )?;
    }
    Ok((name, outcomes))
}

/// How often each method ends how.
fn tally(rows: &[Row], text: &mut String) -> std::fmt::Result {
    let labels = Outcome::ALL.map(Outcome::label).join(" | ");
    writeln!(text, "| method | {labels} |\n|---|---|---|---|---|")?;
    for (column, method) in Method::ALL.iter().enumerate() {
        write!(text, "| {} |", method.label())?;
        for wanted in Outcome::ALL {
            let ends = rows.iter().filter(|(_, o)| o[column] == wanted);
            write!(text, " {} |", ends.count())?;
        }
        writeln!(text)?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut rows = Vec::new();
    let mut sections = String::new();
    for scenario in &SCENARIOS {
        for coarse in COARSE {
            rows.push(section(scenario, coarse, &mut sections)?);
        }
    }
    let commit = commit();
    let mut text = format!(
        "# Which method survives what\n\nWritten at commit {commit} by\n\n```console\n$ {COMMAND}\n```\n\n\
         Every scene has a known path; every method is given it at three lengths of its steps. A case is *correct* if it arrives and \
         all figures are within tolerance, *stopped* if the method gives up with an error, *wrong, says so* if a figure is off and the \
         run marked steps as jumps or as missing the criterion, *wrong and silent* otherwise. Counts are deterministic. A path that \
         stops early shows the figures up to there.\n\n\
         Only the scenes of path following are here; other scenarios of the catalogue are single tests, listed in \
         [tests/README.md](../tests/README.md).\n\n![matrix](stability.svg)\n\n",
    );
    tally(&rows, &mut text)?;
    text.push_str(&sections);
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    std::fs::write(docs.join("stability.md"), text)?;
    let caption = format!("{COMMAND}, commit {commit}");
    std::fs::write(docs.join("stability.svg"), chart(&rows, &caption)?)?;
    Ok(())
}
