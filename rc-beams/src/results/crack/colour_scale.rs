//! Colours of crack strains.

use plotters::element::{PathElement, Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, VPos};

use crate::results::drawing::{Area, Drawn, line, placed, text, units};
use crate::results::evidence::ConcretePoint;
use crate::results::palette::{GREY, INK, sequential};

/// Smallest crack strain that is drawn.
pub(super) const SMALLEST_STRAIN: f64 = 1e-4;

/// Colour scale of crack strains: logarithmic from [`SMALLEST_STRAIN`], over whole decades.
pub(super) struct ColourScale {
    decades: i32,
}

impl ColourScale {
    /// Covers all points with at least one decade.
    pub(super) fn of(points: &[ConcretePoint]) -> Self {
        let largest = points.iter().map(|p| p.crack_strain).fold(0.0, f64::max);
        let decades = (largest / SMALLEST_STRAIN).log10().ceil().clamp(1.0, 6.0);
        Self {
            decades: decades as i32,
        }
    }

    /// Share of the scale, from 0 to 1.
    pub(super) fn share(&self, strain: f64) -> f64 {
        ((strain / SMALLEST_STRAIN).log10() / f64::from(self.decades)).clamp(0.0, 1.0)
    }

    /// Colour bar with numbers, that ends at `right` with its middle at `y` \\[pixels\\].
    pub(super) fn draw_bar<DB: DrawingBackend>(
        &self,
        area: &Area<'_, DB>,
        right: f64,
        y: f64,
    ) -> Drawn<DB> {
        const LENGTH: f64 = 360.0;
        const PARTS: u32 = 120;
        let left = right - LENGTH;
        let [top, bottom] = [units(y - 7.0), units(y + 7.0)];
        // Each part reaches to the end, so that no seams show between them.
        for i in 0..PARTS {
            let share = f64::from(i) / f64::from(PARTS);
            let corners = [(units(left + LENGTH * share), top), (units(right), bottom)];
            area.draw(&Rectangle::new(corners, sequential(share).filled()))?;
        }
        let name = placed(&text(INK, 12.5), HPos::Right, VPos::Center);
        area.draw(&Text::new(
            "crack strain",
            (units(left - 12.0), units(y)),
            name,
        ))?;
        let style = placed(&text(GREY, 12.0), HPos::Center, VPos::Top);
        for decade in 0..=self.decades {
            let share = f64::from(decade) / f64::from(self.decades);
            let x = units(left + LENGTH * share);
            area.draw(&PathElement::new(
                vec![(x, top), (x, bottom + units(4.0))],
                line(INK, 1.0),
            ))?;
            let strain = SMALLEST_STRAIN * 10_f64.powi(decade);
            let label = format!("{strain:.*}", (4 - decade).max(0) as usize);
            area.draw(&Text::new(label, (x, bottom + units(6.0)), style.clone()))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    //! Protects the reading of strains off the colours.
    use super::*;

    #[test]
    fn the_scale_ends_at_the_decade_above_the_largest_strain() {
        let point = |crack_strain| ConcretePoint {
            position: [0.0; 3],
            volume: 1.0,
            crack_strain,
            crack_normal: [1.0, 0.0, 0.0],
            crushing: 0.0,
        };
        let scale = ColourScale::of(&[point(0.0), point(5e-3)]);
        assert_eq!(scale.decades, 2);
        assert!((scale.share(1e-3) - 0.5).abs() < 1e-12);
        assert_eq!((scale.share(0.0), scale.share(1.0)), (0.0, 1.0));
        assert_eq!(ColourScale::of(&[]).decades, 1);
    }
}
