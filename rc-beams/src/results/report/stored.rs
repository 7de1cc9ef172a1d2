//! Reads what a run has left.

use std::error::Error;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::{fs, io};

use csv::{Reader, StringRecord};
use fe_solver::capacity::DROP_FALL;
use serde::Deserialize;
use serde_json::{Map, Value};

use super::exists;
use crate::results::events::EventKind;
use crate::results::mode::FailureMode;
use crate::results::sheets::{MAP, MapRow, read_map};

/// The results of one beam.
#[derive(Debug, Clone)]
pub(super) struct Stored {
    /// Name of its folder.
    pub name: String,
    /// `summary.json`.
    pub summary: StoredSummary,
    /// Deflection (mm) and load (kN) of the rows of `history.csv`.
    pub path: Vec<[f64; 2]>,
    /// `events.csv`.
    pub events: Vec<StoredEvent>,
    /// Rows of `sheets.csv` at the peak and at the end.
    pub sheets: Option<[StoredSheets; 2]>,
    /// `sheet_map.csv`.
    pub map: Vec<MapRow>,
}

/// What is used of `summary.json`.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct StoredSummary {
    pub specimen: String,
    pub preset: String,
    pub law: String,
    pub driver: String,
    pub integration: String,
    pub mesh: String,
    /// Those given that are not the default.
    #[serde(default)]
    pub options: Map<String, Value>,
    pub steps: usize,
    pub peak_load_kn: f64,
    pub deflection_at_peak_mm: f64,
    pub mode: String,
    pub mode_evidence: String,
    pub trust: String,
    pub trust_reason: String,
    pub stop_reason: String,
    pub test_load_kn: Option<f64>,
    pub ratio_model_to_test: Option<f64>,
    pub post_peak_drop: f64,
    pub counterfactual_ratio: Option<f64>,
    pub wall_s: StoredWall,
}

/// What is used of the wall time.
#[derive(Debug, Clone, Copy, Deserialize)]
pub(super) struct StoredWall {
    pub total: f64,
}

impl StoredSummary {
    /// Whether the beam has failed: otherwise, as where the run was stopped, its largest load is a lower bound of the peak.
    pub(super) fn failed(&self) -> bool {
        let rupture = self.mode == FailureMode::SheetRupture.to_string();
        self.mode != FailureMode::None.to_string()
            && match self.test_load_kn {
                // The run tells by a ratio that there is something to compare.
                Some(_) => self.ratio_model_to_test.is_some(),
                // A sheet may rupture while the load of the model, in which none tears, still rises.
                None => !rupture || self.post_peak_drop >= DROP_FALL,
            }
    }

    /// Peak over the load of the test; none where there is no peak.
    pub(super) fn ratio(&self) -> Option<f64> {
        self.ratio_model_to_test.filter(|_| self.failed())
    }
}

/// A row of `events.csv`.
#[derive(Debug, Clone)]
pub(super) struct StoredEvent {
    pub kind: EventKind,
    pub deflection_mm: f64,
    pub load_kn: f64,
}

/// A row of `sheets.csv`, the test span or, without one, the span with the largest value.
#[derive(Debug, Clone, Copy)]
pub(super) struct StoredSheets {
    pub load_kn: f64,
    pub stress_mpa: f64,
    pub force_kn: f64,
    pub debonded: f64,
}

/// Folders in `root` that hold results, sorted by name.
pub(super) fn folders(root: &Path) -> io::Result<Vec<PathBuf>> {
    let mut folders = Vec::new();
    for entry in fs::read_dir(root)? {
        let path = entry?.path();
        if holds_results(&path) {
            folders.push(path);
        }
    }
    folders.sort();
    Ok(folders)
}

/// Whether a folder holds the results of a beam.
pub(super) fn holds_results(folder: &Path) -> bool {
    ["summary.json", "history.csv"]
        .iter()
        .any(|file| exists(&folder.join(file)))
}

/// Reads a folder; also what is wrong with it. Without a summary there is no beam.
pub(super) fn read(folder: &Path) -> (Option<Stored>, Vec<String>) {
    let name = folder.file_name().unwrap_or_default();
    let summary = match summary(folder) {
        Ok(summary) => summary,
        Err(what) => return (None, vec![format!("{what}; the beam is left out")]),
    };
    let mut wrong = Vec::new();
    let mut path = Vec::new();
    let history = rows(folder, "history.csv", &mut |row| {
        path.push([row.number("deflection_mm")?, row.number("load_kn")?]);
        Ok(())
    });
    let peak = [summary.deflection_at_peak_mm, summary.peak_load_kn];
    let holds_peak = path.iter().any(|point| same(*point, peak));
    // How many rows other tables should have is known then.
    let is_whole = history.is_ok();
    match history {
        Err(what) => wrong.push(what),
        Ok(()) if !holds_peak => wrong.push(
            "history.csv does not hold the peak of summary.json; they are of different runs"
                .to_owned(),
        ),
        Ok(()) => {}
    }
    let mut beam = Stored {
        name: name.to_string_lossy().into_owned(),
        summary,
        path,
        events: Vec::new(),
        sheets: None,
        map: Vec::new(),
    };
    let mut gauged = 0;
    let gauges = rows(folder, "gauges.csv", &mut |row| {
        gauged += 1;
        row.number("load_kn").map(drop)
    });
    match gauges {
        Err(what) => wrong.push(what),
        Ok(()) => wrong.extend(unlike("gauges.csv", gauged, &beam.path).filter(|_| is_whole)),
    }
    wrong.extend(rows(folder, "newton.csv", &mut |_| Ok(())).err());
    let events = rows(folder, "events.csv", &mut |row| {
        beam.events.push(event(row)?);
        Ok(())
    });
    wrong.extend(events.err());
    let has = |file: &str| exists(&folder.join(file));
    // A run with sheets writes two tables of them.
    let sheet_tables = ["sheets.csv", MAP];
    let with_sheets = sheet_tables.into_iter().any(has);
    let expected = sheet_tables.into_iter().filter(|_| with_sheets);
    for file in expected.filter(|file| !has(file)) {
        wrong.push(format!("{file} is missing"));
    }
    if has("sheets.csv") {
        match sheets(folder, peak) {
            Ok((found, rows)) => {
                beam.sheets = Some(found);
                wrong.extend(unlike("sheets.csv", rows, &beam.path).filter(|_| is_whole));
            }
            Err(what) => wrong.push(what),
        }
    }
    if has(MAP) {
        let read = fs::File::open(folder.join(MAP)).map_err(|e| e.to_string());
        match read.and_then(|file| read_map(file).map_err(|e| e.to_string())) {
            Ok(rows) => beam.map = rows,
            Err(what) => wrong.push(format!("{MAP}: {what}")),
        }
    }
    (Some(beam), wrong)
}

/// What is said of a table that has not as many rows as the history.
fn unlike(file: &str, rows: usize, path: &[[f64; 2]]) -> Option<String> {
    let steps = path.len();
    (rows != steps).then(|| format!("{file} has {rows} rows for {steps} of history.csv"))
}

fn summary(folder: &Path) -> Result<StoredSummary, String> {
    let told = |e: &dyn Display| format!("summary.json: {e}");
    let text = fs::read(folder.join("summary.json")).map_err(|e| match e.kind() {
        io::ErrorKind::NotFound => {
            "summary.json is missing, the run has not ended or failed before its first load"
                .to_owned()
        }
        _ => told(&e),
    })?;
    let reader = &mut serde_json::Deserializer::from_slice(&text);
    serde_path_to_error::deserialize(reader).map_err(|e| told(&e))
}

/// Whether two points of a path are the same one.
fn same(a: [f64; 2], b: [f64; 2]) -> bool {
    (0..2).all(|i| (a[i] - b[i]).abs() <= 1e-9 * b[i].abs().max(1.0))
}

/// A row of a table with the names of its columns.
struct Row<'a> {
    header: &'a StringRecord,
    cells: &'a StringRecord,
}

impl Row<'_> {
    fn text(&self, column: &str) -> Result<&str, Box<dyn Error>> {
        let at = self.header.iter().position(|c| c == column);
        let cell = at.and_then(|i| self.cells.get(i));
        cell.ok_or_else(|| format!("there is no column {column}").into())
    }

    fn number(&self, column: &str) -> Result<f64, Box<dyn Error>> {
        let cell = self.text(column)?;
        let number = f64::from_str(cell).ok().filter(|n| n.is_finite());
        number.ok_or_else(|| format!("{column} is {cell:?}, not a number").into())
    }

    /// The number of the test span, else the largest of all spans; 0 where all cells are empty.
    fn span(&self, measure: &str) -> Result<f64, Box<dyn Error>> {
        let test = format!("test_span_{measure}");
        if self.header.iter().any(|c| c == test) {
            return self.number_or_zero(&test);
        }
        // Spans alone have a stress; zones are debonded too.
        let spans = self
            .header
            .iter()
            .filter_map(|c| c.strip_suffix("_stress_mpa"));
        let mut largest = 0.0_f64;
        for span in spans {
            largest = largest.max(self.number_or_zero(&format!("{span}_{measure}"))?);
        }
        Ok(largest)
    }

    fn number_or_zero(&self, column: &str) -> Result<f64, Box<dyn Error>> {
        if self.text(column)?.is_empty() {
            Ok(0.0)
        } else {
            self.number(column)
        }
    }
}

/// Whether a row can be read.
type Visited = Result<(), Box<dyn Error>>;

/// Visits the rows of a table up to the first that cannot be read.
fn rows(
    folder: &Path,
    file: &str,
    visit: &mut dyn FnMut(&Row<'_>) -> Visited,
) -> Result<(), String> {
    let path = folder.join(file);
    if !exists(&path) {
        return Err(format!("{file} is missing"));
    }
    let text = fs::read(path).map_err(|e| format!("{file}: {e}"))?;
    if text.last().is_some_and(|end| *end != b'\n') {
        let line = text.split(|b| *b == b'\n').count();
        return Err(format!(
            "{file}, line {line}: the line has no end, the table was cut"
        ));
    }
    let mut reader = Reader::from_reader(text.as_slice());
    let header = reader
        .headers()
        .map_err(|e| format!("{file}: {e}"))?
        .clone();
    if header.is_empty() {
        return Err(format!("{file} is empty"));
    }
    let mut count = 0;
    for cells in reader.records() {
        // The header is line 1.
        let at = |e: &dyn Display| format!("{file}, line {}: {e}", count + 2);
        let cells = cells.map_err(|e| at(&e))?;
        let row = Row {
            header: &header,
            cells: &cells,
        };
        visit(&row).map_err(|e| at(&e))?;
        count += 1;
    }
    // A run may meet no event, and a motion has no iterations.
    if count == 0 && !["events.csv", "newton.csv"].contains(&file) {
        return Err(format!("{file} has no rows"));
    }
    Ok(())
}

fn event(row: &Row<'_>) -> Result<StoredEvent, Box<dyn Error>> {
    let key = row.text("event")?;
    let mut kinds = EventKind::ALL.into_iter();
    let kind = kinds.find(|k| k.key() == key);
    Ok(StoredEvent {
        kind: kind.ok_or_else(|| format!("{key:?} is no event"))?,
        deflection_mm: row.number("deflection_mm")?,
        load_kn: row.number("load_kn")?,
    })
}

/// Rows at the peak and at the end, and how many there are.
fn sheets(folder: &Path, peak: [f64; 2]) -> Result<([StoredSheets; 2], usize), String> {
    let (mut at_peak, mut last, mut count) = (None, None, 0);
    rows(folder, "sheets.csv", &mut |row| {
        let read = StoredSheets {
            load_kn: row.number("load_kn")?,
            stress_mpa: row.span("stress_mpa")?,
            force_kn: row.span("force_kn")?,
            debonded: row.span("debonded")?,
        };
        if same([row.number("deflection_mm")?, read.load_kn], peak) {
            at_peak = Some(read);
        }
        last = Some(read);
        count += 1;
        Ok(())
    })?;
    at_peak
        .zip(last)
        .map(|found| (found.into(), count))
        .ok_or_else(|| "sheets.csv does not hold the peak of summary.json".to_owned())
}
