//! `summary.json`: what a run says, in one object.

mod energy;

pub use energy::{Energy, PartEnergy};

use std::io;

use fe_solver::capacity::{Capacity, PathPoint, Verdict};
use fe_solver::stage::{Counters, PhaseTimes};
use serde::Serialize;
use serde_json::{Map, Value};

use super::error::ResultsError;
use super::folder::Folder;
use super::mode::Diagnosis;
use super::numerical_error::NumericalError;

/// One run of one specimen. The groups are flattened: the file is one object without nesting but for
/// `energy` and `wall_s`. What does not exist, or is not finite, is `null`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// What was run.
    #[serde(flatten)]
    pub setup: Setup,
    /// Work done.
    #[serde(flatten)]
    pub work: Work,
    /// What the load path says.
    #[serde(flatten)]
    pub figures: Figures,
    /// Load (kN) at which the sheets were bonded, where they were not there from the start.
    pub bonded_at_kn: Option<f64>,
    /// Why the run ended.
    pub stop_reason: String,
    /// Whether it ended before its end.
    pub stopped_early: bool,
    /// Mode of failure.
    #[serde(flatten)]
    pub diagnosis: Diagnosis,
    /// Largest load of the laboratory test (kN).
    pub test_load_kn: Option<f64>,
    /// Peak load over that of the test.
    pub ratio_model_to_test: Option<f64>,
    /// What the size of the elements costs in bond.
    pub bond_error: Option<BondError>,
    /// Largest principal tension of cracked concrete up to the peak over the tensile strength: 1 where cracks do not lock.
    pub tension_over_strength: f64,
    /// The numerical error of the peak, where it was asked for.
    pub numerical_error: Option<NumericalError>,
    /// Sum of the vertical reactions under self weight (kN), whole width.
    pub self_weight_reaction_kn: f64,
    /// Energy by part, where it is followed.
    pub energy: Option<Energy>,
    /// Wall time (s).
    pub wall_s: WallTime,
    /// Processor time of all threads (s).
    pub cpu_s: Option<f64>,
    /// Largest resident set (MB).
    pub max_rss_mb: Option<f64>,
}

/// Pull-out of a long strip with elements of the size they have in the beam, against its closed form.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BondError {
    /// Largest element along the fibres (mm).
    pub element_mm: f64,
    /// Largest force the elements transfer (N per mm of width).
    pub force_n_per_mm: f64,
    /// Its exact value (N/mm).
    pub exact_n_per_mm: f64,
    /// Relative error.
    pub relative: f64,
    /// Longest element (mm) that resolves the softening of the bond, a third of its length.
    pub resolving_mm: f64,
}

impl std::fmt::Display for BondError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "elements of {:.0} mm along the fibres transfer {:.1} N/mm in a pull-out, {:+.1} % over the exact {:.1}",
            self.element_mm,
            self.force_n_per_mm,
            100.0 * self.relative,
            self.exact_n_per_mm
        )?;
        if self.element_mm > self.resolving_mm {
            let (most, over) = (self.resolving_mm, self.element_mm / self.resolving_mm);
            write!(
                f,
                "; they are {over:.1} times as long as resolves the softening of the bond, {most:.1} mm: `--mesh` takes more"
            )?;
        }
        Ok(())
    }
}

/// What was run.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Setup {
    /// Name of the specimen.
    pub specimen: String,
    /// Preset.
    pub preset: String,
    /// Law of the concrete.
    pub law: String,
    /// Driver.
    pub driver: String,
    /// Integration rule.
    pub integration: String,
    /// Mesh, as NXxNYxNZ.
    pub mesh: String,
    /// Elements of all kinds.
    pub elements: usize,
    /// Degrees of freedom.
    pub dofs: usize,
    /// Options that were given and are not the default, by name.
    pub options: Map<String, Value>,
    /// Version of the program.
    pub version: String,
    /// [`fingerprint`](super::hash::fingerprint) of specimen and options.
    pub input_hash: String,
}

/// Deterministic counts of the work done, over all stages.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Work {
    /// Accepted steps.
    pub steps: usize,
    /// Iterations, failed attempts included.
    pub newton_iterations: usize,
    /// Attempts repeated with a shorter step.
    pub cutbacks: usize,
    /// Numeric factorisations.
    pub factorisations: usize,
    /// Evaluations of the internal force.
    pub force_evaluations: usize,
}

impl Work {
    /// Adds what a stage did.
    pub fn add(&mut self, counters: &Counters) {
        self.steps += counters.steps;
        self.newton_iterations += counters.iterations;
        self.cutbacks += counters.cutbacks;
        self.factorisations += counters.factorisations;
        self.force_evaluations += counters.force_evaluations;
    }
}

/// What the load path says.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figures {
    /// Largest load before the first fall of 20 % from the running maximum, or of the whole path (kN).
    pub peak_load_kn: f64,
    /// Deflection there (mm).
    pub deflection_at_peak_mm: f64,
    /// First local maximum followed by a fall of 5 % (kN).
    pub first_drop_load_kn: Option<f64>,
    /// Deflection there (mm).
    pub first_drop_deflection_mm: Option<f64>,
    /// Largest fall after the peak, relative to it, before the load exceeds it again.
    pub post_peak_drop: f64,
    /// Whether that fall holds a jump over which no static equilibrium exists.
    pub vertical_drop: bool,
    /// Largest relative residual of the steps up to the peak.
    pub max_residual: Option<f64>,
    /// Steps up to the peak accepted without meeting the criterion.
    pub flagged_steps: usize,
    /// Work-conjugate load less load at the last regular step up to the peak (kN).
    pub p_star_gap_kn: Option<f64>,
    /// How far the peak can be relied on: high, limited or low.
    pub trust: String,
    /// Why.
    pub trust_reason: String,
}

impl Figures {
    /// Reads a path in mm and kN.
    pub fn of(path: &[PathPoint], capacity: &Capacity, verdict: &Verdict) -> Option<Self> {
        let peak = path.get(capacity.peak)?;
        let drop = capacity.first_drop.and_then(|i| path.get(i));
        Some(Self {
            peak_load_kn: peak.load,
            deflection_at_peak_mm: peak.deflection,
            first_drop_load_kn: drop.map(|p| p.load),
            first_drop_deflection_mm: drop.map(|p| p.deflection),
            post_peak_drop: capacity.post_peak_drop,
            vertical_drop: capacity.vertical_drop,
            max_residual: Some(verdict.max_residual).filter(|r| r.is_finite()),
            flagged_steps: verdict.flagged,
            p_star_gap_kn: verdict.gap.filter(|gap| gap.is_finite()),
            trust: verdict.trust.to_string(),
            trust_reason: verdict.reason.clone(),
        })
    }
}

/// Wall time by phase (s).
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct WallTime {
    /// From reading the specimen to the last file but this one.
    pub total: f64,
    /// Laws and internal forces.
    pub laws_and_forces: f64,
    /// Laws, stiffness and assembly.
    pub assembly: f64,
    /// Numeric factorisation.
    pub factorise: f64,
    /// Back-substitution.
    pub solve: f64,
    /// Tables, fields and pictures.
    pub output: f64,
}

impl WallTime {
    /// Adds what a stage took, but for output and total.
    pub fn add(&mut self, times: &PhaseTimes) {
        self.laws_and_forces += times.forces.as_secs_f64();
        self.assembly += times.assembly.as_secs_f64();
        self.factorise += times.factorise.as_secs_f64();
        self.solve += times.solve.as_secs_f64();
    }
}

impl Summary {
    /// Writes `summary.json`.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn write(&self, folder: &Folder) -> Result<(), ResultsError> {
        folder.replace("summary.json", |out| {
            serde_json::to_writer_pretty(&mut *out, self).map_err(io::Error::from)?;
            out.write_all(b"\n")
        })
    }

    /// The result in one line: peak, test, mode, trust, cost.
    pub fn line(&self) -> String {
        let figures = &self.figures;
        let test = match (self.test_load_kn, self.ratio_model_to_test) {
            (Some(load), Some(ratio)) => {
                format!(" (test {load:.1}, {:+.0} %)", percent_over(ratio))
            }
            _ => String::new(),
        };
        let error = match &self.numerical_error {
            Some(error) => format!("  {}", error.line()),
            None => String::new(),
        };
        format!(
            "{:<8}  peak {:.1} kN at {:.2} mm{test}{error}  {}  trust {}  {} steps  {:.1} s",
            self.setup.specimen,
            figures.peak_load_kn,
            figures.deflection_at_peak_mm,
            self.diagnosis.mode,
            figures.trust,
            self.work.steps,
            self.wall_s.total
        )
    }
}

/// By how many per cent the model exceeds the test; never "-0".
fn percent_over(ratio: f64) -> f64 {
    (100.0 * (ratio - 1.0)).round() + 0.0
}

#[cfg(test)]
mod tests;
