//! What is looked at after every accepted step: events, sheets, energy.

use std::collections::BTreeMap;
use std::io;

use fe_core::energy::{self, Cracking};
use fe_core::model::{Model, ModelError};
use fe_core::state::StateStore;
use fe_solver::stage::Stage;

use super::sheets;
use crate::analysis::Reading;
use crate::build::{BarKind, Beam};
use crate::results::error::ResultsError;
use crate::results::events::{Event, EventLog, Survey};
use crate::results::evidence::{ConcretePoint, Layout};
use crate::results::folder::Folder;
use crate::results::sheets::{SheetLayout, SheetRow, SheetTable};
use crate::results::summary::{Energy, PartEnergy};

/// Parts of the energy balance.
const PARTS: [&str; 6] = [
    "concrete",
    "plates",
    "bars",
    "sheets",
    "adhesive",
    "interface",
];
/// Whole width in J per N mm of the half model.
const JOULE: f64 = 2e-3;

/// Evidence gathered along a path.
pub(super) struct Watch {
    layout: Layout,
    sheet_layout: SheetLayout,
    /// Part of every element.
    part: Vec<usize>,
    energies: Vec<energy::PartEnergy>,
    external_work: f64,
    cracking: Cracking,
    log: EventLog,
    table: Option<SheetTable>,
    rows: Vec<SheetRow>,
    /// Largest principal tension of cracked concrete over its strength, step by step under load.
    tension: Vec<f64>,
    /// Loads that pull and supports that hold down, step by step under load.
    backward: Vec<f64>,
}

impl Watch {
    pub(super) fn start(
        beam: &Beam,
        layout: &Layout,
        folder: &Folder,
    ) -> Result<Self, ResultsError> {
        let sheet_layout = sheets::layout(beam, layout);
        let table = match &beam.sheets {
            Some(_) => Some(SheetTable::create(folder, layout, &sheet_layout)?),
            None => None,
        };
        Ok(Self {
            layout: layout.clone(),
            sheet_layout,
            part: parts(beam),
            energies: Vec::new(),
            external_work: 0.0,
            cracking: Cracking::default(),
            log: EventLog::create(folder)?,
            table,
            rows: Vec::new(),
            tension: Vec::new(),
            backward: Vec::new(),
        })
    }

    /// Looks at the accepted state of a stage; the model of the stage may still lack the sheets of the beam.
    /// Returns what has happened for the first time.
    pub(super) fn step(
        &mut self,
        beam: &Beam,
        stage: &Stage<'_>,
        step: usize,
        reading: &Reading,
    ) -> io::Result<&[Event]> {
        let (model, u, state) = (stage.model(), stage.displacement(), stage.state());
        self.energies = stage.ledger().parts(&self.part, PARTS.len());
        self.external_work = stage.ledger().external_work();
        let at = (step, reading.deflection_mm, reading.load_kn);
        let mut survey = Survey::new(&self.layout);
        self.cracking.begin();
        let points = (&mut survey, &mut self.cracking);
        steel_and_concrete(beam, (model, u, state), points).map_err(io::Error::other)?;
        if step > 0 {
            let tension = self.cracking.largest_tension();
            self.tension.push(tension / beam.tensile_mpa);
            self.backward.push(reading.backward);
        }
        if let Some(record) = &beam.sheets {
            let present = model.elements().len() > record.membranes.start;
            let seen = if present {
                sheets::state(record, (model, u, state)).map_err(io::Error::other)?
            } else {
                crate::results::sheets::SheetState::default()
            };
            survey.sheets(&self.sheet_layout.zones, &seen);
            let row = SheetRow::of(&self.layout, &self.sheet_layout, &seen, at);
            if let Some(table) = &mut self.table {
                table.step(&row)?;
            }
            if step > 0 {
                self.rows.push(row);
            }
        }
        let (step, deflection_mm, load_kn) = at;
        let evidence = survey.finish(step, deflection_mm, load_kn);
        Ok(self.log.step(&evidence)?)
    }

    /// Ends what an earlier run left in the tables.
    pub(super) fn settle(&mut self) -> Result<(), ResultsError> {
        self.log.settle()?;
        self.table.as_mut().map_or(Ok(()), SheetTable::settle)
    }

    /// Measures of the sheets along a path of `steps` steps.
    pub(super) fn rows(&self, steps: usize) -> &[SheetRow] {
        last(&self.rows, steps)
    }

    /// Largest stress of sheets over their strength up to the step `peak` of a path of `steps` steps.
    pub(super) fn largest_utilisation(&self, steps: usize, peak: usize) -> f64 {
        let path = self.rows(steps).iter().take(peak + 1);
        path.map(|row| row.utilisation).fold(0.0, f64::max)
    }

    /// Largest principal tension of cracked concrete over its strength up to the step `peak` of a path of `steps` steps.
    pub(super) fn largest_tension(&self, steps: usize, peak: usize) -> f64 {
        let path = last(&self.tension, steps).iter();
        path.take(peak + 1).fold(0.0, |a, b| a.max(*b))
    }

    /// The share of all loads that pull up or are held down, see [`Reading::backward`], at the step `peak` of a path of `steps`
    /// steps.
    pub(super) fn backward(&self, steps: usize, peak: usize) -> f64 {
        let path = last(&self.backward, steps);
        path.get(peak).copied().unwrap_or_default()
    }

    pub(super) const fn sheet_layout(&self) -> &SheetLayout {
        &self.sheet_layout
    }

    /// Energy so far.
    pub(super) fn energy(&self) -> Energy {
        let mut parts = BTreeMap::new();
        for (name, part) in PARTS.iter().zip(&self.energies) {
            if part.work == 0.0 {
                continue;
            }
            let of = |work: f64, stored: f64, dissipated: f64| PartEnergy {
                work_j: JOULE * work,
                stored_j: JOULE * stored,
                dissipated_j: JOULE * dissipated,
            };
            let dissipated = part.dissipated();
            if *name == "concrete" {
                let cracking = self.cracking.dissipated();
                let crushing = dissipated - cracking;
                parts.insert("concrete_cracking".into(), of(cracking, 0.0, cracking));
                let rest = of(part.work - cracking, part.stored, crushing);
                parts.insert("concrete_crushing".into(), rest);
            } else {
                parts.insert((*name).into(), of(part.work, part.stored, dissipated));
            }
        }
        Energy::new(JOULE * self.external_work, parts)
    }
}

/// The last rows: those before the sheets were bonded do not belong to the path.
fn last<T>(rows: &[T], count: usize) -> &[T] {
    &rows[rows.len().saturating_sub(count)..]
}

/// Part of every element.
fn parts(beam: &Beam) -> Vec<usize> {
    let mut part = vec![0; beam.model.elements().len()];
    let mut assign = |range: std::ops::Range<usize>, p: usize| part[range].fill(p);
    assign(beam.plates.clone(), 1);
    for bar in &beam.bars {
        assign(bar.elements.clone(), 2);
        assign(bar.bond.clone(), 5);
    }
    if let Some(sheets) = &beam.sheets {
        assign(sheets.membranes.clone(), 3);
        assign(sheets.adhesive.clone(), 4);
        assign(sheets.interfaces.clone(), 5);
    }
    part
}

fn steel_and_concrete<'a>(
    beam: &'a Beam,
    (model, u, state): (&Model, &[f64], &StateStore),
    (survey, cracking): (&mut Survey<'a>, &mut Cracking),
) -> Result<(), ModelError> {
    for (e, &band) in beam.concrete.clone().zip(&beam.bands) {
        model.sample(e, u, state, &mut |s| {
            cracking.point(&s);
            survey.concrete(&ConcretePoint::from(&s), band);
        })?;
    }
    for bar in &beam.bars {
        let (name, fy) = (bar.name.as_str(), bar.fy_mpa);
        for e in bar.elements.clone() {
            model.sample(e, u, state, &mut |s| match bar.kind {
                BarKind::Longitudinal => survey.bar(name, s.position, s.stress[0], fy),
                BarKind::StirrupLeg(_) => survey.stirrup(name, s.position, s.stress[0], fy),
                BarKind::Tie => {}
            })?;
        }
    }
    Ok(())
}
