//! Writes `docs/stability.md` and its chart: which method survives what.
//!
//! `cargo run --release -p fe-tests --bin stability`

use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use fe_tests::stability::{Case, Figure, Method, Outcome, SCENARIOS, Target, chart};

const COMMAND: &str = "cargo run --release -p fe-tests --bin stability";
/// Lengths of the steps over those of the scene.
const COARSE: [f64; 3] = [0.5, 1.0, 2.0];

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

fn main() -> Result<(), Box<dyn Error>> {
    let mut rows = Vec::new();
    let mut table = String::new();
    for scenario in &SCENARIOS {
        for coarse in COARSE {
            let name = format!("{}: {}, steps x {coarse}", scenario.id, scenario.title);
            writeln!(table, "\n### {name}\n")?;
            writeln!(
                table,
                "| method | outcome | figures (targets) | steps | iterations | factorisations | evaluations | said |"
            )?;
            writeln!(table, "|---|---|---|---|---|---|---|---|")?;
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
                    table,
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
            rows.push((name, outcomes));
        }
    }
    let count = |wanted: Outcome, column: usize| {
        rows.iter()
            .filter(|(_, o)| o.get(column) == Some(&wanted))
            .count()
    };
    let mut text = format!(
        "# Which method survives what\n\nWritten at commit {} by\n\n```console\n$ {COMMAND}\n```\n\n\
         Every scene has a known path; every method is given it at three lengths of its steps. A case is *correct* if it arrives and \
         all figures are within tolerance, *stopped* if the method gives up with an error, *wrong, says so* if a figure is off and the \
         run marked steps as jumps or as missing the criterion, *wrong and silent* otherwise. Counts are deterministic. A path that \
         stops early shows the figures up to there.\n\n\
         Only the scenes of path following are here; other scenarios of the catalogue are single tests, listed in \
         [tests/README.md](../tests/README.md).\n\n![matrix](stability.svg)\n\n\
         | method | correct | stopped, says so | wrong, says so | wrong and silent |\n|---|---|---|---|---|\n",
        commit()
    );
    for (i, method) in Method::ALL.iter().enumerate() {
        writeln!(
            text,
            "| {} | {} | {} | {} | {} |",
            method.label(),
            count(Outcome::Correct, i),
            count(Outcome::Stopped, i),
            count(Outcome::Reported, i),
            count(Outcome::Silent, i)
        )?;
    }
    text.push_str(&table);
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    std::fs::write(docs.join("stability.md"), text)?;
    std::fs::write(
        docs.join("stability.svg"),
        chart(&rows, &format!("{COMMAND}, commit {}", commit()))?,
    )?;
    Ok(())
}
