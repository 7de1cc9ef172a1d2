//! Puts what it reads between the lines `<!-- NAME -->` and `<!-- end -->` of a document.
//!
//! Usage: `insert DOCUMENT NAME`

use std::error::Error;
use std::{env, fs, io};

use fe_tests::accuracy::tables::insert;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [document, name] = arguments.as_slice() else {
        return Err("usage: insert DOCUMENT NAME".into());
    };
    let text = io::read_to_string(io::stdin())?;
    let filled = insert(&fs::read_to_string(document)?, name, &text)
        .ok_or_else(|| format!("{document} has no place for {name}"))?;
    fs::write(document, filled)?;
    Ok(())
}
