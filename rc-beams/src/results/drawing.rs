//! Pictures: one description, drawn as SVG and as PNG.

use std::fmt::Display;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{PathElement, Text};
use plotters::prelude::{DrawingBackend, IntoFont, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, RGBColor, ShapeStyle, TextStyle, WHITE, register_font};

use super::error::ResultsError;
use super::folder::Folder;
use super::palette::{GREY, INK};
use super::strip::Strip;

/// Drawing units per pixel of the finished picture: backends know whole units only, lines and letters
/// need finer ones.
const UNITS: u32 = 4;
/// Units averaged into one dot of a PNG, in each direction: two dots per pixel, for dense screens.
const UNITS_PER_DOT: u32 = 2;
/// Rows of units that are drawn together into a PNG.
const STRIP: u32 = 256;

/// Embedded font, and what a viewer of an SVG without it may use.
const FONT: &str = "DejaVu Sans, Verdana, sans-serif";
static DEJAVU_SANS: &[u8] = include_bytes!("../../assets/DejaVuSans.ttf");

/// Area a picture is drawn on.
pub type Area<'a, DB> = DrawingArea<DB, Shift>;

/// Result of drawing on a backend.
pub type Drawn<DB> = Result<(), DrawingAreaErrorKind<<DB as DrawingBackend>::ErrorType>>;

/// A picture that can be drawn on any backend.
pub trait Picture {
    /// Width and height (pixels).
    fn size(&self) -> (u32, u32);

    /// Draws on a white area.
    ///
    /// # Errors
    ///
    /// Those of the backend.
    fn draw<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Drawn<DB>;

    /// The picture as SVG.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Drawing`].
    fn to_svg(&self) -> Result<String, ResultsError> {
        use_font()?;
        let (width, height) = self.size();
        let (w, h) = (width * UNITS, height * UNITS);
        let mut text = String::new();
        {
            let area = SVGBackend::with_string(&mut text, (w, h)).into_drawing_area();
            self.paint(&area)?;
        }
        // The view box keeps the fine units, the picture gets its own size.
        let fine = format!("width=\"{w}\" height=\"{h}\"");
        Ok(text.replacen(&fine, &format!("width=\"{width}\" height=\"{height}\""), 1))
    }

    /// Writes the picture as PNG; `path` must end in `.png`.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Drawing`].
    fn write_png(&self, path: &Path) -> Result<(), ResultsError> {
        use_font()?;
        let (w, h) = (self.size().0 * UNITS, self.size().1 * UNITS);
        let file = BufWriter::new(File::create(path).map_err(failed)?);
        let mut png = png::Encoder::new(file, w / UNITS_PER_DOT, h / UNITS_PER_DOT);
        png.set_color(png::ColorType::Rgb);
        png.set_depth(png::BitDepth::Eight);
        let mut header = png.write_header().map_err(failed)?;
        let mut out = header.stream_writer().map_err(failed)?;
        // Drawn strip by strip: a picture in fine units is larger than the model of a beam.
        for first in (0..h).step_by(STRIP as usize) {
            let mut strip = Strip::new((w, h), first..(first + STRIP).min(h));
            self.draw(&(&mut strip).into_drawing_area())
                .map_err(failed)?;
            out.write_all(&average(strip.units(), w)).map_err(failed)?;
        }
        out.finish().map_err(failed)
    }

    /// Draws the picture with its background and completes it.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Drawing`].
    fn paint<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Result<(), ResultsError> {
        area.fill(&WHITE).map_err(failed)?;
        self.draw(area).map_err(failed)?;
        area.present().map_err(failed)
    }

    /// Writes `name.svg` into a folder.
    ///
    /// # Errors
    ///
    /// [`ResultsError`].
    fn save_svg(&self, folder: &Folder, name: &str) -> Result<(), ResultsError> {
        let text = self.to_svg()?;
        folder.replace(&format!("{name}.svg"), |out| out.write_all(text.as_bytes()))
    }

    /// Writes `name.png` into a folder.
    ///
    /// # Errors
    ///
    /// [`ResultsError`].
    fn save_png(&self, folder: &Folder, name: &str) -> Result<(), ResultsError> {
        folder.replace_by_path(&format!("{name}.png"), |path| Ok(self.write_png(path)?))
    }
}

/// Drawing units of a length (pixels).
pub fn units(pixels: f64) -> i32 {
    (pixels * f64::from(UNITS)).round() as i32
}

/// A line of a width (pixels).
pub fn line(colour: RGBColor, width: f64) -> ShapeStyle {
    colour.stroke_width(units(width).unsigned_abs())
}

/// Outline of a rectangle between two corners, of the same width on every backend.
pub fn outline([a, b]: [(i32, i32); 2], style: ShapeStyle) -> PathElement<(i32, i32)> {
    PathElement::new(vec![a, (b.0, a.1), b, (a.0, b.1), a], style)
}

/// Text of a size (pixels), placed by its middle left.
pub fn text(colour: RGBColor, size: f64) -> TextStyle<'static> {
    (FONT, units(size))
        .into_font()
        .color(&colour)
        .pos(Pos::new(HPos::Left, VPos::Center))
}

/// The same text, placed otherwise.
pub fn placed(style: &TextStyle<'static>, h: HPos, v: VPos) -> TextStyle<'static> {
    style.pos(Pos::new(h, v))
}

/// Breaks a text between words into lines of at most `length` characters, longer words apart.
pub fn wrap(text: &str, length: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= length => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Name and title in one row at the top left, `more` in small letters below, and before it a title that is too long for the row.
/// Returns where the next row would be (drawing units from the top).
///
/// # Errors
///
/// Those of the backend.
pub fn draw_heading<DB: DrawingBackend>(
    area: &Area<'_, DB>,
    name: &str,
    title: &str,
    more: &str,
) -> Result<i32, DrawingAreaErrorKind<DB::ErrorType>> {
    let left = units(24.0);
    let width = area.dim_in_pixel().0.cast_signed() - 2 * left;
    let wide = |text: &str, style: &TextStyle<'_>| {
        Ok::<_, DrawingAreaErrorKind<_>>(area.estimate_text_size(text, style)?.0.cast_signed())
    };
    let (large, grey, small) = (text(INK, 22.0), text(GREY, 14.0), text(GREY, 13.0));
    let beside = wide(name, &large)? + units(12.0);
    area.draw(&Text::new(name, (left, units(26.0)), large))?;
    let mut below = vec![more];
    if beside + wide(title, &grey)? <= width {
        area.draw(&Text::new(title, (left + beside, units(28.0)), grey))?;
    } else {
        below.insert(0, title);
    }
    let mut rows = Vec::new();
    for text in below {
        let share = f64::from(width) / f64::from(wide(text, &small)?.max(1));
        let in_a_row = share * text.chars().count() as f64;
        rows.extend(wrap(text, in_a_row as usize));
    }
    let mut y = units(52.0);
    for row in &rows {
        area.draw(&Text::new(row.as_str(), (left, y), small.clone()))?;
        y += units(17.0);
    }
    Ok(y)
}

fn use_font() -> Result<(), ResultsError> {
    register_font(FONT, FontStyle::Normal, DEJAVU_SANS)
        .map_err(|_| ResultsError::Drawing("the embedded font is damaged".to_owned()))
}

fn failed(error: impl Display) -> ResultsError {
    ResultsError::Drawing(error.to_string())
}

/// Mean colour of squares of [`UNITS_PER_DOT`] units, as RGB rows; rows of `w` units.
fn average(fine: &[u8], w: u32) -> Vec<u8> {
    let (n, row) = (UNITS_PER_DOT as usize, 3 * w as usize);
    let mut dots = Vec::with_capacity(fine.len() / (n * n));
    for rows in fine.chunks_exact(n * row) {
        for x in 0..w as usize / n {
            for channel in 0..3 {
                let sum: usize = (0..n * n)
                    .map(|i| usize::from(rows[(i / n) * row + 3 * (n * x + i % n) + channel]))
                    .sum();
                dots.push((sum / (n * n)) as u8);
            }
        }
    }
    dots
}

#[cfg(test)]
mod tests {
    //! Protects the frame of every picture: its size, its font and its smoothness.
    use super::*;

    struct Sample;

    impl Picture for Sample {
        fn size(&self) -> (u32, u32) {
            (20, 10)
        }

        fn draw<DB: DrawingBackend>(&self, area: &Area<'_, DB>) -> Drawn<DB> {
            area.draw(&outline([(0, 0), (20, 20)], line(INK, 1.0)))?;
            area.draw(&Text::new("a < b", (0, 0), text(INK, 5.0)))
        }
    }

    #[test]
    fn an_svg_has_its_own_size_fine_units_and_a_named_font() {
        let svg = Sample.to_svg().unwrap();
        assert!(svg.starts_with("<svg width=\"20\" height=\"10\" viewBox=\"0 0 80 40\""));
        assert!(svg.contains("DejaVu Sans") && svg.contains("a &lt; b"));
        assert!(svg.trim_end().ends_with("</svg>"));
    }

    #[test]
    fn a_png_has_two_dots_per_pixel() {
        let root = tempfile::tempdir().unwrap();
        let folder = Folder::create(root.path(), "beam").unwrap();
        Sample.save_png(&folder, "sample").unwrap();
        let png = std::fs::read(folder.path().join("sample.png")).unwrap();
        assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
        // Width and height stand at the start of the header chunk.
        assert_eq!(png[16..24], [0, 0, 0, 40, 0, 0, 0, 20]);
    }

    #[test]
    fn dots_are_means_of_their_units() {
        let mut fine = [0; 3 * 4 * 2];
        fine[0] = 100; // first unit of the first row
        fine[3 * 4 + 3] = 60; // second unit of the second row
        assert_eq!(average(&fine, 4), [40, 0, 0, 0, 0, 0]);
    }

    /// What does not fit beside the name stands below it, in as many rows as it takes.
    #[test]
    fn long_titles_move_below_the_name() {
        use_font().unwrap();
        let mut svg = String::new();
        let area = SVGBackend::with_string(&mut svg, (860 * UNITS, 560 * UNITS));
        let area = area.into_drawing_area();
        let next = |title: &str, more| draw_heading(&area, "beam", title, more).unwrap();
        assert_eq!(next("short", ""), units(52.0));
        assert_eq!(next("short", "one row"), units(69.0));
        assert_eq!(next(&"long ".repeat(27), ""), units(69.0));
        assert_eq!(next(&"long ".repeat(45), "one row"), units(103.0));
    }

    #[test]
    fn lines_break_between_words() {
        assert_eq!(wrap("every step meets it", 11), ["every step", "meets it"]);
        assert!(wrap("", 10).is_empty());
    }
}
