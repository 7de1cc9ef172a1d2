//! Ctrl-C and termination signals.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::error::ResultsError;
use crate::exit::Exit;

/// Tells a run that its user wants it to stop.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Watches for Ctrl-C, SIGTERM and SIGHUP from now on. The first is noted, so that the run can end in
    /// order; the second ends the process at once. Only once per process.
    ///
    /// # Errors
    ///
    /// [`ResultsError::Signal`] when the handler cannot be installed.
    pub fn install() -> Result<Self, ResultsError> {
        let interrupt = Self::default();
        let flag = Arc::clone(&interrupt.0);
        ctrlc::set_handler(move || {
            if flag.swap(true, Ordering::Relaxed) {
                std::process::exit(i32::from(Exit::Interrupted.code()));
            }
            // A message that cannot be written is no reason to fail.
            let _ = writeln!(
                io::stderr(),
                "stopping after the last accepted step; press Ctrl-C again to end at once"
            );
        })?;
        Ok(interrupt)
    }

    /// Whether a signal has come.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
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

    fn signal(child: &Child) {
        let id = child.id().to_string();
        let status = Command::new("kill").args(["-INT", &id]).status().unwrap();
        assert!(status.success());
    }

    #[test]
    fn the_first_signal_is_noted_and_the_second_ends_the_process() {
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
        assert!(lines.any(|line| line.unwrap() == "Interrupted"));
        signal(&child);
        assert_eq!(child.wait().unwrap().code(), Some(130));
    }
}
