//! Fibre sheets lie on free faces of the beam, apart from each other, and gauges on them.

use super::edges::LEAST;
use super::{ALONG, Checks, TOLERANCE};
use crate::column::{GAUGE_COLUMNS, TEST_SPAN, bar_gauge};
use crate::spec::sheets::{Cover, Face, SheetGauge, Stretch, Wrap};

const FACE: &str = "on the side, from_mm and to_mm are heights above the soffit; on soffit and top, \
                    distances from the middle of the width";

/// A rectangle of sheet on a face.
struct Patch<'a> {
    /// The field of the cover.
    path: String,
    stretch: &'a Stretch,
    cover: &'a Cover,
}

impl Patch<'_> {
    /// Whether two covers of one face lie on the same place, or would after moving by less than `gap` (mm). Stretches of one
    /// cover are compared where their order is checked.
    fn meets(&self, other: &Self, gap: f64) -> bool {
        let wide = |(from, to): (f64, f64)| (from - gap, to + gap);
        self.path != other.path
            && self.cover.face == other.cover.face
            && overlap(wide(self.along()), other.along())
            && overlap(wide(self.across()), other.across())
    }

    /// Whether a point (mm) of the face lies on the patch.
    fn holds(&self, x: f64, across: f64) -> bool {
        let within = |at, (from, to)| from - TOLERANCE <= at && at <= to + TOLERANCE;
        within(x, self.along()) && within(across, self.across())
    }

    fn along(&self) -> (f64, f64) {
        (self.stretch.x_from_mm.get(), self.stretch.x_to_mm.get())
    }

    fn across(&self) -> (f64, f64) {
        (self.cover.from_mm.get(), self.cover.to_mm.get())
    }
}

/// Whether two intervals share more than an end.
fn overlap(a: (f64, f64), b: (f64, f64)) -> bool {
    a.0 < b.1 - TOLERANCE && b.0 < a.1 - TOLERANCE
}

impl Checks<'_> {
    /// Of a beam known to be `supported` as it may, sheets are clear of the plates.
    pub(super) fn sheets(&mut self, supported: bool) {
        let specimen = self.specimen;
        let mut patches = Vec::new();
        let mut laid = true;
        if let Some(sheets) = &specimen.sheets {
            self.at_least_one("sheets.wraps", "wraps", sheets.wraps.len());
            for (i, wrap) in sheets.wraps.iter().enumerate() {
                let path = format!("sheets.wraps[{i}]");
                let before = &sheets.wraps[..i];
                let mut others = vec![TEST_SPAN.to_owned()];
                others.extend(before.iter().flat_map(Wrap::sheet_names));
                let before = before.iter().map(|w| &w.name);
                if self.named_once(&path, ("wraps", &wrap.name), before) {
                    wrap.sheet_names()
                        .all(|name| self.named_once(&path, ("sheets", &name), others.iter()));
                }
                laid &= self.passes(|c| c.wrap(&path, wrap));
                for (k, cover) in wrap.faces.iter().enumerate() {
                    let path = format!("{path}.faces[{k}]");
                    patches.extend(wrap.stretches.iter().map(|stretch| Patch {
                        path: path.clone(),
                        stretch,
                        cover,
                    }));
                }
            }
            let alone = laid && self.passes(|c| c.covered_once(&patches));
            if alone && supported && self.passes(|c| c.clear_of_plates(&sheets.wraps)) {
                laid &= self.passes(|c| c.sheet_edges(&sheets.wraps));
            }
        } else if specimen.staged.is_some() {
            self.report(
                "staged",
                "sheets bonded under load, but no sheets; allowed: with `sheets` only",
                "write `staged: None`, or give the sheets",
            );
        }
        let gauges = &specimen.measuring.sheet_gauges;
        let others = specimen.bar_gauges().map(|(bar, x)| bar_gauge(bar, x));
        let others: Vec<String> = others.chain(GAUGE_COLUMNS.map(str::to_owned)).collect();
        for (i, gauge) in gauges.iter().enumerate() {
            let path = format!("measuring.sheet_gauges[{i}]");
            let before = gauges[..i].iter().map(|g| &g.name).chain(&others);
            self.named_once(&path, ("gauges", &gauge.name), before);
            self.gauge(&path, gauge, laid.then_some(&patches));
        }
    }

    fn at_least_one(&mut self, path: &str, what: &str, count: usize) {
        if count == 0 {
            let message = format!("{what}: 0; allowed: at least 1");
            self.report(path, message, "give one, or remove what would hold it");
        }
    }

    fn wrap(&mut self, path: &str, wrap: &Wrap) {
        let (stretches, faces) = (&wrap.stretches, &wrap.faces);
        self.at_least_one(&format!("{path}.stretches"), "stretches", stretches.len());
        self.at_least_one(&format!("{path}.faces"), "faces", faces.len());
        let length = self.length();
        let mut least = 0.0;
        for (i, stretch) in stretches.iter().enumerate() {
            let path = format!("{path}.stretches[{i}]");
            let (from, to) = (stretch.x_from_mm.get(), stretch.x_to_mm.get());
            let left = ("left end of the stretch", from);
            let right = ("right end of the stretch", to);
            let on_beam = least..=length.max(least);
            let behind =
                "stretches lie on the beam, each behind the one to its left with a gap between";
            let end = format!("{path}.x_to_mm");
            let fits = self
                .passes(|c| c.within(format!("{path}.x_from_mm"), left, on_beam, behind))
                && self.passes(|c| c.within(&end, right, 0.0..=length, ALONG))
                && self.passes(|c| c.ascending(&end, from, to));
            if !fits {
                break;
            }
            least = to + LEAST;
        }
        for (i, cover) in faces.iter().enumerate() {
            self.cover(&format!("{path}.faces[{i}]"), cover);
        }
    }

    /// No sheet lies between a plate, or a stub, and the face it stands on. A plate and a stretch are told once each.
    fn clear_of_plates(&mut self, wraps: &[Wrap]) {
        let specimen = self.specimen;
        let below = specimen.supports.iter();
        let below = below.map(|s| (Face::Soffit, "support", s.x_mm, &s.plate));
        let above = specimen.loads.iter();
        let above = above.map(|load| (Face::Top, "load", load.x_mm, &load.plate));
        let mut plates: Vec<_> = below.chain(above).collect();
        for (i, wrap) in wraps.iter().enumerate() {
            for (k, stretch) in wrap.stretches.iter().enumerate() {
                let sheet = (stretch.x_from_mm.get(), stretch.x_to_mm.get());
                let ends =
                    |centre: f64, length: f64| (centre - 0.5 * length, centre + 0.5 * length);
                let across = plates.iter().position(|(face, _, centre, plate)| {
                    wrap.faces.iter().any(|cover| cover.face == *face)
                        && overlap(sheet, ends(centre.get(), plate.length_mm.get()))
                });
                let Some(at) = across else { continue };
                let (face, what, centre, plate) = plates.remove(at);
                let ((from, to), (left, right)) =
                    (sheet, ends(centre.get(), plate.length_mm.get()));
                self.report(
                    format!("sheets.wraps[{i}].stretches[{k}]"),
                    format!(
                        "sheet on the {face:?} face from {from} to {to} mm, across the {what}; allowed: up to \
                         {left} mm or from {right} mm"
                    ),
                    "end the stretch at the plate and begin another behind it",
                );
            }
        }
    }

    fn cover(&mut self, path: &str, cover: &Cover) {
        let width = match cover.face {
            Face::Side => self.height(),
            Face::Soffit | Face::Top => self.half_width(),
        };
        let (from, to) = (cover.from_mm.get(), cover.to_mm.get());
        let edge = ("edge of the sheet", to);
        self.within(format!("{path}.to_mm"), edge, 0.0..=width, FACE);
        self.ascending(format!("{path}.to_mm"), from, to);
        let plies = cover.angles_deg.len();
        self.at_least_one(&format!("{path}.angles_deg"), "plies", plies);
        let whole = 2.0 * (to - from).max(0.0);
        if let Some(overlap) = cover.overlap_mm
            && overlap.get() > whole + TOLERANCE
        {
            let overlap = overlap.get();
            self.report(
                format!("{path}.overlap_mm"),
                format!("sheet lies twice over {overlap} mm; allowed: up to {whole} mm, its width"),
                "write another ply if the sheet lies twice everywhere",
            );
        }
    }

    fn covered_once(&mut self, patches: &[Patch]) {
        let mut reported = "";
        for (i, patch) in patches.iter().enumerate() {
            if patch.path == reported {
                continue;
            }
            let (face, (from, to)) = (patch.cover.face, patch.along());
            let found = |gap| patches[..i].iter().find(|other| patch.meets(other, gap));
            if let Some(other) = found(0.0) {
                self.report(
                    &patch.path,
                    format!(
                        "{face:?} face covered twice between {from} and {to} mm, also by {}; allowed: once",
                        other.path
                    ),
                    "list all plies of a place in one `angles_deg`",
                );
                reported = &patch.path;
            } else if let Some(other) = found(LEAST) {
                self.report(
                    &patch.path,
                    format!(
                        "sheet on the {face:?} face between {from} and {to} mm touches {}; allowed: {LEAST} mm between them, or more",
                        other.path
                    ),
                    "make one sheet of the two, or leave a gap",
                );
                reported = &patch.path;
            }
        }
    }

    /// With `patches` that are known, gauges lie on them.
    fn gauge(&mut self, path: &str, gauge: &SheetGauge, patches: Option<&Vec<Patch>>) {
        let (x, y, z) = (gauge.x_mm.get(), gauge.y_mm.get(), gauge.z_mm.get());
        let half = self.half_width();
        let side = "gauges are on the side face, half of the width from its middle";
        self.within(format!("{path}.z_mm"), ("gauge", z), half..=half, side);
        let Some(patches) = patches else { return };
        let mut sides = patches.iter().filter(|p| p.cover.face == Face::Side);
        let Some(sheet) = sides.find(|p| p.holds(x, y)) else {
            self.report(
                format!("{path}.x_mm"),
                format!(
                    "no sheet at x = {x} mm, y = {y} mm; allowed: where a sheet covers the side"
                ),
                "move the gauge onto a sheet, for instance to the middle of the nearest strip",
            );
            return;
        };
        let length = gauge.gauge_length_mm.get();
        for (x, y) in gauge.ends() {
            if !sheet.holds(x, y) {
                self.report(
                    format!("{path}.gauge_length_mm"),
                    format!("a gauge of {length} mm ends at x = {x:.1} mm, y = {y:.1} mm, off its sheet; allowed: ends on the sheet"),
                    "shorten the gauge, turn it along the sheet, or move it",
                );
                return;
            }
        }
    }
}
