//! Reads a specimen from the text of its file.

use ron::extensions::Extensions;

use super::specimen::Specimen;

/// Reads a specimen.
///
/// # Errors
///
/// The first thing wrong in the text, with its place.
pub fn read(_name: &str, text: &str) -> Result<Specimen, ron::error::SpannedError> {
    ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .from_str(text)
}
