//! What a point went through.

use std::io::{self, Write};

use crate::kinematics::Kinematics;
use crate::material::{Material, state_labels};

/// One point of the path.
#[derive(Debug, Clone, PartialEq)]
pub struct PointRow {
    /// Strain components.
    pub strain: Vec<f64>,
    /// Stress components (MPa).
    pub stress: Vec<f64>,
    /// Internal variables.
    pub state: Vec<f64>,
}

/// The path of a point: the virgin state, then one row per step.
#[derive(Debug, Clone, PartialEq)]
pub struct PointHistory {
    columns: Vec<String>,
    rows: Vec<PointRow>,
}

impl PointHistory {
    pub(super) fn new<K: Kinematics>(law: &dyn Material<K>) -> Self {
        let labels = K::STRAIN_LABELS.iter().chain(K::STRESS_LABELS);
        Self {
            columns: labels
                .map(|&label| label.to_owned())
                .chain(state_labels(law.state_vars()))
                .collect(),
            rows: Vec::new(),
        }
    }

    pub(super) fn push(&mut self, row: PointRow) {
        self.rows.push(row);
    }

    /// Names of strains, stresses and internal variables, in the order of the columns; the components of
    /// a vector carry their index, as in `crack_axes[2]`.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The rows.
    pub fn rows(&self) -> &[PointRow] {
        &self.rows
    }

    /// Writes a header and one line per row, comma-separated, every number so that it reads back the same.
    ///
    /// # Errors
    ///
    /// Those of `out`.
    pub fn write_csv(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "{}", self.columns.join(","))?;
        for row in &self.rows {
            let values = row.strain.iter().chain(&row.stress).chain(&row.state);
            let cells: Vec<String> = values.map(|v| format!("{v:e}")).collect();
            writeln!(out, "{}", cells.join(","))?;
        }
        Ok(())
    }
}
