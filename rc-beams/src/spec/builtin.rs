//! The specimens that come with the program.

/// Name and text of every specimen file of the folder `specimens`, sorted by name.
pub const BUILTIN: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/builtin.rs"));

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{Series, Specimen, Stirrups, read};

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
                "A-SO3-1", "A-SO3-4", "A-SO4-1", "A-SW3-1", "A-SW4-1", "B-CF1", "B-CO1", "B-CW1"
            ]
        );
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
            let (count, last) = match s.name.as_str() {
                "A-SO3-1" | "A-SO3-4" | "A-SO4-1" => (13 + 4, Some(3025.0)),
                "A-SW3-1" | "A-SW4-1" => (19 + 13, Some(3025.0)),
                "B-CW1" => (29 + 19, Some(4855.0)),
                "B-CO1" => (19 + 11, Some(4855.0)),
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
