//! Sheets and interface seen from the side, as pictures.

use plotters::element::{PathElement, Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::Color;

use super::{Face, MapKind, MapRow, MapState, Zone};
use crate::results::drawing::{Area, Drawn, Picture, draw_heading, line, outline, text, units};
use crate::results::palette::{GREY, INK, SKY_BLUE, sequential};
use crate::results::side_view::{ColourScale, Corners, Frame, SIDE, WIDTH};

/// Quantity of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// Slip of the interface: `slip.svg`.
    Slip,
    /// Stress along the fibres of the sheets: `sheet.svg`.
    FibreStress,
}

impl Shown {
    /// Name of the file without `.svg`.
    pub const fn file(self) -> &'static str {
        match self {
            Self::Slip => "slip",
            Self::FibreStress => "sheet",
        }
    }

    /// Title of the picture of the peak (kN, mm).
    pub fn title(self, load_kn: f64, deflection_mm: f64) -> String {
        let what = match self {
            Self::Slip => "slip between sheets and concrete",
            Self::FibreStress => "fibre stress of the sheets",
        };
        format!("{what} at the peak, {load_kn:.1} kN at {deflection_mm:.2} mm")
    }

    /// Whether there are points to show on the side: none have a slip with perfect bond.
    pub fn is_in(self, rows: &[MapRow]) -> bool {
        let shown = (self.kind(), Face::Side);
        rows.iter().any(|row| (row.kind, row.face) == shown)
    }

    const fn label(self) -> &'static str {
        match self {
            Self::Slip => "slip [mm]",
            Self::FibreStress => "fibre stress [MPa]",
        }
    }

    const fn kind(self) -> MapKind {
        match self {
            Self::Slip => MapKind::Interface,
            Self::FibreStress => MapKind::Sheet,
        }
    }

    const fn value(self, row: &MapRow) -> Option<f64> {
        match self {
            Self::Slip => row.slip_mm,
            Self::FibreStress => row.fibre_stress_mpa,
        }
    }
}

/// Side view of the side face, x to the right and y up, in mm. Only the rows of `sheet_map.csv` are
/// needed; without zones their outlines follow from the points.
#[derive(Debug, Clone, Copy)]
pub struct SheetView<'a> {
    /// Name of the specimen.
    pub specimen: &'a str,
    /// Which state is shown.
    pub title: &'a str,
    /// Quantity.
    pub shown: Shown,
    /// State.
    pub state: MapState,
    /// Rows of `sheet_map.csv`.
    pub rows: &'a [MapRow],
    /// Strips and sheets.
    pub zones: &'a [Zone],
    /// Outlines of elements: lower left and upper right corner.
    pub elements: &'a [[[f64; 2]; 2]],
    /// Where supports hold.
    pub supports: &'a [[f64; 2]],
    /// Where loads push down.
    pub loads: &'a [[f64; 2]],
}

/// The part of a face that a point stands for.
struct Cell<'a> {
    corners: Corners,
    value: f64,
    row: &'a MapRow,
}

impl Picture for SheetView<'_> {
    fn size(&self) -> (u32, u32) {
        self.frame(&self.outlines(&self.cells())).size()
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Drawn<DB> {
        draw_heading(area, self.specimen, self.title, "")?;
        let cells = self.cells();
        let outlines = self.outlines(&cells);
        let frame = self.frame(&outlines);
        frame.draw_elements(area, self.elements)?;
        let values = cells.iter().map(|c| c.value);
        let scale = ColourScale::linear(values.fold(0.0, f64::max));
        for cell in cells.iter().filter(|c| c.value > 0.0) {
            let corners = cell.corners.map(|c| frame.at(c));
            let colour = sequential(scale.share(cell.value));
            area.draw(&Rectangle::new(corners, colour.filled()))?;
        }
        for cell in cells.iter().filter(|c| c.row.debonded == Some(1)) {
            hatch(area, cell.corners.map(|c| frame.at(c)))?;
        }
        for corners in outlines {
            area.draw(&outline(corners.map(|c| frame.at(c)), line(INK, 1.0)))?;
        }
        frame.draw_conditions(area, self.supports, self.loads)?;
        frame.draw_axis(area)?;
        let y = frame.legend_y();
        draw_legend(area, self.shown, y)?;
        scale.draw_bar(area, self.shown.label(), WIDTH - SIDE, y)
    }
}

impl SheetView<'_> {
    fn frame(&self, outlines: &[Corners]) -> Frame {
        Frame::of(&[self.elements, outlines].concat())
    }

    /// Cells of the side face: bounded midway between the rows and columns of points of a zone, beyond
    /// the outer ones by half the smallest distance.
    fn cells(&self) -> Vec<Cell<'_>> {
        let shown = |row: &&MapRow| {
            (row.state, row.kind, row.face) == (self.state, self.shown.kind(), Face::Side)
        };
        let mut zones: Vec<(&str, Vec<&MapRow>)> = Vec::new();
        for row in self.rows.iter().filter(shown) {
            match zones.iter_mut().find(|(name, _)| *name == row.zone) {
                Some((_, rows)) => rows.push(row),
                None => zones.push((&row.zone, vec![row])),
            }
        }
        let mut cells = Vec::new();
        for (_, rows) in zones {
            let columns = places(rows.iter().map(|r| r.x_mm));
            let lines = places(rows.iter().map(|r| r.y_mm));
            for row in rows {
                let (Some(value), x, y) = (
                    self.shown.value(row),
                    interval(&columns, row.x_mm),
                    interval(&lines, row.y_mm),
                ) else {
                    continue;
                };
                let zone = self.zones.iter().find(|z| z.name == row.zone);
                let [x, y] = zone.map_or([x, y], |z| [within(x, z.x_mm), within(y, z.y_mm)]);
                let corners = [[x[0], y[0]], [x[1], y[1]]];
                cells.push(Cell {
                    corners,
                    value,
                    row,
                });
            }
        }
        cells
    }

    /// Outlines of the zones: those given, else the bounds of the cells.
    fn outlines(&self, cells: &[Cell<'_>]) -> Vec<Corners> {
        if !self.zones.is_empty() {
            let zones = self.zones.iter();
            return zones
                .map(|z| [[z.x_mm[0], z.y_mm[0]], [z.x_mm[1], z.y_mm[1]]])
                .collect();
        }
        let mut zones: Vec<(&str, Corners)> = Vec::new();
        for cell in cells {
            match zones.iter_mut().find(|(name, _)| *name == cell.row.zone) {
                Some((_, [low, high])) => {
                    for i in 0..2 {
                        low[i] = low[i].min(cell.corners[0][i]);
                        high[i] = high[i].max(cell.corners[1][i]);
                    }
                }
                None => zones.push((&cell.row.zone, cell.corners)),
            }
        }
        zones.into_iter().map(|(_, corners)| corners).collect()
    }
}

/// Different places in increasing order; what lies closer than 1e-3 mm is one.
fn places(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup_by(|a, b| *a - *b < 1e-3);
    sorted
}

/// The interval around the place next to `value`.
fn interval(places: &[f64], value: f64) -> [f64; 2] {
    let gaps = places.windows(2).map(|pair| pair[1] - pair[0]);
    let smallest = gaps.fold(f64::INFINITY, f64::min);
    let margin = if smallest.is_finite() {
        0.5 * smallest
    } else {
        5.0
    };
    let nearest = |a: &f64, b: &f64| (a - value).abs().total_cmp(&(b - value).abs());
    let next = places.iter().enumerate().min_by(|a, b| nearest(a.1, b.1));
    let Some((i, &at)) = next else {
        return [value - margin, value + margin];
    };
    let middle = |other: Option<&f64>| other.map(|&o| f64::midpoint(o, at));
    [
        middle(i.checked_sub(1).and_then(|i| places.get(i))).unwrap_or(at - margin),
        middle(places.get(i + 1)).unwrap_or(at + margin),
    ]
}

/// An interval, its ends moved into another one.
fn within([a, b]: [f64; 2], [low, high]: [f64; 2]) -> [f64; 2] {
    [a.max(low), b.min(high)]
}

/// Oblique strokes over a rectangle, at the same places in neighbouring ones.
fn hatch<DB: DrawingBackend>(area: &Area<'_, DB>, corners: [(i32, i32); 2]) -> Drawn<DB> {
    let [a, b] = corners;
    let (left, right) = (a.0.min(b.0), a.0.max(b.0));
    let (top, bottom) = (a.1.min(b.1), a.1.max(b.1));
    let step = units(5.0);
    // Strokes x + y = c.
    let mut c = (left + top).div_euclid(step) * step + step;
    while c < right + bottom {
        let start = left.max(c - bottom);
        let end = right.min(c - top);
        if start < end {
            let ends = vec![(start, c - start), (end, c - end)];
            area.draw(&PathElement::new(ends, line(SKY_BLUE, 1.5)))?;
        }
        c += step;
    }
    Ok(())
}

/// Explains outlines and hatching, at the lower left.
fn draw_legend<DB: DrawingBackend>(area: &Area<'_, DB>, shown: Shown, y: f64) -> Drawn<DB> {
    let sample = |x: f64| {
        [
            (units(x), units(y - 7.0)),
            (units(x + 26.0), units(y + 7.0)),
        ]
    };
    let label = |x: f64, words: &'static str, colour| {
        area.draw(&Text::new(words, (units(x), units(y)), text(colour, 12.5)))
    };
    area.draw(&outline(sample(SIDE), line(INK, 1.0)))?;
    label(SIDE + 34.0, "sheet on the side", INK)?;
    if shown == Shown::Slip {
        hatch(area, sample(SIDE + 190.0))?;
        label(SIDE + 224.0, "debonded", INK)
    } else {
        label(SIDE + 190.0, "compression is not coloured", GREY)
    }
}
