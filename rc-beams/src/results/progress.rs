//! Live progress of a run, on standard error.

use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Time between two lines where there is no terminal.
const LINE_INTERVAL: Duration = Duration::from_secs(30);
/// Parts the bar is divided into; it shows deflections.
const BAR_TICKS: f64 = 1000.0;

/// Where a run stands.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Status {
    /// Step.
    pub step: usize,
    /// Deflection (mm).
    pub deflection_mm: f64,
    /// Load (kN).
    pub load_kn: f64,
    /// Iterations of the step.
    pub iterations: usize,
    /// Whether the step misses the criterion.
    pub flagged: bool,
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "step {:>4}  P {:>7.1} kN  w {:>6.2} mm  it {:>3}{}",
            self.step,
            self.load_kn,
            self.deflection_mm,
            self.iterations,
            if self.flagged { "  flagged" } else { "" }
        )
    }
}

/// Where the progress of all beams under way is shown.
#[derive(Debug)]
pub struct Board {
    bars: MultiProgress,
    /// Whether a result could not be printed.
    lost: AtomicBool,
}

impl Board {
    /// A board on standard error.
    pub fn new() -> Self {
        Self {
            bars: MultiProgress::with_draw_target(ProgressDrawTarget::stderr()),
            lost: AtomicBool::new(false),
        }
    }

    /// Prints the result of a beam on standard output.
    pub fn print_result(&self, line: &str) {
        let printed = self.bars.suspend(|| writeln!(io::stdout(), "{line}"));
        // A reader that has gone away is no loss.
        if printed.is_err_and(|e| e.kind() != io::ErrorKind::BrokenPipe) {
            self.lost.store(true, Ordering::Relaxed);
        }
    }

    /// Says on standard error what stops a beam.
    pub fn tell(&self, text: &str) {
        self.bars.suspend(|| say(text));
    }

    /// Whether a result could not be printed.
    pub fn has_lost(&self) -> bool {
        self.lost.load(Ordering::Relaxed)
    }
}

impl Default for Board {
    fn default() -> Self {
        Self::new()
    }
}

/// Progress of one beam: a bar on a terminal, else a line at the start, one every 30 seconds and one at
/// the end.
#[derive(Debug)]
pub struct Progress {
    name: String,
    end_mm: f64,
    status: Status,
    display: Display,
}

#[derive(Debug)]
enum Display {
    Bar(ProgressBar),
    Lines { start: Instant, schedule: Schedule },
}

impl Progress {
    /// Starts for the beam `name`, whose path ends at a deflection of `end_mm` at the latest.
    pub fn start(board: &Board, name: &str, end_mm: f64) -> Self {
        let display = if io::stderr().is_terminal() {
            Display::Bar(board.bars.add(bar(name)))
        } else {
            say(&format!("{name}: started"));
            Display::Lines {
                start: Instant::now(),
                schedule: Schedule::every(LINE_INTERVAL),
            }
        };
        Self {
            name: name.to_owned(),
            end_mm,
            status: Status::default(),
            display,
        }
    }

    /// An iteration of the step under way, counted from 0.
    pub fn iteration(&mut self, step: usize, iteration: usize) {
        self.status.step = step;
        self.status.iterations = iteration;
        self.show();
    }

    /// An accepted step.
    pub fn step(&mut self, status: Status) {
        self.status = status;
        self.show();
    }

    /// A message that stays; the bar goes on below it.
    pub fn note(&self, text: &str) {
        let text = format!("{}: {text}", self.name);
        match &self.display {
            Display::Bar(bar) => bar.suspend(|| say(&text)),
            Display::Lines { .. } => say(&text),
        }
    }

    /// Ends; the result is for standard output.
    pub fn finish(&self) {
        match &self.display {
            Display::Bar(bar) => bar.finish_and_clear(),
            Display::Lines { .. } => say(&format!("{}: ended, {}", self.name, self.status)),
        }
    }

    fn show(&mut self) {
        match &mut self.display {
            Display::Bar(bar) => {
                let share = self.status.deflection_mm / self.end_mm;
                bar.set_position((share.clamp(0.0, 1.0) * BAR_TICKS) as u64);
                bar.set_message(self.status.to_string());
            }
            Display::Lines { start, schedule } => {
                if schedule.is_due(start.elapsed()) {
                    say(&format!("{}: {}", self.name, self.status));
                }
            }
        }
    }
}

fn say(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}

fn bar(name: &str) -> ProgressBar {
    let bar = ProgressBar::new(BAR_TICKS as u64);
    // The template is fixed; should it be refused, the default style serves.
    if let Ok(style) = ProgressStyle::with_template("{prefix:<8} {bar:12} {elapsed:>4}  {wide_msg}")
    {
        bar.set_style(style.progress_chars("█▌░"));
    }
    bar.set_prefix(name.to_owned());
    bar
}

/// Decides when the next line is due.
#[derive(Debug, Clone, Copy)]
struct Schedule {
    interval: Duration,
    next: Duration,
}

impl Schedule {
    const fn every(interval: Duration) -> Self {
        Self {
            interval,
            next: interval,
        }
    }

    /// Whether a line is due at a time since the start; then the next one is due an interval later.
    fn is_due(&mut self, now: Duration) -> bool {
        let due = now >= self.next;
        if due {
            self.next = now + self.interval;
        }
        due
    }
}

#[cfg(test)]
mod tests {
    //! Protects logs from floods and from silence, without waiting for the clock.
    use super::*;

    #[test]
    fn lines_keep_their_distance() {
        let mut schedule = Schedule::every(Duration::from_secs(30));
        let due: Vec<u64> = (0..=100)
            .filter(|&s| schedule.is_due(Duration::from_secs(s)))
            .collect();
        assert_eq!(due, [30, 60, 90]);
    }

    #[test]
    fn a_status_reads_in_columns() {
        let status = Status {
            step: 31,
            deflection_mm: 1.123,
            load_kn: 74.04,
            iterations: 4,
            flagged: false,
        };
        assert_eq!(
            status.to_string(),
            "step   31  P    74.0 kN  w   1.12 mm  it   4"
        );
        let flagged = Status {
            flagged: true,
            ..status
        };
        assert!(flagged.to_string().ends_with("flagged"));
    }
}
