//! Finds events and writes `events.csv`.

use super::{Event, EventKind, StepEvidence};
use crate::results::error::ResultsError;
use crate::results::folder::Folder;
use crate::results::table::{Table, number};

const COLUMNS: [&str; 9] = [
    "event",
    "step",
    "deflection_mm",
    "load_kn",
    "x_mm",
    "y_mm",
    "z_mm",
    "where",
    "detail",
];

/// `events.csv` of one run: a row is on disk as soon as the event has happened.
#[derive(Debug)]
pub struct EventLog {
    table: Table,
    events: Vec<Event>,
}

impl EventLog {
    /// Starts the table.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn create(folder: &Folder) -> Result<Self, ResultsError> {
        Ok(Self {
            table: Table::create(folder, "events.csv", COLUMNS)?,
            events: Vec::new(),
        })
    }

    /// Everything so far, in the order of time.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Ends what an earlier run left: from here on rows are new.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn settle(&mut self) -> Result<(), ResultsError> {
        self.table.settle()
    }

    /// Takes the evidence of an accepted step; returns and writes what happens for the first time.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Output`].
    pub fn step(&mut self, evidence: &StepEvidence) -> Result<&[Event], ResultsError> {
        let before = self.events.len();
        for kind in EventKind::ALL {
            let known = self.events.iter().any(|e| e.kind == kind);
            let reach = evidence
                .reading(kind)
                .filter(|r| !known && kind.is_reached(r.value));
            if let Some(reach) = reach {
                self.events.push(Event {
                    kind,
                    step: evidence.step,
                    deflection_mm: evidence.deflection_mm,
                    load_kn: evidence.load_kn,
                    reach: reach.clone(),
                });
            }
        }
        for event in &self.events[before..] {
            self.table.row(cells(event))?;
        }
        if self.events.len() > before {
            self.table.flush()?;
        }
        Ok(&self.events[before..])
    }
}

fn cells(event: &Event) -> [String; COLUMNS.len()] {
    let [x, y, z] = event.reach.position;
    [
        event.kind.key().to_owned(),
        event.step.to_string(),
        number(event.deflection_mm),
        number(event.load_kn),
        number(x),
        number(y),
        number(z),
        event.reach.place.clone(),
        event.kind.detail(event.reach.amount),
    ]
}
