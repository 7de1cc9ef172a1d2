//! What is wrong with a file, and where.

use std::ops::Range;
use std::sync::Arc;

use miette::{Diagnostic, NamedSource, SourceSpan};
use ron::error::{Error, Position, SpannedError};

use super::places::Places;
use crate::suggest::nearest;

/// Longest line (bytes) that is shown; no file written by hand has a longer one.
const LONGEST_LINE: usize = 2000;

/// An error of a file; shows the line it stands in.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[error("{message}")]
#[diagnostic(code(rc_beams::input))]
pub struct RonError {
    message: String,
    label: String,
    #[help]
    help: Option<String>,
    /// None where its lines are too long to be shown.
    #[source_code]
    file: Option<Arc<NamedSource<String>>>,
    #[label("{label}")]
    place: SourceSpan,
}

impl RonError {
    /// From the error of the parser at the field `path`.
    pub(super) fn parse(file: &Arc<NamedSource<String>>, path: &str, error: &SpannedError) -> Self {
        let text = file.inner();
        let place = offset(text, error.span.start)..offset(text, error.span.end);
        let parent = path.trim_end_matches('?');
        let (field, place, words) = if text.trim().is_empty() {
            ("", 0..0, Words::empty())
        } else if error.code == Error::UnclosedBlockComment {
            // The parser has looked for the end of it everywhere.
            let begin = text.rfind("/*").unwrap_or(place.start);
            ("", begin..begin + 2, Words::of(&error.code))
        } else if text[place.start..].trim().is_empty() && expects_more(&error.code) {
            ("", place, Words::of(&Error::Eof))
        } else if let Some((place, words)) = foreign(text, place.start, &error.code)
            .or_else(|| lettered_number(text, &place, &error.code))
        {
            ("", place, words)
        } else {
            mistyped_number(text, place.start)
                .or_else(|| mistyped_number(text, behind_comma(text, place.start)?))
                .unwrap_or_else(|| ("", place, Words::of(&error.code)))
        };
        let field = if parent == path {
            path.into()
        } else {
            format!("{parent}{field}")
        };
        Self::new(file, field.trim_matches('.'), words, place)
    }

    /// From what is wrong with the value at `path`.
    pub(super) fn found(
        file: &Arc<NamedSource<String>>,
        path: &str,
        what: String,
        help: Option<String>,
    ) -> Self {
        let place = Places::of(file.inner()).find(path);
        Self::new(file, "", Words::new(what, "here", help), place)
    }

    fn new(
        file: &Arc<NamedSource<String>>,
        field: &str,
        words: Words,
        place: Range<usize>,
    ) -> Self {
        let Words { what, label, help } = words;
        let message = if field.is_empty() {
            what
        } else {
            format!("{field}: {what}")
        };
        let readable = file.inner().lines().all(|line| line.len() <= LONGEST_LINE);
        let message = if readable {
            message
        } else {
            format!("{}: {message}", address(file, place.start))
        };
        Self {
            message,
            label,
            help,
            file: readable.then(|| Arc::clone(file)),
            place: one_line(file.inner(), place).into(),
        }
    }
}

/// What is wrong, the words under the place, and what to do.
struct Words {
    what: String,
    label: String,
    help: Option<String>,
}

impl Words {
    fn new(what: impl Into<String>, label: impl Into<String>, help: Option<String>) -> Self {
        Self {
            what: what.into(),
            label: label.into(),
            help,
        }
    }

    /// The words for a file without content.
    fn empty() -> Self {
        let help = "start from a copy of one of the samples that come with the program";
        Self::new("the file is empty", "here", Some(help.into()))
    }

    /// The words for an error of the parser.
    fn of(error: &Error) -> Self {
        match error {
            Error::NoSuchStructField {
                expected, found, ..
            } => Self::unknown("no such field", found, expected),
            Error::NoSuchEnumVariant {
                expected, found, ..
            } => Self::unknown("no such choice", found, expected),
            Error::MissingStructField { field, .. } => Self::new(
                format!("the field `{field}` is missing"),
                format!("add `{field}: ...` before this"),
                None,
            ),
            Error::DuplicateStructField { field, .. } => Self::new(
                format!("the field `{field}` stands twice"),
                "again here",
                Some("remove one of the two".into()),
            ),
            Error::Message(what) => Self::new(what, "this value", None),
            Error::ExpectedFloat | Error::ExpectedInteger => Self::new(
                "a number is expected",
                "here",
                Some("write digits with a decimal point, without quotes".into()),
            ),
            Error::IntegerOutOfBounds => Self::new(
                "a negative or far too large number; allowed: whole numbers that are not negative",
                "here",
                None,
            ),
            Error::TrailingCharacters => Self::new(
                "text behind the closing bracket",
                "here",
                Some("a file holds one value in brackets: remove what follows it".into()),
            ),
            Error::ExpectedStructLike | Error::ExpectedNamedStructLike(_) => Self::new(
                "a group of fields in brackets is expected",
                "here",
                Some("write `(field: value, ...)`".into()),
            ),
            Error::UnclosedBlockComment => Self::new(
                "a comment without an end",
                "begins here",
                Some("end it with */".into()),
            ),
            Error::ExpectedStringEnd => Self::new(
                "a text without an end",
                "begins here",
                Some("end it with a quotation mark".into()),
            ),
            Error::Eof => Self::new(
                "the text ends too early",
                "here",
                Some("close all brackets".into()),
            ),
            other => Self::new(other.to_string().to_lowercase(), "here", None),
        }
    }

    fn unknown(what: &str, found: &str, allowed: &[&str]) -> Self {
        let label = match nearest(found, allowed.iter().copied()) {
            Some(name) => format!("did you mean `{name}`?"),
            None => "not known here".into(),
        };
        Self::new(
            what,
            label,
            Some(format!("allowed: {}", allowed.join(", "))),
        )
    }
}

/// What lines begin with in languages whose comments or directives are others.
const FOREIGN: [&str; 8] = ["#", "%", ";", "--", "!", "@", "$", "<"];

/// Recognises a comment or directive of another language that the parser stumbled over at `at`, one that includes another
/// file for instance. Gives its place and the words.
fn foreign(text: &str, at: usize, error: &Error) -> Option<(Range<usize>, Words)> {
    let before = text.get(..at)?;
    let begin = before.rfind('\n').map_or(0, |i| i + 1);
    let line = text[begin..].lines().next()?;
    let lead = line.len() - line.trim_start().len();
    let sign = FOREIGN.iter().find(|s| line[lead..].starts_with(**s));
    let at_sign = at <= begin + lead + 2 && !line[lead..].starts_with("#![enable");
    let what = match (sign.filter(|_| at_sign), error) {
        (Some(sign), _) => format!("a line that begins with `{sign}`"),
        (None, Error::ExpectedDifferentStructName { found, .. })
            if ["include", "import"].contains(&found.as_str()) =>
        {
            format!("`{found}`")
        }
        _ => return None,
    };
    let help = "write here what another file holds: a file stands alone and has no directives; a comment begins with //";
    let place = if at_sign && sign.is_some() {
        begin + lead..begin + line.len()
    } else {
        at..begin + line.len()
    };
    Some((place, Words::new(what, "this", Some(help.into()))))
}

/// Recognises a value at `place` that was refused before the letters behind it were read: 27e3MPa, 0x1b. Gives its place
/// and the words.
fn lettered_number(
    text: &str,
    place: &Range<usize>,
    error: &Error,
) -> Option<(Range<usize>, Words)> {
    let tail = text.get(place.end..)?;
    let rest = tail.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_');
    let digits = text
        .get(place.clone())?
        .ends_with(|c: char| c.is_ascii_digit());
    if !matches!(error, Error::Message(_)) || !digits || rest.len() == tail.len() {
        return None;
    }
    let help = "write digits with a decimal point: the name of the field states the unit";
    let words = Words::new("a number with letters in it", "this", Some(help.into()));
    Some((place.start..text.len() - rest.len(), words))
}

/// Recognises a number whose tail the parser stumbled over at `at`: a decimal comma, a unit, a second number, or a
/// fraction where a whole number belongs. Gives the name of its field, its place and the words.
fn mistyped_number(text: &str, at: usize) -> Option<(&str, Range<usize>, Words)> {
    let (before, after) = text.split_at_checked(at)?;
    let tail = after
        .split(|c: char| !c.is_ascii_alphanumeric() && c != '.')
        .next()?;
    let first = tail.chars().next()?;
    let comma = before.ends_with(',') && first.is_ascii_digit();
    let before = before.trim_end_matches(if comma { ',' } else { ' ' });
    let lead = before.trim_end_matches(|c: char| c.is_ascii_digit() || ".+-".contains(c));
    let number = &before[lead.len()..];
    let is_field = after[tail.len()..].trim_start().starts_with(':');
    if !number.ends_with(|c: char| c.is_ascii_digit()) || is_field {
        return None;
    }
    let words = if comma {
        let help = format!("use a decimal point: {number}.{tail}");
        Words::new("a number with a decimal comma", "this number", Some(help))
    } else if first.is_ascii_alphabetic() {
        let help = format!("write {number} alone: the name of the field states the unit");
        Words::new("a number with a unit behind it", "this number", Some(help))
    } else if before.len() < at {
        let help = format!("write {number} or {tail}");
        Words::new("two numbers where one belongs", "these", Some(help))
    } else {
        Words::new("a fraction; allowed: whole numbers", "this number", None)
    };
    let name = lead.trim_end().strip_suffix(':').unwrap_or_default();
    let name = name
        .rsplit(|c: char| !c.is_alphanumeric() && c != '_')
        .next()?;
    Some((name, lead.len()..at + tail.len(), words))
}

/// Place of the digits behind `field: 12,` whose number begins at `at`: in a group a field has one.
fn behind_comma(text: &str, at: usize) -> Option<usize> {
    let (before, after) = text.split_at_checked(at)?;
    let rest = after.trim_start_matches(|c: char| c.is_ascii_digit() || ".+-".contains(c));
    let tail = rest.strip_prefix(',')?;
    let decimals = tail.starts_with(|c: char| c.is_ascii_digit());
    (decimals && before.trim_end().ends_with(':')).then(|| text.len() - tail.len())
}

/// Whether the parser has asked for what may have been cut off.
const fn expects_more(error: &Error) -> bool {
    matches!(
        error,
        Error::ExpectedStructLike | Error::ExpectedNamedStructLike(_)
    )
}

/// The first line of a place; its end, where there is nothing but blanks before.
fn one_line(text: &str, place: Range<usize>) -> Range<usize> {
    let shown = text.get(place.clone()).unwrap_or_default();
    if shown.trim().is_empty() && !text[place.end..].trim().is_empty() {
        return place.end..place.end;
    }
    place.start..place.start + shown.lines().next().unwrap_or_default().len()
}

/// Name of the file with line and column of a byte, counted from 1.
fn address(file: &NamedSource<String>, at: usize) -> String {
    let before = file.inner().get(..at).unwrap_or_default();
    let line = 1 + before.matches('\n').count();
    let column = 1 + before.chars().rev().take_while(|c| *c != '\n').count();
    format!("{}:{line}:{column}", file.name())
}

/// Byte offset of a line and column, both counted from 1, columns in characters.
fn offset(text: &str, position: Position) -> usize {
    let lines = text
        .split_inclusive('\n')
        .take(position.line.saturating_sub(1));
    let line: usize = lines.map(str::len).sum();
    let columns = text[line..].chars().take(position.col.saturating_sub(1));
    line + columns.map(char::len_utf8).sum::<usize>()
}
