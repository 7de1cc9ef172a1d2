//! Beams named on the command line: those that come with the program, and files.

use std::path::{Path, PathBuf};
use std::{fs, io};

use miette::Diagnostic;

use crate::exit::Exit;
use crate::ronfile::RonError;
use crate::spec::{BUILTIN, Specimen, read};
use crate::suggest::nearest;

const BYTE_ORDER_MARK: char = '\u{feff}';

/// What is wrong with a beam named on the command line.
#[derive(Debug, thiserror::Error, Diagnostic)]
#[non_exhaustive]
pub enum InputError {
    /// Neither a beam of the program nor a file.
    #[error("there is no beam `{name}`")]
    #[diagnostic(code(rc_beams::unknown_beam))]
    UnknownBeam {
        /// The name given.
        name: String,
        /// Names that exist.
        #[help]
        help: String,
    },
    /// Two beams would write into one folder.
    #[error(
        "the beam `{name}` is given twice, by {first} and {again}; allowed: once, its name is that of its results"
    )]
    #[diagnostic(
        code(rc_beams::twice),
        help("give it once, or change the name in one file")
    )]
    Twice {
        /// The name of the beam.
        name: String,
        /// What stands for it on the command line.
        first: String,
        /// And once more.
        again: String,
    },
    /// A file that cannot be read.
    #[error("cannot read {}", path.display())]
    #[diagnostic(code(rc_beams::file), help("check the path"))]
    File {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file that holds no text.
    #[error("{}, line {line}: byte {byte} of the file is not UTF-8 text that can be shown", path.display())]
    #[diagnostic(
        code(rc_beams::text),
        help(
            "name a text file; if it is one, save it with the encoding UTF-8 and without control characters"
        )
    )]
    NotText {
        /// The file.
        path: PathBuf,
        /// Line of the first byte that is not text, counted from 1.
        line: usize,
        /// That byte, counted from 1.
        byte: usize,
    },
    /// A file whose content is wrong.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Content(#[from] RonError),
}

impl InputError {
    /// How the program ends because of it.
    pub fn exit(&self) -> Exit {
        match self {
            Self::UnknownBeam { .. } | Self::Twice { .. } => Exit::Usage,
            Self::File { .. } => Exit::File,
            Self::NotText { .. } | Self::Content(_) => Exit::BadInput,
        }
    }
}

/// The specimens named: beams of the program, files, or `all` beams of the program.
///
/// # Errors
///
/// Everything wrong with any of them.
pub fn load_all(names: &[String]) -> Result<Vec<Specimen>, Vec<InputError>> {
    let mut specimens: Vec<Specimen> = Vec::new();
    let mut given: Vec<&str> = Vec::new();
    let mut errors = Vec::new();
    for name in each(names) {
        let new = match load(name) {
            Ok(new) => new,
            Err(more) => {
                errors.extend(more);
                continue;
            }
        };
        if let Some(at) = specimens.iter().position(|s| s.name == new.name) {
            errors.push(InputError::Twice {
                name: new.name,
                first: given[at].into(),
                again: name.into(),
            });
        } else {
            specimens.push(new);
            given.push(name);
        }
    }
    if errors.is_empty() {
        Ok(specimens)
    } else {
        Err(errors)
    }
}

/// What is named, with the beams of the program for `all`.
pub fn each(names: &[String]) -> impl Iterator<Item = &str> {
    let all = BUILTIN.iter().map(|(name, _)| *name);
    names.iter().flat_map(move |name| match name.as_str() {
        "all" => all.clone().collect(),
        other => vec![other],
    })
}

/// The specimen of that name, or of that file.
///
/// # Errors
///
/// Everything wrong with it.
pub fn load(name: &str) -> Result<Specimen, Vec<InputError>> {
    let text = text(name).map_err(|error| vec![error])?;
    read(name, &text).map_err(|errors| errors.into_iter().map(InputError::from).collect())
}

fn text(name: &str) -> Result<String, InputError> {
    if let Some((_, text)) = BUILTIN.iter().find(|(known, _)| *known == name) {
        return Ok((*text).into());
    }
    let path = Path::new(name);
    let names_a_file = path.extension().is_some_and(|e| e == "ron")
        || path.components().count() > 1
        || path.exists();
    if names_a_file {
        read_file(path)
    } else {
        Err(unknown(name))
    }
}

/// The text of a file, without the byte order mark that some editors put before it; a carriage return that ends a line alone
/// is read as the line feed that it stands for, so that places in messages remain.
///
/// # Errors
///
/// [`InputError::File`] and [`InputError::NotText`].
pub(crate) fn read_file(path: &Path) -> Result<String, InputError> {
    let mut bytes = fs::read(path).map_err(|source| InputError::File {
        path: path.into(),
        source,
    })?;
    for at in 0..bytes.len() {
        if bytes[at] == b'\r' && bytes.get(at + 1) != Some(&b'\n') {
            bytes[at] = b'\n';
        }
    }
    let no_text = |bytes: &[u8], good: usize| {
        let lines = bytes.iter().take(good).filter(|b| **b == b'\n');
        InputError::NotText {
            path: path.into(),
            line: 1 + lines.count(),
            byte: 1 + good,
        }
    };
    let mut text = String::from_utf8(bytes)
        .map_err(|error| no_text(error.as_bytes(), error.utf8_error().valid_up_to()))?;
    // Messages show the lines of the file: what would drive a terminal is kept from it.
    if let Some(at) = text.find(|c: char| c.is_control() && !"\n\r\t".contains(c)) {
        return Err(no_text(text.as_bytes(), at));
    }
    if text.starts_with(BYTE_ORDER_MARK) {
        text.remove(0);
    }
    Ok(text)
}

fn unknown(name: &str) -> InputError {
    let guess = nearest(name, BUILTIN.iter().map(|(known, _)| *known));
    let guess = guess
        .map(|g| format!("did you mean `{g}`? "))
        .unwrap_or_default();
    InputError::UnknownBeam {
        name: name.into(),
        help: format!("{guess}`rc-beams list` shows all; a file ends in .ron"),
    }
}
