//! Processor time and memory of the process.

use std::fs;

/// Clock ticks per second in `/proc/self/stat` (USER_HZ, 100 on every architecture Rust supports).
const TICKS_PER_SECOND: f64 = 100.0;

/// What a run uses, counted from its start. `None` where the system does not tell (Linux does).
#[derive(Debug, Clone, Copy)]
pub struct Resources {
    cpu_at_start_s: Option<f64>,
}

impl Resources {
    /// Starts counting. The peak of memory starts anew if the system lets it; else it is that of the
    /// process so far.
    pub fn start() -> Self {
        // 5 resets the peak of the resident set, see proc(5).
        let _ = fs::write("/proc/self/clear_refs", "5");
        Self {
            cpu_at_start_s: process_cpu_s(),
        }
    }

    /// Processor time of all threads since the start (s), user and system.
    pub fn cpu_s(&self) -> Option<f64> {
        Some(process_cpu_s()? - self.cpu_at_start_s?)
    }

    /// Largest resident set since the start (MB, 10^6 bytes).
    pub fn max_rss_mb(&self) -> Option<f64> {
        peak_mb(&fs::read_to_string("/proc/self/status").ok()?)
    }
}

fn process_cpu_s() -> Option<f64> {
    cpu_s(&fs::read_to_string("/proc/self/stat").ok()?)
}

/// Fields 14 and 15 of proc(5), utime and stime; the name, field 2, may hold spaces and brackets.
fn cpu_s(stat: &str) -> Option<f64> {
    let (_, after_name) = stat.rsplit_once(')')?;
    let mut fields = after_name.split_whitespace().skip(11);
    let mut ticks = || fields.next()?.parse::<f64>().ok();
    Some((ticks()? + ticks()?) / TICKS_PER_SECOND)
}

/// VmHWM of proc(5), in units of 1024 bytes.
fn peak_mb(status: &str) -> Option<f64> {
    let value = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = value.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1024.0 / 1e6)
}

#[cfg(test)]
mod tests {
    //! Protects the reading of proc(5); the process name is hostile on purpose.
    use super::*;

    #[test]
    fn times_are_found_behind_any_name() {
        let stat = "7 (a) b (c) R 1 2 3 4 5 6 7 8 9 10 150 25 0 0 20 0";
        assert_eq!(cpu_s(stat), Some(1.75));
        assert_eq!(cpu_s("7 (a) R 1"), None);
    }

    #[test]
    fn the_peak_is_the_high_water_mark() {
        let status = "Name:\tx\nVmPeak:\t  9000 kB\nVmHWM:\t    1000 kB\nVmRSS:\t 900 kB\n";
        assert_eq!(peak_mb(status), Some(1.024));
        assert_eq!(peak_mb("Name:\tx\n"), None);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn this_process_uses_memory() {
        let used = Resources::start();
        assert!(used.max_rss_mb().is_some_and(|mb| mb > 0.5));
        assert!(used.cpu_s().is_some_and(|s| s >= 0.0));
    }
}
