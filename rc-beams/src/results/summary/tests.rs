//! Protects the keys and the validity of the summary: other programs read it.
use super::*;
use crate::results::mode::FailureMode;
use serde_json::Value;

/// Keys that readers may rely on.
const KEYS: [&str; 41] = [
    "specimen",
    "preset",
    "law",
    "driver",
    "integration",
    "mesh",
    "elements",
    "dofs",
    "steps",
    "newton_iterations",
    "cutbacks",
    "factorisations",
    "force_evaluations",
    "peak_load_kn",
    "deflection_at_peak_mm",
    "first_drop_load_kn",
    "first_drop_deflection_mm",
    "post_peak_drop",
    "bonded_at_kn",
    "stop_reason",
    "stopped_early",
    "max_residual",
    "flagged_steps",
    "p_star_gap_kn",
    "trust",
    "trust_reason",
    "mode",
    "mode_evidence",
    "counterfactual_ratio",
    "tension_over_strength",
    "numerical_error",
    "energy",
    "test_load_kn",
    "ratio_model_to_test",
    "self_weight_reaction_kn",
    "wall_s",
    "cpu_s",
    "max_rss_mb",
    "options",
    "version",
    "input_hash",
];

/// Every key is explained in the manual.
#[test]
fn the_manual_names_every_key() {
    let manual = include_str!("../../../README.md");
    let value = serde_json::to_value(summary(&[0.0, 10.0, 5.0])).unwrap();
    for key in value.as_object().unwrap().keys() {
        assert!(manual.contains(&format!("`{key}`")), "{key}");
    }
}

fn summary(loads: &[f64]) -> Summary {
    let point = |(i, &load): (usize, &f64)| PathPoint {
        deflection: i as f64,
        load,
        work_conjugate_load: load,
        residual: if i == 0 { f64::INFINITY } else { 1e-3 },
        flagged: false,
        held: false,
        unstable: false,
        kinetic: None,
        viscous: None,
    };
    let path: Vec<_> = loads.iter().enumerate().map(point).collect();
    let capacity = Capacity::of(&path).unwrap();
    let verdict = Verdict::of(&path, &capacity);
    Summary {
        setup: Setup {
            specimen: "A-SO3-1".to_owned(),
            ..Setup::default()
        },
        work: Work {
            steps: 84,
            ..Work::default()
        },
        figures: Figures::of(&path, &capacity, &verdict).unwrap(),
        bonded_at_kn: None,
        stop_reason: "the load fell by 20 %".to_owned(),
        stopped_early: false,
        diagnosis: Diagnosis {
            mode: FailureMode::DiagonalTension,
            mode_evidence: String::new(),
            counterfactual_ratio: None,
        },
        test_load_kn: Some(151.0),
        ratio_model_to_test: Some(149.2 / 151.0),
        self_weight_reaction_kn: f64::NAN,
        bond_error: None,
        tension_over_strength: 1.0,
        numerical_error: None,
        energy: None,
        wall_s: WallTime {
            total: 6.14,
            ..WallTime::default()
        },
        cpu_s: None,
        max_rss_mb: Some(60.0),
    }
}

#[test]
fn the_file_is_valid_json_with_every_key_even_where_numbers_are_not_finite() {
    let root = tempfile::tempdir().unwrap();
    let folder = Folder::create(root.path(), "beam").unwrap();
    summary(&[0.0, 149.2, 100.0]).write(&folder).unwrap();
    let text = std::fs::read_to_string(folder.path().join("summary.json")).unwrap();
    let json: Value = serde_json::from_str(&text).unwrap();
    for key in KEYS {
        assert!(json.get(key).is_some(), "{key} is missing");
    }
    assert_eq!(json["peak_load_kn"], 149.2);
    assert_eq!(json["mode"], "shear (diagonal tension)");
    assert!(json["wall_s"]["laws_and_forces"].is_number());
    for key in ["max_residual", "self_weight_reaction_kn", "cpu_s"] {
        assert!(json[key].is_null(), "{key}");
    }
}

#[test]
fn arching_beyond_the_first_drop_shows_both_loads() {
    let figures = summary(&[0.0, 100.0, 90.0, 120.0, 80.0]).figures;
    assert_eq!(figures.peak_load_kn, 120.0);
    assert_eq!(figures.first_drop_load_kn, Some(100.0));
    assert_eq!(figures.first_drop_deflection_mm, Some(1.0));
}

#[test]
fn the_line_says_it_all() {
    assert_eq!(
        summary(&[0.0, 149.2, 100.0]).line(),
        "A-SO3-1   peak 149.2 kN at 1.00 mm (test 151.0, -1 %)  shear (diagonal tension)  \
         trust high  84 steps  6.1 s"
    );
    let mut prediction = summary(&[0.0, 149.2, 100.0]);
    prediction.ratio_model_to_test = None;
    assert!(!prediction.line().contains("test"));
}

#[test]
fn a_ratio_just_below_one_is_no_negative_zero() {
    assert_eq!(format!("{:+.0} %", percent_over(0.999)), "+0 %");
    assert_eq!(format!("{:+.0} %", percent_over(0.987)), "-1 %");
}

#[test]
fn the_energy_balance_closes_where_the_parts_do_the_external_work() {
    let part = |work_j, stored_j| PartEnergy {
        work_j,
        stored_j,
        dissipated_j: work_j - stored_j,
    };
    let parts = [
        ("concrete".to_owned(), part(300.0, 120.0)),
        ("interface".to_owned(), part(97.0, 10.0)),
    ];
    let mut run = summary(&[0.0, 149.2, 100.0]);
    run.energy = Some(Energy::new(400.0, parts.into()));
    let json = serde_json::to_value(&run).unwrap();
    assert_eq!(json["energy"]["closure"], 0.0075);
    assert_eq!(json["energy"]["parts"]["interface"]["dissipated_j"], 87.0);
    assert_eq!(Energy::new(0.0, [].into()).closure, None);
}
