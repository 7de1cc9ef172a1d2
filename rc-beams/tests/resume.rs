//! Protects runs that are killed: continued, they write the same tables to the last bit; what cannot be continued is
//! refused, and nothing is changed.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

const SMALL: [&str; 7] = [
    "A-SO4-2", "--mesh", "47x2x1", "--until", "1.5", "--fields", "none",
];
const TABLES: [&str; 5] = [
    "history.csv",
    "gauges.csv",
    "newton.csv",
    "events.csv",
    "sheets.csv",
];

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rc-beams"));
    command.arg("run").args(arguments).arg("-o").arg(folder);
    command.env("NO_COLOR", "1");
    command
}

fn resume(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = command(folder, arguments);
    command.arg("--resume").output().unwrap()
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(Result::unwrap);
    entries
        .map(|e| {
            let name = e.file_name().into_string().unwrap();
            (name, fs::read(e.path()).unwrap())
        })
        .collect()
}

fn rows(beam: &Path) -> usize {
    fs::read_to_string(beam.join("history.csv")).map_or(0, |t| t.lines().count())
}

/// Starts or continues a run and kills it without warning once it has written `steps` rows, or lasted `time`.
/// Returns whether it was killed before its end.
fn kill(mut command: Command, beam: &Path, steps: usize, time: Duration) -> bool {
    let begin = Instant::now();
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().unwrap();
    while rows(beam) < steps && begin.elapsed() < time {
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    true
}

fn assert_same_tables(beam: &Path, whole: &Path) {
    for table in TABLES {
        let [is, was] = [beam, whole].map(|f| fs::read_to_string(f.join(table)).unwrap());
        let differ = is.lines().zip(was.lines()).position(|(a, b)| a != b);
        assert!(is == was, "{table} differs from line {differ:?} on");
    }
}

/// Killed three times, each time a few steps later, and continued each time: the same tables as in one go; the
/// checkpoint is gone, and another `--resume` leaves everything as it is.
#[test]
fn a_run_killed_again_and_again_ends_as_one_in_one_go() {
    let (whole, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    assert!(
        command(whole.path(), &SMALL)
            .output()
            .unwrap()
            .status
            .success()
    );
    let (whole, beam) = (whole.path().join("A-SO4-2"), folder.path().join("A-SO4-2"));
    let long = Duration::from_secs(60);
    assert!(kill(command(folder.path(), &SMALL), &beam, 5, long));
    for steps in [15, 25] {
        let mut again = command(folder.path(), &SMALL);
        again.arg("--resume");
        assert!(kill(again, &beam, steps, long));
        assert!(beam.join("checkpoint.json").exists());
    }
    let output = resume(folder.path(), &SMALL);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{message}");
    assert!(message.contains("resumed after step"), "{message}");
    assert_same_tables(&beam, &whole);
    assert!(!beam.join("checkpoint.json").exists() && !beam.join("checkpoint.bin").exists());
    let before = files(&beam);
    let output = resume(folder.path(), &SMALL);
    assert!(String::from_utf8_lossy(&output.stdout).contains("done before"));
    assert_eq!(files(&beam), before);
}

/// The tangent of an unstable state is not looked at in every step; what such a step counted is the same when it is taken
/// again.
#[test]
fn a_run_killed_after_unstable_steps_goes_on() {
    let mut unstable = SMALL;
    unstable[2] = "47x3x1";
    let (whole, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let output = command(whole.path(), &unstable).output().unwrap();
    assert!(output.status.success());
    let (whole, beam) = (whole.path().join("A-SO4-2"), folder.path().join("A-SO4-2"));
    let history = fs::read_to_string(whole.join("history.csv")).unwrap();
    let mut lines = history.lines().map(|line| line.split(','));
    let pivots = lines
        .next()
        .unwrap()
        .position(|name| name == "negative_pivots");
    let not_counted = lines.position(|mut line| line.nth(pivots.unwrap()) == Some(""));
    let beyond = not_counted.unwrap() + 4;
    assert!(kill(
        command(folder.path(), &unstable),
        &beam,
        beyond,
        Duration::from_secs(60)
    ));
    let output = resume(folder.path(), &unstable);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{message}");
    assert!(message.contains("resumed after step"), "{message}");
    assert_same_tables(&beam, &whole);
}

/// Damaged, truncated, foreign, and changed tables: one error that names the file, code 4, and no file changes.
#[test]
fn what_cannot_be_continued_is_refused_and_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let beam = folder.path().join("A-SO4-2");
    let long = Duration::from_secs(60);
    assert!(kill(command(folder.path(), &SMALL), &beam, 5, long));
    let good = files(&beam);
    let refuse = |arguments: &[&str], name: &str, content: Option<Vec<u8>>, words: &str| {
        if let Some(content) = content {
            fs::write(beam.join(name), content).unwrap();
        }
        let before = files(&beam);
        let output = resume(folder.path(), arguments);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(4), "{message}");
        assert!(
            message.contains(name) && message.contains(words),
            "{message}"
        );
        assert!(message.contains("without --resume"), "{message}");
        assert!(files(&beam) == before, "{name} {words}");
        fs::write(beam.join(name), &good[name]).unwrap();
    };
    let steps = &good["checkpoint.bin"];
    let mut flipped = steps.clone();
    flipped[100] ^= 1;
    refuse(&SMALL, "checkpoint.bin", Some(flipped), "checksum");
    let short = steps[..steps.len() / 2].to_vec();
    refuse(&SMALL, "checkpoint.bin", Some(short), "truncated");
    refuse(&SMALL, "checkpoint.json", Some(b"{".to_vec()), "damaged");
    let header = String::from_utf8(good["checkpoint.json"].clone()).unwrap();
    let other = header.replace("\"0.", "\"9.").into_bytes();
    refuse(&SMALL, "checkpoint.json", Some(other), "another build");
    let mut finer = SMALL;
    finer[2] = "48x2x1";
    refuse(&finer, "checkpoint.json", None, "other options");
    let history = String::from_utf8(good["history.csv"].clone()).unwrap();
    let changed = history.replacen("\n1,", "\n7,", 1).into_bytes();
    refuse(&SMALL, "history.csv", Some(changed), "line 3");
    assert!(resume(folder.path(), &SMALL).status.success());
}

/// Ten kills at moments of no choice in one run of A-SO3-2 at full size; a minute or two.
#[test]
#[ignore = "long: cargo test --release -p rc-beams --test resume -- --ignored"]
fn ten_kills_of_a_strengthened_beam() {
    let arguments = ["A-SO3-2", "--fields", "none"];
    let whole = tempfile::tempdir().unwrap();
    let begin = Instant::now();
    assert!(
        command(whole.path(), &arguments)
            .output()
            .unwrap()
            .status
            .success()
    );
    let lasts = begin.elapsed();
    let whole = whole.path().join("A-SO3-2");
    let mut killed = 0;
    for trial in 0..10_u32 {
        // Spread evenly, in no order: multiples of the golden ratio.
        let share = 0.05 + 0.9 * (0.618_034 * f64::from(trial + 1)).fract();
        let folder = tempfile::tempdir().unwrap();
        let beam = folder.path().join("A-SO3-2");
        let time = lasts.mul_f64(share);
        killed += usize::from(kill(
            command(folder.path(), &arguments),
            &beam,
            usize::MAX,
            time,
        ));
        let steps = rows(&beam).saturating_sub(2);
        assert!(resume(folder.path(), &arguments).status.success());
        assert_same_tables(&beam, &whole);
        println!(
            "killed at {:.0} % after step {steps}: identical",
            100.0 * share
        );
    }
    assert_eq!(killed, 10);
}
