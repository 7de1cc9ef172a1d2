//! Protects the first hour of a new user: every mistake in an input gets one clear message with file,
//! line, column, field, allowed range and remedy, a code other than 0, and changes no file.

mod bond;
mod once;
mod sheets;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const BEAM: &str = include_str!("../../specimens/A-SO3-1.ron");

fn rc_beams(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rc-beams"))
        .args(arguments)
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .output()
        .unwrap()
}

/// Standard error on one line, so that wrapping does not matter.
fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr)
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}

/// Runs a copy of a beam with one text replaced.
fn run_changed(beam: &str, from: &str, to: &str) -> (String, Option<i32>) {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(
        beam.matches(from).count(),
        1,
        "{from:?} must stand once in the file"
    );
    fs::write(folder.path().join("beam.ron"), beam.replace(from, to)).unwrap();
    let output = rc_beams(&["run", "beam.ron"], folder.path());
    let left: Vec<_> = fs::read_dir(folder.path())
        .unwrap()
        .map(|e| e.unwrap().file_name())
        .collect();
    assert_eq!(left, ["beam.ron"], "nothing may be written");
    assert!(output.stdout.is_empty());
    (message(&output), output.status.code())
}

/// Target: who closes standard error still gets the code of the finding.
#[test]
fn a_closed_standard_error_leaves_the_code() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let status = Command::new(env!("CARGO_BIN_EXE_rc-beams"))
        .args(["check", "no_such_beam"])
        .stderr(writer)
        .status();
    let unknown = rc_beams(&["check", "no_such_beam"], Path::new("."));
    assert_eq!(status.unwrap().code(), unknown.status.code());
}

/// Target: where the plates before leave no place for one on the beam, that is said, and no range is made up.
#[test]
fn a_plate_without_a_place_is_refused() {
    let (message, code) = run_changed(BEAM, "x_mm: 610,", "x_mm: 2990,");
    assert_eq!(code, Some(3));
    for words in [
        "supports[1].x_mm: centre of the support at 2440 mm",
        "has no place on a beam of 3050 mm behind 3040 mm",
        "order the supports from left to right",
    ] {
        assert!(message.contains(words), "{words}: {message}");
    }
}

/// `beam.ron:line:column` of `what` inside the changed text.
fn place(beam: &str, from: &str, to: &str, what: &str) -> String {
    let text = beam.replace(from, to);
    let at = text.find(to).unwrap() + to.find(what).unwrap();
    let line = text[..at].matches('\n').count() + 1;
    let column = text[..at].chars().rev().take_while(|c| *c != '\n').count() + 1;
    format!("[beam.ron:{line}:{column}]")
}

/// Text replaced, replacement, the part of it pointed at, words of the message.
type Case = (
    &'static str,
    &'static str,
    &'static str,
    &'static [&'static str],
);

const CASES: &[Case] = &[
    // No place is left for a plate.
    (
        "x_mm: 2440,",
        "x_mm: 3010,",
        "3010",
        &[
            "supports[1].x_mm",
            "allowed: 710 to 3000 mm",
            "a plate of 100 mm lies on the beam",
        ],
    ),
    // Plates almost on one another's edges, and almost at the end of the beam.
    (
        "x_mm: 1370,",
        "x_mm: 710.1,",
        "710.1",
        &[
            "loads[0].x_mm: edge of a plate at 660.1 mm, 0.100 mm from the edge of a plate at 660 mm",
            "allowed: on it, or 3 mm from it or more",
        ],
    ),
    (
        "x_mm: 610,",
        "x_mm: 50.5,",
        "50.5",
        &["supports[0].x_mm: edge of a plate at 0.5 mm, 0.500 mm from the end of the beam at 0 mm"],
    ),
    // Softer than the strength and the strain there allow.
    (
        "young_mpa: 25000",
        "young_mpa: 6000",
        "6000",
        &[
            "concrete.young_mpa: 6000 MPa is too soft for this strength; allowed: (13",
            "give the modulus at the origin",
        ],
    ),
    // No convex surface of onset goes through both strengths.
    (
        "reported_tensile_mpa: 2.7",
        "reported_tensile_mpa: 9",
        "9",
        &[
            "concrete.reported_tensile_mpa: 9 MPa does not go with the compressive strength; allowed: up to",
            "leave it out for that of the Model Code, 2.17 MPa",
        ],
    ),
    (
        "reported_tensile_mpa: 2.7",
        "reported_tensile_mpa: 0.4",
        "0.4",
        &[
            "concrete.reported_tensile_mpa: 0.4 MPa does not go",
            "allowed: from",
        ],
    ),
    // Unknown field.
    (
        "reported_strength_mpa: 27.5",
        "reported_strenght_mpa: 27.5",
        "reported_strenght_mpa",
        &[
            "concrete.reported_strenght_mpa: no such field",
            "did you mean `reported_strength_mpa`?",
            "allowed: reported_strength_mpa, reported_tensile_mpa, young_mpa, poisson",
        ],
    ),
    // Wrong magnitude of units.
    (
        "young_mpa: 25000",
        "young_mpa: 25",
        "25",
        &[
            "concrete.young_mpa: 25 MPa is out of range",
            "allowed: 5000 to 60000 MPa",
            "is it in GPa? Then write 25000",
        ],
    ),
    (
        "length_mm: 3050",
        "length_mm: 3.05",
        "3.05",
        &[
            "beam.length_mm: 3.05 mm",
            "allowed: 500 to 20000 mm",
            "is it in m? Then write 3050",
        ],
    ),
    (
        "density_kg_m3: 2540",
        "density_kg_m3: 2.54",
        "2.54",
        &[
            "concrete.density_kg_m3",
            "allowed: 1000 to 4000 kg/m3",
            "in t/m3? Then write 2540",
        ],
    ),
    // Decimal comma, unit behind a number, letters in it, two for one, fraction for a count.
    (
        "density_kg_m3: 2540",
        "density_kg_m3: 254e4kg",
        "254e4kg",
        &[
            "concrete.density_kg_m3: a number with letters in it",
            "the name of the field states the unit",
        ],
    ),
    (
        "density_kg_m3: 2540",
        "density_kg_m3: 0x9ec",
        "0x9ec",
        &["concrete.density_kg_m3: a number with letters in it"],
    ),
    (
        "length_mm: 3050,",
        "length_mm: 3050 5,",
        "3050 5",
        &[
            "beam.length_mm: two numbers where one belongs",
            "write 3050 or 5",
        ],
    ),
    (
        "length_mm: 3050,",
        "length_mm: 3050,0,",
        "3050,0",
        &[
            "beam.length_mm: a number with a decimal comma",
            "use a decimal point: 3050.0",
        ],
    ),
    (
        "density_kg_m3: 2540,",
        "density_kg_m3: 0,254,",
        "0,254",
        &[
            "concrete.density_kg_m3: a number with a decimal comma",
            "use a decimal point: 0.254",
        ],
    ),
    (
        "length_mm: 3050,",
        "length_mm: 3050 mm,",
        "3050 mm",
        &[
            "beam.length_mm: a number with a unit behind it",
            "write 3050 alone",
        ],
    ),
    (
        "load: TotalReactions",
        "load: InnerShear(end_support: 1.5)",
        "1.5",
        &["measuring.load.InnerShear.end_support: a fraction; allowed: whole numbers"],
    ),
    // What is no part of the language.
    (
        "    series: A,",
        "    #include \"series.ron\"\n    series: A,",
        "#include",
        &[
            "a line that begins with `#`",
            "a file stands alone and has no directives; a comment begins with //",
        ],
    ),
    (
        "bars: [",
        "bars: [\n% of the test",
        "% of",
        &[
            "bars[0]: a line that begins with `%`",
            "a comment begins with //",
        ],
    ),
    (
        "(\n    name:",
        "#include \"all.ron\"\n(\n    name:",
        "#include",
        &["a line that begins with `#`"],
    ),
    (
        "    beam: (",
        "    beam: include(\"beam.ron\"), other: (",
        "include",
        &["beam: `include`", "a file stands alone"],
    ),
    // Not a number.
    (
        "length_mm: 3050",
        "length_mm: NaN",
        "NaN",
        &[
            "beam.length_mm: NaN is not a finite number",
            "allowed: 500 to 20000 mm",
        ],
    ),
    (
        "load_kn: 151.0",
        "load_kn: inf",
        "inf",
        &[
            "test.load_kn: inf is not a finite number",
            "allowed: 1 to 10000 kN",
        ],
    ),
    // Negative cross-section; one that contradicts the diameter.
    (
        "area_mm2: 78.54",
        "area_mm2: -78.54",
        "-78.54",
        &[
            "stirrups.area_mm2: -78.54 mm2 is out of range",
            "allowed: 5 to 3000 mm2",
        ],
    ),
    (
        "area_mm2: 78.54",
        "area_mm2: 785.4",
        "785.4",
        &[
            "stirrups.area_mm2: 785.4 mm2 for a diameter of 10 mm",
            "allowed: 62.8 to 86.4 mm2",
        ],
    ),
    // Reinforcement outside the concrete.
    (
        "y_mm: 254",
        "y_mm: 354",
        "354",
        &[
            "bars[1].axis.y_mm: axis of bar \"top\" at 354 mm",
            "allowed: 16 to 289 mm",
            "y is measured from the soffit",
        ],
    ),
    (
        "vertical: (z_mm: 45",
        "vertical: (z_mm: 95",
        "95",
        &[
            "stirrups.shape.vertical.z_mm: vertical leg at 95 mm",
            "allowed: 5 to 70 mm",
        ],
    ),
    (
        "first_mm: 2650",
        "first_mm: 2600",
        "2600",
        &[
            "stirrups.zones[2].stirrups.first_mm: first stirrup at 2600",
            "allowed: 2650 to 3050 mm",
        ],
    ),
    (
        "x_from_mm: 2650",
        "x_from_mm: 2700",
        "2700",
        &["stirrups.zones[2].x_from_mm: zone begins at 2700 mm; allowed: 2650 mm"],
    ),
    // Supports and loads.
    (
        "held: [Uy]",
        "held: []",
        "",
        &[
            "supports[1].held: holds nothing; allowed: Ux, Uy, or both",
            "name what it holds, or leave the support out",
        ],
    ),
    (
        "held: [Uy]",
        "held: [Ux]",
        "",
        &[
            "supports: supports that hold Uy: 1; allowed: at least 2",
            "add a support with `held: [Uy]`",
        ],
    ),
    (
        "held: [Ux, Uy]",
        "held: [Uy]",
        "",
        &[
            "supports that hold Ux: 0; allowed: at least 1",
            "write `held: [Ux, Uy]` at one support",
        ],
    ),
    (
        "held: [Ux, Uy]",
        "held: [Uz, Uy]",
        "Uz",
        &["supports[0].held[0]: no such choice", "allowed: Ux, Uy"],
    ),
    (
        "x_mm: 610",
        "x_mm: 10",
        "10",
        &[
            "supports[0].x_mm: centre of the support at 10 mm",
            "allowed: 50 to 3000 mm",
        ],
    ),
    (
        "x_mm: 1680",
        "x_mm: 1400",
        "1400",
        &[
            "loads[1].x_mm: centre of the load at 1400 mm",
            "allowed: 1470 to 3000 mm",
        ],
    ),
    (
        "x_mm: 1370",
        "x_mm: 680",
        "680",
        &[
            "loads[0].x_mm: centre of the load at 680 mm, above the support at 610 mm",
            "allowed: 100 mm or more away from it",
        ],
    ),
    (
        "stub: None,\n            source: \"Soares (2022), chapters 5 and 6\",\n        ),\n    ]",
        "stub: (length_mm: 200, depth_mm: 150, source: \"\"), source: \"\",\n        ),\n    ]",
        "200",
        &[
            "supports[1].stub.length_mm: stub of 200 mm",
            "allowed: 100 mm, the length of its plate",
        ],
    ),
    // Measuring points.
    (
        "load: TotalReactions",
        "load: InnerShear(end_support: 0)",
        "InnerShear",
        &[
            "measuring.load: shear at an inner support of 2 supports",
            "allowed: 3 supports",
        ],
    ),
    // Bars that leave no room for concrete.
    (
        "name: \"bottom\",\n            diameter_mm: 32,\n            area_mm2: 804.25,\n            count_in_half: 1",
        "name: \"bottom\",\n            diameter_mm: 32,\n            area_mm2: 804.25,\n            count_in_half: 100",
        "100",
        &[
            "bars[0].count_in_half: all bars have",
            "allowed: 4575 mm2, a fifth",
        ],
    ),
    (
        "y_mm: 0,",
        "y_mm: 306,",
        "306",
        &[
            "measuring.deflection.y_mm: deflection read at 306 mm",
            "allowed: 0 to 305 mm",
        ],
    ),
    (
        "x_mm: 1525,\n            y_mm: 0,",
        "x_mm: 640,\n            y_mm: 0,",
        "640",
        &[
            "measuring.deflection.x_mm: deflection read at 640 mm, above the support at 610 mm",
            "allowed: more than",
        ],
    ),
    (
        "held: [Ux, Uy]",
        "held: [Ux, Uy, Uy]",
        "",
        &["supports[0].held: Uy stands twice"],
    ),
    // Counts.
    (
        "y_mm: 51,",
        "y_mm: \"51\",",
        "",
        &["bars[0].axis.y_mm: a number is expected"],
    ),
    // Shape of the file.
    (
        "series: A,",
        "",
        "",
        &["the field `series` is missing", "add `series: ...`"],
    ),
    (
        "series: A,",
        "series: A, series: A,",
        "",
        &["the field `series` stands twice"],
    ),
    (
        "series: A,",
        "series: C,",
        "C",
        &["series: no such choice", "allowed: A, B"],
    ),
    (
        "title: \"Simply",
        "title: \"Two\\nlines, simply",
        "",
        &[
            "title: \"Two\\nlines",
            "control characters; allowed: one line",
        ],
    ),
    (
        "name: \"A-SO3-1\"",
        "name: \"../x\"",
        "\"../x\"",
        &["name: \"../x\" cannot name a folder"],
    ),
];

#[test]
fn mistakes_in_a_file_are_named_with_their_place() {
    check_cases(BEAM, CASES);
}

/// Target: shear at an inner support is read off equal shares of the load, so spans carry alike and supports hold up.
#[test]
fn shear_of_unlike_spans_is_refused() {
    let beam = include_str!("../../specimens/B-CF1.ron");
    assert!(beam.contains("InnerShear"));
    let cases: &[Case] = &[
        (
            "x_mm: 1375,",
            "x_mm: 3000,",
            "",
            &[
                "measuring.load: shear at an inner support of spans of 1980 and 1980 mm with loads [] and [560.0, 1065.0] mm",
                "allowed: equal spans with loads at equal places within them, to 1 %",
            ],
        ),
        // As many loads in every span, at other places; in an overhang.
        (
            "x_mm: 1375,",
            "x_mm: 1000,",
            "",
            &["with loads [1440.0] and [1065.0] mm from it"],
        ),
        (
            "x_mm: 1375,",
            "x_mm: 200,",
            "",
            &["with loads [2240.0] and"],
        ),
        (
            "            x_mm: 460,\n            held: [Uy],",
            "            x_mm: 460,\n            held: [Ux],",
            "",
            &["supports[0].held: no Uy, where shear at an inner support is measured"],
        ),
    ];
    check_cases(beam, cases);
}

fn check_cases(beam: &str, cases: &[Case]) {
    for (from, to, what, words) in cases {
        let (message, code) = run_changed(beam, from, to);
        assert_eq!(code, Some(3), "{to:?}: {message}");
        for words in *words {
            assert!(
                message.contains(words),
                "{to:?}: {words:?} is missing in:\n{message}"
            );
        }
        let place = if what.is_empty() {
            "[beam.ron:".into()
        } else {
            place(beam, from, to, what)
        };
        assert!(
            message.contains(&place),
            "{to:?}: {place} is missing in:\n{message}"
        );
        assert!(message.ends_with("nothing was run"), "{to:?}: {message}");
    }
}

/// Arguments, exit code, words of the message.
type Arguments = (&'static [&'static str], i32, &'static [&'static str]);

const STAGED: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/specimens/examples/A-SO3-4-staged.ron"
);
const CASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/cyclic-bar.ron");

const COMMANDS: &[Arguments] = &[
    (&["point", "missing.ron"], 4, &["cannot read missing.ron"]),
    (
        &["point", CASE, "-o", "file/x.csv"],
        4,
        &["cannot write file/x.csv"],
    ),
    (&["run"], 2, &["<BEAM>..."]),
    (
        &["run", "A-SO31"],
        2,
        &[
            "no beam `A-SO31`",
            "did you mean `A-SO3-1`?",
            "rc-beams list",
        ],
    ),
    (
        &["run", "A-SO3-1", "A-SO3-1"],
        2,
        &["the beam `A-SO3-1` is given twice, by A-SO3-1 and A-SO3-1"],
    ),
    (
        &["run", "missing.ron"],
        4,
        &["cannot read missing.ron", "No such file", "check the path"],
    ),
    (
        &["check", "missing.ron"],
        4,
        &["cannot read missing.ron", "1 checked, 1 bad"],
    ),
    (
        &["run", "A-SO3-1", "-o", "file"],
        4,
        &["cannot write file", "--output"],
    ),
    (
        &["run", "A-SO3-1", "-o", "file/below"],
        4,
        &["cannot write file/below", "nothing was run"],
    ),
    (
        &["run", "A-SO3-1", "--tensile-strength-factor", "0.25"],
        2,
        &[
            "--tensile-strength-factor 0.25 does not go with the compressive strength of A-SO3-1; allowed: from 0.27",
            "nothing was run",
        ],
    ),
    (
        &["run", "A-SO3-1", "--tensile-strength-factor", "4"],
        2,
        &["allowed: up to 3.26"],
    ),
    (
        &["run", "A-SO3-2", "--bond", "perfect", "--counterfactual"],
        2,
        &["--counterfactual has no effect with perfect bond"],
    ),
    (
        &[
            "run",
            "A-SO3-2",
            "--law",
            "objective",
            "--bond",
            "perfect",
            "--strip-bond",
            "sheet",
        ],
        2,
        &["--strip-bond has no effect with perfect bond"],
    ),
    (
        &[
            "run",
            "A-SO3-1",
            "--preset",
            "characteristic",
            "--crack-spacing-mm",
            "40",
        ],
        2,
        &["--crack-spacing-mm has no effect without interlock"],
    ),
    (
        &["run", "A-SO3-1", "--mesh", "0x4x1"],
        2,
        &["--mesh", "0 elements along", "1 to 1000"],
    ),
    (
        &["run", "A-SO3-1", "--mesh", "1000x1000x1000"],
        2,
        &["--mesh", "1000000000 elements", "up to 20000 in all"],
    ),
    (
        &["run", "A-SO3-1", "--mesh", "27x27x27"],
        2,
        &["--mesh", "would take about 18 GB; allowed: up to 4 GB"],
    ),
    (
        &["run", "A-SO3-1", "--mesh", "60"],
        2,
        &["--mesh", "1 counts; write two or three", "60x4x1"],
    ),
    (
        &["run", "A-SO3-1", "--mesh", "60x4xa"],
        2,
        &["\"a\" is not a whole number"],
    ),
    (
        &["run", "A-SO3-1", "--until", "-3"],
        2,
        &["--until", "-3 mm", "allowed: 0.1 to 500 mm"],
    ),
    (
        &["run", "A-SO3-1", "--until", "NaN"],
        2,
        &["NaN is not a finite number"],
    ),
    (
        &["run", "A-SO3-1", "--until", "3,5"],
        2,
        &["not a number; use a decimal point"],
    ),
    (
        &["run", "A-SO3-1", "--steps", "0"],
        2,
        &["--steps", "allowed: whole numbers from 1 to 1000000"],
    ),
    (
        &["run", "A-SO3-1", "--threads", "-1"],
        2,
        &["--threads", "allowed: whole numbers from 1 to 1024"],
    ),
    (
        &["run", "A-SO3-1", "--mesh", "4x4x1"],
        2,
        &["too few", "with --mesh give 13 or more as the first count"],
    ),
    (
        &["run", "A-SO3-1", "--law", "magic"],
        2,
        &["--law", "fixed-crack, reference, objective"],
    ),
    (
        &[
            "run",
            "A-SO3-1",
            "--law",
            "objective",
            "--shear-floor",
            "0.5",
        ],
        2,
        &[
            "--shear-floor has no effect",
            "--law objective",
            "--law fixed-crack",
        ],
    ),
    (
        &[
            "run",
            "A-SO3-1",
            "--preset",
            "characteristic",
            "--aggregate-mm",
            "10",
        ],
        2,
        &["--aggregate-mm has no effect", "--shear-transfer interlock"],
    ),
    (
        &[
            "run",
            "A-SO3-1",
            "--preset",
            "characteristic",
            "--mesh",
            "60x4",
        ],
        2,
        &["--mesh 60x4x1", "--integration irons"],
    ),
];

#[test]
fn mistakes_on_the_command_line_are_named() {
    for (arguments, code, words) in COMMANDS {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "kept").unwrap();
        let output = rc_beams(arguments, folder.path());
        let message = message(&output);
        assert_eq!(
            output.status.code(),
            Some(*code),
            "{arguments:?}: {message}"
        );
        for words in *words {
            assert!(
                message.contains(words),
                "{arguments:?}: {words:?} is missing in:\n{message}"
            );
        }
        assert_eq!(fs::read_to_string(&file).unwrap(), "kept");
        assert_eq!(
            fs::read_dir(folder.path()).unwrap().count(),
            1,
            "{arguments:?} wrote a file"
        );
    }
}

/// One bad beam among good ones: nothing is run, no folder is made.
#[test]
fn all_inputs_are_checked_before_the_first_run() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("bad.ron"), BEAM.replace("25000", "25")).unwrap();
    let output = rc_beams(&["run", "A-SW3-1", "bad.ron", "nobody"], folder.path());
    assert_eq!(output.status.code(), Some(3));
    let message = message(&output);
    assert!(
        message.contains("bad.ron:") && message.contains("no beam `nobody`"),
        "{message}"
    );
    assert!(!folder.path().join("results").exists());
}

#[test]
fn the_beams_of_the_program_are_listed_and_pass_their_checks() {
    let folder = tempfile::tempdir().unwrap();
    let listed = rc_beams(&["list"], folder.path());
    let table = String::from_utf8_lossy(&listed.stdout).into_owned();
    let beams: Vec<&str> = table
        .lines()
        .skip(1)
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert_eq!(beams.len(), 21, "{table}");
    for named in [&beams[..], &["all"]] {
        let checked = rc_beams(&[&["check"], named].concat(), folder.path());
        assert_eq!(checked.status.code(), Some(0), "{}", message(&checked));
        let said = String::from_utf8_lossy(&checked.stdout).into_owned();
        assert_eq!(said.matches(": ok, beam ").count(), 21, "{said}");
    }
    let example = rc_beams(&["check", STAGED], folder.path());
    assert_eq!(example.status.code(), Some(0), "{}", message(&example));
    let json = rc_beams(&["list", "--json"], folder.path());
    let rows: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(rows[0]["name"], "A-SO3-1");
    assert_eq!(rows[0]["test_load_kn"], 151.0);
    assert_eq!(rows[20]["test_load_kn"], serde_json::Value::Null);
    let strengthening = |beam: &str| {
        let mut rows = rows.as_array().unwrap().iter();
        let row = rows.find(|row| row["name"] == beam).unwrap();
        row["strengthening"].as_str().unwrap().to_owned()
    };
    for (beam, words) in [
        ("A-SO3-1", "none"),
        ("A-SO3-3", "U 90, strips of 75 mm"),
        ("A-SO3-4", "U 90"),
        ("A-SW4-2", "U 90/0"),
        ("B-CO2", "U 90, strips of 50 mm"),
        ("B-CF4", "full wrap 90"),
    ] {
        assert_eq!(strengthening(beam), words, "{beam}");
    }
}

/// Bytes of a file, exit code, words of the message.
#[test]
fn files_that_are_no_specimens_are_refused_and_a_byte_order_mark_is_not() {
    let long_line = format!("{{{}", "(".repeat(100_000));
    let long_name = BEAM.replace(
        "name: \"A-SO3-1\"",
        &format!("name: \"{}\"", "a".repeat(65)),
    );
    let count = BEAM.replacen("count_in_half: 1", "count_in_half: 5000000000", 1);
    let none = BEAM.replacen("count_in_half: 1", "count_in_half: 0", 1);
    let twice = format!("{BEAM}{BEAM}");
    let open = BEAM.replacen("bars: [", "/* bars: [", 1);
    let (first_bar, _) = BEAM.split_once("\n        ),\n        (").unwrap();
    let cut = format!("{first_bar}\n        ),\n    ");
    let open_text = format!("{cut}    (name: \"");
    let cases: [(&[u8], &str); 13] = [
        (b"", "the file is empty"),
        (b" \r\n\n", "the file is empty"),
        (
            b"(\n\"\xff",
            "x.ron, line 2: byte 4 of the file is not UTF-8 text",
        ),
        (
            b"(\n\"\x1b[31m",
            "x.ron, line 2: byte 4 of the file is not UTF-8 text that can be shown",
        ),
        (b"(\0", "x.ron, line 1: byte 2 of the file"),
        (open.as_bytes(), "a comment without an end ╭─[x.ron:26:5]"),
        (cut.as_bytes(), "bars[1]: the text ends too early"),
        (open_text.as_bytes(), "bars[1].name: a text without an end"),
        (
            long_line.as_bytes(),
            "x.ron:1:1: a group of fields in brackets is expected",
        ),
        (long_name.as_bytes(), "allowed: 1 to 64 letters"),
        (
            count.as_bytes(),
            "5000000000 is out of range; allowed: whole numbers from 1 to 100",
        ),
        (
            none.as_bytes(),
            "0 is out of range; allowed: whole numbers from 1 to 100",
        ),
        (twice.as_bytes(), "text behind the closing bracket"),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (bytes, words) in cases {
        fs::write(folder.path().join("x.ron"), bytes).unwrap();
        let output = rc_beams(&["run", "x.ron"], folder.path());
        let message = message(&output);
        assert_eq!(output.status.code(), Some(3), "{message}");
        assert!(
            message.contains(words),
            "{words:?} is missing in:\n{message}"
        );
        let shown = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            shown.lines().count() < 15,
            "one place is shown, no more: {shown}"
        );
        assert!(
            !shown.contains(|c: char| c.is_control() && c != '\n'),
            "{shown:?}"
        );
        assert!(!folder.path().join("results").exists());
    }
    fs::write(folder.path().join("x.ron"), format!("{}{BEAM}", '\u{feff}')).unwrap();
    let output = rc_beams(&["check", "x.ron"], folder.path());
    assert_eq!(output.status.code(), Some(0), "{}", message(&output));
}

/// Target: lines that end with a carriage return alone, or with one before the line feed, are lines: a comment ends with them,
/// and places are those of an editor.
#[test]
fn every_end_of_a_line_is_one() {
    let folder = tempfile::tempdir().unwrap();
    let wrong = BEAM.replace("length_mm: 3050", "length_mm: 3");
    for end in ["\n", "\r\n", "\r"] {
        let write = |text: &str| {
            fs::write(folder.path().join("x.ron"), text.replace('\n', end)).unwrap();
            rc_beams(&["check", "x.ron"], folder.path())
        };
        let output = write(BEAM);
        assert_eq!(output.status.code(), Some(0), "{}", message(&output));
        let refused = message(&write(&wrong));
        assert!(refused.contains("[x.ron:9:20]"), "{end:?}: {refused}");
    }
}

/// A place of results that cannot be written, of the second beam: the first is not run either.
#[test]
fn all_folders_are_tried_before_the_first_run() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("results")).unwrap();
    fs::write(folder.path().join("results/A-SO4-1"), "kept").unwrap();
    let output = rc_beams(&["run", "A-SO3-1", "A-SO4-1"], folder.path());
    assert_eq!(output.status.code(), Some(4), "{}", message(&output));
    assert!(!folder.path().join("results/A-SO3-1").exists());
}
