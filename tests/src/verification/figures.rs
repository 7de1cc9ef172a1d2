//! Figures of the manual: closed forms and targets beside what tests tell by their curves.

use std::f64::consts::FRAC_PI_2;

use fe_contact::{Envelope, PullOut};

use super::findings::Findings;
use crate::cube::Failure;
use crate::delamination::{dcb, enf};
use crate::figure::{Axis, Chart, Series, svg};
use crate::softening_bar::{OPENING, STRENGTH, YOUNG};
use crate::strip;

const COMMAND: &str = "cargo run --release -p fe-tests --bin verification";

/// A figure beside the results of a file of tests.
#[derive(Debug)]
pub struct Figure {
    /// Name of its file, without ending.
    pub name: &'static str,
    /// The file whose tests it shows.
    pub file: &'static str,
    /// What is to be seen.
    pub caption: &'static str,
    /// The picture.
    pub svg: String,
}

/// All figures.
///
/// # Errors
///
/// A curve that no test has told.
pub fn all(findings: &Findings) -> Result<Vec<Figure>, Failure> {
    let figures = [
        (
            "cook",
            "tests/tests/el05_cook.rs",
            "Cook's membrane over the size of its elements, and the limit.",
            vec![cook(findings)?],
        ),
        (
            "elliptic-plate",
            "tests/tests/el07_elliptic_plate.rs",
            "LE10 over the size of the cells, from the Gauss points.",
            vec![elliptic_plate(findings)?],
        ),
        (
            "curved-shells",
            "tests/tests/sh02_curved_shells.rs",
            "Thin curved shells with 4 points over the size of elements.",
            vec![curved_shells(findings)?],
        ),
        (
            "pull-out",
            "tests/tests/str01_pull_out.rs",
            "Strips pulled off a rigid face. Lines: closed form; marks: computed.",
            vec![pull_out(findings)?],
        ),
        (
            "softening-bar",
            "tests/tests/str03_softening_bar.rs",
            "One crack band. Lines: closed form; marks: computed.",
            vec![softening_bar(findings)?],
        ),
        (
            "delamination",
            "tests/tests/str04_delamination.rs",
            "Double cantilever beam and end-notched flexure. Lines: beam theory of a growing crack; marks: computed.",
            vec![double_cantilever(findings)?, end_notched(findings)?],
        ),
        (
            "envelope",
            "fe-materials/src/concrete/ottosen/tests.rs",
            "ft = 0.1 fc. That the surface exceeds tests is its property.",
            vec![envelope(findings)?],
        ),
        (
            "compression",
            "fe-materials/src/concrete/hardening/tests.rs",
            "Curve of the Model Code. Lines: the law; marks: targets.",
            vec![compression(findings)?],
        ),
        (
            "cycles",
            "fe-materials/src/biso.rs",
            "A steel bar to 1 %, -1 % and back: both kinds of hardening.",
            vec![cycles(findings)?],
        ),
    ];
    let drawn = figures.into_iter().map(|(name, file, caption, charts)| {
        Ok(Figure {
            name,
            file,
            caption,
            svg: svg(&charts, [caption, COMMAND])?,
        })
    });
    drawn.collect()
}

fn line(name: &str, style: usize, line: Vec<[f64; 2]>) -> Series {
    Series {
        name: name.into(),
        style,
        line,
        marks: Vec::new(),
    }
}

/// Marks that a line joins.
fn joined(name: &str, style: usize, points: &[[f64; 2]]) -> Series {
    Series {
        marks: points.to_vec(),
        ..line(name, style, points.to_vec())
    }
}

/// In other units.
fn scaled(points: &[[f64; 2]], [a, b]: [f64; 2]) -> Vec<[f64; 2]> {
    points.iter().map(|[x, y]| [a * x, b * y]).collect()
}

/// `n` + 1 values from one to another.
fn between(from: f64, to: f64, n: u32) -> impl Iterator<Item = f64> {
    (0..=n).map(move |i| from + (to - from) * f64::from(i) / f64::from(n))
}

fn cook(findings: &Findings) -> Result<Chart, Failure> {
    Ok(Chart {
        title: "Deflection of the middle of the edge".into(),
        x: Axis::from_zero("1 / elements per side", 0.6, 0.1),
        y: Axis::new("deflection", [22.6, 24.2], 0.2),
        legend: Some([0.05, 23.1]),
        series: vec![
            joined("9 points", 0, findings.curve("cook, 9 points")?),
            joined("4 points", 1, findings.curve("cook, 4 points")?),
            line("limit, 23.96", 2, vec![[0.0, 23.96], [0.6, 23.96]]),
        ],
    })
}

fn elliptic_plate(findings: &Findings) -> Result<Chart, Failure> {
    Ok(Chart {
        title: "Stress at D".into(),
        x: Axis::from_zero("1 / cells along the ellipse", 0.4, 0.1),
        y: Axis::new("- stress yy (MPa)", [5.2, 5.6], 0.1),
        legend: Some([0.25, 5.56]),
        series: vec![
            joined("27 points", 0, findings.curve("LE10, 27 points")?),
            joined("8 points", 1, findings.curve("LE10, 8 points")?),
            line("target, 5.38", 2, vec![[0.0, 5.38], [0.4, 5.38]]),
        ],
    })
}

fn curved_shells(findings: &Findings) -> Result<Chart, Failure> {
    Ok(Chart {
        title: "Displacement over its target".into(),
        x: Axis::from_zero("1 / elements per side", 0.6, 0.1),
        y: Axis::new("ratio", [0.8, 1.1], 0.05),
        legend: Some([0.35, 0.88]),
        series: vec![
            joined("Scordelis-Lo roof", 0, findings.curve("roof")?),
            joined("hemisphere", 1, findings.curve("hemisphere")?),
            joined("pinched cylinder", 2, findings.curve("cylinder")?),
        ],
    })
}

/// Displacement (mm) and force (kN) of the closed form: elastic, softening, coming off, and the last piece at once.
fn closed_pull_out(length: f64) -> Result<Vec<[f64; 2]>, Failure> {
    let bond = strip::bond()?;
    let membrane = strip::YOUNG * strip::THICKNESS;
    let closed = PullOut::new(bond, membrane)?;
    let end = bond.final_slip();
    let last = (FRAC_PI_2 / closed.lambda()[1]).min(length);
    let force = |per_width: f64| 1e-3 * strip::WIDTH * per_width;
    let mut path = vec![[0.0, 0.0]];
    for softened in between(0.0, last, 200) {
        let (p, displacement) = closed.softening(length, softened);
        if displacement < end {
            path.push([displacement, force(p)]);
        }
    }
    for loose in between(0.0, length - last, 200).filter(|_| length > last) {
        let (mut low, mut high) = (0.0, last);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if closed.softening(length - loose, middle).1 < end {
                low = middle;
            } else {
                high = middle;
            }
        }
        let (p, _) = closed.softening(length - loose, low);
        path.push([end + p * loose / membrane, force(p)]);
    }
    path.push([end, 0.0]);
    Ok(path)
}

fn pull_out(findings: &Findings) -> Result<Chart, Failure> {
    let series = |style, length: f64| -> Result<Series, Failure> {
        let found = findings.curve(&format!("pull-out, {length} mm"))?;
        Ok(Series {
            marks: scaled(found, [1.0, 1e-3]),
            ..line(
                &format!("{length} mm bonded"),
                style,
                closed_pull_out(length)?,
            )
        })
    };
    Ok(Chart {
        title: "Force and displacement of the loaded end".into(),
        x: Axis::from_zero("displacement (mm)", 2.0, 0.5),
        y: Axis::from_zero("force (kN)", 10.0, 2.0),
        legend: Some([1.2, 3.0]),
        series: vec![series(0, 50.0)?, series(1, 400.0)?],
    })
}

fn softening_bar(findings: &Findings) -> Result<Chart, Failure> {
    let series = |(style, length): (usize, f64)| -> Result<Series, Failure> {
        let path = vec![
            [0.0, 0.0],
            [length * STRENGTH / YOUNG, STRENGTH],
            [OPENING, 0.0],
        ];
        let found = findings.curve(&format!("softening bar, {length} mm"))?;
        Ok(Series {
            marks: found.to_vec(),
            ..line(&format!("{length} mm"), style, path)
        })
    };
    let lengths = [200.0, 500.0, 1000.0, 2000.0].into_iter().enumerate();
    Ok(Chart {
        title: "Stress and displacement of the end".into(),
        x: Axis::from_zero("displacement (mm)", 0.16, 0.02),
        y: Axis::from_zero("stress (MPa)", 2.5, 0.5),
        legend: Some([0.125, 0.8]),
        series: lengths.map(series).collect::<Result<_, _>>()?,
    })
}

/// Displacement and load of a formula over crack lengths (mm).
fn crack(formula: fn(f64) -> [f64; 2], from: f64, to: f64) -> Vec<[f64; 2]> {
    let points = between(from, to, 200).map(formula);
    points.map(|[load, w]| [w, load]).collect()
}

fn double_cantilever(findings: &Findings) -> Result<Chart, Failure> {
    let computed = Series {
        marks: findings.curve("DCB")?.to_vec(),
        ..line("notch of 30 mm", 0, crack(dcb, 28.0, 42.0))
    };
    Ok(Chart {
        title: "Double cantilever beam".into(),
        x: Axis::from_zero("opening (mm)", 3.5, 0.5),
        y: Axis::from_zero("load (N)", 80.0, 20.0),
        legend: None,
        series: vec![computed],
    })
}

fn end_notched(findings: &Findings) -> Result<Chart, Failure> {
    let mut series = vec![line("beam theory", 3, crack(enf, 19.0, 50.0))];
    for (style, notch) in [20.0, 30.0, 40.0].into_iter().enumerate() {
        series.push(Series {
            marks: findings.curve(&format!("ENF, {notch} mm"))?.to_vec(),
            ..line(&format!("notch of {notch} mm"), style, Vec::new())
        });
    }
    Ok(Chart {
        title: "End-notched flexure".into(),
        x: Axis::from_zero("deflection (mm)", 2.5, 0.5),
        y: Axis::from_zero("load (N)", 500.0, 100.0),
        legend: Some([0.2, 480.0]),
        series,
    })
}

/// Stresses over fc of the fit of Kupfer and Gerstle (1973) to the tests of Kupfer, Hilsdorf and Ruesch (1969).
fn kupfer(ft: f64) -> Vec<[f64; 2]> {
    let mut half = vec![[ft, ft], [0.0, ft]];
    half.extend(between(0.0, 1.0, 20).map(|c| [-c, ft * (1.0 - 0.8 * c)]));
    half.extend(between(0.0, 1.0, 40).map(|ratio| {
        let strength = (1.0 + 3.65 * ratio) / (1.0 + ratio).powi(2);
        [-strength, -ratio * strength]
    }));
    let mirrored: Vec<_> = half.iter().rev().map(|[x, y]| [*y, *x]).collect();
    half.extend(mirrored);
    half
}

fn envelope(findings: &Findings) -> Result<Chart, Failure> {
    let targets = Series {
        marks: findings.curve("envelope targets")?.to_vec(),
        ..line("its targets", 0, Vec::new())
    };
    Ok(Chart {
        title: "Biaxial strength".into(),
        x: Axis::new("stress 1 over fc", [-1.5, 0.5], 0.5),
        y: Axis::new("stress 2 over fc", [-1.5, 0.5], 0.5),
        legend: Some([-0.7, -0.3]),
        series: vec![
            line("Ottosen's surface", 0, findings.curve("envelope")?.to_vec()),
            targets,
            line("Kupfer and Gerstle", 1, kupfer(0.1)),
        ],
    })
}

fn compression(findings: &Findings) -> Result<Chart, Failure> {
    let series = |(style, fck): (usize, f64)| -> Result<Series, Failure> {
        let law = findings.curve(&format!("compression, fck = {fck}"))?;
        let targets = findings.curve(&format!("compression targets, fck = {fck}"))?;
        Ok(Series {
            marks: targets.to_vec(),
            ..line(&format!("fck = {fck} MPa"), style, law.to_vec())
        })
    };
    let strengths = [20.0, 30.0].into_iter().enumerate();
    Ok(Chart {
        title: "Uniaxial compression".into(),
        x: Axis::from_zero("strain (permille)", 3.5, 0.5),
        y: Axis::from_zero("stress (MPa)", 40.0, 10.0),
        legend: None,
        series: strengths.map(series).collect::<Result<_, _>>()?,
    })
}

fn cycles(findings: &Findings) -> Result<Chart, Failure> {
    let series = |(style, name): (usize, &str)| -> Result<Series, Failure> {
        let path = findings.curve(&format!("cycle, {name}"))?;
        Ok(line(&name.to_lowercase(), style, path.to_vec()))
    };
    let kinds = ["Kinematic", "Isotropic"].into_iter().enumerate();
    Ok(Chart {
        title: "Cyclic steel bar".into(),
        x: Axis::new("strain (permille)", [-12.0, 12.0], 4.0),
        y: Axis::new("stress (MPa)", [-600.0, 600.0], 200.0),
        legend: Some([-4.0, 50.0]),
        series: kinds.map(series).collect::<Result<_, _>>()?,
    })
}
