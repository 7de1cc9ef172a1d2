//! The matrix as SVG text.

use std::fmt::Write;

use super::{Method, Outcome};

const NAME: f64 = 650.0;
const CELL: [f64; 2] = [64.0, 26.0];
const HEAD: f64 = 150.0;

/// Rows with a name and one outcome per method that applies, below the names of the methods, above a caption.
///
/// # Errors
///
/// None: a string takes what is written.
pub fn chart(
    rows: &[(String, Vec<Option<Outcome>>)],
    caption: &str,
) -> Result<String, std::fmt::Error> {
    let width = NAME + CELL[0] * Method::ALL.len() as f64 + 80.0;
    let bottom = HEAD + CELL[1] * rows.len() as f64;
    let mut out = String::new();
    writeln!(
        out,
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{}" font-family="sans-serif" font-size="12">"#,
        bottom + 70.0
    )?;
    writeln!(out, r#"<rect width="100%" height="100%" fill="white"/>"#)?;
    for (i, method) in Method::ALL.iter().enumerate() {
        let x = NAME + CELL[0] * (i as f64 + 0.5);
        let (y, name) = (HEAD - 8.0, method.label());
        writeln!(
            out,
            r#"<text x="{x}" y="{y}" transform="rotate(-55 {x} {y})">{name}</text>"#
        )?;
    }
    for (row, (name, outcomes)) in rows.iter().enumerate() {
        let y = HEAD + CELL[1] * row as f64;
        writeln!(out, r#"<text x="10" y="{}">{name}</text>"#, y + 17.0)?;
        for (i, outcome) in outcomes.iter().enumerate() {
            if let Some(outcome) = outcome {
                cell(&mut out, [NAME + CELL[0] * i as f64, y], *outcome)?;
            }
        }
    }
    for (i, outcome) in Outcome::ALL.into_iter().enumerate() {
        let x = 10.0 + 190.0 * i as f64;
        cell(&mut out, [x, bottom + 12.0], outcome)?;
        let (x, y, label) = (x + CELL[0] + 6.0, bottom + 29.0, outcome.label());
        writeln!(out, r#"<text x="{x}" y="{y}">{label}</text>"#)?;
    }
    writeln!(
        out,
        r#"<text x="10" y="{}" fill="gray">{caption}</text>"#,
        bottom + 60.0
    )?;
    writeln!(out, "</svg>")?;
    Ok(out)
}

/// A coloured cell with a sign of its own, for those who see no colours.
fn cell(out: &mut String, [x, y]: [f64; 2], outcome: Outcome) -> std::fmt::Result {
    let (w, h) = (CELL[0] - 4.0, CELL[1] - 4.0);
    let (colour, cx) = (outcome.colour(), x + 0.5 * w);
    let sign = match outcome {
        Outcome::Correct => "+",
        Outcome::Stopped => "|",
        Outcome::Reported => "?",
        Outcome::Silent => "!",
    };
    writeln!(
        out,
        r#"<rect x="{x}" y="{y}" width="{w}" height="{h}" fill="{colour}"/><text x="{cx}" y="{}" text-anchor="middle" font-weight="bold">{sign}</text>"#,
        y + 16.0
    )
}
