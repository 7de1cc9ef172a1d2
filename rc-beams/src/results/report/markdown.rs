//! `report.md`.

use std::fmt::Write as _;

use super::figures::Group;
use super::stored::{Stored, StoredSheets};
use super::{Report, counted};
use crate::results::events::EventKind;
use crate::results::sheets::{Shown, is_lost};

/// The text of the report.
pub(super) fn report(beams: &[Stored], groups: &[Group], report: &Report) -> String {
    let mut text = format!("# Results of {}\n\n", counted(beams.len()));
    text += &peaks(beams);
    let accuracy = report.accuracy.as_ref();
    let accuracy = accuracy.map_or_else(
        || "No beam has both a peak and a test.".to_owned(),
        |a| format!("{a}."),
    );
    let _ = writeln!(text, "\n{}\n", capital(&accuracy));
    text += &without_failure(beams);
    text += &settings(beams);
    if !report.problems.is_empty() {
        text += "\n## Problems\n\n";
        for problem in &report.problems {
            let _ = writeln!(text, "- {problem}");
        }
    }
    if !groups.is_empty() {
        text += "\n## Curves\n";
        for Group { name, file } in groups {
            let _ = write!(text, "\n![load over deflection, {name}]({file})\n");
        }
    }
    text += &events(beams);
    text += &sheets(beams);
    text += "\n## Evidence\n\n";
    for beam in beams {
        let s = &beam.summary;
        let _ = writeln!(
            text,
            "- {}: {}. Mode: {}. Trust: {}. End: {}.",
            beam.name, s.mode, s.mode_evidence, s.trust_reason, s.stop_reason
        );
    }
    text
}

fn peaks(beams: &[Stored]) -> String {
    let header = [
        "beam",
        "load kN",
        "deflection mm",
        "mode",
        "trust",
        "test kN",
        "load/test",
        "time s",
        "steps",
    ];
    let rows = beams.iter().map(|beam| {
        let s = &beam.summary;
        vec![
            beam.name.clone(),
            format!(
                "{}{:.1}",
                if s.failed() { "" } else { "> " },
                s.peak_load_kn
            ),
            format!("{:.2}", s.deflection_at_peak_mm),
            s.mode.clone(),
            s.trust.clone(),
            optional(s.test_load_kn, 1),
            optional(s.ratio(), 2),
            format!("{:.1}", s.wall_s.total),
            s.steps.to_string(),
        ]
    });
    table(&header, rows)
}

/// Beams whose load is a lower bound of the peak.
fn without_failure(beams: &[Stored]) -> String {
    let open = beams.iter().filter(|b| !b.summary.failed());
    let open: Vec<String> = open
        .map(|b| format!("{} ({})", b.name, b.summary.stop_reason))
        .collect();
    if open.is_empty() {
        return String::new();
    }
    format!(
        "No failure was reached, so the load is no peak and not compared with a test: {}.\n\n",
        open.join(", ")
    )
}

/// Options that are told as what they come to, or that change no answer.
const TOLD: [&str; 8] = [
    "preset",
    "law",
    "driver",
    "integration",
    "mesh",
    "fields",
    "band",
    "counterfactual",
];

/// Beams by the settings they were run with.
fn settings(beams: &[Stored]) -> String {
    let mut by_settings: Vec<(String, Vec<&str>)> = Vec::new();
    for beam in beams {
        let s = &beam.summary;
        let mut of = format!(
            "preset {}, law {}, driver {}, {} integration, mesh {}",
            s.preset, s.law, s.driver, s.integration, s.mesh
        );
        for (name, value) in s
            .options
            .iter()
            .filter(|(name, _)| !TOLD.contains(&name.as_str()))
        {
            let value = value
                .as_str()
                .map_or_else(|| value.to_string(), str::to_owned);
            let _ = write!(of, ", {} {value}", name.replace('_', " "));
        }
        match by_settings.iter_mut().find(|(known, _)| *known == of) {
            Some((_, names)) => names.push(&beam.name),
            None => by_settings.push((of, vec![&beam.name])),
        }
    }
    let mut text = String::new();
    for (of, names) in &by_settings {
        let which = if by_settings.len() == 1 {
            "all beams".to_owned()
        } else {
            names.join(", ")
        };
        let _ = writeln!(text, "- {}: {which}", capital(of));
    }
    text
}

/// Load and deflection of every event, one row per beam.
fn events(beams: &[Stored]) -> String {
    let with: Vec<&Stored> = beams.iter().filter(|b| !b.events.is_empty()).collect();
    let seen = |kind: &EventKind| {
        with.iter()
            .any(|b| b.events.iter().any(|e| e.kind == *kind))
    };
    let kinds: Vec<EventKind> = EventKind::ALL.into_iter().filter(seen).collect();
    if kinds.is_empty() {
        return String::new();
    }
    let header: Vec<&str> = std::iter::once("beam")
        .chain(kinds.iter().map(|k| k.words()))
        .collect();
    let rows = with.iter().map(|beam| {
        let mut cells = vec![beam.name.clone()];
        cells.extend(kinds.iter().map(|kind| {
            let event = beam.events.iter().find(|e| e.kind == *kind);
            event.map_or_else(
                || "-".to_owned(),
                |e| format!("{:.1} kN, {:.2} mm", e.load_kn, e.deflection_mm),
            )
        }));
        cells
    });
    format!(
        "\n## Events\n\nLoad and deflection when it happens first.\n\n{}",
        table(&header, rows)
    )
}

/// Sheets at the peak and at the end, and their pictures.
fn sheets(beams: &[Stored]) -> String {
    let with: Vec<(&Stored, [StoredSheets; 2])> =
        beams.iter().filter_map(|b| Some((b, b.sheets?))).collect();
    let mut text = String::new();
    if !with.is_empty() {
        let header = [
            "beam",
            "largest fibre stress at the peak MPa",
            "largest sheet force at the peak kN",
            "at the end kN",
            "side debonded at the peak",
            "at the end",
        ];
        let rows = with.iter().map(|(beam, [peak, end])| {
            vec![
                beam.name.clone(),
                format!("{:.0}", peak.stress_mpa),
                format!("{:.1}", peak.force_kn),
                if is_lost(end.load_kn, peak.load_kn) {
                    "lost with the load".to_owned()
                } else {
                    format!("{:.1}", end.force_kn)
                },
                format!("{:.0} %", 100.0 * peak.debonded),
                format!("{:.0} %", 100.0 * end.debonded),
            ]
        });
        text += "\n## Sheets of the test span\n\n";
        text += &table(&header, rows);
    }
    for beam in beams {
        let shown = [Shown::Slip, Shown::FibreStress].into_iter();
        for shown in shown.filter(|shown| shown.is_in(&beam.map)) {
            let (name, file) = (&beam.name, shown.file());
            let _ = write!(text, "\n![{file} at the peak, {name}]({name}/{file}.svg)\n");
        }
    }
    text
}

/// A table, its cells without what would end them.
fn table(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut text = format!(
        "| {} |\n|{}\n",
        header.join(" | "),
        "---|".repeat(header.len())
    );
    for row in rows {
        let cells: Vec<String> = row.iter().map(|c| c.replace('|', "\\|")).collect();
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    text
}

fn optional(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |v| format!("{v:.digits$}"))
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}
