//! Documents with tables that programs write.

use std::fs;
use std::path::Path;

use crate::cube::Failure;

/// Puts every table, of a name, into its place in a document: between the lines `<!-- name -->` and `<!-- end -->`.
///
/// # Errors
///
/// A document that cannot be read or written, or lacks a place.
pub fn fill<'a>(
    document: impl AsRef<Path>,
    tables: impl IntoIterator<Item = (&'a str, String)>,
) -> Result<(), Failure> {
    let path = document.as_ref();
    let mut text = fs::read_to_string(path)?;
    for (name, table) in tables {
        text = insert(&text, name, &table)
            .ok_or_else(|| format!("{} has no place for {name}", path.display()))?;
    }
    Ok(fs::write(path, text)?)
}

/// The document with a table in its place. None if it lacks one.
fn insert(document: &str, name: &str, table: &str) -> Option<String> {
    let begin = format!("<!-- {name} -->\n");
    let start = document.find(&begin)? + begin.len();
    let end = start + document[start..].find("<!-- end -->")?;
    Some(format!(
        "{}\n{table}\n{}",
        &document[..start],
        &document[end..]
    ))
}

#[cfg(test)]
mod tests {
    //! Protects the text around tables.
    use super::*;

    #[test]
    fn a_table_replaces_the_one_before() {
        let document = "a\n<!-- x -->\nold\n<!-- end -->\nb\n<!-- y -->\n<!-- end -->\n";
        let once = insert(document, "x", "new\n").unwrap();
        assert_eq!(once, insert(&once, "x", "new\n").unwrap());
        assert!(
            once.contains("<!-- x -->\n\nnew\n\n<!-- end -->\nb\n"),
            "{once}"
        );
        assert!(insert(document, "z", "").is_none());
    }
}
