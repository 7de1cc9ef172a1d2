//! What pictures of the beam from the side have in common: frame, supports, loads, axis, colours.

mod colour_scale;

pub(super) use colour_scale::ColourScale;

use plotters::element::{PathElement, Polygon, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor};

use super::drawing::{Area, Drawn, line, outline, placed, text, units};
use super::palette::{FAINT, GREEN, GREY, INK};

/// Height of heading and load arrows, and of axis, legend and colour bar (pixels).
const ABOVE: f64 = 106.0;
const BELOW: f64 = 112.0;
/// Margin at either end (pixels).
pub(super) const SIDE: f64 = 36.0;
/// Width of the picture (pixels).
pub(super) const WIDTH: f64 = 1400.0;

/// Lower left and upper right corner of a rectangle (mm).
pub(super) type Corners = [[f64; 2]; 2];

/// How mm become drawing units; x to the right and y up.
#[derive(Debug)]
pub(super) struct Frame {
    low: [f64; 2],
    high: [f64; 2],
    /// Pixels per mm.
    scale: f64,
}

impl Frame {
    /// The frame that shows all rectangles, and the origin.
    pub(super) fn of(rectangles: &[Corners]) -> Self {
        let (mut low, mut high) = ([0.0, 0.0], [1.0, 1.0]);
        for corners in rectangles {
            for i in 0..2 {
                low[i] = corners[0][i].min(low[i]);
                high[i] = corners[1][i].max(high[i]);
            }
        }
        let scale = (WIDTH - 2.0 * SIDE) / (high[0] - low[0]);
        Self { low, high, scale }
    }

    /// Size of the picture (pixels).
    pub(super) fn size(&self) -> (u32, u32) {
        let height = ABOVE + self.scale * (self.high[1] - self.low[1]) + BELOW;
        (WIDTH as u32, height.ceil() as u32)
    }

    /// Where legend and colour bar stand (pixels from the top).
    pub(super) fn legend_y(&self) -> f64 {
        f64::from(self.size().1) - 42.0
    }

    pub(super) fn at(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let across = SIDE + self.scale * (x - self.low[0]);
        let down = ABOVE + self.scale * (self.high[1] - y);
        (units(across), units(down))
    }

    /// Faint outlines of elements.
    pub(super) fn draw_elements<DB: DrawingBackend>(
        &self,
        area: &Area<'_, DB>,
        elements: &[Corners],
    ) -> Drawn<DB> {
        elements.iter().try_for_each(|corners| {
            area.draw(&outline(corners.map(|c| self.at(c)), line(FAINT, 0.75)))
        })
    }

    /// Supports as triangles, loads as arrows.
    pub(super) fn draw_conditions<DB: DrawingBackend>(
        &self,
        area: &Area<'_, DB>,
        supports: &[[f64; 2]],
        loads: &[[f64; 2]],
    ) -> Drawn<DB> {
        for &support in supports {
            area.draw(&triangle(self.at(support), 9.0, 14.0, INK))?;
        }
        for &load in loads {
            let tip = self.at(load);
            let shaft = vec![(tip.0, tip.1 - units(34.0)), (tip.0, tip.1 - units(8.0))];
            area.draw(&PathElement::new(shaft, line(GREEN, 2.5)))?;
            area.draw(&triangle(tip, 6.0, -12.0, GREEN))?;
        }
        Ok(())
    }

    /// Positions along the beam, below it.
    pub(super) fn draw_axis<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Drawn<DB> {
        let y = self.at(self.low).1 + units(26.0);
        let ends = [self.low, self.high].map(|p| (self.at(p).0, y));
        area.draw(&PathElement::new(ends.to_vec(), line(GREY, 1.0)))?;
        let style = placed(&text(GREY, 12.0), HPos::Center, VPos::Top);
        let last = (self.high[0] / 500.0) as u32;
        for tick in 0..=last {
            let x = 500 * tick;
            let at = (self.at([f64::from(x), 0.0]).0, y);
            let end = (at.0, y + units(5.0));
            area.draw(&PathElement::new(vec![at, end], line(GREY, 1.0)))?;
            let unit = if tick == last { " mm" } else { "" };
            let label = format!("{x}{unit}");
            area.draw(&Text::new(
                label,
                (end.0, end.1 + units(2.0)),
                style.clone(),
            ))?;
        }
        Ok(())
    }
}

/// A triangle with its tip at a point, `height` downwards (pixels).
fn triangle(
    (x, y): (i32, i32),
    half_width: f64,
    height: f64,
    colour: RGBColor,
) -> Polygon<(i32, i32)> {
    let base = y + units(height);
    let (left, right) = (x - units(half_width), x + units(half_width));
    Polygon::new(vec![(x, y), (left, base), (right, base)], colour.filled())
}
