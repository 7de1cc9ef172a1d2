//! Protects the main job: what `run` computes, what it writes, and what it leaves when it is stopped.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use serde_json::Value;

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rc-beams"));
    command
        .arg("run")
        .args(arguments)
        .arg("-o")
        .arg(folder)
        .env("NO_COLOR", "1");
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().unwrap()
}

fn summary(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("A-SO3-1/summary.json")).unwrap()).unwrap()
}

/// Target: `--band` adds the peaks with half the steps and with a finer mesh, which differ, and leaves the run itself as it is,
/// to the last bit.
#[test]
fn finer_steps_and_elements_give_a_band() {
    let alone = tempfile::tempdir().unwrap();
    let banded = tempfile::tempdir().unwrap();
    let mut arguments = vec!["A-SO3-1", "--mesh", "16x2x1", "--fields", "none"];
    assert_eq!(run(alone.path(), &arguments).status.code(), Some(0));
    arguments.push("--band");
    let output = run(banded.path(), &arguments);
    assert_eq!(output.status.code(), Some(0));
    let history = |folder: &Path| fs::read(folder.join("A-SO3-1/history.csv")).unwrap();
    assert_eq!(history(alone.path()), history(banded.path()));
    let (plain, summary) = (summary(alone.path()), summary(banded.path()));
    assert!(plain["numerical_error"].is_null());
    let number = |value: &Value| value.as_f64().unwrap();
    let (peak, error) = (
        number(&summary["peak_load_kn"]),
        &summary["numerical_error"],
    );
    for variation in ["half_steps", "finer_mesh"] {
        let varied = number(&error[variation]["peak_load_kn"]);
        let change = number(&error[variation]["change"]);
        assert!(varied != peak && (change - (varied / peak - 1.0)).abs() < 1e-12);
        let extrapolated = number(&error[variation]["extrapolated_peak_load_kn"]);
        assert!((extrapolated / peak - 1.0).abs() <= number(&error["error_bar"]) + 1e-12);
    }
    assert_eq!(error["mesh"], "24x3x1");
    let reason = summary["trust_reason"].as_str().unwrap();
    assert!(
        reason.contains("half the steps: ") && reason.contains("a finer mesh: "),
        "{reason}"
    );
    let line = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(line.contains("mesh 24x3x1"), "{line}");
}

/// Target: a path that ends while the load rises has no error bar and is not compared with the test.
#[test]
fn a_load_that_still_rises_has_no_error_bar_and_no_ratio() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "A-SO3-1", "--mesh", "16x2x1", "--until", "0.4", "--fields", "none", "--band",
    ];
    let output = run(folder.path(), &arguments);
    let line = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        line.contains("no error bar") && !line.contains("(test"),
        "{line}"
    );
    let summary = summary(folder.path());
    assert!(summary["numerical_error"].is_null() && summary["ratio_model_to_test"].is_null());
}

/// Target: less tensile strength or fracture energy carries less, less crushing energy nothing before anything crushes, to the last
/// bit.
#[test]
fn tensile_strength_and_energies_of_cracking_and_crushing_can_be_varied_apart() {
    let load = |flag: Option<&str>| {
        let folder = tempfile::tempdir().unwrap();
        let mut arguments = vec![
            "A-SO3-1", "--mesh", "16x2x1", "--until", "1.0", "--fields", "none",
        ];
        arguments.extend(flag.into_iter().chain(flag.map(|_| "0.5")));
        assert_eq!(run(folder.path(), &arguments).status.code(), Some(0));
        summary(folder.path())["peak_load_kn"].as_f64().unwrap()
    };
    let plain = load(None);
    assert!(load(Some("--tensile-strength-factor")) < 0.97 * plain);
    assert!(load(Some("--fracture-energy-factor")) < 0.97 * plain);
    assert_eq!(load(Some("--crushing-energy-factor")), plain);
}

/// Source: the branches that A-SO3-1 with the characteristic preset has near its peak: steps from 0.0015 to 0.01 mm put it
/// between 145.9 and 154.2 kN, the slow motion (`--driver explicit`) at 156.1 kN and 2.21 mm, prototypes of the law at 149 +- 2 kN.
/// Target: 151 kN within 4 %, the true residual at most 1e-3 at every step, a drop of at least 20 %, a diagonal failure.
#[test]
fn a_beam_is_carried_past_its_diagonal_failure() {
    let folder = tempfile::tempdir().unwrap();
    let output = run(folder.path(), &["A-SO3-1", "--preset", "characteristic"]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{message}");
    let summary = summary(folder.path());
    let number = |key: &str| summary[key].as_f64().unwrap();
    assert!(
        (number("peak_load_kn") / 151.0 - 1.0).abs() < 0.04,
        "{summary}"
    );
    let deflection = number("deflection_at_peak_mm");
    assert!((2.0..2.25).contains(&deflection), "{deflection}");
    assert!(number("max_residual") <= 1e-3);
    assert_eq!(number("flagged_steps"), 0.0);
    assert!(number("post_peak_drop") >= 0.2);
    assert!((number("self_weight_reaction_kn") - 3.477).abs() < 1e-3);
    assert!(number("p_star_gap_kn").abs() < 1.0);
    assert_eq!(summary["mode"], "shear (diagonal tension)");
    for file in [
        "history.csv",
        "gauges.csv",
        "newton.csv",
        "curve.svg",
        "curve.png",
        "crack.svg",
        "fields.pvd",
        "fields_0001.vtu",
        "fields_bars_0002.vtu",
    ] {
        let length = fs::metadata(folder.path().join("A-SO3-1").join(file))
            .unwrap()
            .len();
        assert!(length > 100, "{file}");
    }
    let line = String::from_utf8(output.stdout).unwrap();
    assert!(
        line.contains("A-SO3-1") && line.contains("test 151.0"),
        "{line}"
    );
}

/// Cells of a table, per row, by the names of the columns.
fn columns<const N: usize>(folder: &Path, file: &str, names: [&str; N]) -> Vec<[usize; N]> {
    let text = fs::read_to_string(folder.join("A-SO3-1").join(file)).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let places = names.map(|name| header.iter().position(|c| *c == name).unwrap());
    lines
        .map(|cells| places.map(|i| cells[i].parse().unwrap()))
        .collect()
}

/// Target: the iterations of a step are the rows of its last attempt in `newton.csv`, over snaps too; all rows, with those of
/// rejected attempts and of the self weight, are those of the summary.
#[test]
fn all_tables_count_the_same_iterations() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["A-SO3-1", "--mesh", "32x2x1", "--fields", "none"];
    assert_eq!(run(folder.path(), &arguments).status.code(), Some(0));
    let told = columns(folder.path(), "newton.csv", ["step", "attempt"]);
    let steps = columns(
        folder.path(),
        "history.csv",
        ["step", "attempts", "iterations", "held"],
    );
    assert!(steps.iter().any(|[_, _, _, held]| *held > 0));
    for [step, attempts, iterations, _] in &steps[1..] {
        let rows = told.iter().filter(|row| *row == &[*step, *attempts]);
        assert_eq!(rows.count(), *iterations, "step {step}");
    }
    let of_self_weight = steps[0][2] as u64;
    let all = summary(folder.path())["newton_iterations"].as_u64();
    assert_eq!(all, Some(told.len() as u64 + of_self_weight));
}

/// Same input, same output: the history of a cracking beam is the same to the last bit for one thread
/// and two.
#[test]
fn threads_do_not_change_a_bit() {
    let history = |threads: &str| {
        let folder = tempfile::tempdir().unwrap();
        let arguments = [
            "A-SW3-1",
            "--mesh",
            "32x2x1",
            "--until",
            "1",
            "--threads",
            threads,
        ];
        assert!(run(folder.path(), &arguments).status.success());
        fs::read(folder.path().join("A-SW3-1/history.csv")).unwrap()
    };
    assert!(history("1") == history("2"));
}

/// Ctrl-C and kill keep every accepted step: the tables end with a whole line, the fields of the last step
/// are there, the code is 130.
#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_it_has() {
    for signal in ["-INT", "-TERM"] {
        let folder = tempfile::tempdir().unwrap();
        let mut child = command(folder.path(), &["A-SO3-1", "--mesh", "32x2x1"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let history = folder.path().join("A-SO3-1/history.csv");
        let rows = || fs::read_to_string(&history).map_or(0, |text| text.lines().count());
        while rows() < 5 && child.try_wait().unwrap().is_none() {
            sleep(Duration::from_millis(5));
        }
        signal_to(&child, signal);
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130), "{signal}");
        let line = String::from_utf8(output.stdout).unwrap();
        let kept = "stopped by the user; the results up to the last accepted step are in";
        assert!(line.contains(kept), "{line}");
        let text = fs::read_to_string(&history).unwrap();
        let columns = text.lines().next().unwrap().split(',').count();
        assert!(text.ends_with('\n') && text.lines().all(|l| l.split(',').count() == columns));
        let fields = fs::read_to_string(folder.path().join("A-SO3-1/fields.pvd")).unwrap();
        assert!(fields.contains("fields_0001.vtu") && fields.contains("</VTKFile>"));
        // The peak is the last step: its fields are written once.
        assert!(!fields.contains("fields_0002.vtu"));
        assert_eq!(summary(folder.path())["stop_reason"], "stopped by the user");
    }
}

/// Target: under self weight an interruption is heeded as well; what goes on from there is a whole run.
#[cfg(unix)]
#[test]
fn an_interruption_under_self_weight_is_heeded() {
    let folder = tempfile::tempdir().unwrap();
    let mut arguments = vec!["A-SO3-1", "--mesh", "120x12", "--until", "0.1"];
    let history = folder.path().join("A-SO3-1/history.csv");
    let rows = || fs::read_to_string(&history).map_or(0, |text| text.lines().count());
    // On a busy machine a signal may come only after self weight was accepted.
    let heeded = (0..5).any(|_| {
        let _ = fs::remove_file(&history);
        let child = command(folder.path(), &arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        while rows() == 0 {
            sleep(Duration::from_millis(1));
        }
        signal_to(&child, "-INT");
        let output = child.wait_with_output().unwrap();
        let line = String::from_utf8(output.stdout).unwrap();
        assert_eq!(output.status.code(), Some(130), "{line}");
        assert!(line.contains("--resume goes on from there"), "{line}");
        rows() == 1
    });
    assert!(heeded, "self weight was accepted each time");
    arguments.push("--resume");
    assert_eq!(run(folder.path(), &arguments).status.code(), Some(0));
    assert!(rows() > 2 && summary(folder.path())["steps"].as_u64() > Some(0));
}

/// Target: who starts a run that is to ignore a signal, as shells do in the background, is heeded; other signals still end it.
#[cfg(target_os = "linux")]
#[test]
fn a_signal_that_is_ignored_from_the_start_stays_so() {
    for (signal, code) in [("-INT", 0), ("-TERM", 130)] {
        let folder = tempfile::tempdir().unwrap();
        let script =
            "trap '' INT; exec \"$0\" run A-SO3-1 --mesh 32x2x1 --until 1 --fields none -o \"$1\"";
        let child = Command::new("sh")
            .args(["-c", script, env!("CARGO_BIN_EXE_rc-beams")])
            .arg(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let history = folder.path().join("A-SO3-1/history.csv");
        while fs::read_to_string(&history).map_or(0, |text| text.lines().count()) < 5 {
            sleep(Duration::from_millis(1));
        }
        signal_to(&child, signal);
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(code), "{signal}");
    }
}

fn signal_to(child: &Child, signal: &str) {
    let status = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(status.unwrap().success());
}

/// Target: who stops a beam in its run with half the steps learns that its error bar is missing, and which beams were not
/// started; `--resume` brings it.
#[test]
fn an_interrupted_band_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let mut arguments = vec![
        "A-SO3-1",
        "A-SW3-1",
        "--mesh",
        "32x2x1",
        "--band",
        "--threads",
        "1",
    ];
    let child = command(folder.path(), &arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    while !folder.path().join("A-SO3-1/fields_0001.vtu").exists() {
        sleep(Duration::from_millis(2));
    }
    signal_to(&child, "-INT");
    let output = child.wait_with_output().unwrap();
    let shown = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(130), "{shown}");
    for text in [
        "in its runs with other steps",
        "--resume",
        "A-SW3-1   not started",
    ] {
        assert!(shown.contains(text), "{text}: {shown}");
    }
    assert!(summary(folder.path())["numerical_error"].is_null());
    arguments.push("--resume");
    arguments.remove(1);
    assert_eq!(run(folder.path(), &arguments).status.code(), Some(0));
    assert!(summary(folder.path())["numerical_error"]["error_bar"].is_number());
}

/// Target: where no more can be written, as on a full disk, the cause is told and what goes on from there; beams not yet started
/// are told too.
#[cfg(unix)]
#[test]
fn a_full_disk_is_told_with_its_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let script = "trap '' XFSZ; ulimit -f 60; exec \"$0\" run A-SO3-1 A-SW3-1 --mesh 48x4 --fields all --threads 1 -o \"$1\"";
    let output = Command::new("sh")
        .args(["-c", script, env!("CARGO_BIN_EXE_rc-beams")])
        .arg(folder.path())
        .output()
        .unwrap();
    let results = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(4), "{results}");
    for words in [
        "File too large",
        "--resume goes on from there",
        "A-SW3-1   not started",
    ] {
        assert!(results.contains(words), "{words}: {results}");
    }
}

/// Target: a beam that breaks under its own weight stops no other, and is told.
#[test]
fn a_beam_that_cannot_carry_itself_stops_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let weak = include_str!("../specimens/A-SO3-1.ron")
        .replace("\"A-SO3-1\"", "\"weak\"")
        .replace("length_mm: 3050,", "length_mm: 20000,")
        .replace("x_mm: 2440,", "x_mm: 19700,")
        .replace("x_to_mm: 3050,", "x_to_mm: 20000,")
        .replace("diameter_mm: 32,", "diameter_mm: 3,")
        .replace("area_mm2: 804.25,", "area_mm2: 7,")
        .replace("reported_tensile_mpa: 2.7,", "reported_tensile_mpa: 2.1,");
    let file = folder.path().join("weak.ron");
    fs::write(&file, weak).unwrap();
    let arguments = [
        file.to_str().unwrap(),
        "A-SO3-1",
        "--mesh",
        "16x2",
        "--until",
        "0.2",
        "--threads",
        "1",
    ];
    let output = run(folder.path(), &arguments);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("weak: under its own weight"), "{told}");
    let results = String::from_utf8_lossy(&output.stdout);
    assert!(results.contains("A-SO3-1   peak"), "{results}");
}

/// Modified Newton-Raphson and the reference law serve the same command.
#[test]
fn other_drivers_and_laws_run() {
    for other in [
        ["--driver", "modified-newton"],
        ["--law", "reference"],
        ["--law", "objective"],
    ] {
        let folder = tempfile::tempdir().unwrap();
        let base = [
            "A-SO3-1", "--mesh", "16x2x1", "--until", "0.1", "--fields", "none",
        ];
        let output = run(folder.path(), &[&base[..], &other[..]].concat());
        let shown = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{shown}");
        // Only the default law takes the modulus of the specimen.
        let told = shown.contains("warning: --law");
        assert_eq!(told, other[0] == "--law", "{shown}");
        let summary = summary(folder.path());
        assert_eq!(summary["flagged_steps"], 0, "{summary}");
        assert!(summary["peak_load_kn"].as_f64().unwrap() > 5.0, "{summary}");
        assert!(!folder.path().join("A-SO3-1/fields.pvd").exists());
    }
}

/// Target: Poisson's ratio of the specimen counts with every law.
#[test]
fn every_law_takes_the_poisson_ratio_of_the_specimen() {
    let beam = include_str!("../specimens/A-SO3-1.ron");
    assert_eq!(beam.matches("poisson: 0.2,\n        density").count(), 1);
    for law in ["fixed-crack", "reference", "objective"] {
        let load = |poisson: &str| {
            let folder = tempfile::tempdir().unwrap();
            let file = folder.path().join("beam.ron");
            let changed = format!("poisson: {poisson},\n        density");
            fs::write(
                &file,
                beam.replace("poisson: 0.2,\n        density", &changed),
            )
            .unwrap();
            let arguments = [
                file.to_str().unwrap(),
                "--mesh",
                "16x2x1",
                "--until",
                "0.1",
                "--fields",
                "none",
                "--law",
                law,
            ];
            assert!(run(folder.path(), &arguments).status.success());
            summary(folder.path())["peak_load_kn"].as_f64().unwrap()
        };
        assert_ne!(load("0.2"), load("0.4"), "{law}");
    }
}

/// Target: what is allowed and hardly meant is run, and warned of; beams with sheets are not warned of options of sheets.
#[test]
fn options_that_do_nothing_are_warned_of() {
    let folder = tempfile::tempdir().unwrap();
    let warnings = |beam: &str, threads: &str| {
        let arguments = [
            beam,
            "--mesh",
            "16x3",
            "--until",
            "0.1",
            "--fields",
            "none",
            "--bond",
            "perfect",
            "--threads",
            threads,
        ];
        let output = run(folder.path(), &arguments);
        let shown = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{shown}");
        ["--threads", "--bond has no effect on beams without sheets"]
            .map(|text| shown.contains(&format!("warning: {text}")))
    };
    let crowded = std::thread::available_parallelism().unwrap().get() + 1;
    assert_eq!(warnings("A-SO3-1", &crowded.to_string()), [true, true]);
    assert_eq!(warnings("A-SW3-2", "1"), [false, false]);
}

/// Protects the range of strengths that specimens may have: with the tensile strength of the Code the laws of the default serve
/// both ends of it.
#[test]
fn the_weakest_and_the_strongest_concrete_run() {
    let folder = tempfile::tempdir().unwrap();
    let beam = include_str!("../specimens/A-SO3-1.ron");
    for (strength, young) in [("16", "25000"), ("63", "38000")] {
        let changed = beam
            .replace(
                "reported_strength_mpa: 27.5",
                &format!("reported_strength_mpa: {strength}"),
            )
            .replace("young_mpa: 25000", &format!("young_mpa: {young}"))
            .replace("reported_tensile_mpa: 2.7,", "");
        let file = folder.path().join(format!("c{strength}.ron"));
        fs::write(&file, changed).unwrap();
        let arguments = [file.to_str().unwrap(), "--mesh", "16x2", "--until", "0.3"];
        let output = run(folder.path(), &arguments);
        let shown = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{shown}");
    }
}
