//! Protects the manual: its tables name the flags that exist with their defaults, and the fields of the
//! specimen file with the ranges that the reader enforces.

use clap::Args;
use rc_beams::options::RunOptions;
use rc_beams::spec::read;

const MANUAL: &str = include_str!("../README.md");
const BEAMS: [&str; 5] = [
    include_str!("../specimens/A-SO3-1.ron"),
    include_str!("../specimens/B-CO1.ron"),
    include_str!("../specimens/B-CF4.ron"),
    include_str!("../specimens/examples/A-SO3-4-staged.ron"),
    include_str!("../specimens/examples/A-SO3-1-slip.ron"),
];

/// The cells of the rows of the table that give a field and a range of numbers.
fn rows() -> impl Iterator<Item = (&'static str, f64, f64)> {
    MANUAL.lines().filter_map(|line| {
        let mut cells = line.split('|').map(str::trim).skip(1);
        let field = cells.next()?.strip_prefix('`')?.strip_suffix('`')?;
        let (low, high) = cells.next()?.split_once(" to ")?;
        Some((field, low.parse().ok()?, high.parse().ok()?))
    })
}

/// A beam with another value in the field, if it has the field.
fn with(beam: &str, field: &str, value: f64) -> Option<String> {
    let mut at = 0;
    for name in field.split('.') {
        let name = format!("{}:", name.trim_end_matches("[]"));
        let starts = |i: &usize| beam[..*i].ends_with([' ', '(']);
        at += beam[at..]
            .match_indices(&name)
            .map(|(i, _)| i)
            .find(|i| starts(&(at + i)))?;
        at += name.len();
    }
    let end = at + beam[at..].find([',', ')'])?;
    beam[at..end].trim().parse::<f64>().ok()?;
    Some(format!("{} {value:?}{}", &beam[..at], &beam[end..]))
}

#[test]
fn ranges_are_those_of_the_reader() {
    let mut count = 0;
    for (field, low, high) in rows() {
        for value in [low - 1e-3, high + 1e-3] {
            let text = BEAMS.iter().find_map(|beam| with(beam, field, value));
            let text = text.unwrap_or_else(|| panic!("no beam has the field {field}"));
            let errors: Vec<String> = read("beam", &text)
                .unwrap_err()
                .iter()
                .map(ToString::to_string)
                .collect();
            let range = format!("allowed: {low} to {high}");
            let last = field.rsplit('.').next().unwrap();
            assert!(
                errors.len() == 1 && errors[0].contains(&range) && errors[0].contains(last),
                "{field} = {value}: {errors:?}"
            );
        }
        count += 1;
    }
    assert!(count > 40, "{count} rows");
}

/// Whether a line of a table is that of a flag, and not of one whose name begins alike.
fn is_row(line: &str, long: &str) -> bool {
    let named = |end: char| line.contains(&format!("`--{long}{end}"));
    named('`') || named(' ')
}

/// Defaults that the program chooses when a flag is not given are written without a value in its help.
#[test]
fn flags_and_their_defaults_are_those_of_the_program() {
    let command = RunOptions::augment_args(clap::Command::new("run"));
    for flag in command.get_arguments() {
        let long = flag.get_long().unwrap();
        let row = MANUAL
            .lines()
            .find(|line| line.starts_with("| `-") && is_row(line, long))
            .unwrap_or_else(|| panic!("the manual lacks --{long}"));
        for default in flag.get_default_values() {
            let default = format!("| `{}` |", default.to_str().unwrap());
            assert!(row.contains(&default), "{row}: the default is {default}");
        }
    }
}

#[test]
fn every_field_is_in_the_table() {
    for line in BEAMS.iter().flat_map(|beam| beam.lines()) {
        let name = line.trim().split(':').next().unwrap();
        let is_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        if !name.is_empty() && name.chars().all(is_name) {
            assert!(MANUAL.contains(name), "the manual lacks {name}");
        }
    }
}
