//! The specimens that come with the program.

/// Name and text of every specimen file of the folder `specimens`, sorted by name.
pub const BUILTIN: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/builtin.rs"));

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{Cover, Series, SheetGauge, Specimen, Stirrups, Stretch, Wrap, read};

    fn builtin() -> Vec<Specimen> {
        BUILTIN
            .iter()
            .map(|(name, text)| read(name, text).unwrap())
            .collect()
    }

    /// Protects the files: each is read without error and carries the name of its file.
    #[test]
    fn all_files_are_read() {
        let names: Vec<String> = builtin().into_iter().map(|s| s.name).collect();
        let files: Vec<&str> = BUILTIN.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, files);
        assert_eq!(
            files,
            [
                "A-SO3-1", "A-SO3-2", "A-SO3-3", "A-SO3-4", "A-SO3-5", "A-SO4-1", "A-SO4-2",
                "A-SO4-3", "A-SW3-1", "A-SW3-2", "A-SW4-1", "A-SW4-2", "B-CF1", "B-CF2", "B-CF3",
                "B-CF4", "B-CO1", "B-CO2", "B-CO3", "B-CW1", "B-CW2"
            ]
        );
    }

    /// Protects the strengthened beams: without sheets, gauges on them, title, deflection and result of the
    /// test, each is the bare beam of its group.
    #[test]
    fn strengthened_beams_are_the_bare_beams_with_sheets() {
        let beams = builtin();
        let bare = |name: &str| beams.iter().find(|s| s.name == name);
        for s in &beams {
            let first = format!("{}1", &s.name[..s.name.len() - 1]);
            let first = bare(&first).unwrap();
            let mut stripped = s.clone();
            stripped.sheets = None;
            stripped.measuring.sheet_gauges.clear();
            stripped.name.clone_from(&first.name);
            stripped.title.clone_from(&first.title);
            stripped.imposed = first.imposed.clone();
            stripped.test.clone_from(&first.test);
            assert_eq!(&stripped, first, "{}", s.name);
            assert_eq!(s.sheets.is_none(), s.name == first.name, "{}", s.name);
        }
    }

    /// Protects the layouts: area of fibre sheet in the half model (mm2, plies and overlap counted), by hand
    /// from the widths of the strips and the lengths of the sheets of Soares (2022), chapters 5 and 6.
    #[test]
    fn sheets_have_the_area_of_the_layout() {
        let (side, soffit) = (305.0, 75.0);
        let spans = 2.0 * (2290.0 - 510.0);
        for s in builtin() {
            let Some(sheets) = &s.sheets else { continue };
            let (along, side_plies) = match s.name.as_str() {
                "A-SO3-2" => (14.0 * 50.0, 1.0),
                "A-SO3-3" => (12.0 * 75.0 + 2.0 * 78.75, 1.0),
                "A-SO3-4" => (1830.0 - 120.0, 1.0),
                "A-SO3-5" | "A-SW3-2" => (1830.0 - 120.0, 2.0),
                "A-SO4-2" => (17.0 * 50.0, 1.0),
                "A-SO4-3" => (2240.0 - 120.0, 1.0),
                "A-SW4-2" => (2240.0 - 120.0, 2.0),
                "B-CO2" => (28.0 * 50.0, 1.0),
                "B-CO3" | "B-CF2" => (spans, 1.0),
                "B-CW2" | "B-CF3" => (spans, 2.0),
                "B-CF4" => (spans - 200.0, 1.0),
                other => panic!("{other}"),
            };
            let top = if s.name == "B-CF4" { 75.0 + 25.0 } else { 0.0 };
            let expected = along * (side_plies * side + soffit + top);
            let wraps = sheets.wraps.iter();
            let area: f64 = wraps.map(|wrap| length(wrap) * girth(wrap)).sum();
            assert!(
                (area - expected).abs() < 1e-6 * expected,
                "{}: {area}",
                s.name
            );
        }
    }

    fn length(wrap: &Wrap) -> f64 {
        let length = |s: &Stretch| s.x_to_mm.get() - s.x_from_mm.get();
        wrap.stretches.iter().map(length).sum()
    }

    /// Width of all plies round the half section (mm).
    fn girth(wrap: &Wrap) -> f64 {
        let width =
            |c: &Cover| (c.to_mm.get() - c.from_mm.get()) * c.angles_deg.len() as f64 * c.smear();
        wrap.faces.iter().map(width).sum()
    }

    /// Protects the gauges: on sheets, three in the test span, three more in the other span of group B-CF.
    #[test]
    fn gauges_are_counted() {
        for s in builtin() {
            let gauges = &s.measuring.sheet_gauges;
            let expected = match (&s.sheets, s.name.starts_with("B-CF")) {
                (None, _) => 0,
                (_, false) => 3,
                (_, true) => 6,
            };
            assert_eq!(gauges.len(), expected, "{}", s.name);
            let span = &s.measuring.test_span;
            let inside = |g: &&SheetGauge| span.x_from_mm < g.x_mm && g.x_mm < span.x_to_mm;
            assert_eq!(
                gauges.iter().filter(inside).count(),
                expected.min(3),
                "{}",
                s.name
            );
        }
    }

    /// Protects outline, density and gravity: a beam of series A weighs 3.477 kN (3.05 x 0.15 x 0.305 m,
    /// 2540 kg/m3, 9.81 m/s2).
    #[test]
    fn beams_of_series_a_weigh_3_477_kn() {
        for s in builtin().iter().filter(|s| s.series == Series::A) {
            let beam = &s.beam;
            let volume = [
                beam.length_mm.get(),
                beam.width_mm.get(),
                beam.height_mm.get(),
            ]
            .map(|mm| 1e-3 * mm)
            .iter()
            .product::<f64>();
            let weight =
                volume * s.concrete.density_kg_m3.get() * s.gravity.acceleration_m_s2.get();
            assert!((weight - 3477.0).abs() < 0.5, "{}: {weight} N", s.name);
        }
    }

    /// Protects the zones: counts of stirrups after the spacings of Soares (2022), positions of
    /// A-SO3-1 and A-SO4-1 as in appendix A there.
    #[test]
    fn stirrups_are_counted() {
        for s in builtin() {
            let positions = s
                .stirrups
                .iter()
                .flat_map(Stirrups::positions)
                .collect::<Vec<_>>();
            let group = &s.name[..s.name.len() - 1];
            let (count, last) = match group {
                "A-SO3-" | "A-SO4-" => (13 + 4, Some(3025.0)),
                "A-SW3-" | "A-SW4-" => (19 + 13, Some(3025.0)),
                "B-CW" => (29 + 19, Some(4855.0)),
                "B-CO" => (19 + 11, Some(4855.0)),
                _ => (0, None),
            };
            assert_eq!(
                (positions.len(), positions.last().copied()),
                (count, last),
                "{}",
                s.name
            );
        }
    }
}
