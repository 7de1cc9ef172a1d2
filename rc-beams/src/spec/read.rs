//! Reads a specimen from the text of its file.

use super::check::check;
use super::specimen::Specimen;
use crate::ronfile::{RonError, RonFile};

/// Reads and checks a specimen; `name` stands for the file in messages.
///
/// # Errors
///
/// The first thing that cannot be read, else everything that [`check`] finds.
pub fn read(name: &str, text: &str) -> Result<Specimen, Vec<RonError>> {
    let file = RonFile::new(name, text);
    let specimen = file.parse().map_err(|error| vec![error])?;
    let findings = check(&specimen);
    if findings.is_empty() {
        return Ok(specimen);
    }
    let shown = findings.into_iter().map(|found| {
        let message = format!("{}: {}", found.path, found.message);
        file.error(&found.path, message, Some(found.remedy))
    });
    Err(shown.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::BUILTIN;

    /// Protects the reader from panics: every character of a file removed or replaced in turn.
    #[test]
    fn no_slip_of_the_keyboard_panics() {
        let (_, text) = BUILTIN[0];
        let mut refused = 0;
        for (at, c) in text.char_indices() {
            let (before, after) = (&text[..at], &text[at + c.len_utf8()..]);
            for slip in ["", ",", "é"] {
                refused += usize::from(read("slip", &format!("{before}{slip}{after}")).is_err());
            }
        }
        assert!(
            refused > text.len(),
            "{refused} of {} slips refused",
            3 * text.chars().count()
        );
    }

    /// Protects what a run writes of its specimen: it is read back as the same specimen.
    #[test]
    fn a_specimen_survives_writing_and_reading() {
        let slip = include_str!("../../specimens/examples/A-SO3-1-slip.ron");
        for (name, text) in BUILTIN.iter().chain(&[("slip", slip)]) {
            let specimen = read(name, text).unwrap();
            let written = ron::ser::to_string_pretty(&specimen, ron::ser::PrettyConfig::default());
            assert_eq!(read(name, &written.unwrap()).unwrap(), specimen);
        }
    }
}
