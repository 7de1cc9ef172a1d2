//! Pictures of the report.

use std::path::Path;

use super::ReportError;
use super::stored::Stored;
use crate::results::curve::{GroupCurves, GroupLine};
use crate::results::drawing::Picture;
use crate::results::folder::Folder;
use crate::results::sheets::{MapState, SheetView, Shown};

/// A group of beams with the name of its picture.
pub(super) struct Group {
    pub name: String,
    pub file: String,
}

/// The name without its last number: `A-SO3` of `A-SO3-4`, `B-CO` of `B-CO1`.
pub(super) fn group_of(specimen: &str) -> &str {
    let name = specimen.trim_end_matches(|c: char| c.is_ascii_digit());
    let name = name.trim_end_matches(['-', '_', '.']);
    if name.is_empty() { specimen } else { name }
}

/// Draws `report-GROUP.svg` for each group of beams whose path is known, in the order of their names.
pub(super) fn groups(folder: &Folder, beams: &[Stored]) -> Result<Vec<Group>, ReportError> {
    let mut names: Vec<&str> = beams
        .iter()
        .filter(|b| !b.path.is_empty())
        .map(|b| group_of(&b.summary.specimen))
        .collect();
    names.sort_unstable();
    names.dedup();
    let mut groups = Vec::new();
    for name in names {
        let members = beams
            .iter()
            .filter(|b| !b.path.is_empty() && group_of(&b.summary.specimen) == name);
        let lines: Vec<GroupLine<'_>> = members
            .map(|b| GroupLine {
                name: &b.name,
                path: &b.path,
                peak: [b.summary.deflection_at_peak_mm, b.summary.peak_load_kn],
                test_load_kn: b.summary.test_load_kn,
            })
            .collect();
        let picture = GroupCurves {
            name,
            lines: &lines,
        };
        let safe = |c: char| {
            if c.is_alphanumeric() || "-_.".contains(c) {
                c
            } else {
                '_'
            }
        };
        let file = format!("report-{}", name.chars().map(safe).collect::<String>());
        picture.save_svg(folder, &file)?;
        groups.push(Group {
            name: name.to_owned(),
            file: file + ".svg",
        });
    }
    Ok(groups)
}

/// Draws `slip.svg` and `sheet.svg` of a beam where they are missing and its points are known.
pub(super) fn sheets(path: &Path, beam: &Stored) -> Result<(), ReportError> {
    for shown in [Shown::Slip, Shown::FibreStress] {
        let file = format!("{}.svg", shown.file());
        if !shown.is_in(&beam.map) || super::exists(&path.join(file)) {
            continue;
        }
        let summary = &beam.summary;
        let title = shown.title(summary.peak_load_kn, summary.deflection_at_peak_mm);
        let view = SheetView {
            specimen: &summary.specimen,
            title: &title,
            shown,
            state: MapState::Peak,
            rows: &beam.map,
            zones: &[],
            elements: &[],
            supports: &[],
            loads: &[],
        };
        view.save_svg(&Folder::open(path)?, shown.file())?;
    }
    Ok(())
}
