//! Tables that grow during a run: steps, gauges, iterations.

use fe_solver::critical::Critical;
use fe_solver::recorder::IterationRecord;

use crate::column::GAUGE_COLUMNS;

use super::error::ResultsError;
use super::folder::Folder;
use super::table::{Table, number};

/// One row of `history.csv`: an accepted step; self weight is step 0. Loads and reactions of the whole
/// width.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StepRow {
    /// Step, counted from 1; 0 is self weight.
    pub step: usize,
    /// Deflection (mm).
    pub deflection_mm: f64,
    /// Load P, net of self weight (kN).
    pub load_kn: f64,
    /// Work-conjugate load P* (kN); none for self weight.
    pub p_star_kn: Option<f64>,
    /// Vertical reaction of each support, from left to right (kN).
    pub reactions_kn: Vec<f64>,
    /// Force of each load, down positive, from left to right (kN).
    pub loads_kn: Vec<f64>,
    /// Negative pivots of the tangent, where they were counted; they are not at every step while there are some.
    pub negative_pivots: Option<usize>,
    /// Critical point passed on the way.
    pub critical: Option<Critical>,
    /// Relative residual.
    pub residual: f64,
    /// Criterion it is held against.
    pub criterion: f64,
    /// Iterations of the successful attempt.
    pub iterations: usize,
    /// Attempts.
    pub attempts: usize,
    /// Whether it passed a snap at a held load factor.
    pub held: bool,
    /// Accepted without meeting the criterion.
    pub flagged: bool,
    /// Length of the step in the imposed displacement (mm).
    pub step_mm: f64,
    /// Largest kinetic energy of the step over the work so far, of a motion.
    pub kinetic: Option<f64>,
    /// Viscous work over the work so far, where laws lag behind.
    pub viscous: Option<f64>,
    /// Numeric factorisations so far.
    pub factorisations: usize,
    /// Evaluations of the internal force so far.
    pub force_evaluations: usize,
}

impl StepRow {
    fn cells(&self) -> Vec<String> {
        let mut cells = vec![
            self.step.to_string(),
            number(self.deflection_mm),
            number(self.load_kn),
            self.p_star_kn.map_or_else(String::new, number),
        ];
        let forces = self.reactions_kn.iter().chain(&self.loads_kn);
        cells.extend(forces.copied().map(number));
        cells.extend([
            self.negative_pivots
                .map_or_else(String::new, |n| n.to_string()),
            self.critical.map_or_else(String::new, |c| c.to_string()),
            number(self.residual),
            number(self.criterion),
            self.iterations.to_string(),
            self.attempts.to_string(),
            u8::from(self.held).to_string(),
            u8::from(self.flagged).to_string(),
            number(self.step_mm),
            self.kinetic.map_or_else(String::new, number),
            self.viscous.map_or_else(String::new, number),
            self.factorisations.to_string(),
            self.force_evaluations.to_string(),
        ]);
        cells
    }
}

/// Columns of `history.csv` before and after the forces of supports and loads.
const STEP_COLUMNS: ([&str; 4], [&str; 13]) = (
    ["step", "deflection_mm", "load_kn", "p_star_kn"],
    [
        "negative_pivots",
        "critical",
        "residual",
        "criterion",
        "iterations",
        "attempts",
        "held",
        "flagged",
        "step_mm",
        "kinetic_share",
        "viscous_share",
        "factorisations",
        "force_evaluations",
    ],
);

const ITERATION_COLUMNS: [&str; 7] = [
    "step",
    "attempt",
    "iteration",
    "lambda",
    "residual",
    "criterion",
    "line_search",
];

/// `history.csv`, `gauges.csv` and `newton.csv` of one run.
///
/// All three are handed to the system after every accepted step: a run that is interrupted or killed
/// leaves them readable up to there. Numbers are written without loss; one that is not finite leaves its
/// cell empty.
#[derive(Debug)]
pub struct History {
    steps: Table,
    gauges: Table,
    iterations: Table,
}

impl History {
    /// Starts the tables. `forces` and `gauges` name the columns of reactions, then loads, and of gauges, with units.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn create(
        folder: &Folder,
        forces: &[String],
        gauges: &[String],
    ) -> Result<Self, ResultsError> {
        let (before, after) = STEP_COLUMNS;
        let forces = forces.iter().map(String::as_str);
        let steps = before.into_iter().chain(forces).chain(after);
        let readings = gauges.iter().map(String::as_str);
        let gauges = GAUGE_COLUMNS.into_iter().chain(readings);
        Ok(Self {
            steps: Table::create(folder, "history.csv", steps)?,
            gauges: Table::create(folder, "gauges.csv", gauges)?,
            iterations: Table::create(folder, "newton.csv", ITERATION_COLUMNS)?,
        })
    }

    /// Adds an iteration of the load stage.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn iteration(&mut self, record: &IterationRecord) -> Result<(), ResultsError> {
        self.iterations.row([
            record.step.to_string(),
            record.attempt.to_string(),
            record.iteration.to_string(),
            number(record.lambda),
            number(record.residual),
            number(record.criterion),
            number(record.line_search),
        ])
    }

    /// Adds an accepted step with the readings of all gauges.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`], also when forces or readings do not match the columns.
    pub fn step(&mut self, row: &StepRow, readings: &[f64]) -> Result<(), ResultsError> {
        self.steps.row(row.cells())?;
        let measured = [row.deflection_mm, row.load_kn];
        self.gauges
            .row(measured.iter().chain(readings).copied().map(number))?;
        self.flush()
    }

    /// Ends what an earlier run left: from here on rows are new.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn settle(&mut self) -> Result<(), ResultsError> {
        self.tables().into_iter().try_for_each(Table::settle)
    }

    /// Hands everything so far to the system.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn flush(&mut self) -> Result<(), ResultsError> {
        self.tables().into_iter().try_for_each(Table::flush)
    }

    /// All tables, that of the steps last: what it holds, the others hold.
    const fn tables(&mut self) -> [&mut Table; 3] {
        [&mut self.iterations, &mut self.gauges, &mut self.steps]
    }
}

#[cfg(test)]
mod tests {
    //! Protects the tables against interruption: what was accepted is on disk before the next step.
    use super::*;
    use std::fs;

    fn row(step: usize, load_kn: f64) -> StepRow {
        StepRow {
            step,
            load_kn,
            deflection_mm: 0.1 * step as f64,
            reactions_kn: vec![0.5 * load_kn; 2],
            loads_kn: vec![load_kn],
            residual: 5e-4,
            criterion: 1e-3,
            iterations: 3,
            attempts: 1,
            negative_pivots: Some(0),
            ..StepRow::default()
        }
    }

    fn history(folder: &Folder) -> History {
        let forces = ["reaction_x610_kn", "reaction_x2440_kn", "load_x1525_kn"].map(str::to_owned);
        History::create(folder, &forces, &["stirrup_x1650_strain".to_owned()]).unwrap()
    }

    #[test]
    fn every_accepted_step_is_readable_while_the_run_goes_on() {
        let root = tempfile::tempdir().unwrap();
        let folder = Folder::create(root.path(), "beam").unwrap();
        let mut history = history(&folder);
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
        assert_eq!(read("history.csv").lines().count(), 1);

        history.step(&row(0, 0.0), &[0.0]).unwrap();
        let iteration = IterationRecord {
            step: 1,
            attempt: 1,
            iteration: 0,
            lambda: 0.1,
            residual: f64::INFINITY,
            criterion: 1e-3,
            line_search: 1.0,
        };
        history.iteration(&iteration).unwrap();
        let step = StepRow {
            p_star_kn: Some(20.25),
            negative_pivots: None,
            ..row(1, 20.0)
        };
        history.step(&step, &[1.5e-5]).unwrap();

        let expected = "step,deflection_mm,load_kn,p_star_kn,reaction_x610_kn,reaction_x2440_kn,load_x1525_kn,\
                        negative_pivots,critical,residual,criterion,iterations,attempts,held,flagged,step_mm,kinetic_share,\
                        viscous_share,factorisations,force_evaluations\n\
                        0,0,0,,0,0,0,0,,0.0005,0.001,3,1,0,0,0,,,0,0\n\
                        1,0.1,20,20.25,10,10,20,,,0.0005,0.001,3,1,0,0,0,,,0,0\n";
        assert_eq!(read("history.csv"), expected);
        assert_eq!(
            read("gauges.csv"),
            "deflection_mm,load_kn,stirrup_x1650_strain\n0,0,0\n0.1,20,1.5e-5\n"
        );
        assert_eq!(
            read("newton.csv").lines().nth(1),
            Some("1,1,0,0.1,,0.001,1")
        );
    }

    #[test]
    fn a_row_that_does_not_match_its_columns_is_refused() {
        let root = tempfile::tempdir().unwrap();
        let folder = Folder::create(root.path(), "beam").unwrap();
        let mut history = history(&folder);
        let error = history.step(&row(1, 1.0), &[]).unwrap_err();
        assert!(error.to_string().contains("gauges.csv"), "{error}");
    }
}
