//! Axes of deflection and load.

use plotters::chart::{ChartBuilder, ChartContext, LabelAreaPosition};
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{Cartesian2d, DrawingBackend};
use plotters::style::{Color, WHITE};

use crate::results::drawing::{Area, line, text, units};
use crate::results::palette::{FAINT, INK};

/// A chart of load (kN) over deflection (mm).
pub(super) type Chart<'c, DB> = ChartContext<'c, DB, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Share of the largest deflection that a negative one must exceed to be shown.
const RISES: f64 = 0.02;

/// Ends of the axis for deflections (mm), `room` times as far as they go: from 0, unless the point moves up.
pub(super) fn span(deflections: &mut dyn Iterator<Item = f64>, room: f64) -> [f64; 2] {
    let none = (0.0_f64, f64::MIN_POSITIVE);
    let (low, high) = deflections.fold(none, |(low, high), w| (low.min(w), high.max(w)));
    let low = if low < -RISES * high { low } else { 0.0 };
    [room * low, room * high]
}

/// Draws axes over a [`span`] of deflections and from 0 to a load, with margins at the top and the right (drawing units).
pub(super) fn axes<'c, DB: DrawingBackend>(
    area: &Area<'c, DB>,
    (top, right): (i32, i32),
    ([x_begin, x_end], y_end): ([f64; 2], f64),
) -> Result<Chart<'c, DB>, DrawingAreaErrorKind<DB::ErrorType>> {
    let mut chart = ChartBuilder::on(area)
        .margin_top(top)
        .margin_right(right)
        .margin_bottom(units(8.0))
        .margin_left(units(8.0))
        .set_label_area_size(LabelAreaPosition::Left, units(58.0))
        .set_label_area_size(LabelAreaPosition::Bottom, units(46.0))
        .build_cartesian_2d(x_begin..x_end, 0.0..y_end)?;
    chart
        .configure_mesh()
        .bold_line_style(line(FAINT, 0.75))
        .light_line_style(WHITE.mix(0.0))
        .axis_style(line(INK, 1.0))
        .label_style(text(INK, 13.0))
        .axis_desc_style(text(INK, 14.0))
        .set_all_tick_mark_size(units(4.0))
        .x_labels(10)
        .y_labels(10)
        .x_label_formatter(&|value| short(*value))
        .y_label_formatter(&|value| short(*value))
        .x_desc("deflection [mm]")
        .y_desc("load [kN]")
        .draw()?;
    Ok(chart)
}

/// A number at an axis, without zeros at its end.
fn short(value: f64) -> String {
    ((value * 1e3).round() / 1e3).to_string()
}
