//! What tests say of themselves.

/// The tests of a source file.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Page {
    /// What the file says of them together.
    pub header: String,
    /// Name and what it protects.
    pub tests: Vec<(String, String)>,
}

/// Reads a source file: the header is the inner comment nearest before its tests.
pub fn read(source: &str) -> Page {
    let mut page = Page::default();
    let (mut inner, mut outer) = (Vec::new(), Vec::new());
    let mut fresh = true;
    let mut is_test = false;
    for line in source.lines().map(str::trim) {
        if let Some(text) = line.strip_prefix("//!") {
            if fresh {
                inner.clear();
            }
            fresh = false;
            inner.push(text.trim());
            continue;
        }
        fresh = true;
        if let Some(text) = line.strip_prefix("///") {
            outer.push(text.trim());
        } else if line == "#[test]" {
            is_test = true;
        } else if let (true, Some(rest)) = (is_test, line.strip_prefix("fn ")) {
            let name = rest.split('(').next().unwrap_or_default();
            if page.tests.is_empty() {
                page.header = inner.join(" ").trim().replace("  ", "\n\n");
            }
            page.tests.push((name.to_owned(), outer.join(" ")));
            (is_test, outer) = (false, Vec::new());
        } else if !line.starts_with("#[") {
            outer.clear();
        }
    }
    page
}

#[cfg(test)]
mod tests {
    //! Protects the verification manual.
    use super::*;

    #[test]
    fn tests_are_found_with_their_words() {
        let source = "//! Of a module.\n\nfn a() {}\n\nmod tests {\n    //! Protects\n    //! all.\n\n    /// Target: 1.\n    \
                      #[test]\n    fn one_is_one() {\n    }\n\n    /// No test.\n    fn other() {}\n    #[test]\n    fn bare() {}\n}\n";
        let page = read(source);
        assert_eq!(page.header, "Protects all.");
        let expected = [("one_is_one", "Target: 1."), ("bare", "")];
        let expected = expected.map(|(a, b)| (a.to_owned(), b.to_owned()));
        assert_eq!(page.tests, expected);
    }
}
