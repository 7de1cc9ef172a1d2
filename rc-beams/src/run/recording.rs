//! Writes what a run says while it runs.

use std::io;
use std::time::{Duration, Instant};

use fe_core::model::Model;
use fe_core::output::FieldSeries;
use fe_solver::journal::Entry;
use fe_solver::recorder::{Continue, IterationRecord, StepView};

use super::watch::Watch;
use crate::analysis::{Observer, Reading, Snapshot};
use crate::build::{Beam, Gauge};
use crate::options::Fields;
use crate::output::OutputError;
use crate::results::checkpoint::Checkpoint;
use crate::results::error::ResultsError;
use crate::results::evidence::Layout;
use crate::results::folder::Folder;
use crate::results::history::{History, StepRow};
use crate::results::interrupt::Interrupt;
use crate::results::progress::{Board, Progress, Status};

/// Tables, fields and live progress of one beam.
pub(super) struct Recording<'a> {
    beam: &'a Beam,
    folder: Folder,
    checkpoint: Checkpoint,
    /// Whether steps of an earlier run are accepted again.
    resuming: bool,
    history: History,
    gauges: Vec<Gauge>,
    watch: Watch,
    fields: Fields,
    /// Where fields are written. Its thread lives as long as this, so that its time is counted.
    series: Option<FieldSeries>,
    progress: Progress,
    interrupt: &'a Interrupt,
    criterion: f64,
    spent: Duration,
}

impl<'a> Recording<'a> {
    pub(super) fn start(
        (board, name): (&Board, &str),
        (beam, layout): (&'a Beam, &Layout),
        (folder, checkpoint): (&Folder, Checkpoint),
        fields: Fields,
        plan: (f64, f64),
        interrupt: &'a Interrupt,
    ) -> Result<Self, ResultsError> {
        let measures = &beam.measures;
        let reactions = measures.supports.iter().map(|s| ("reaction", s.x));
        let loads = measures.loads.iter().map(|l| ("load", l.x));
        let forces: Vec<String> = reactions
            .chain(loads)
            .map(|(what, x)| format!("{what}_x{x}_kn"))
            .collect();
        let gauges: Vec<String> = beam.gauges.iter().map(|g| g.name.clone()).collect();
        // The fields of single states are written in the end; until then those of an earlier run stay.
        let series = (fields == Fields::All)
            .then(|| series(folder))
            .transpose()?;
        let (until_mm, criterion) = plan;
        Ok(Self {
            beam,
            folder: folder.clone(),
            resuming: checkpoint.records() > 0,
            checkpoint,
            history: History::create(folder, &forces, &gauges)?,
            gauges: beam.gauges.clone(),
            watch: Watch::start(beam, layout, folder)?,
            fields,
            series,
            progress: Progress::start(board, name, until_mm),
            interrupt,
            criterion,
            spent: Duration::ZERO,
        })
    }

    /// Says something that stays on the terminal.
    pub(super) fn note(&self, text: &str) {
        self.progress.note(text);
    }

    /// Whether steps of an earlier run are still being accepted again.
    pub(super) const fn is_resuming(&self) -> bool {
        self.resuming
    }

    /// Writes the fields of the given states of a model, unless every step has been recorded, and waits for what is not
    /// written yet. Returns the wall time spent on output.
    pub(super) fn finish(
        &mut self,
        model: &Model,
        states: &[&Snapshot],
    ) -> Result<Duration, ResultsError> {
        let begin = Instant::now();
        let refused = |source| refused(&self.folder, source);
        if self.fields == Fields::Last {
            // An interruption wrote those of its last step.
            self.folder.remove_fields()?;
            let series = self.series.insert(series(&self.folder)?);
            for s in states {
                series
                    .record(s.deflection_mm, model, &s.displacement, &s.state)
                    .map_err(refused)?;
            }
        }
        if let Some(series) = &mut self.series {
            series.flush().map_err(refused)?;
        }
        self.progress.finish();
        Ok(self.spent + begin.elapsed())
    }

    /// The evidence gathered.
    pub(super) const fn watch(&self) -> &Watch {
        &self.watch
    }

    fn record(&mut self, view: &StepView<'_>, reading: &Reading, step: usize) -> io::Result<()> {
        let begin = Instant::now();
        let stage = view.stage;
        let row = StepRow {
            step,
            deflection_mm: reading.deflection_mm,
            load_kn: reading.load_kn,
            p_star_kn: (step > 0).then_some(reading.work_conjugate_load_kn),
            reactions_kn: reading.reactions_kn.clone(),
            loads_kn: reading.loads_kn.clone(),
            negative_pivots: view.negative_pivots,
            critical: view.critical,
            residual: view.residual,
            criterion: self.criterion,
            iterations: view.iterations,
            attempts: view.attempts,
            held: view.held,
            flagged: view.flagged,
            step_mm: if step > 0 { view.increment } else { 0.0 },
            kinetic: view.kinetic,
            viscous: view.viscous,
            factorisations: stage.counters().factorisations,
            force_evaluations: stage.counters().force_evaluations,
        };
        let model = stage.model();
        // A beam that is strengthened under load has no strain of its sheets before.
        let complete = model.elements().len() == self.beam.model.elements().len();
        let strains = self
            .gauges
            .iter()
            .map(|g| {
                if g.is_on_sheet() && !complete {
                    Ok(f64::NAN)
                } else {
                    g.read(model, stage.displacement(), stage.state())
                }
            })
            .collect::<Result<Vec<f64>, _>>()
            .map_err(io::Error::other)?;
        self.history.step(&row, &strains)?;
        if let Some(series) = &mut self.series {
            let u = stage.displacement();
            series
                .record(reading.deflection_mm, model, u, stage.state())
                .map_err(io::Error::other)?;
        }
        for event in self.watch.step(self.beam, stage, step, reading)? {
            if !self.resuming {
                self.progress.note(&event.to_string());
            }
        }
        self.progress.step(Status {
            step,
            deflection_mm: reading.deflection_mm,
            load_kn: reading.load_kn,
            iterations: view.iterations,
            flagged: view.flagged,
        });
        self.spent += begin.elapsed();
        Ok(())
    }
}

fn series(folder: &Folder) -> Result<FieldSeries, ResultsError> {
    FieldSeries::create(folder.path(), "fields").map_err(|source| refused(folder, source))
}

/// Fields that cannot be written.
fn refused(folder: &Folder, source: fe_core::output::OutputError) -> ResultsError {
    use fe_core::output::OutputError::Io;
    let kind = match &source {
        Io { source, .. } => source.kind(),
        _ => io::ErrorKind::Other,
    };
    ResultsError::Output(OutputError {
        path: folder.path().join("fields.pvd"),
        source: io::Error::new(kind, source),
    })
}

impl Observer for Recording<'_> {
    fn weight(&mut self, view: &StepView<'_>, reading: &Reading) -> io::Result<()> {
        self.record(view, reading, 0)
    }

    fn weighing(&mut self) -> io::Result<()> {
        self.interrupt.check()
    }

    fn iteration(&mut self, record: &IterationRecord) -> io::Result<()> {
        self.interrupt.check()?;
        self.progress.iteration(record.step, record.iteration);
        Ok(self.history.iteration(record)?)
    }

    fn recall(&mut self) -> io::Result<Option<Entry>> {
        let entry = self.checkpoint.recall()?;
        if entry.is_none() && self.resuming {
            self.resuming = false;
            self.checkpoint.settle()?;
            self.history.settle()?;
            self.watch.settle()?;
            let steps = self.checkpoint.records() - 1;
            self.progress.note(&format!("resumed after step {steps}"));
        }
        Ok(entry)
    }

    fn keep(&mut self, entry: &Entry) -> io::Result<()> {
        let begin = Instant::now();
        self.checkpoint.add(entry)?;
        self.spent += begin.elapsed();
        Ok(())
    }

    fn step(
        &mut self,
        view: &StepView<'_>,
        step: usize,
        reading: &Reading,
    ) -> io::Result<Continue> {
        self.record(view, reading, step)?;
        Ok(Continue::Yes)
    }

    fn note(&mut self, step: usize, text: &str) -> io::Result<()> {
        self.progress.note(&format!("step {step}: {text}"));
        Ok(())
    }

    fn bonded(&mut self, beam: &Beam) -> io::Result<()> {
        self.gauges.clone_from(&beam.gauges);
        self.progress.note("sheets bonded");
        Ok(())
    }
}
