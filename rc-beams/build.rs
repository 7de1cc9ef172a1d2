//! Collects `specimens/*.ron` into a table of names and texts, so that a new specimen is one new file.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=specimens");
    let folder = Path::new("specimens").canonicalize()?;
    let mut files: Vec<PathBuf> = fs::read_dir(folder)?
        .map(|entry| Ok(entry?.path()))
        .collect::<io::Result<_>>()?;
    files.retain(|file| file.extension().is_some_and(|e| e == "ron"));
    files.sort();
    let row = |file: &PathBuf| {
        let name = file.file_stem()?.to_str()?;
        Some(format!("({name:?}, include_str!({:?})),\n", file.to_str()?))
    };
    let table: Option<String> = files.iter().map(row).collect();
    let table = table.ok_or_else(|| io::Error::other("a file name is not UTF-8"))?;
    let out = env::var("OUT_DIR").map_err(io::Error::other)?;
    fs::write(Path::new(&out).join("builtin.rs"), format!("&[{table}]"))
}
