//! What is run: beams, and settings that differ from the default in one thing.

/// A set of beams run with the same options.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// Folder of its results.
    pub name: &'static str,
    /// What differs, for a reader.
    pub what: &'static str,
    /// Options of `rc-beams run`, separated by spaces.
    pub options: &'static str,
    /// Options of beams with sheets where they differ: their meshes have lines that strips need.
    pub with_sheets: Option<&'static str>,
    /// Property of the concrete, in the file of the specimen, that is multiplied by a factor.
    pub scaled: Option<(&'static str, f64)>,
    /// Its beams.
    pub beams: &'static [&'static str],
}

impl Case {
    /// Options for one beam.
    pub fn options_of(&self, beam: &str) -> Vec<&'static str> {
        let bare = beam.starts_with("A-") && beam.ends_with("-1");
        let options = match self.with_sheets {
            Some(options) if !bare => options,
            _ => self.options,
        };
        options.split_whitespace().collect()
    }

    /// Its options, for a reader.
    pub fn written_options(&self) -> String {
        let options = format!("`{}`", self.options);
        match (self.with_sheets, self.scaled) {
            (Some(other), _) => format!("{options}, with sheets `{other}`"),
            (None, Some((property, factor))) => format!("`{property}` times {factor}"),
            (None, None) => options,
        }
    }
}

/// All beams, in the order of tables.
pub const ALL: [&str; 21] = [
    "A-SO3-1", "A-SO4-1", "A-SW3-1", "A-SW4-1", "A-SO3-2", "A-SO3-3", "A-SO3-4", "A-SO3-5",
    "A-SO4-2", "A-SO4-3", "A-SW3-2", "A-SW4-2", "B-CF1", "B-CF2", "B-CF3", "B-CF4", "B-CO1",
    "B-CO2", "B-CO3", "B-CW1", "B-CW2",
];

/// Beams whose tests are known.
pub const KNOWN: &[&str] = ALL.split_at(12).0;

const BARE: &[&str] = &["A-SO3-1", "A-SO4-1", "A-SW3-1", "A-SW4-1"];

/// A beam of each kind.
pub const KINDS: &[&str] = &["A-SO3-1", "A-SW3-1", "A-SO3-2", "A-SW3-2"];

const fn case(
    name: &'static str,
    what: &'static str,
    options: &'static str,
    beams: &'static [&'static str],
) -> Case {
    Case {
        name,
        what,
        options,
        with_sheets: None,
        scaled: None,
        beams,
    }
}

/// Known beams with a property of their concrete that is `factor` times the reported one.
const fn scaled(
    name: &'static str,
    what: &'static str,
    property: &'static str,
    factor: f64,
) -> Case {
    Case {
        scaled: Some((property, factor)),
        ..case(name, what, "", KNOWN)
    }
}

/// The default, with its numerical error and what it would carry with perfect bond.
pub const DEFAULT: Case = case("default", "as it is", "--band --counterfactual", &ALL);

/// Twice the elements along and up: what the error bars are judged by.
pub const TWICE: Case = Case {
    with_sheets: Some("--mesh 120x12"),
    ..case("mesh-120x8", "twice the elements", "--mesh 120x8", &ALL)
};

/// The path without iteration.
pub const MOTION: Case = case("explicit", "slow motion", "--driver explicit", &ALL);

/// The model of the source, on its mesh.
pub const SOURCE: Case = case(
    "source",
    "law of the source",
    "--preset reference --mesh 60x4x1",
    KNOWN,
);

/// Numerical settings.
pub const NUMERICS: [Case; 10] = [
    Case {
        with_sheets: Some("--mesh 88x9"),
        ..case("mesh-88x6", "finer", "--mesh 88x6", KINDS)
    },
    Case {
        with_sheets: Some("--mesh 60x6x1"),
        ..case("mesh-60x4x1", "one across", "--mesh 60x4x1", KNOWN)
    },
    Case {
        with_sheets: Some("--mesh 88x9x1"),
        ..case("mesh-88x6x1", "finer, one across", "--mesh 88x6x1", KINDS)
    },
    Case {
        with_sheets: Some("--mesh 60x6x2"),
        ..case("mesh-60x4x2", "two across", "--mesh 60x4x2", KINDS)
    },
    case("full", "27 points", "--integration full", KINDS),
    case("reduced", "8 points", "--integration reduced", BARE),
    case("floor-up", "floor of shear x 3", "--shear-floor 3e-4", BARE),
    case(
        "floor-down",
        "floor of shear / 3",
        "--shear-floor 3.3e-5",
        BARE,
    ),
    case("criterion", "criterion x 0.3", "--criterion 3e-4", KINDS),
    case(
        "automatic",
        "steps limited by events",
        "--driver automatic",
        &["A-SO3-1"],
    ),
];

/// A beam of each kind on meshes of `rows` over the height, with sheets of others, and so many columns.
macro_rules! meshes {
    (rows: $bare:literal, $sheets:literal; columns: $($columns:literal),+) => {
        [$(Case {
            with_sheets: Some(concat!("--mesh ", $columns, "x", $sheets)),
            ..case(
                concat!("mesh-", $columns, "x", $bare),
                "another mesh",
                concat!("--mesh ", $columns, "x", $bare),
                KINDS,
            )
        }),+]
    };
}

/// Meshes of nearly the size of the default's.
pub const COARSE: [Case; 5] = meshes!(rows: 4, 6; columns: 52, 56, 60, 64, 68);

/// Meshes with half as many elements again along and up.
pub const FINE: [Case; 5] = meshes!(rows: 6, 9; columns: 80, 84, 90, 92, 96);

/// Parameters of the law, one at a time by 20 %.
pub const PARAMETERS: [Case; 20] = [
    scaled("fc-down", "reported strength", "reported_strength_mpa", 0.8),
    scaled("fc-up", "reported strength", "reported_strength_mpa", 1.2),
    scaled("young-down", "modulus", "young_mpa", 0.8),
    scaled("young-up", "modulus", "young_mpa", 1.2),
    scaled("poisson-down", "Poisson's ratio", "poisson", 0.8),
    scaled("poisson-up", "Poisson's ratio", "poisson", 1.2),
    case(
        "ft-down",
        "tensile strength",
        "--tensile-strength-factor 0.8",
        KNOWN,
    ),
    case(
        "ft-up",
        "tensile strength",
        "--tensile-strength-factor 1.2",
        KNOWN,
    ),
    case(
        "gf-down",
        "fracture energy",
        "--fracture-energy-factor 0.8",
        KNOWN,
    ),
    case(
        "gf-up",
        "fracture energy",
        "--fracture-energy-factor 1.2",
        KNOWN,
    ),
    case(
        "gc-down",
        "crushing energy",
        "--crushing-energy-factor 0.8",
        KNOWN,
    ),
    case(
        "gc-up",
        "crushing energy",
        "--crushing-energy-factor 1.2",
        KNOWN,
    ),
    case("aggregate-down", "aggregate", "--aggregate-mm 15.2", KNOWN),
    case("aggregate-up", "aggregate", "--aggregate-mm 22.8", KNOWN),
    case(
        "spacing-down",
        "spacing of cracks",
        "--crack-spacing-mm 40",
        KNOWN,
    ),
    case(
        "spacing-up",
        "spacing of cracks",
        "--crack-spacing-mm 60",
        KNOWN,
    ),
    case("fixing-down", "fixing share", "--fixing-share 0.56", KNOWN),
    case("fixing-up", "fixing share", "--fixing-share 0.84", KNOWN),
    case("band-down", "band width", "--band-factor 0.8", KNOWN),
    case("band-up", "band width", "--band-factor 1.2", KNOWN),
];

#[cfg(test)]
mod tests {
    //! Protects the names of folders: no two cases share one.
    use super::*;

    #[test]
    fn names_are_distinct() {
        let cases = NUMERICS.iter().chain(&PARAMETERS);
        let cases = cases
            .chain(&COARSE)
            .chain(&FINE)
            .chain([&DEFAULT, &TWICE, &MOTION, &SOURCE]);
        let mut names: Vec<&str> = cases.map(|c| c.name).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn meshes_of_beams_with_sheets_have_their_lines() {
        let case = NUMERICS[0];
        assert_eq!(case.options_of("A-SO3-1"), ["--mesh", "88x6"]);
        assert_eq!(case.options_of("A-SO3-2"), ["--mesh", "88x9"]);
        assert_eq!(case.options_of("B-CO1"), ["--mesh", "88x9"]);
    }
}
