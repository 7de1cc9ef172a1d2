//! Colours of a quantity, with the bar that explains them.

use plotters::element::{PathElement, Rectangle, Text};
use plotters::prelude::DrawingBackend;
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, VPos};

use crate::results::drawing::{Area, Drawn, line, placed, text, units};
use crate::results::palette::{GREY, INK, sequential};

/// Colour scale of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::results) enum ColourScale {
    /// Logarithmic from `smallest`, over whole decades.
    Decades { smallest: f64, decades: i32 },
    /// Linear from 0, with `parts` equal parts of a round length.
    Linear { part: f64, parts: i32 },
}

impl ColourScale {
    /// Decades from `smallest` that cover `largest`, one at least.
    pub(in crate::results) fn decades(smallest: f64, largest: f64) -> Self {
        let decades = (largest / smallest).log10().ceil().clamp(1.0, 6.0);
        Self::Decades {
            smallest,
            decades: decades as i32,
        }
    }

    /// From 0 to the round number above `largest`; to 1 where nothing is positive.
    pub(in crate::results) fn linear(largest: f64) -> Self {
        let top = if largest > 0.0 && largest.is_finite() {
            largest
        } else {
            1.0
        };
        let raw = top / 5.0;
        let decade = 10_f64.powf(raw.log10().floor());
        let round = [1.0, 2.0, 2.5, 5.0].into_iter().map(|r| r * decade);
        let part = round
            .into_iter()
            .find(|p| *p >= raw * (1.0 - 1e-9))
            .unwrap_or(10.0 * decade);
        let parts = (top / part * (1.0 - 1e-9)).ceil() as i32;
        Self::Linear { part, parts }
    }

    /// Share of the scale, from 0 to 1.
    pub(in crate::results) fn share(&self, value: f64) -> f64 {
        match *self {
            Self::Decades { smallest, decades } => {
                ((value / smallest).log10() / f64::from(decades)).clamp(0.0, 1.0)
            }
            Self::Linear { part, parts } => (value / (part * f64::from(parts))).clamp(0.0, 1.0),
        }
    }

    const fn marks(self) -> i32 {
        match self {
            Self::Decades { decades, .. } => decades,
            Self::Linear { parts, .. } => parts,
        }
    }

    fn label(self, mark: i32) -> String {
        match self {
            Self::Decades { smallest, .. } => {
                let first = (-smallest.log10()).round() as i32;
                let value = smallest * 10_f64.powi(mark);
                format!("{value:.*}", (first - mark).max(0) as usize)
            }
            Self::Linear { part, .. } => {
                let value = part * f64::from(mark);
                ((value * 1e6).round() / 1e6).to_string()
            }
        }
    }

    /// Colour bar called `name` with numbers, that ends at `right` with its middle at `y` \\[pixels\\].
    pub(in crate::results) fn draw_bar<DB: DrawingBackend>(
        &self,
        area: &Area<'_, DB>,
        name: &str,
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
        let style = placed(&text(INK, 12.5), HPos::Right, VPos::Center);
        area.draw(&Text::new(name, (units(left - 12.0), units(y)), style))?;
        let style = placed(&text(GREY, 12.0), HPos::Center, VPos::Top);
        let marks = self.marks();
        for mark in 0..=marks {
            let x = units(left + LENGTH * f64::from(mark) / f64::from(marks));
            area.draw(&PathElement::new(
                vec![(x, top), (x, bottom + units(4.0))],
                line(INK, 1.0),
            ))?;
            let at = (x, bottom + units(6.0));
            area.draw(&Text::new(self.label(mark), at, style.clone()))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    //! Protects the reading of values off the colours.
    use super::*;

    #[test]
    fn decades_end_above_the_largest_value() {
        let scale = ColourScale::decades(1e-4, 5e-3);
        assert_eq!(scale.marks(), 2);
        assert!((scale.share(1e-3) - 0.5).abs() < 1e-12);
        assert_eq!((scale.share(0.0), scale.share(1.0)), (0.0, 1.0));
        assert_eq!(scale.label(1), "0.001");
        assert_eq!(ColourScale::decades(1e-4, 0.0).marks(), 1);
    }

    #[test]
    fn a_linear_scale_ends_at_a_round_number_not_below_the_largest_value() {
        for (largest, last) in [
            (0.171, "0.2"),
            (1390.0, "1500"),
            (1.0, "1"),
            (0.9999, "1"),
            (5.01, "6"),
        ] {
            let scale = ColourScale::linear(largest);
            assert_eq!(scale.label(scale.marks()), last, "{largest}");
            assert!(scale.share(largest) > 0.75);
        }
        assert_eq!(ColourScale::linear(1000.0).share(250.0), 0.25);
        assert_eq!(ColourScale::linear(0.0), ColourScale::linear(1.0));
        assert_eq!(ColourScale::linear(f64::NAN), ColourScale::linear(1.0));
    }
}
