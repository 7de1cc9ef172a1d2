//! Edges of plates and sheets lie on other lines of the mesh, or clear of them: elements between the two would be as thin as the
//! distance.

use super::{Checks, TOLERANCE};
use crate::spec::sheets::{Face, Wrap};

/// Least distance (mm) between an edge of a sheet and another line of the mesh; assumed. A row of 0.1 mm on a side of 305 mm
/// moves a peak by several percent, and interfaces that touch would meet in nodes that lie in one place and are not one.
pub(super) const LEAST: f64 = 3.0;

/// A line of the mesh.
#[derive(Clone, Copy)]
struct Line {
    /// Where it lies (mm).
    at: f64,
    /// What it is.
    what: &'static str,
    /// The plate it belongs to.
    plate: Option<usize>,
}

/// A line of no plate.
const fn line(at: f64, what: &'static str) -> Line {
    Line {
        at,
        what,
        plate: None,
    }
}

const THIN: &str =
    "elements between the two would be as thin as that: move one onto the other, or apart";
const END: &str = "end of the beam";
const BEAM: &str = "edge of the beam";
const MIDDLE: &str = "middle of the width";
const SHEET: &str = "edge of a sheet";

impl Checks<'_> {
    /// Lines of the mesh along the beam that plates and ends of the beam make.
    fn lines_along(&self) -> Vec<Line> {
        let mut along: Vec<Line> = [0.0, self.length()].map(|x| line(x, END)).into();
        for (plate, (x, length)) in self.specimen.plates().enumerate() {
            let ends = [x - 0.5 * length, x + 0.5 * length].map(|x| line(x, "edge of a plate"));
            let all = ends.into_iter().chain([line(x, "middle of a plate")]);
            along.extend(all.map(|line| Line {
                plate: Some(plate),
                ..line
            }));
        }
        along
    }

    /// Of plates that are known to lie on the beam, apart from each other. Each is told once.
    pub(super) fn plate_edges(&mut self) {
        let lines = self.lines_along();
        let supports = self.specimen.supports.len();
        let mut told = Vec::new();
        for (i, one) in lines.iter().enumerate() {
            for other in &lines[..i] {
                let off = (one.at - other.at).abs();
                let clear = off <= TOLERANCE || off >= LEAST - TOLERANCE;
                let (Some(plate), false) = (one.plate, clear) else {
                    continue;
                };
                let known = |p: &Option<usize>| p.is_some_and(|p| told.contains(&p));
                if one.plate == other.plate || known(&one.plate) || known(&other.plate) {
                    continue;
                }
                let path = match plate.checked_sub(supports) {
                    None => format!("supports[{plate}].x_mm"),
                    Some(load) => format!("loads[{load}].x_mm"),
                };
                let (at, what, line, beside) = (one.at, one.what, other.at, other.what);
                self.report(
                    path,
                    format!(
                        "{what} at {at} mm, {off:.3} mm from the {beside} at {line} mm; allowed: on it, or {LEAST} mm from it \
                         or more"
                    ),
                    THIN,
                );
                told.extend([Some(plate), other.plate].into_iter().flatten());
            }
        }
    }

    /// Of sheets and plates that are known to be as they may.
    pub(super) fn sheet_edges(&mut self, wraps: &[Wrap]) {
        let mut along = self.lines_along();
        let mut up: Vec<Line> = [0.0, self.height()].map(|y| line(y, BEAM)).into();
        let mut across = vec![line(0.0, MIDDLE), line(self.half_width(), BEAM)];
        for wrap in wraps {
            for s in &wrap.stretches {
                along.extend([s.x_from_mm, s.x_to_mm].map(|x| line(x.get(), SHEET)));
            }
            for cover in &wrap.faces {
                let lines = match cover.face {
                    Face::Side => &mut up,
                    Face::Soffit | Face::Top => &mut across,
                };
                lines.extend([cover.from_mm, cover.to_mm].map(|at| line(at.get(), SHEET)));
            }
        }
        for (i, wrap) in wraps.iter().enumerate() {
            for (k, s) in wrap.stretches.iter().enumerate() {
                let path = format!("sheets.wraps[{i}].stretches[{k}]");
                let (from, to) = (s.x_from_mm.get(), s.x_to_mm.get());
                if self.passes(|c| c.clear_of(&mut along, format!("{path}.x_from_mm"), from)) {
                    self.clear_of(&mut along, format!("{path}.x_to_mm"), to);
                }
            }
            for (k, cover) in wrap.faces.iter().enumerate() {
                let path = format!("sheets.wraps[{i}].faces[{k}]");
                let lines = match cover.face {
                    Face::Side => &mut up,
                    Face::Soffit | Face::Top => &mut across,
                };
                self.clear_of(lines, format!("{path}.from_mm"), cover.from_mm.get());
                self.clear_of(lines, format!("{path}.to_mm"), cover.to_mm.get());
            }
        }
    }

    /// Reports an edge that is not quite on another line; a plate is told once.
    fn clear_of(&mut self, lines: &mut Vec<Line>, path: String, at: f64) {
        let off = |line: &&Line| (line.at - at).abs();
        // Of two sheets, the right or upper one is told.
        let others = lines
            .iter()
            .filter(|line| off(line) > TOLERANCE && !(line.what == SHEET && line.at > at));
        let nearest = others.min_by(|a, b| off(a).total_cmp(&off(b)));
        let nearest = nearest.filter(|line| off(line) < LEAST - TOLERANCE);
        if let Some(&Line {
            at: line,
            what,
            plate,
        }) = nearest
        {
            let off = (line - at).abs();
            self.report(
                path,
                format!(
                    "edge of the sheet at {at} mm, {off:.3} mm from the {what} at {line} mm; allowed: on it, or {LEAST} mm from \
                     it or more"
                ),
                THIN,
            );
            lines.retain(|line| plate.is_none() || line.plate != plate);
        }
    }
}
