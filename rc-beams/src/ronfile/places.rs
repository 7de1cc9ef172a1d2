//! Where a field stands in the text of a file.

use std::ops::Range;

/// Byte ranges of all values of a RON text, by path: `supports[1].plate.length_mm`.
///
/// The text is one that the parser accepted; of anything else the places may be incomplete.
#[derive(Debug)]
pub(super) struct Places(Vec<(String, Range<usize>)>);

impl Places {
    /// Scans a text.
    pub(super) fn of(text: &str) -> Self {
        let mut scanner = Scanner {
            text,
            at: 0,
            places: Vec::new(),
        };
        scanner.value("");
        Self(scanner.places)
    }

    /// Range of the value at `path`, or of the longest leading part of it that stands in the text.
    pub(super) fn find(&self, path: &str) -> Range<usize> {
        let leads = |(known, _): &&(String, Range<usize>)| {
            path.strip_prefix(known.as_str()).is_some_and(|rest| {
                rest.is_empty() || known.is_empty() || rest.starts_with(['.', '['])
            })
        };
        let best = self
            .0
            .iter()
            .filter(leads)
            .max_by_key(|(known, _)| known.len());
        best.map_or(0..0, |(_, range)| range.clone())
    }
}

/// A cursor over the text.
struct Scanner<'a> {
    text: &'a str,
    at: usize,
    places: Vec<(String, Range<usize>)>,
}

impl<'a> Scanner<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Advances over the longest lead of characters that `wanted` accepts.
    fn take_while(&mut self, wanted: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let length = rest.find(|c| !wanted(c)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// Advances behind `end`, or to the end of the text.
    fn skip_past(&mut self, end: &str) {
        self.at = self
            .rest()
            .find(end)
            .map_or(self.text.len(), |i| self.at + i + end.len());
    }

    fn skip(&mut self, token: char) -> bool {
        let found = self.rest().starts_with(token);
        if found {
            self.at += token.len_utf8();
        }
        found
    }

    /// Skips white space, comments and attributes.
    fn skip_blank(&mut self) {
        loop {
            self.take_while(char::is_whitespace);
            match self.rest().as_bytes() {
                [b'/', b'/', ..] => self.skip_past("\n"),
                [b'/', b'*', ..] => self.skip_past("*/"),
                [b'#', b'!', ..] => self.skip_past("]"),
                _ => return,
            }
        }
    }

    /// Records one value and those inside it.
    fn value(&mut self, path: &str) {
        self.skip_blank();
        let start = self.at;
        if self.skip('[') {
            self.list(path);
        } else if self.skip('{') {
            self.entries(path, '}');
        } else if self.rest().starts_with('"') {
            self.string();
        } else {
            let word = self.take_while(|c| !c.is_whitespace() && !",:()[]{}\"".contains(c));
            let end = self.at;
            self.skip_blank();
            match word.strip_prefix('r') {
                Some(hashes) if self.skip('"') => self.skip_past(&format!("\"{hashes}")),
                _ if self.skip('(') => self.entries(path, ')'),
                _ => self.at = end,
            }
        }
        self.places.push((path.into(), start..self.at));
    }

    fn list(&mut self, path: &str) {
        for index in 0.. {
            self.skip_blank();
            if self.skip(']') || self.rest().is_empty() {
                return;
            }
            let before = self.at;
            self.value(&format!("{path}[{index}]"));
            self.skip_blank();
            if !self.skip(',') && self.at == before {
                return;
            }
        }
    }

    /// Fields of a structure or entries of a map.
    fn entries(&mut self, path: &str, close: char) {
        loop {
            self.skip_blank();
            if self.skip(close) || self.rest().is_empty() {
                return;
            }
            let name = self.name();
            self.skip_blank();
            if !self.skip(':') {
                return;
            }
            self.value(&if path.is_empty() {
                name.into()
            } else {
                format!("{path}.{name}")
            });
            self.skip_blank();
            self.skip(',');
        }
    }

    /// Name of a field or key of a map.
    fn name(&mut self) -> &'a str {
        let start = self.at;
        if self.rest().starts_with('"') {
            self.string();
        } else {
            self.take_while(|c| c.is_alphanumeric() || c == '_');
        }
        self.text[start..self.at].trim_matches('"')
    }

    /// Skips a string from its opening to its closing quote.
    fn string(&mut self) {
        let mut escaped = true;
        let closes = |c| {
            let closes = c == '"' && !escaped;
            escaped = c == '\\' && !escaped;
            closes
        };
        self.at = self
            .rest()
            .find(closes)
            .map_or(self.text.len(), |i| self.at + i + 1);
    }
}

#[cfg(test)]
mod tests {
    //! Protects the places in messages about fields that disagree with one another.
    use super::*;

    const TEXT: &str = r##"#![enable(implicit_some)]
// a comment with (brackets: 1)
Beam(
    title: "a \" (quote: 2)", /* b: 3 */
    raw: r#"x " y"#,
    bars: [(y_mm: 51.5), Bar(y_mm: -1e3)],
    load: InnerShear(end_support: 1), none: None,
    strain: {"eps_xx": 0.1, "eps_yy": -2},
)"##;

    #[test]
    fn values_are_found_by_path() {
        let places = Places::of(TEXT);
        for (path, value) in [
            ("title", r#""a \" (quote: 2)""#),
            ("raw", r##"r#"x " y"#"##),
            ("bars[0]", "(y_mm: 51.5)"),
            ("bars[0].y_mm", "51.5"),
            ("bars[1].y_mm", "-1e3"),
            ("load", "InnerShear(end_support: 1)"),
            ("load.end_support", "1"),
            ("none", "None"),
            ("strain.eps_yy", "-2"),
            ("bars[1].missing", "Bar(y_mm: -1e3)"),
        ] {
            assert_eq!(&TEXT[places.find(path)], value, "{path}");
        }
    }
}
