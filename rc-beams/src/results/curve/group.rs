//! Load against deflection of several beams, as one picture.

use plotters::element::{Circle, PathElement, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::{Color, RGBColor, WHITE};

use super::axes::{axes, span};
use crate::results::drawing::{Area, Drawn, Picture, draw_heading, line, text, units};
use crate::results::palette::{BLUE, GREEN, GREY, INK, ORANGE, PURPLE, SKY_BLUE, VERMILLION};

const COLOURS: [RGBColor; 7] = [BLUE, VERMILLION, GREEN, ORANGE, SKY_BLUE, PURPLE, INK];
/// Room for the legend beside the axes (pixels).
const LEGEND: f64 = 230.0;

/// One beam of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupLine<'a> {
    /// Name of the beam.
    pub name: &'a str,
    /// Deflection (mm) and load (kN) of the accepted steps.
    pub path: &'a [[f64; 2]],
    /// Deflection (mm) and load (kN) at the peak.
    pub peak: [f64; 2],
    /// Largest load of the laboratory test (kN), if known.
    pub test_load_kn: Option<f64>,
}

/// Load-deflection curves of several beams; loads of tests as strokes at the right end of the axes.
#[derive(Debug, Clone, Copy)]
pub struct GroupCurves<'a> {
    /// Name of the group.
    pub name: &'a str,
    /// The beams, at least one.
    pub lines: &'a [GroupLine<'a>],
}

impl Picture for GroupCurves<'_> {
    fn size(&self) -> (u32, u32) {
        let legend = 60.0 + 44.0 * self.lines.len() as f64;
        (1000, (legend.max(480.0) + 80.0) as u32)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Drawn<DB> {
        let title = "circles: peaks; strokes at the right: loads of the tests";
        draw_heading(area, self.name, title, "")?;
        let ends = self.extent();
        let mut chart = axes(area, (units(52.0), units(LEGEND + 20.0)), ends)?;
        for (each, colour) in self.lines.iter().zip(COLOURS.into_iter().cycle()) {
            let points = each.path.iter().map(|&[w, p]| (w, p)).collect::<Vec<_>>();
            chart.draw_series([PathElement::new(points, line(colour, 2.0))])?;
            if let Some(load) = each.test_load_kn {
                let [begin, end] = ends.0;
                let stroke = vec![(end - 0.05 * (end - begin), load), (end, load)];
                chart.draw_series([PathElement::new(stroke, line(colour, 3.5))])?;
            }
        }
        // Above all curves.
        for (each, colour) in self.lines.iter().zip(COLOURS.into_iter().cycle()) {
            let at = chart.backend_coord(&(each.peak[0], each.peak[1]));
            area.draw(&Circle::new(at, units(4.0), WHITE.filled()))?;
            area.draw(&Circle::new(at, units(4.0), line(colour, 2.0)))?;
        }
        self.draw_legend(area)
    }
}

impl GroupCurves<'_> {
    /// Ends of the axes.
    fn extent(&self) -> ([f64; 2], f64) {
        let points = || {
            self.lines
                .iter()
                .flat_map(|l| l.path.iter().chain([&l.peak]))
        };
        let tests = self.lines.iter().filter_map(|l| l.test_load_kn);
        let largest =
            |values: &mut dyn Iterator<Item = f64>| values.fold(f64::MIN_POSITIVE, f64::max);
        let loads = points().map(|p| p[1]);
        (
            span(&mut points().map(|p| p[0]), 1.08),
            1.08 * largest(&mut loads.chain(tests)),
        )
    }

    /// Name, peak and test of each beam, beside the axes.
    fn draw_legend<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Drawn<DB> {
        let left = f64::from(self.size().0) - LEGEND;
        let rows = (0..).map(|i| 70.0 + 44.0 * f64::from(i));
        for ((each, colour), y) in self.lines.iter().zip(COLOURS.into_iter().cycle()).zip(rows) {
            let ends = vec![(units(left), units(y)), (units(left + 30.0), units(y))];
            area.draw(&PathElement::new(ends, line(colour, 2.0)))?;
            let at = (units(left + 40.0), units(y));
            area.draw(&Text::new(each.name, at, text(INK, 13.0)))?;
            let test = each
                .test_load_kn
                .map_or_else(String::new, |load| format!(", test {load:.1} kN"));
            let figures = format!("peak {:.1} kN{test}", each.peak[1]);
            let at = (units(left + 40.0), units(y + 17.0));
            area.draw(&Text::new(figures, at, text(GREY, 12.0)))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    //! Protects what a reader must find: every beam by name and colour, its peak, its test.
    use super::*;

    #[test]
    fn every_beam_has_its_colour_peak_and_test() {
        let path: Vec<[f64; 2]> = [[0.0, 0.0], [1.0, 150.0], [2.0, 100.0]].into();
        let line = |name, test_load_kn| GroupLine {
            name,
            path: &path,
            peak: [1.0, 150.0],
            test_load_kn,
        };
        let svg = |lines: &[GroupLine<'_>]| {
            let picture = GroupCurves {
                name: "A-SO3",
                lines,
            };
            picture.to_svg().unwrap()
        };
        let two = svg(&[line("A-SO3-1", Some(151.0)), line("A-SO3-2", None)]);
        for words in [
            "A-SO3-1",
            "A-SO3-2",
            "peak 150.0 kN, test 151.0 kN",
            "deflection [mm]",
            "#0072B2",
            "#D55E00",
        ] {
            assert!(two.contains(words), "{words} is missing");
        }
        assert_eq!(two.matches("test 1").count(), 1);
        // Curve, stroke of the test, sample of the legend.
        let strokes = |svg: &str, colour: &str| {
            svg.lines()
                .filter(|l| l.contains("<polyline") && l.contains(colour))
                .count()
        };
        assert_eq!((strokes(&two, "#0072B2"), strokes(&two, "#D55E00")), (3, 2));
    }

    #[test]
    fn eight_beams_and_one_without_a_path_can_be_drawn() {
        let names = ["1", "2", "3", "4", "5", "6", "7", "8"];
        let lines = names.map(|name| GroupLine {
            name,
            path: &[],
            peak: [0.0, 0.0],
            test_load_kn: None,
        });
        let picture = GroupCurves {
            name: "B-CF",
            lines: &lines,
        };
        assert!(picture.to_svg().unwrap().contains("B-CF"));
    }
}
