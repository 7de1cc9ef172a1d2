//! `report.csv`.

use std::io::{self, Write};

use super::stored::Stored;
use crate::results::table::number;

const COLUMNS: [&str; 18] = [
    "beam",
    "peak_load_kn",
    "deflection_at_peak_mm",
    "mode",
    "trust",
    "test_load_kn",
    "ratio_model_to_test",
    "wall_s",
    "steps",
    "preset",
    "law",
    "driver",
    "integration",
    "mesh",
    "counterfactual_ratio",
    "mode_evidence",
    "trust_reason",
    "stop_reason",
];

/// Writes one row per beam.
pub(super) fn write(out: &mut dyn Write, beams: &[Stored]) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(COLUMNS)?;
    let optional = |value: Option<f64>| value.map_or_else(String::new, number);
    for beam in beams {
        let s = &beam.summary;
        writer.write_record([
            beam.name.clone(),
            number(s.peak_load_kn),
            number(s.deflection_at_peak_mm),
            s.mode.clone(),
            s.trust.clone(),
            optional(s.test_load_kn),
            optional(s.ratio()),
            number(s.wall_s.total),
            s.steps.to_string(),
            s.preset.clone(),
            s.law.clone(),
            s.driver.clone(),
            s.integration.clone(),
            s.mesh.clone(),
            optional(s.counterfactual_ratio),
            s.mode_evidence.clone(),
            s.trust_reason.clone(),
            s.stop_reason.clone(),
        ])?;
    }
    writer.flush()
}
