//! What the lines of a load-deflection curve mean.

use fe_solver::capacity::{PathPoint, is_jump};
use plotters::element::{Circle, PathElement, Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::{Color, WHITE};

use crate::results::drawing::{Area, Drawn, line, outline, text, units};
use crate::results::palette::{BLUE, FAINT, INK, ORANGE, VERMILLION};

/// Explains what is drawn of `path`, in a box that ends short of the lower right corner of the axes.
pub(super) fn draw_legend<DB: DrawingBackend>(
    area: &Area<'_, DB>,
    (right, bottom): (i32, i32),
    path: &[PathPoint],
) -> Drawn<DB> {
    let mut rows = vec![Row::Load, Row::WorkConjugate];
    if (0..path.len()).any(|i| is_jump(path, i)) {
        rows.push(Row::Jump);
    }
    if path.iter().any(|p| p.flagged) {
        rows.push(Row::Flagged);
    }
    let height = 20.0 * rows.len() as f64 + 8.0;
    let corner = (right - units(12.0), bottom - units(12.0));
    let origin = (corner.0 - units(238.0), corner.1 - units(height));
    area.draw(&Rectangle::new([origin, corner], WHITE.mix(0.9).filled()))?;
    area.draw(&outline([origin, corner], line(FAINT, 1.0)))?;
    for (i, row) in rows.into_iter().enumerate() {
        let y = origin.1 + units(14.0 + 20.0 * i as f64);
        let ends = [(origin.0 + units(10.0), y), (origin.0 + units(42.0), y)];
        row.draw_sample(area, ends)?;
        let at = (origin.0 + units(52.0), y);
        area.draw(&Text::new(row.label(), at, text(INK, 12.5)))?;
    }
    Ok(())
}

/// A row of the legend.
#[derive(Debug, Clone, Copy)]
enum Row {
    Load,
    WorkConjugate,
    Jump,
    Flagged,
}

impl Row {
    const fn label(self) -> &'static str {
        match self {
            Self::Load => "load P",
            Self::WorkConjugate => "work-conjugate load P*",
            Self::Jump => "jump, no static equilibrium",
            Self::Flagged => "step that misses the criterion",
        }
    }

    fn draw_sample<DB: DrawingBackend>(
        self,
        area: &Area<'_, DB>,
        ends: [(i32, i32); 2],
    ) -> Drawn<DB> {
        let [(x0, y), (x1, _)] = ends;
        let middle = (i32::midpoint(x0, x1), y);
        let dashes = |length: f64, style| {
            let step = 2 * units(length);
            let starts = (x0..x1).step_by(step.unsigned_abs() as usize);
            starts
                .map(|x| PathElement::new(vec![(x, y), ((x + units(length)).min(x1), y)], style))
                .try_for_each(|dash| area.draw(&dash))
        };
        match self {
            Self::Load => area.draw(&PathElement::new(ends.to_vec(), line(BLUE, 2.0))),
            Self::WorkConjugate => dashes(4.0, line(VERMILLION, 1.0)),
            Self::Jump => dashes(3.0, line(BLUE, 2.0)),
            Self::Flagged => area.draw(&Circle::new(middle, units(4.0), line(ORANGE, 1.5))),
        }
    }
}
