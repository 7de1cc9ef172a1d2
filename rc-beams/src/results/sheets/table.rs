//! `sheets.csv`.

use super::{SheetLayout, SheetRow};
use crate::column::slug;
use crate::results::error::ResultsError;
use crate::results::evidence::Layout;
use crate::results::folder::Folder;
use crate::results::table::{Table, number};

/// `sheets.csv` of one run, on disk up to the last accepted step.
///
/// Columns: `step`, `deflection_mm`, `load_kn`, `utilisation`; per shear span `SPAN_stress_mpa`,
/// `SPAN_force_kn`, `SPAN_debonded`; per zone `ZONE_debonded`, `ZONE_slip_max_mm`, `ZONE_fibre_mpa`. Names are in small letters
/// with `_` for what is no letter or digit. A share without bonded area leaves its cell empty.
#[derive(Debug)]
pub struct SheetTable {
    table: Table,
}

impl SheetTable {
    /// Starts the table.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn create(
        folder: &Folder,
        layout: &Layout,
        sheets: &SheetLayout,
    ) -> Result<Self, ResultsError> {
        let mut columns: Vec<String> = ["step", "deflection_mm", "load_kn", "utilisation"]
            .map(str::to_owned)
            .into();
        for span in &layout.shear_spans {
            let name = slug(&span.name);
            columns.extend(["stress_mpa", "force_kn", "debonded"].map(|m| format!("{name}_{m}")));
        }
        for zone in &sheets.zones {
            let name = slug(&zone.name);
            columns.extend(["debonded", "slip_max_mm", "fibre_mpa"].map(|m| format!("{name}_{m}")));
        }
        let columns = columns.iter().map(String::as_str);
        Ok(Self {
            table: Table::create(folder, "sheets.csv", columns)?,
        })
    }

    /// Ends what an earlier run left: from here on rows are new.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn settle(&mut self) -> Result<(), ResultsError> {
        self.table.settle()
    }

    /// Adds an accepted step.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`], also when the row does not match the columns.
    pub fn step(&mut self, row: &SheetRow) -> Result<(), ResultsError> {
        let share = |s: Option<f64>| s.map_or_else(String::new, number);
        let mut cells = vec![
            row.step.to_string(),
            number(row.deflection_mm),
            number(row.load_kn),
            number(row.utilisation),
        ];
        for s in &row.spans {
            cells.extend([number(s.stress_mpa), number(s.force_kn), share(s.debonded)]);
        }
        for z in &row.zones {
            cells.extend([
                share(z.debonded),
                number(z.slip_max_mm),
                number(z.fibre_mpa),
            ]);
        }
        self.table.row(cells)?;
        self.table.flush()
    }
}
