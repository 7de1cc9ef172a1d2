//! Runs the tests of the framework and writes `docs/verification.md` with its figures: every test with what it protects, its
//! target and its source, as the test itself says, and what it has found. If a test fails, nothing is written.

use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use fe_tests::verification::figures::{self, Figure};
use fe_tests::verification::findings::{Finding, Findings};
use fe_tests::verification::manual::{Page, read};
use fe_tests::verification::overview::overview;

const COMMAND: &str = "cargo run --release -p fe-tests --bin verification";

/// The crates whose tests are run.
const CRATES: [&str; 6] = [
    "fe-core",
    "fe-elements",
    "fe-materials",
    "fe-contact",
    "fe-solver",
    "fe-tests",
];

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

/// Files with tests below folders, by their names in the workspace.
fn pages(root: &Path, folders: &[&str]) -> Result<Vec<(String, Page)>, Box<dyn Error>> {
    let mut files = Vec::new();
    for folder in folders {
        sources(&root.join(folder), &mut files)?;
    }
    let mut pages = Vec::new();
    for file in files {
        let page = read(&fs::read_to_string(&file)?);
        if !page.tests.is_empty() {
            pages.push((file.strip_prefix(root)?.display().to_string(), page));
        }
    }
    Ok(pages)
}

/// What the tests print.
fn run(root: &Path) -> Result<String, Box<dyn Error>> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut tests = Command::new(cargo);
    tests.args(["test", "--release", "--locked", "--lib", "--tests"]);
    tests.args(CRATES.iter().flat_map(|name| ["-p", name]));
    tests.args(["--", "--show-output"]);
    let done = tests.current_dir(root).stderr(Stdio::inherit()).output()?;
    let output = String::from_utf8(done.stdout)?;
    if done.status.success() {
        return Ok(output);
    }
    eprint!("{output}");
    Err("the tests do not pass: docs/verification.md stays as it is".into())
}

/// The findings of a file, by its tests.
fn of_page<'a>(
    findings: &'a Findings,
    (file, page): &'a (String, Page),
) -> Vec<(&'a str, &'a [Finding])> {
    let tests = page.tests.iter().map(|(name, _)| name.as_str());
    tests
        .map(|name| (name, findings.of(file, name)))
        .filter(|(_, found)| !found.is_empty())
        .collect()
}

fn show(
    text: &mut String,
    page: &(String, Page),
    findings: &Findings,
    figures: &[Figure],
) -> std::fmt::Result {
    let (name, Page { header, tests }) = page;
    writeln!(text, "### {name}\n")?;
    if !header.is_empty() {
        writeln!(text, "{header}\n")?;
    }
    writeln!(text, "| test | what it protects, target |\n|---|---|")?;
    for (test, about) in tests {
        let about = about.replace('|', "\\|");
        writeln!(text, "| {} | {about} |", test.replace('_', " "))?;
    }
    writeln!(text)?;
    let found = of_page(findings, page);
    if !found.is_empty() {
        writeln!(
            text,
            "| test | result of | target | result |\n|---|---|---|---|"
        )?;
    }
    for (test, found) in &found {
        let mut test = test.replace('_', " ");
        for finding in *found {
            let (_, what) = finding.parts();
            let Finding { found, target, .. } = finding;
            writeln!(text, "| {test} | {what} | {target} | {found} |")?;
            test.clear();
        }
    }
    if !found.is_empty() {
        writeln!(text)?;
    }
    for Figure { name, caption, .. } in figures.iter().filter(|f| f.file == *name) {
        writeln!(text, "![{caption}](verification/{name}.svg)\n")?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let findings = Findings::read(&run(&root)?)?;
    let figures = figures::all(&findings)?;
    let mut parts = Vec::new();
    for (title, folders) in PARTS {
        parts.push((title, pages(&root, folders)?));
    }
    let all = || parts.iter().flat_map(|(_, pages)| pages);
    for (file, test) in findings.places() {
        let is_it = |(name, page): &(String, Page)| {
            name == file && page.tests.iter().any(|(name, _)| name == test)
        };
        if !all().any(is_it) {
            return Err(format!("no page has the test {test} of {file}").into());
        }
    }
    let mut placed = Vec::new();
    for page in all() {
        for (_, found) in of_page(&findings, page) {
            placed.extend(found.iter().map(|finding| (page.0.as_str(), finding)));
        }
    }
    let overview = overview(&placed)?;
    let mut text = format!(
        "# Verification\n\nWritten by\n\n```console\n$ {COMMAND}\n```\n\nfrom the tests themselves, which it runs. Every one of them passes \
         whenever the tests of the workspace do (`cargo test --workspace`): a result outside its target fails them. What is compared with \
         tests on beams instead is in [accuracy.md](accuracy.md); scenes in which methods fail are in [stability.md](stability.md).\n\n\
         ## Cases\n\nElements (EL), laws of materials (MAT), shells (SH) and structures with closed forms (STR): the results that tell \
         most, the others are with their tests below. Full, Irons and Reduced are the rules of integration: 27, 14 and 8 points of \
         hexahedra, 9 and 4 of quadrilaterals. A deviation that only rounding leaves is given by the power of ten above it.\n\n{overview}\n"
    );
    for (title, pages) in &parts {
        writeln!(text, "## {title}\n")?;
        for page in pages {
            show(&mut text, page, &findings, &figures)?;
        }
    }
    let docs = root.join("docs");
    fs::create_dir_all(docs.join("verification"))?;
    for Figure { name, svg, .. } in &figures {
        fs::write(docs.join(format!("verification/{name}.svg")), svg)?;
    }
    fs::write(
        docs.join("verification.md"),
        text.trim_end().to_owned() + "\n",
    )?;
    Ok(())
}
