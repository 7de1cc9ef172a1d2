//! The program `rc-beams`.

use std::process::ExitCode;

fn main() -> ExitCode {
    rc_beams::cli::main().into()
}
