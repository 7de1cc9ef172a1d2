//! Writes `docs/verification.md`: every test of the framework with what it protects, its target and its source, as the test
//! itself says.

use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use fe_tests::manual::{Page, read};

const COMMAND: &str = "cargo run --release -p fe-tests --bin verification";

/// Where tests are, and what they are about.
const PARTS: [(&str, &[&str]); 5] = [
    (
        "Cases across the crates: elements, structures, stability",
        &["tests/tests"],
    ),
    ("Elements", &["fe-elements/tests", "fe-elements/src"]),
    (
        "Laws of materials",
        &["fe-materials/tests", "fe-materials/src"],
    ),
    (
        "Laws and elements of interfaces",
        &["fe-contact/tests", "fe-contact/src"],
    ),
    (
        "Core and solver",
        &["fe-core/tests", "fe-core/src", "fe-solver/src"],
    ),
];

/// Source files below a folder, in order.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) -> std::io::Result<()> {
    let mut entries: Vec<_> = fs::read_dir(folder)?.collect::<Result<_, _>>()?;
    entries.sort_by_key(fs::DirEntry::path);
    for entry in entries {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, found)?;
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    Ok(())
}

fn show(text: &mut String, name: &str, page: &Page) -> std::fmt::Result {
    writeln!(text, "### {name}\n")?;
    if !page.header.is_empty() {
        writeln!(text, "{}\n", page.header)?;
    }
    writeln!(text, "| test | what it protects, target |\n|---|---|")?;
    for (test, about) in &page.tests {
        writeln!(text, "| {test} | {} |", about.replace('|', "\\|"))?;
    }
    writeln!(text)
}

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut text = format!(
        "# Verification\n\nWritten by\n\n```console\n$ {COMMAND}\n```\n\nfrom the tests themselves. Every one of them passes whenever \
         the tests of the workspace do (`cargo test --workspace`): a result outside its target fails them. What is compared with tests on \
         beams instead is in [accuracy.md](accuracy.md); scenes in which methods fail are in [stability.md](stability.md).\n\n"
    );
    for (title, folders) in PARTS {
        writeln!(text, "## {title}\n")?;
        for folder in folders {
            let mut files = Vec::new();
            sources(&root.join(folder), &mut files)?;
            for file in files {
                let page = read(&fs::read_to_string(&file)?);
                if !page.tests.is_empty() {
                    let name = file.strip_prefix(&root)?.display().to_string();
                    show(&mut text, &name, &page)?;
                }
            }
        }
    }
    fs::write(
        root.join("docs/verification.md"),
        text.trim_end().to_owned() + "\n",
    )?;
    Ok(())
}
