//! Crack strains seen from the side, as a picture.

use plotters::element::{PathElement, Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::Color;

use super::drawing::{Area, Drawn, Picture, draw_heading, line, text, units};
use super::evidence::ConcretePoint;
use super::palette::{BLUE, GREY, INK, sequential};
use super::side_view::{ColourScale, Frame, SIDE, WIDTH};

/// Smallest crack strain that is drawn.
const SMALLEST_STRAIN: f64 = 1e-4;

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
        Frame::of(self.elements).size()
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Drawn<DB> {
        draw_heading(area, self.specimen, self.title, "")?;
        let frame = Frame::of(self.elements);
        frame.draw_elements(area, self.elements)?;
        self.draw_crushing(area, &frame)?;
        for (polylines, width) in [(self.stirrups, 1.0), (self.bars, 1.75)] {
            for polyline in polylines {
                let points: Vec<_> = polyline.iter().map(|&p| frame.at(p)).collect();
                area.draw(&PathElement::new(points, line(GREY, width)))?;
            }
        }
        let strains = self.points.iter().map(|p| p.crack_strain);
        let scale = ColourScale::decades(SMALLEST_STRAIN, strains.fold(0.0, f64::max));
        self.draw_cracks(area, &frame, &scale)?;
        frame.draw_conditions(area, self.supports, self.loads)?;
        frame.draw_axis(area)?;
        draw_legend(area, frame.legend_y())?;
        scale.draw_bar(area, "crack strain", WIDTH - SIDE, frame.legend_y())
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
