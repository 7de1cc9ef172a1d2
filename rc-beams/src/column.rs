//! Names as columns of tables.

/// A name as part of a column: its words in small letters, joined by underscores.
pub(crate) fn slug(name: &str) -> String {
    let plain = name.to_lowercase();
    let words = plain.split(|c: char| !c.is_alphanumeric());
    let words: Vec<&str> = words.filter(|w| !w.is_empty()).collect();
    words.join("_")
}
