//! What one run has left: its summary and the work of its path.

use std::error::Error;
use std::fs;
use std::path::Path;

use serde_json::Value;

/// Results of one beam.
#[derive(Debug)]
pub struct Outcome {
    summary: Value,
    /// Factorisations and force evaluations an accepted step up to the peak.
    pub cost: [f64; 2],
}

impl Outcome {
    /// Reads the folder of a beam; none if it has not been run to its end.
    ///
    /// # Errors
    ///
    /// What cannot be read or understood, by file.
    pub fn read(folder: &Path) -> Result<Option<Self>, Box<dyn Error>> {
        let file = folder.join("summary.json");
        let Ok(text) = fs::read_to_string(&file) else {
            return Ok(None);
        };
        let summary =
            serde_json::from_str(&text).map_err(|e| format!("{}: {e}", file.display()))?;
        let history = folder.join("history.csv");
        let cost = cost(&fs::read_to_string(&history)?)
            .ok_or_else(|| format!("{}: no steps", history.display()))?;
        Ok(Some(Self { summary, cost }))
    }

    /// A number of the summary, by the names that lead to it.
    pub fn number(&self, path: &[&str]) -> Option<f64> {
        self.value(path)?.as_f64()
    }

    /// A text of the summary.
    pub fn text(&self, path: &[&str]) -> Option<&str> {
        self.value(path)?.as_str()
    }

    fn value(&self, path: &[&str]) -> Option<&Value> {
        path.iter().try_fold(&self.summary, |v, key| v.get(key))
    }

    /// Peak load (kN).
    pub fn peak(&self) -> Option<f64> {
        self.number(&["peak_load_kn"])
    }

    /// Peak over that of the test, less 1.
    pub fn error(&self) -> Option<f64> {
        self.number(&["ratio_model_to_test"]).map(|r| r - 1.0)
    }
}

/// Work an accepted step up to the peak, from `history.csv`.
fn cost(history: &str) -> Option<[f64; 2]> {
    let mut lines = history.lines();
    let names: Vec<&str> = lines.next()?.split(',').collect();
    let column = |name| names.iter().position(|n| *n == name);
    let (load, work) = (
        column("load_kn")?,
        [column("factorisations")?, column("force_evaluations")?],
    );
    let mut peak: Option<(f64, f64, [f64; 2])> = None;
    for (step, line) in lines.enumerate().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|c| c.parse().unwrap_or(0.0)).collect();
        let at = |column: usize| cells.get(column).copied();
        if peak.is_none_or(|(best, _, _)| at(load).is_some_and(|p| p > best)) {
            peak = Some((at(load)?, step as f64, [at(work[0])?, at(work[1])?]));
        }
    }
    peak.map(|(_, steps, work)| work.map(|w| w / steps))
}

#[cfg(test)]
mod tests {
    //! Protects what counts as the work of a path.
    use super::*;

    /// Self weight is no step of the path; what follows the peak does not count, failed attempts do.
    #[test]
    fn work_is_counted_up_to_the_peak() {
        let history = "step,load_kn,critical,factorisations,force_evaluations\n0,0,,2,4\n1,10,,4,14\n2,20,limit \
                       point,6,34\n3,5,,90,900\n";
        assert_eq!(cost(history), Some([3.0, 17.0]));
        assert_eq!(
            cost("step,load_kn,factorisations,force_evaluations\n"),
            None
        );
    }
}
