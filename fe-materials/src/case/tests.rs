//! Protects the case files: every law can be written down, samples run, mistakes are named.

use approx::assert_abs_diff_eq;
use fe_core::testing::within;
use ron::Options;
use ron::extensions::Extensions;

use super::*;

fn parse(text: &str) -> Result<PointCase, ron::error::SpannedError> {
    Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .from_str(text)
}

/// A case of the given law that goes to the given targets in ten steps.
fn case(law: &str, targets: &str) -> PointCase {
    parse(&format!("(law: {law}, program: [({targets}, steps: 10)])")).unwrap()
}

fn sample(name: &str) -> PointRun {
    let path = format!(
        "{}/../rc-beams/cases/{name}.ron",
        env!("CARGO_MANIFEST_DIR")
    );
    let run = parse(&std::fs::read_to_string(path).unwrap())
        .unwrap()
        .run()
        .unwrap();
    run.result.clone().unwrap();
    run
}

const CONCRETE: &str = "concrete: (fck_mpa: 30)";
const SHEET: &str = "sheet: (young_1_mpa: 228000, young_2_mpa: 10, shear_mpa: 10, poisson_12: 0, \
                     strength_mpa: 3790)";

/// Every law of the crate, also written down and read again, under uniaxial strain, everything else free of stress. Target: a finite stress
/// of the sign of the strain.
#[test]
fn every_law_can_be_written_down_and_run() {
    let solid = [
        "Elastic(young_mpa: 30000, poisson: 0.2)".to_owned(),
        "VonMises(young_mpa: 200000, poisson: 0.3, yield_mpa: 400)".into(),
        format!("Associated({CONCRETE})"),
        format!("Isochoric({CONCRETE})"),
        format!("Objective({CONCRETE}, band_width_mm: 30)"),
        format!("Reference({CONCRETE}, stiffening: Stirrups, retention: Hinton)"),
        format!("Reference({CONCRETE}, stiffening: VerticalCracks((0, 1, 0)), shear_floor: 0.1)"),
        format!("FixedCrack({CONCRETE}, band_width_mm: 30, ottosen_onset: false)"),
    ];
    let sheet = [
        "ElasticSheet(young_mpa: 30000, poisson: 0.2)".to_owned(),
        format!("Lamina({SHEET})"),
        format!("Laminate(plies: [({SHEET}, angle_deg: 90, thickness_mm: 0.165)])"),
    ];
    let bar = [
        "ElasticBar(young_mpa: 200000)".to_owned(),
        "HotRolledBar(young_mpa: 200000, yield_mpa: 460, tangent_mpa: 2000)".into(),
        "ColdWorkedBar(young_mpa: 200000, strength_mpa: 350, hardening: Kinematic)".into(),
    ];
    for (laws, name) in [(&solid[..], "eps_xx"), (&sheet, "eps_11"), (&bar, "eps")] {
        for law in laws {
            let case = case(law, &format!("strain: {{{name:?}: -0.001}}"));
            assert_eq!(parse(&ron::to_string(&case).unwrap()).as_ref(), Ok(&case));
            let run = case.run().unwrap();
            assert_eq!(run.result, Ok(()), "{law}");
            let last = run.history.rows().last().unwrap();
            assert!(last.stress[0].is_finite() && last.stress[0] < 0.0, "{law}");
        }
    }
}

/// Source: fib Model Code 2010, 5.1-26 for fck = 30. Target: -fcm at -eps_c1, the curve to 1e-6, and the
/// elastic unloading after it.
#[test]
fn compression_sample_follows_the_curve() {
    let run = sample("compression-c30");
    let p = ConcreteCase {
        fck_mpa: Some(30.0),
        ..ConcreteCase::default()
    }
    .build()
    .unwrap();
    let k = p.plasticity_number();
    let rows = run.history.rows();
    for row in &rows[1..=35] {
        let n = -row.strain[0] / p.eps_c1;
        let stress = -p.fcm_mpa * (k * n - n * n) / (1.0 + (k - 2.0) * n);
        assert_abs_diff_eq!(row.stress[0], stress, epsilon = 1e-6);
    }
    assert_abs_diff_eq!(rows[23].stress[0], -38.0, epsilon = 1e-6);
    let recovered = rows[40].strain[0] - rows[35].strain[0];
    assert_abs_diff_eq!(recovered, -rows[35].stress[0] / p.young_mpa, epsilon = 1e-9);
}

/// Source: crack band, linear softening to e_u = 2 G_F/(fctm h). Target: the line, and no stress at its
/// end.
#[test]
fn tension_sample_follows_the_line() {
    let run = sample("tension-c30");
    let fctm = 0.3 * 30.0_f64.powf(2.0 / 3.0);
    let energy = 0.073 * 38.0_f64.powf(0.18);
    let (cracking, end) = (
        fctm / (21_500.0 * 3.8_f64.cbrt()),
        2.0 * energy / (fctm * 10.0),
    );
    let rows = run.history.rows();
    for row in rows[1..=200].iter().chain(&rows[400..]) {
        let e = row.strain[0];
        let expected = if e <= cracking {
            fctm * e / cracking
        } else {
            (fctm * (end - e) / (end - cracking)).max(0.0)
        };
        assert_abs_diff_eq!(row.stress[0], expected, epsilon = 1e-6);
    }
    let unloaded = &rows[210];
    assert!(unloaded.strain[0].abs() < 1e-8 && unloaded.stress[0].abs() < 1e-6);
    assert!(rows.last().unwrap().stress[0].abs() < 1e-9);
}

/// Benchmark MAT-06 from a file.
#[test]
fn bar_sample_gives_the_printed_stresses() {
    let run = sample("cyclic-bar");
    for (row, target) in [(50, 475.4), (150, -505.892), (200, 515.774)] {
        let stress = run.history.rows()[row].stress[0];
        within(&format!("stress in row {row} (MPa)"), stress, target, 5e-4);
    }
}

/// A property that a law would pass over in silence is refused with its name and that of the law; where it counts, it is taken.
#[test]
fn properties_without_use_are_refused_and_others_have_one() {
    let limit = ("eps_c_lim", "eps_c_lim: 0.004");
    let energy = ("fracture_energy_n_per_mm", "fracture_energy_n_per_mm: 0.1");
    let reference = "stiffening: Stirrups";
    for (law, rest, (property, given), used) in [
        ("FixedCrack", "band_width_mm: 30", limit, false),
        ("FixedCrack", "band_width_mm: 30", energy, true),
        ("Objective", "band_width_mm: 30", limit, false),
        ("Objective", "band_width_mm: 30", energy, true),
        ("Reference", reference, limit, true),
        ("Reference", reference, energy, false),
        ("Isochoric", "", limit, true),
        ("Isochoric", "", energy, false),
        ("Associated", "", energy, false),
    ] {
        // Pressed beyond the end of the curve, or drawn beyond the crack.
        let strain = if property == "eps_c_lim" { -0.01 } else { 1e-3 };
        let strained = format!(r#"strain: {{"eps_xx": {strain}}}"#);
        let run = |given: &str| {
            let text = format!("{law}(concrete: (fck_mpa: 30{given}), {rest})");
            case(&text, &strained).run()
        };
        let found = run(&format!(", {given}"));
        if used {
            let (found, without) = (found.unwrap(), run("").unwrap());
            assert_eq!(found.result, Ok(()), "{law} {given}");
            assert_ne!(found.history, without.history, "{law} {given}");
        } else {
            let text = format!("{law} {given}");
            assert_eq!(found, Err(CaseError::Unused { law, property }), "{text}");
        }
    }
}

/// A mistake in a file is one error that says what to change.
#[test]
fn mistakes_are_named() {
    let bar = "ElasticBar(young_mpa: 200000)";
    let unknown = case(bar, r#"strain: {"eps_xx": 0.1}"#).run().unwrap_err();
    assert_eq!(
        unknown.to_string(),
        "program, segment 1: strain has no component \"eps_xx\"; it has eps"
    );
    let twice = case(bar, r#"strain: {"eps": 0.1}, stress_mpa: {"sig": 1}"#).run();
    assert!(matches!(twice, Err(CaseError::Overdetermined { .. })));
    for (strengths, count) in [("", 0), ("fck_mpa: 30, fcm_mpa: 38", 2)] {
        let law = format!("Isochoric(concrete: ({strengths}))");
        let found = case(&law, "strain: {}").run();
        assert_eq!(found, Err(CaseError::Strength { given: count }));
    }
    let wide = format!("FixedCrack({CONCRETE}, band_width_mm: 1e6)");
    let refused = case(&wide, "strain: {}").run();
    assert!(matches!(
        refused,
        Err(CaseError::Point(PointError::Refused(_)))
    ));
    let negative = case("ElasticBar(young_mpa: -1)", "strain: {}").run();
    assert!(matches!(negative, Err(CaseError::Law(_))));
    let empty = parse(&format!("(law: {bar}, program: [])")).unwrap().run();
    assert_eq!(empty, Err(CaseError::NoSegments));
    for text in [
        "(law: ElasticBar(young_gpa: 200), program: [])",
        "(law: Elastic(young_mpa: 1, poisson: 0), program: [(steps: 1, stress: {})])",
        "(law: Elastic(young_mpa: 1, poisson: 0), programme: [])",
        "(law: Isochoric(concrete: (fck: 30)), program: [])",
        "(law: Steel, program: [])",
    ] {
        assert!(parse(text).is_err(), "{text}");
    }
}
