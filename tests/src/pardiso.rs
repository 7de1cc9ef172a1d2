//! Intel's PARDISO on a matrix of ours: a reference run beside our factorisation, by a script of Python.

use std::error::Error;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use fe_core::sparsity::{MatrixValues, Sparsity};

/// The interpreter with `pypardiso`; without it there is no reference.
pub const INTERPRETER: &str = "PARDISO_PYTHON";
const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/pardiso.py");

/// Medians of times, on one thread (ms).
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Symbolic phase.
    pub analysis: f64,
    /// Numerical factorisation.
    pub factorisation: f64,
    /// One right-hand side.
    pub solution: f64,
    /// Which order of the equations was the fastest.
    pub order: String,
}

/// Largest relative residual of a solution that counts.
const RESIDUAL: f64 = 1e-8;

/// Equations and entries, where rows begin, columns (from 1), the order of the equations (from 1) and values, little-endian.
fn write(
    path: &Path,
    pattern: &Sparsity,
    lower: &[f64],
    order: &[u32],
) -> Result<(), Box<dyn Error>> {
    let mut file = BufWriter::new(File::create(path)?);
    for count in [pattern.len(), pattern.nnz()] {
        file.write_all(&i64::try_from(count)?.to_le_bytes())?;
    }
    // Columns of the lower triangle are rows of the upper one.
    for index in pattern.col_ptr().iter().chain(pattern.row_idx()) {
        file.write_all(&i32::try_from(index + 1)?.to_le_bytes())?;
    }
    for equation in order {
        file.write_all(&i32::try_from(equation + 1)?.to_le_bytes())?;
    }
    for value in lower {
        file.write_all(&value.to_le_bytes())?;
    }
    Ok(file.flush()?)
}

/// Factorises and solves `times` times: a symmetric positive definite matrix, in the given order of its equations and in
/// those that PARDISO finds; none if [`INTERPRETER`] is not set.
///
/// # Errors
///
/// When the matrix cannot be written, the script fails, or its solution misses the right-hand side.
pub fn measure(
    pattern: &Sparsity,
    matrix: &MatrixValues,
    order: &[u32],
    times: usize,
) -> Result<Option<Reference>, Box<dyn Error>> {
    let Some(python) = std::env::var_os(INTERPRETER) else {
        return Ok(None);
    };
    let path = std::env::temp_dir().join(format!("pardiso-{}.bin", std::process::id()));
    write(&path, pattern, &matrix.lower, order)?;
    let output = Command::new(python)
        .arg(SCRIPT)
        .arg(&path)
        .arg(times.to_string())
        .env("MKL_NUM_THREADS", "1")
        .env("OMP_NUM_THREADS", "1")
        .stdin(Stdio::null())
        .output();
    fs::remove_file(&path)?;
    let output = output?;
    if !output.status.success() {
        return Err(format!("PARDISO: {}", String::from_utf8_lossy(&output.stderr)).into());
    }
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let words: Vec<&str> = said.split_whitespace().collect();
    let [analysis, factorisation, solution, order, residual] = words[..] else {
        return Err(format!("PARDISO said: {said}").into());
    };
    let residual: f64 = residual.parse()?;
    if residual > RESIDUAL {
        return Err(format!("PARDISO: residual {residual:e}").into());
    }
    Ok(Some(Reference {
        analysis: analysis.parse()?,
        factorisation: factorisation.parse()?,
        solution: solution.parse()?,
        order: order.to_owned(),
    }))
}
