//! Exit codes of the program.

use std::process::ExitCode;

/// How the program ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// Everything reached its end; a beam that fails after its peak did.
    Done,
    /// A run stopped early; its results are kept.
    StoppedEarly,
    /// The command line is wrong.
    Usage,
    /// An input file is wrong; nothing was run.
    BadInput,
    /// A file cannot be read or written.
    File,
    /// Interrupted; the results up to the last accepted step are kept.
    Interrupted,
}

impl Exit {
    /// The code handed to the shell.
    pub fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::StoppedEarly => 1,
            Self::Usage => 2,
            Self::BadInput => 3,
            Self::File => 4,
            Self::Interrupted => 130,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}
