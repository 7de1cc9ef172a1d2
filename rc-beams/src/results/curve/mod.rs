//! Load against deflection, as a picture.

mod axes;
mod group;
mod legend;

pub use group::{GroupCurves, GroupLine};

use std::mem::take;

use fe_solver::capacity::{Capacity, PathPoint, Verdict, is_jump};
use plotters::element::{Circle, EmptyElement, PathElement, Text, TriangleMarker};
use plotters::prelude::{DashedLineSeries, DrawingBackend};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, WHITE};

use self::axes::{Chart, axes, span};
use self::legend::draw_legend;
use super::drawing::{Area, Drawn, Picture, draw_heading, line, placed, text, units};
use super::palette::{BLUE, GREEN, ORANGE, VERMILLION};

/// Load-deflection curve of a run, in mm and kN.
#[derive(Debug, Clone, Copy)]
pub struct Curve<'a> {
    /// Name of the specimen.
    pub specimen: &'a str,
    /// What the specimen is, and how it was run.
    pub title: &'a str,
    /// Load path.
    pub path: &'a [PathPoint],
    /// Peak and first drop.
    pub capacity: &'a Capacity,
    /// Trust.
    pub verdict: &'a Verdict,
    /// Last point before sheets were bonded under load.
    pub bonded: Option<usize>,
    /// Largest load of the laboratory test (kN), if known.
    pub test_load_kn: Option<f64>,
}

impl Picture for Curve<'_> {
    fn size(&self) -> (u32, u32) {
        (860, 560)
    }

    fn draw<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Drawn<DB> {
        let trust = format!("trust {}: {}", self.verdict.trust, self.verdict.reason);
        let below = draw_heading(area, self.specimen, self.title, &trust)?;
        let ends = self.extent();
        let mut chart = axes(area, (below, units(28.0)), ends)?;
        // A load-deflection curve seldom goes to the lower right; where it does, it crosses the legend.
        draw_legend(area, chart.backend_coord(&(ends.0[1], 0.0)), self.path)?;
        self.draw_test(&mut chart)?;
        self.draw_path(&mut chart)?;
        self.draw_marks(&chart, area)
    }
}

impl Curve<'_> {
    /// Ends of the axes, with room above the curve for labels.
    fn extent(&self) -> ([f64; 2], f64) {
        let largest =
            |values: &mut dyn Iterator<Item = f64>| values.fold(f64::MIN_POSITIVE, f64::max);
        let mut deflections = self.path.iter().map(|p| p.deflection);
        let loads = self.path.iter().map(|p| p.load);
        let load = largest(&mut loads.chain(self.test_load_kn));
        (span(&mut deflections, 1.05), 1.18 * load)
    }

    /// Load of the laboratory test as a dashed line.
    fn draw_test<DB: DrawingBackend>(&self, chart: &mut Chart<'_, DB>) -> Drawn<DB> {
        let Some(load) = self.test_load_kn else {
            return Ok(());
        };
        let ([begin, end], _) = self.extent();
        let ends = [(begin, load), (end, load)];
        let style = line(GREEN, 1.5);
        chart.draw_series(DashedLineSeries::new(ends, units(8.0), units(5.0), style))?;
        let label = format!("test {load:.1} kN");
        let style = placed(&text(GREEN, 13.0), HPos::Left, VPos::Bottom);
        chart
            .draw_series([EmptyElement::at((begin, load))
                + Text::new(label, (units(8.0), units(-4.0)), style)])?;
        Ok(())
    }

    /// P from the unloaded beam on, broken by dashes where it jumps; P* where it is regular and in range.
    fn draw_path<DB: DrawingBackend>(&self, chart: &mut Chart<'_, DB>) -> Drawn<DB> {
        let at = |p: &PathPoint| (p.deflection, p.load);
        let solid = line(BLUE, 2.0);
        let top = self.extent().1;
        let (mut load, mut work) = (vec![(0.0, 0.0)], Vec::new());
        for (i, point) in self.path.iter().enumerate() {
            let jump = is_jump(self.path, i);
            if jump {
                let ends = [at(&self.path[i - 1]), at(point)];
                chart.draw_series(DashedLineSeries::new(ends, units(3.0), units(3.0), solid))?;
                chart.draw_series([PathElement::new(take(&mut load), solid)])?;
            }
            load.push(at(point));
            if jump || !(0.0..=top).contains(&point.work_conjugate_load) {
                draw_work(chart, take(&mut work))?;
            } else {
                work.push((point.deflection, point.work_conjugate_load));
            }
        }
        chart.draw_series([PathElement::new(load, solid)])?;
        draw_work(chart, work)?;
        let flagged = self.path.iter().filter(|p| p.flagged);
        chart.draw_series(flagged.map(|p| Circle::new(at(p), units(4.0), line(ORANGE, 1.5))))?;
        Ok(())
    }

    /// Peak and first drop with their values, and where sheets were bonded.
    fn draw_marks<DB: DrawingBackend>(
        &self,
        chart: &Chart<'_, DB>,
        area: &Area<'_, DB>,
    ) -> Drawn<DB> {
        let Some(peak) = self.path.get(self.capacity.peak) else {
            return Ok(());
        };
        let spot = |p: &PathPoint| chart.backend_coord(&(p.deflection, p.load));
        if let Some(point) = self.bonded.and_then(|i| self.path.get(i)) {
            let (x, y) = spot(point);
            area.draw(&Circle::new((x, y), units(4.0), BLUE.filled()))?;
            let style = placed(&text(BLUE, 13.0), HPos::Left, VPos::Top);
            let at = (x + units(9.0), y + units(2.0));
            area.draw(&Text::new("sheets bonded", at, style))?;
        }
        let value = |p: &PathPoint| format!("{:.1} kN at {:.2} mm", p.load, p.deflection);
        let first = self
            .capacity
            .first_drop
            .filter(|&i| i != self.capacity.peak);
        if let Some(drop) = first.and_then(|i| self.path.get(i)) {
            let (x, y) = spot(drop);
            area.draw(&TriangleMarker::new((x, y), units(6.0), BLUE.filled()))?;
            let style = placed(&text(BLUE, 13.0), HPos::Right, VPos::Bottom);
            let label = format!("first drop {}", value(drop));
            area.draw(&Text::new(label, (x - units(6.0), y - units(6.0)), style))?;
        }
        let (x, y) = spot(peak);
        area.draw(&Circle::new((x, y), units(5.0), WHITE.filled()))?;
        area.draw(&Circle::new((x, y), units(5.0), line(BLUE, 2.0)))?;
        // Above the line of the test where that is close.
        let line_y = self.test_load_kn.map(|p| chart.backend_coord(&(0.0, p)).1);
        let close = line_y.filter(|l| (y - units(28.0)..y + units(6.0)).contains(l));
        let label_y = close.map_or(y, |l| l.min(y)) - units(9.0);
        let [left, right] = self.extent().0.map(|x| chart.backend_coord(&(x, 0.0)).0);
        let half = units(95.0);
        let (label_x, h) = if x + half > right {
            (right, HPos::Right)
        } else if x - half < left {
            (x.max(left + units(4.0)), HPos::Left)
        } else {
            (x, HPos::Center)
        };
        let style = placed(&text(BLUE, 14.0), h, VPos::Bottom);
        area.draw(&Text::new(
            format!("peak {}", value(peak)),
            (label_x, label_y),
            style,
        ))
    }
}

/// A regular stretch of P*.
fn draw_work<DB: DrawingBackend>(chart: &mut Chart<'_, DB>, points: Vec<(f64, f64)>) -> Drawn<DB> {
    let style = line(VERMILLION, 1.0);
    chart.draw_series(DashedLineSeries::new(points, units(4.0), units(4.0), style))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    //! Protects what a reader must find in the picture: peak, first drop, test, trust, and the marks of
    //! steps that are no equilibrium.
    use super::*;

    fn path(loads: &[f64]) -> Vec<PathPoint> {
        let point = |(i, &load): (usize, &f64)| PathPoint {
            deflection: 0.5 * i as f64,
            load,
            work_conjugate_load: load,
            residual: 5e-4,
            flagged: false,
            held: false,
            unstable: false,
            kinetic: None,
            viscous: None,
        };
        loads.iter().enumerate().map(point).collect()
    }

    fn svg(path: &[PathPoint], test_load_kn: Option<f64>) -> String {
        let capacity = Capacity::of(path).unwrap();
        let curve = Curve {
            specimen: "A-SO3-1",
            title: "simply supported",
            path,
            capacity: &capacity,
            verdict: &Verdict::of(path, &capacity),
            bonded: (path.len() > 3).then_some(1),
            test_load_kn,
        };
        curve.to_svg().unwrap()
    }

    #[test]
    fn peak_first_drop_test_and_trust_are_written_out() {
        let svg = svg(&path(&[0.0, 100.0, 90.0, 149.2, 60.0]), Some(151.0));
        for text in [
            "A-SO3-1",
            "peak 149.2 kN at 1.50 mm",
            "first drop 100.0 kN at 0.50 mm",
            "sheets bonded",
            "test 151.0 kN",
            "trust high: every step",
            "deflection [mm]",
        ] {
            assert!(svg.contains(text), "{text} is missing");
        }
        assert!(!svg.contains("jump") && !svg.contains("misses"));
    }

    #[test]
    fn an_unknown_test_draws_nothing_and_marks_are_explained() {
        let mut path = path(&[0.0, 100.0, 50.0]);
        path[2].held = true;
        path[2].flagged = true;
        path[2].work_conjugate_load = -1400.0;
        let svg = svg(&path, None);
        assert!(!svg.contains("test ") && !svg.contains("bonded"));
        assert!(!svg.contains("first drop"), "the peak is the first drop");
        assert!(svg.contains("jump, no static equilibrium"));
        assert!(svg.contains("step that misses the criterion"));
    }

    /// Between loads on cantilevers a beam moves up: its curve goes to the left.
    #[test]
    fn a_point_that_moves_up_is_drawn_too() {
        let down = path(&[0.0, 100.0, 50.0]);
        let mut up = down.clone();
        for point in &mut up {
            point.deflection *= -1.0;
        }
        let labels = |path: &[PathPoint]| {
            let svg = svg(path, Some(90.0));
            ["\n-1\n", "\n1\n"].map(|label| svg.contains(label))
        };
        assert_eq!(labels(&down), [false, true]);
        assert_eq!(labels(&up), [true, false]);
    }

    #[test]
    fn a_path_of_one_unloaded_point_can_be_drawn() {
        assert!(svg(&path(&[0.0]), None).contains("trust low"));
    }
}
