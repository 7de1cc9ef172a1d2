//! The largest readings of one step.

use super::{DIAGONAL_DEG, EventKind, FLEXURAL_DEG, Reach, StepEvidence};
use crate::results::evidence::{ConcretePoint, Layout};
use crate::results::sheets::{Face, InterfacePoint, SheetPoint, SheetState, Zone};

/// Place of a point outside all shear spans.
const BETWEEN: &str = "outside the shear spans";

#[derive(Debug, Clone, Copy)]
struct Candidate<'a> {
    value: f64,
    amount: f64,
    position: [f64; 3],
    place: &'a str,
    face: Option<Face>,
}

/// Looks at the points of one accepted step, in any order.
#[derive(Debug)]
pub struct Survey<'a> {
    layout: &'a Layout,
    largest: [Option<Candidate<'a>>; EventKind::ALL.len()],
}

impl<'a> Survey<'a> {
    /// Nothing seen yet.
    pub fn new(layout: &'a Layout) -> Self {
        Self {
            layout,
            largest: [None; EventKind::ALL.len()],
        }
    }

    /// A point of the concrete in an element whose law has a crack-band width of `band_mm` (mm).
    pub fn concrete(&mut self, point: &ConcretePoint, band_mm: f64) {
        let span = self.layout.span_at(point.position[0]);
        let place = span.map_or(BETWEEN, |i| self.layout.shear_spans[i].name.as_str());
        let seen = |value| Candidate {
            value,
            amount: value,
            position: point.position,
            place,
            face: None,
        };
        let angle = point.inclination_deg();
        let width = point.crack_strain * band_mm;
        if angle <= FLEXURAL_DEG {
            self.offer(EventKind::FlexuralCrack, seen(width));
        } else if span.is_some() && DIAGONAL_DEG.contains(&angle) {
            self.offer(EventKind::DiagonalCrack, seen(width));
        }
        self.offer(EventKind::Crushing, seen(point.crushing));
        self.offer(EventKind::Crushed, seen(point.crushing));
    }

    /// A point of a stirrup, with its tensile and its yield stress (MPa).
    pub fn stirrup(&mut self, name: &'a str, position: [f64; 3], stress: f64, fy: f64) {
        self.steel(EventKind::StirrupYield, name, position, [stress, fy]);
    }

    /// A point of a longitudinal bar, with its tensile and its yield stress (MPa).
    pub fn bar(&mut self, name: &'a str, position: [f64; 3], stress: f64, fy: f64) {
        self.steel(EventKind::BarYield, name, position, [stress, fy]);
    }

    /// Sheets and their interface; `zones` names them.
    pub fn sheets(&mut self, zones: &'a [Zone], state: &SheetState) {
        let name = |zone: usize| zones.get(zone).map_or("sheet", |z| z.name.as_str());
        for point in &state.sheet {
            self.sheet(name(point.zone), point);
        }
        for point in &state.interface {
            self.interface(name(point.zone), point);
        }
    }

    /// What the step shows.
    pub fn finish(self, step: usize, deflection_mm: f64, load_kn: f64) -> StepEvidence {
        let reach = |c: Candidate<'_>| Reach {
            value: c.value,
            amount: c.amount,
            position: c.position,
            place: c
                .face
                .map_or_else(|| c.place.to_owned(), |face| format!("{}, {face}", c.place)),
        };
        StepEvidence {
            step,
            deflection_mm,
            load_kn,
            readings: self.largest.map(|c| c.map(reach)),
        }
    }

    fn steel(&mut self, kind: EventKind, place: &'a str, position: [f64; 3], [s, fy]: [f64; 2]) {
        self.offer(
            kind,
            Candidate {
                value: s / fy,
                amount: s,
                position,
                place,
                face: None,
            },
        );
    }

    fn sheet(&mut self, place: &'a str, point: &SheetPoint) {
        self.offer(
            EventKind::SheetRupture,
            Candidate {
                value: point.utilisation,
                amount: point.fibre_stress_mpa,
                position: point.position,
                place,
                face: Some(point.face),
            },
        );
    }

    fn interface(&mut self, place: &'a str, point: &InterfacePoint) {
        for (kind, limit) in [
            (EventKind::InterfaceStrength, point.s0_mm),
            (EventKind::Debonding, point.sf_mm),
        ] {
            let candidate = Candidate {
                value: point.slip_max_mm / limit,
                amount: point.slip_max_mm,
                position: point.position,
                place,
                face: Some(point.face),
            };
            self.offer(kind, candidate);
        }
    }

    /// Keeps the larger one; what is not a number never counts.
    fn offer(&mut self, kind: EventKind, new: Candidate<'a>) {
        let slot = &mut self.largest[kind as usize];
        if !new.value.is_nan() && slot.is_none_or(|old| new.value > old.value) {
            *slot = Some(new);
        }
    }
}
