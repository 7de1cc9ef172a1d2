//! Crack strains seen from the side, as a picture.

mod colour_scale;

use plotters::element::{PathElement, Polygon, Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, VPos};

use self::colour_scale::{ColourScale, SMALLEST_STRAIN};
use super::drawing::{Area, Drawn, Picture, draw_heading, line, outline, placed, text, units};
use super::evidence::ConcretePoint;
use super::palette::{BLUE, FAINT, GREEN, GREY, INK, sequential};

/// Height of heading and load arrows, and of axis, legend and colour bar (pixels).
const ABOVE: f64 = 106.0;
const BELOW: f64 = 112.0;
const SIDE: f64 = 36.0;
const WIDTH: f64 = 1400.0;

/// Side view, x to the right and y up, in mm.
#[derive(Debug, Clone, Copy)]
pub struct CrackView<'a> {
    /// Name of the specimen.
    pub specimen: &'a str,
    /// Which state is shown.
    pub title: &'a str,
    /// Outlines of elements: lower left and upper right corner.
    pub elements: &'a [[[f64; 2]; 2]],
    /// Longitudinal bars.
    pub bars: &'a [Vec<[f64; 2]>],
    /// Stirrups.
    pub stirrups: &'a [Vec<[f64; 2]>],
    /// Where supports hold.
    pub supports: &'a [[f64; 2]],
    /// Where loads push down.
    pub loads: &'a [[f64; 2]],
    /// Integration points of the concrete.
    pub points: &'a [ConcretePoint],
}

impl Picture for CrackView<'_> {
    fn size(&self) -> (u32, u32) {
        let frame = Frame::of(self.elements);
        let height = ABOVE + frame.scale * (frame.high[1] - frame.low[1]) + BELOW;
        (WIDTH as u32, height.ceil() as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Drawn<DB> {
        draw_heading(area, self.specimen, self.title, &[])?;
        let frame = Frame::of(self.elements);
        for corners in self.elements {
            let corners = corners.map(|c| frame.at(c));
            area.draw(&outline(corners, line(FAINT, 0.75)))?;
        }
        self.draw_crushing(area, &frame)?;
        for (polylines, width) in [(self.stirrups, 1.0), (self.bars, 1.75)] {
            for polyline in polylines {
                let points: Vec<_> = polyline.iter().map(|&p| frame.at(p)).collect();
                area.draw(&PathElement::new(points, line(GREY, width)))?;
            }
        }
        let scale = ColourScale::of(self.points);
        self.draw_cracks(area, &frame, &scale)?;
        self.draw_conditions(area, &frame)?;
        frame.draw_axis(area)?;
        let bottom = f64::from(self.size().1) - 42.0;
        draw_legend(area, bottom)?;
        scale.draw_bar(area, WIDTH - SIDE, bottom)
    }
}

impl CrackView<'_> {
    /// Squares over crushing concrete, the darker the more of its capacity is consumed.
    fn draw_crushing<DB: DrawingBackend>(&self, area: &Area<'_, DB>, frame: &Frame) -> Drawn<DB> {
        for point in self.points.iter().filter(|p| p.crushing > 0.0) {
            let half = 0.4 * point.volume.cbrt();
            let [x, y, _] = point.position;
            let corners = [[x - half, y - half], [x + half, y + half]].map(|c| frame.at(c));
            let opacity = 0.15 + 0.55 * point.crushing.min(1.0);
            area.draw(&Rectangle::new(corners, BLUE.mix(opacity).filled()))?;
        }
        Ok(())
    }

    /// Strokes along the traces of cracks, the widest last.
    fn draw_cracks<DB: DrawingBackend>(
        &self,
        area: &Area<'_, DB>,
        frame: &Frame,
        scale: &ColourScale,
    ) -> Drawn<DB> {
        let open = |p: &&ConcretePoint| p.crack_strain >= SMALLEST_STRAIN;
        let mut cracks: Vec<_> = self.points.iter().filter(open).collect();
        cracks.sort_by(|a, b| a.crack_strain.total_cmp(&b.crack_strain));
        for crack in cracks {
            let half = 0.45 * crack.volume.cbrt();
            let ([x, y, _], [nx, ny, _]) = (crack.position, crack.crack_normal);
            let ends = [-half, half].map(|s| frame.at([x - s * ny, y + s * nx]));
            let share = scale.share(crack.crack_strain);
            let style = line(sequential(share), 0.8 + 3.2 * share);
            area.draw(&PathElement::new(ends.to_vec(), style))?;
        }
        Ok(())
    }

    /// Supports as triangles, loads as arrows.
    fn draw_conditions<DB: DrawingBackend>(&self, area: &Area<'_, DB>, frame: &Frame) -> Drawn<DB> {
        for &support in self.supports {
            area.draw(&triangle(frame.at(support), 9.0, 14.0, INK))?;
        }
        for &load in self.loads {
            let tip = frame.at(load);
            let shaft = vec![(tip.0, tip.1 - units(34.0)), (tip.0, tip.1 - units(8.0))];
            area.draw(&PathElement::new(shaft, line(GREEN, 2.5)))?;
            area.draw(&triangle(tip, 6.0, -12.0, GREEN))?;
        }
        Ok(())
    }
}

/// A triangle with its tip at a point, `height` downwards (pixels).
fn triangle(
    (x, y): (i32, i32),
    half_width: f64,
    height: f64,
    colour: plotters::style::RGBColor,
) -> Polygon<(i32, i32)> {
    let base = y + units(height);
    let (left, right) = (x - units(half_width), x + units(half_width));
    Polygon::new(vec![(x, y), (left, base), (right, base)], colour.filled())
}

/// Explains bars, loads and crushing, at the lower left.
fn draw_legend<DB: DrawingBackend>(area: &Area<'_, DB>, y: f64) -> Drawn<DB> {
    let label = |x: f64, words: &'static str| {
        area.draw(&Text::new(words, (units(x), units(y)), text(INK, 12.5)))
    };
    let stroke = |x: f64, width: f64| {
        let ends = vec![(units(x), units(y)), (units(x + 26.0), units(y))];
        area.draw(&PathElement::new(ends, line(GREY, width)))
    };
    stroke(SIDE, 1.75)?;
    label(SIDE + 34.0, "bars")?;
    stroke(SIDE + 84.0, 1.0)?;
    label(SIDE + 118.0, "stirrups")?;
    for i in 0..4 {
        let x = SIDE + 200.0 + 14.0 * f64::from(i);
        let corners = [
            (units(x), units(y - 7.0)),
            (units(x + 14.0), units(y + 7.0)),
        ];
        let opacity = 0.15 + 0.55 * f64::from(i) / 3.0;
        area.draw(&Rectangle::new(corners, BLUE.mix(opacity).filled()))?;
    }
    label(
        SIDE + 264.0,
        "crushing, from the strength to the residual stress",
    )
}

/// How mm become drawing units.
struct Frame {
    low: [f64; 2],
    high: [f64; 2],
    /// Pixels per mm.
    scale: f64,
}

impl Frame {
    fn of(elements: &[[[f64; 2]; 2]]) -> Self {
        let (mut low, mut high) = ([0.0, 0.0], [1.0, 1.0]);
        for corners in elements {
            for i in 0..2 {
                low[i] = corners[0][i].min(low[i]);
                high[i] = corners[1][i].max(high[i]);
            }
        }
        let scale = (WIDTH - 2.0 * SIDE) / (high[0] - low[0]);
        Self { low, high, scale }
    }

    fn at(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let across = SIDE + self.scale * (x - self.low[0]);
        let down = ABOVE + self.scale * (self.high[1] - y);
        (units(across), units(down))
    }

    /// Positions along the beam, below it.
    fn draw_axis<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Drawn<DB> {
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

#[cfg(test)]
mod tests {
    //! Protects the direction of cracks and what is left out.
    use super::*;

    fn view(points: &[ConcretePoint]) -> String {
        let view = CrackView {
            specimen: "A-SO3-1",
            title: "crack strain at the peak",
            elements: &[[[0.0, 0.0], [1328.0, 300.0]]],
            bars: &[],
            stirrups: &[],
            supports: &[],
            loads: &[],
            points,
        };
        view.to_svg().unwrap()
    }

    fn crack(crack_strain: f64, crack_normal: [f64; 3]) -> ConcretePoint {
        ConcretePoint {
            position: [500.0, 100.0, 0.0],
            volume: 1e6,
            crack_strain,
            crack_normal,
            crushing: 0.0,
        }
    }

    /// At one pixel per mm, a point stands for 100 mm and its stroke is 90 mm long.
    #[test]
    fn a_stroke_runs_along_its_crack_and_shrinks_where_the_crack_turns_out_of_the_plane() {
        let stroke = |points: &[ConcretePoint]| {
            let (drawn, bare) = (view(points), view(&[]));
            let new = drawn
                .lines()
                .find(|line| !bare.contains(*line) && line.contains("polyline"));
            new.map(|line| line.split("points=\"").nth(1).unwrap().trim().to_owned())
        };
        let (x, y) = (units(36.0 + 500.0), units(106.0 + 200.0));
        let vertical = stroke(&[crack(1e-4, [1.0, 0.0, 0.0])]).unwrap();
        let ends = format!("{x},{} {x},{}", y + units(45.0), y - units(45.0));
        assert!(vertical.starts_with(&ends), "{vertical} is not {ends}");
        let oblique = stroke(&[crack(1e-4, [0.6, 0.0, 0.8])]).unwrap();
        let ends = format!("{x},{} {x},{}", y + units(27.0), y - units(27.0));
        assert!(oblique.starts_with(&ends), "{oblique} is not {ends}");
        assert_eq!(stroke(&[crack(0.9e-4, [1.0, 0.0, 0.0])]), None);
    }

    #[test]
    fn the_colour_bar_has_numbers() {
        let svg = view(&[crack(5e-3, [1.0, 0.0, 0.0])]);
        for text in [
            "crack strain",
            "0.0001",
            "0.001",
            "0.01",
            "crushing",
            "1000 mm",
        ] {
            assert!(svg.contains(text), "{text} is missing");
        }
    }
}
