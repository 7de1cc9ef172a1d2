//! Line charts as SVG text: closed forms as lines, computed points as marks.

use std::fmt::Write;

const WIDTH: f64 = 460.0;
const HEIGHT: f64 = 380.0;
const LEFT: f64 = 55.0;
const RIGHT: f64 = 20.0;
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

/// An axis.
#[derive(Debug, Clone)]
pub struct Axis {
    /// Name and unit.
    pub name: String,
    /// First and last value.
    pub ends: [f64; 2],
    /// Distance of its ticks; on one by decades the factor between them.
    pub tick: f64,
    /// Whether equal ratios are equally far apart.
    decades: bool,
}

impl Axis {
    /// An axis from zero to its end.
    pub fn from_zero(name: &str, end: f64, tick: f64) -> Self {
        Self::new(name, [0.0, end], tick)
    }

    /// An axis between its ends.
    pub fn new(name: &str, ends: [f64; 2], tick: f64) -> Self {
        Self {
            name: name.into(),
            ends,
            tick,
            decades: false,
        }
    }

    /// A logarithmic axis between powers of ten.
    pub fn decades(name: &str, ends: [f64; 2]) -> Self {
        Self {
            decades: true,
            ..Self::new(name, ends, 10.0)
        }
    }

    /// Where a value is, from 0 at the first to 1 at the last.
    fn share(&self, value: f64) -> f64 {
        let [first, last] = self.ends;
        if self.decades {
            (value / first).log10() / (last / first).log10()
        } else {
            (value - first) / (last - first)
        }
    }

    /// Values with a tick, and their text.
    fn ticks(&self) -> Vec<(f64, String)> {
        let [first, last] = self.ends;
        if self.decades {
            let values = std::iter::successors(Some(first), |v| Some(v * self.tick));
            let values = values.take_while(|v| *v < 1.1 * last);
            return values.map(|v| (v, format!("{v:.0}"))).collect();
        }
        let decimals = (-self.tick.log10()).ceil().max(1.0) as usize;
        let count = ((last - first) / self.tick).round() as usize;
        let ticks = (0..=count).map(|i| {
            // Added to zero, no zero is negative.
            let value = ((first / self.tick).round() + i as f64) * self.tick + 0.0;
            (value, format!("{value:.decimals$}"))
        });
        ticks.collect()
    }
}

/// One chart.
#[derive(Debug, Clone)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Place of the first line of the legend, on the axes; at the foot of the middle if there is none.
    pub legend: Option<[f64; 2]>,
    /// What is drawn.
    pub series: Vec<Series>,
}

impl Chart {
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (w, h) = (WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM);
        let (x, y) = (self.x.share(x), self.y.share(y));
        [LEFT + x * w, HEIGHT - BOTTOM - y * h]
    }

    fn draw(&self, out: &mut String) -> std::fmt::Result {
        let [[x0, x1], [y0, y1]] = [self.x.ends, self.y.ends];
        let [left, bottom] = self.place([x0, y0]);
        let [right, top] = self.place([x1, y1]);
        let middle = 0.5 * (left + right);
        writeln!(
            out,
            r#"<text x="{middle}" y="24" class="title">{}</text>"#,
            self.title
        )?;
        for (value, text) in self.x.ticks() {
            let [x, _] = self.place([value, y0]);
            writeln!(
                out,
                r#"<path d="M{x:.1} {bottom:.1}V{top:.1}" class="grid"/>"#
            )?;
            writeln!(
                out,
                r#"<text x="{x:.1}" y="{:.1}">{text}</text>"#,
                bottom + 16.0
            )?;
        }
        for (value, text) in self.y.ticks() {
            let [_, y] = self.place([x0, value]);
            writeln!(
                out,
                r#"<path d="M{left:.1} {y:.1}H{right:.1}" class="grid"/>"#
            )?;
            let (x, y) = (left - 6.0, y + 4.0);
            writeln!(
                out,
                r#"<text x="{x:.1}" y="{y:.1}" class="left">{text}</text>"#
            )?;
        }
        let (below, height) = (bottom + 36.0, 0.5 * (top + bottom));
        writeln!(
            out,
            r#"<text x="{middle}" y="{below:.1}">{}</text>"#,
            self.x.name
        )?;
        writeln!(
            out,
            r#"<text transform="translate(14 {height:.1}) rotate(-90)">{}</text>"#,
            self.y.name
        )?;
        for (row, series) in self.series.iter().enumerate() {
            // Each shape comes in another colour every time round.
            let round = series.style / COLOURS.len();
            let colour = COLOURS[(series.style + round) % COLOURS.len()];
            out.push_str(r#"<path d=""#);
            for (i, &point) in series.line.iter().enumerate() {
                let [x, y] = self.place(point);
                write!(out, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' })?;
            }
            writeln!(out, r#"" fill="none" stroke="{colour}"/>"#)?;
            for &point in &series.marks {
                mark(out, self.place(point), series.style, colour)?;
            }
            let foot = HEIGHT - BOTTOM - 18.0 * self.series.len() as f64;
            let [x, y] = self
                .legend
                .map_or([middle - 40.0, foot], |at| self.place(at));
            let y = y + 18.0 * row as f64;
            if series.marks.is_empty() {
                writeln!(
                    out,
                    r#"<path d="M{:.1} {y:.1}h16" stroke="{colour}"/>"#,
                    x - 8.0
                )?;
            } else {
                mark(out, [x, y], series.style, colour)?;
            }
            let (x, y) = (x + 12.0, y + 4.0);
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
