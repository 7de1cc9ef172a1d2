//! Draws `docs/single_cube.svg`: the concrete laws on one hexahedron against their closed forms.
//!
//! `cargo run --release -p fe-tests --bin single-cube`

use std::path::Path;

use fe_tests::cube::{Failure, cases, curve};
use fe_tests::figure::{Axis, Chart, Series, svg};

const COMMAND: &str = "cargo run --release -p fe-tests --bin single-cube";
const COMPRESSION: f64 = 3.5e-3;
const TENSION: f64 = 2e-3;

/// A closed form at many strains up to `end`, in permille and MPa.
fn line(end: f64, stress: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let strains = (0..=400).map(|i| end * f64::from(i) / 400.0);
    strains.map(|e| [1e3 * e, stress(e)]).collect()
}

/// Magnitudes of a computed path, in permille and MPa.
fn marks(path: &[[f64; 2]]) -> Vec<[f64; 2]> {
    path.iter().map(|[e, s]| [1e3 * e.abs(), s.abs()]).collect()
}

fn main() -> Result<(), Failure> {
    let mut compression = Vec::new();
    let mut tension = Vec::new();
    for (style, case) in cases()?.into_iter().enumerate() {
        compression.push(Series {
            name: case.name.into(),
            style,
            line: line(COMPRESSION, |e| case.crushing.stress(e)),
            marks: marks(&curve(&case.law, -COMPRESSION, 14)?),
        });
        if let Some(softening) = case.tension {
            tension.push(Series {
                name: case.name.into(),
                style,
                line: line(TENSION, |e| softening.stress(e)),
                marks: marks(&curve(&case.law, TENSION, 40)?),
            });
        }
    }
    let charts = [
        Chart {
            title: "Compression".into(),
            x: Axis::from_zero("strain (permille)", 3.5, 0.5),
            y: Axis::from_zero("stress (MPa)", 40.0, 10.0),
            legend: None,
            series: compression,
        },
        Chart {
            title: "Tension".into(),
            x: Axis::from_zero("strain (permille)", 2.0, 0.5),
            y: Axis::from_zero("stress (MPa)", 3.0, 0.5),
            legend: None,
            series: tension,
        },
    ];
    let caption = [
        "Cube of 10 mm, fck = 30 MPa, uniaxial stress. Lines: closed forms; marks: one 20-node hexahedron.",
        COMMAND,
    ];
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/single_cube.svg");
    std::fs::write(&path, svg(&charts, caption)?)?;
    println!("{}", path.display());
    Ok(())
}
