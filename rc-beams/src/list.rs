//! The table of the beams that come with the program.

use std::fmt::Write as _;

use serde::Serialize;

use crate::spec::{Face, Mode, Series, Specimen, Wrap};

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Row {
    name: String,
    title: String,
    series: Series,
    strengthening: String,
    concrete_strength_mpa: f64,
    /// Distances of the stirrups in the test span, one per zone with stirrups.
    stirrup_spacings_mm: Vec<f64>,
    test_load_kn: Option<f64>,
    mode_observed: Option<Mode>,
}

impl From<&Specimen> for Row {
    fn from(specimen: &Specimen) -> Self {
        let span = &specimen.measuring.test_span;
        let spacings = specimen.stirrups.iter().flat_map(|s| s.spacings(span));
        Self {
            name: specimen.name.clone(),
            title: specimen.title.clone(),
            series: specimen.series,
            strengthening: strengthening(specimen),
            concrete_strength_mpa: specimen.concrete.reported_strength_mpa.get(),
            stirrup_spacings_mm: spacings.collect(),
            test_load_kn: specimen.test.as_ref().map(|t| t.load_kn.get()),
            mode_observed: specimen.test.as_ref().map(|t| t.mode),
        }
    }
}

/// The sheets in a few words, such as `U 90/0`: shape, then the angle of each ply on the side.
fn strengthening(specimen: &Specimen) -> String {
    let Some(sheets) = &specimen.sheets else {
        return "none".into();
    };
    let words = |wrap: &Wrap| wrap_in_words(wrap, specimen.beam.height_mm.get());
    let wraps: Vec<String> = sheets.wraps.iter().map(words).collect();
    wraps.join(" + ")
}

/// Stretches shorter than the beam is high are called strips.
fn wrap_in_words(wrap: &Wrap, height: f64) -> String {
    let cover = |face| wrap.faces.iter().find(|cover| cover.face == face);
    let shape = match [Face::Side, Face::Soffit, Face::Top].map(|face| cover(face).is_some()) {
        [true, true, true] => "full wrap",
        [true, true, false] => "U",
        [true, false, false] => "sides",
        _ => &wrap.name,
    };
    let main = cover(Face::Side).or(wrap.faces.first());
    let angles = main.iter().flat_map(|cover| &cover.angles_deg);
    let angles: Vec<String> = angles.map(|angle| angle.get().to_string()).collect();
    let mut widths: Vec<f64> = wrap
        .stretches
        .iter()
        .map(|s| s.x_to_mm.get() - s.x_from_mm.get())
        .collect();
    widths.sort_by(f64::total_cmp);
    let strips = match widths.get(widths.len() / 2) {
        Some(width) if *width < height => format!(", strips of {width} mm"),
        _ => String::new(),
    };
    format!("{shape} {}{strips}", angles.join("/"))
}

const HEADER: [&str; 7] = [
    "beam",
    "series",
    "strengthening",
    "concrete MPa",
    "stirrups in test span",
    "test kN",
    "mode observed",
];

/// The table as text, columns aligned.
pub fn table(rows: &[Row]) -> String {
    let mut cells = vec![HEADER.map(String::from)];
    cells.extend(rows.iter().map(Row::cells));
    let width = |column: usize| cells.iter().map(|row| row[column].len()).max().unwrap_or(0);
    let widths: [usize; HEADER.len()] = std::array::from_fn(width);
    let mut text = String::new();
    for row in &cells {
        let padded: Vec<String> = row
            .iter()
            .zip(widths)
            .map(|(cell, width)| format!("{cell:width$}"))
            .collect();
        let _ = writeln!(text, "{}", padded.join("  ").trim_end());
    }
    text
}

impl Row {
    fn cells(&self) -> [String; HEADER.len()] {
        let spacings: Vec<String> = self
            .stirrup_spacings_mm
            .iter()
            .map(|s| format!("every {s} mm"))
            .collect();
        [
            self.name.clone(),
            format!("{:?}", self.series),
            self.strengthening.clone(),
            format!("{:.1}", self.concrete_strength_mpa),
            if spacings.is_empty() {
                "none".into()
            } else {
                spacings.join(", ")
            },
            self.test_load_kn
                .map_or("prediction".into(), |load| format!("{load:.1}")),
            self.mode_observed
                .map_or("-".into(), |mode| format!("{mode:?}").to_lowercase()),
        ]
    }
}
