//! Puts what it reads between the lines `<!-- NAME -->` and `<!-- end -->` of a document.
//!
//! Usage: `insert DOCUMENT NAME`

use std::error::Error;
use std::{env, io};

use fe_tests::document::fill;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [document, name] = arguments.as_slice() else {
        return Err("usage: insert DOCUMENT NAME".into());
    };
    let text = io::read_to_string(io::stdin())?;
    fill(document, [(name.as_str(), text)])
}
