//! Line charts as SVG text: closed forms as lines, computed points as marks.

use std::fmt::Write;

const WIDTH: f64 = 460.0;
const HEIGHT: f64 = 380.0;
const LEFT: f64 = 55.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 48.0;
const CAPTION: f64 = 34.0;
/// Distinguishable without colour vision (Wong 2011), with a mark of their own each.
const COLOURS: [&str; 4] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7"];

/// One law in one chart.
#[derive(Debug, Clone)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Place in the order of colours and marks.
    pub style: usize,
    /// Closed form.
    pub line: Vec<[f64; 2]>,
    /// Computed points.
    pub marks: Vec<[f64; 2]>,
}

/// One chart with both axes from zero.
#[derive(Debug, Clone)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Name and unit of the horizontal axis, its end and the distance of its ticks.
    pub x: (String, f64, f64),
    /// Name and unit of the vertical axis, its end and the distance of its ticks.
    pub y: (String, f64, f64),
    /// What is drawn.
    pub series: Vec<Series>,
}

impl Chart {
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (w, h) = (WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM);
        [LEFT + x / self.x.1 * w, HEIGHT - BOTTOM - y / self.y.1 * h]
    }

    fn draw(&self, out: &mut String) -> std::fmt::Result {
        let [left, bottom] = self.place([0.0, 0.0]);
        let [right, top] = self.place([self.x.1, self.y.1]);
        let middle = 0.5 * (left + right);
        writeln!(
            out,
            r#"<text x="{middle}" y="24" class="title">{}</text>"#,
            self.title
        )?;
        for i in 0..=(self.x.1 / self.x.2).round() as usize {
            let value = i as f64 * self.x.2;
            let [x, _] = self.place([value, 0.0]);
            writeln!(
                out,
                r#"<path d="M{x:.1} {bottom:.1}V{top:.1}" class="grid"/>"#
            )?;
            writeln!(
                out,
                r#"<text x="{x:.1}" y="{:.1}">{value:.1}</text>"#,
                bottom + 16.0
            )?;
        }
        for i in 0..=(self.y.1 / self.y.2).round() as usize {
            let value = i as f64 * self.y.2;
            let [_, y] = self.place([0.0, value]);
            writeln!(
                out,
                r#"<path d="M{left:.1} {y:.1}H{right:.1}" class="grid"/>"#
            )?;
            let (x, y) = (left - 6.0, y + 4.0);
            writeln!(
                out,
                r#"<text x="{x:.1}" y="{y:.1}" class="left">{value:.1}</text>"#
            )?;
        }
        let (below, height) = (bottom + 36.0, 0.5 * (top + bottom));
        writeln!(
            out,
            r#"<text x="{middle}" y="{below:.1}">{}</text>"#,
            self.x.0
        )?;
        writeln!(
            out,
            r#"<text transform="translate(14 {height:.1}) rotate(-90)">{}</text>"#,
            self.y.0
        )?;
        for (row, series) in self.series.iter().enumerate() {
            let colour = COLOURS[series.style % COLOURS.len()];
            out.push_str(r#"<path d=""#);
            for (i, &point) in series.line.iter().enumerate() {
                let [x, y] = self.place(point);
                write!(out, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' })?;
            }
            writeln!(out, r#"" fill="none" stroke="{colour}"/>"#)?;
            for &point in &series.marks {
                mark(out, self.place(point), series.style, colour)?;
            }
            let y = HEIGHT - BOTTOM - 18.0 * (self.series.len() - row) as f64;
            mark(out, [middle - 40.0, y], series.style, colour)?;
            let (x, y) = (middle - 28.0, y + 4.0);
            writeln!(
                out,
                r#"<text x="{x:.1}" y="{y:.1}" class="right">{}</text>"#,
                series.name
            )?;
        }
        Ok(())
    }
}

/// A circle, square, diamond or cross.
fn mark(out: &mut String, [x, y]: [f64; 2], style: usize, colour: &str) -> std::fmt::Result {
    let shape = match style % COLOURS.len() {
        0 => "m-3 0a3 3 0 1 0 6 0a3 3 0 1 0 -6 0",
        1 => "m-3 -3h6v6h-6z",
        2 => "m0 -4l4 4l-4 4l-4 -4z",
        _ => "m-3 -3l6 6m0 -6l-6 6",
    };
    writeln!(
        out,
        r#"<path d="M{x:.1} {y:.1}{shape}" fill="none" stroke="{colour}"/>"#
    )
}

/// Charts side by side over a caption of two lines.
///
/// # Errors
///
/// Never in practice: writing to a string does not fail.
pub fn svg(charts: &[Chart], caption: [&str; 2]) -> Result<String, std::fmt::Error> {
    let (width, height) = (WIDTH * charts.len() as f64, HEIGHT + CAPTION);
    let mut out = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">
<style>text{{text-anchor:middle}}.title{{font-size:14px}}.left{{text-anchor:end}}.right,.caption{{text-anchor:start}}.grid{{stroke:#ddd;fill:none}}</style>
<rect width="{width}" height="{height}" fill="white"/>
"#
    );
    for (i, chart) in charts.iter().enumerate() {
        writeln!(out, r#"<g transform="translate({} 0)">"#, WIDTH * i as f64)?;
        chart.draw(&mut out)?;
        out.push_str("</g>\n");
    }
    for (i, line) in caption.iter().enumerate() {
        let y = HEIGHT + 8.0 + 16.0 * i as f64;
        writeln!(out, r#"<text x="14" y="{y}" class="caption">{line}</text>"#)?;
    }
    out.push_str("</svg>\n");
    Ok(out)
}
