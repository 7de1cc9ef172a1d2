//! Ctrl-C and termination signals.

#[cfg(unix)]
use std::fs;
use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use signal_hook::flag;

use super::error::ResultsError;
use crate::exit::Exit;

/// Signals within this time are one.
const ONE_SIGNAL: Duration = Duration::from_millis(500);
/// How often it is looked whether one has come.
const LOOK_EVERY: Duration = Duration::from_millis(100);

/// Tells a run that its user wants it to stop.
#[derive(Debug, Clone, Default)]
pub struct Interrupt {
    set: Arc<AtomicBool>,
    /// Whether the user has been told that it was noted.
    told: Arc<AtomicBool>,
}

impl Interrupt {
    /// Watches for Ctrl-C, SIGTERM and SIGHUP from now on; one that is ignored, as under `nohup`, stays so where the
    /// system tells (Linux). The first is noted, so that the run can end in order; a second, half a second or more behind it,
    /// ends the process at once: some programs, as `timeout`, send the first one twice. Only once per process.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Signal`] when the handler cannot be installed.
    pub fn install() -> Result<Self, ResultsError> {
        let interrupt = Self::default();
        let final_next = Arc::new(AtomicBool::new(false));
        let code = i32::from(Exit::Interrupted.code());
        for signal in heeded() {
            flag::register_conditional_shutdown(signal, code, Arc::clone(&final_next))
                .and_then(|_| flag::register(signal, Arc::clone(&interrupt.set)))
                .map_err(ResultsError::Signal)?;
        }
        let set = Arc::clone(&interrupt.set);
        let wait = move || {
            while !set.load(Ordering::Relaxed) {
                thread::sleep(LOOK_EVERY);
            }
            thread::sleep(ONE_SIGNAL);
            final_next.store(true, Ordering::Relaxed);
        };
        let watch = thread::Builder::new().name("signals".into());
        watch.spawn(wait).map_err(ResultsError::Signal)?;
        Ok(interrupt)
    }

    /// Whether a signal has come.
    pub fn is_set(&self) -> bool {
        let set = self.set.load(Ordering::Relaxed);
        if set && !self.told.swap(true, Ordering::Relaxed) {
            // A message that cannot be written is no reason to fail.
            let _ = writeln!(
                io::stderr(),
                "stopping after the last accepted step; press Ctrl-C again to end at once"
            );
        }
        set
    }

    /// For recorders: ends the analysis once a signal has come.
    ///
    /// # Errors
    ///
    /// An error of kind [`io::ErrorKind::Interrupted`] once a signal has come.
    pub fn check(&self) -> io::Result<()> {
        if self.is_set() {
            return Err(io::Error::new(
                io::ErrorKind::Interrupted,
                "stopped by the user",
            ));
        }
        Ok(())
    }
}

/// The signals that ask the program to end, but for those that whoever started it has it ignore.
#[cfg(unix)]
fn heeded() -> impl Iterator<Item = i32> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let all = [SIGINT, SIGTERM, SIGHUP].into_iter();
    all.filter(move |signal| !ignores(&status, *signal))
}

#[cfg(not(unix))]
fn heeded() -> impl Iterator<Item = i32> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    [SIGINT, SIGTERM].into_iter()
}

/// Whether a process with that status, see proc(5), ignores a signal.
#[cfg(unix)]
fn ignores(status: &str, signal: i32) -> bool {
    let mask = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|m| u64::from_str_radix(m.trim(), 16).ok());
    mask.is_some_and(|m| m >> (signal - 1) & 1 == 1)
}

#[cfg(all(test, unix))]
mod tests {
    //! Protects the way out: the first signal lets the run end in order, the second always ends it.
    use super::*;
    use std::io::{BufRead, BufReader};
    use std::process::{Child, Command, Stdio};

    /// The process under test; it ends by the second signal only.
    #[test]
    #[ignore = "run by the test below, in a process of its own"]
    fn waits_for_signals() {
        let interrupt = Interrupt::install().unwrap();
        assert!(interrupt.check().is_ok());
        println!("\nready");
        while !interrupt.is_set() {
            std::thread::yield_now();
        }
        let kind = interrupt.check().unwrap_err().kind();
        println!("{kind:?}");
        loop {
            std::thread::park();
        }
    }

    #[test]
    fn a_signal_that_is_ignored_is_known() {
        let status = "Name:\trc-beams\nSigBlk:\tffffffffffffffff\nSigIgn:\t0000000000001001\n";
        assert!(ignores(status, 1) && ignores(status, 13));
        assert!(!ignores(status, 2) && !ignores("", 1));
    }

    /// The one signal that whoever started the tests hardly has them ignore.
    fn signal(child: &Child) {
        let id = child.id().to_string();
        let kill = Command::new("kill").args(["-TERM", &id]).status();
        let status = kill.unwrap();
        assert!(status.success());
    }

    #[test]
    fn signals_at_once_are_noted_and_a_later_one_ends_the_process() {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--ignored", "--exact", "--nocapture"])
            .arg("results::interrupt::tests::waits_for_signals")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        assert!(lines.any(|line| line.unwrap() == "ready"));
        signal(&child);
        signal(&child);
        assert!(lines.any(|line| line.unwrap() == "Interrupted"));
        thread::sleep(2 * (ONE_SIGNAL + LOOK_EVERY));
        signal(&child);
        assert_eq!(child.wait().unwrap().code(), Some(130));
    }
}
