//! The cases of the catalogue, and a table of what they come to.

use std::fmt::Write;

use super::findings::Finding;
use crate::cube::Failure;

/// A case of the catalogue: its name, what it is, and the source of its targets.
pub struct Case(pub &'static str, &'static str, &'static str);

const INDEPENDENT: &str = "computed independently";
const BEAMS: &str = "MacNeal and Harder (1985)";

/// All of them, in the order of their names.
pub const CASES: [Case; 33] = [
    Case("EL-01", "patch test of seven distorted hexahedra", BEAMS),
    Case("EL-02", "modes without energy of one element", INDEPENDENT),
    Case("EL-03", "mechanisms of columns with 8 points", INDEPENDENT),
    Case(
        "EL-03c",
        "mechanism of a column between cracked neighbours",
        "proportion",
    ),
    Case(
        "EL-04",
        "slender beams of six and twelve hexahedra",
        "MacNeal and Harder (1985); ratios computed independently",
    ),
    Case("EL-05", "Cook's membrane", "Cook (1974)"),
    Case("EL-06", "thick tube under pressure", "Lamé"),
    Case(
        "EL-07",
        "thick elliptic plate under pressure",
        "NAFEMS (1990), LE10",
    ),
    Case(
        "EL-08",
        "thermal stress, optional",
        "NAFEMS (1990), LE11: not there, since no law strains by temperature",
    ),
    Case("EL-09", "embedded bar under uniform strain", "statics"),
    Case(
        "EL-09b",
        "bar of constant force on fields without pattern",
        "statics",
    ),
    Case("EL-09c", "bar with bond that does not slip", "statics"),
    Case(
        "EL-10",
        "bar on shared edges, faces, planes of symmetry",
        "statics",
    ),
    Case(
        "EL-11",
        "uniform pressure on an 8-node face",
        "shape functions, integrated",
    ),
    Case("MAT-01", "Ottosen's surface", "Ottosen (1977)"),
    Case(
        "MAT-02",
        "calibration of the surface",
        "Ottosen (1977), table 1",
    ),
    Case(
        "MAT-03",
        "biaxial and confined strength",
        "Ottosen's surface, computed independently",
    ),
    Case(
        "MAT-04",
        "contract of the laws of concrete on random paths",
        "finite differences, thermodynamics",
    ),
    Case(
        "MAT-05",
        "uniaxial compression",
        "fib Model Code 2010, 5.1-26",
    ),
    Case("MAT-06", "cyclic steel bar", "solved by hand"),
    Case("MAT-07", "bilinear bond of sheets", "Lu et al. (2005)"),
    Case(
        "SH-01",
        "patch tests of membranes and shells",
        "MacNeal and Harder (1985), Bathe (1996)",
    ),
    Case(
        "SH-02",
        "thin curved shells",
        "MacNeal and Harder (1985), Belytschko et al. (1985)",
    ),
    Case(
        "SH-03",
        "square plates",
        "Timoshenko and Woinowsky-Krieger (1959), Wang et al. (2000)",
    ),
    Case("SH-04", "slender beams of six shells", BEAMS),
    Case(
        "STR-01",
        "strip pulled off a rigid face",
        "Yuan et al. (2004), closed form",
    ),
    Case(
        "STR-02",
        "peak load over the size of elements",
        "Yuan et al. (2004), closed form",
    ),
    Case("STR-03", "softening bar", "bar and crack in series"),
    Case(
        "STR-04",
        "double cantilever beam, end-notched flexure",
        "beam theory",
    ),
    Case(
        "STR-05",
        "reinforced tie",
        "statics of bars in parallel and in series",
    ),
    Case(
        "STR-06",
        "reinforced section in bending",
        "equilibrium, closed form",
    ),
    Case("STR-07", "reinforced panel in shear", "limit analysis"),
    Case(
        "STR-08",
        "the same model in a turned frame",
        "frame indifference",
    ),
];

/// Not there, and said to be so.
const MISSING: &str = "EL-08";

/// The place of a heading in a document.
pub fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || ['-', '_'].contains(c);
    heading.to_lowercase().chars().filter(kept).collect()
}

/// A table of the findings that stand for cases, with the file each is in.
///
/// # Errors
///
/// A case without a finding, or a finding of a case that is not in the list.
pub fn overview(findings: &[(&str, &Finding)]) -> Result<String, Failure> {
    let mut text = String::from(
        "| case | what | source | where | result of | target | result |\n|---|---|---|---|---|---|---|\n",
    );
    for Case(id, what, source) in &CASES {
        let mine = |(_, finding): &&(&str, &Finding)| finding.parts().0 == Some(id);
        let mine: Vec<_> = findings.iter().filter(mine).collect();
        if mine.is_empty() && *id != MISSING {
            return Err(format!("no test tells a result of {id}").into());
        }
        let mut head = format!("| {id} | {what} | {source}");
        if mine.is_empty() {
            writeln!(text, "{head} | | | | |")?;
        }
        let mut last = "";
        for (file, finding) in mine {
            let name = file.rsplit('/').next().unwrap_or(file);
            let link = if *file == last {
                String::new()
            } else {
                format!("[{name}](#{})", anchor(file))
            };
            last = file;
            let (_, what) = finding.parts();
            let Finding { found, target, .. } = finding;
            writeln!(text, "{head} | {link} | {what} | {target} | {found} |")?;
            head = "| | | ".into();
        }
    }
    for (file, finding) in findings {
        if let (Some(id), _) = finding.parts()
            && CASES.iter().all(|case| case.0 != id)
        {
            return Err(format!("{file} tells a result of {id}, which is not in the list").into());
        }
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    //! Protects the overview against cases that are lost.
    use super::*;

    fn finding(id: &str) -> Finding {
        Finding {
            what: format!("{id}: load"),
            found: "1.02".into(),
            target: "1 ± 0.1".into(),
        }
    }

    #[test]
    fn every_case_has_a_result_or_there_is_no_table() {
        let of_cases = |left_out: &str| -> Vec<Finding> {
            let ids = CASES.iter().map(|case| case.0);
            ids.filter(|id| ![left_out, MISSING].contains(id))
                .map(finding)
                .collect()
        };
        let table = |findings: &[Finding]| {
            let placed: Vec<_> = findings.iter().map(|f| ("tests/tests/a_b.rs", f)).collect();
            overview(&placed)
        };
        let mut all = of_cases("");
        let text = table(&all).unwrap();
        assert!(
            text.contains("| [a_b.rs](#teststestsa_brs) | load | 1 ± 0.1 | 1.02 |\n"),
            "{text}"
        );
        assert!(table(&of_cases("STR-03")).is_err());
        all.push(finding("STR-99"));
        assert!(table(&all).is_err());
    }

    #[test]
    fn cases_are_in_order() {
        assert!(CASES.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }
}
