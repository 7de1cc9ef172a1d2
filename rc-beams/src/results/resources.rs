//! Processor time of a run and memory of the process.

use std::fs;

/// Clock ticks per second in `/proc/self/stat` (USER_HZ, 100 on every architecture Rust supports).
const TICKS_PER_SECOND: f64 = 100.0;

/// What a run uses, counted from its start. `None` where the system does not tell (Linux does).
#[derive(Debug, Clone)]
pub struct Resources {
    threads: String,
    cpu_at_start_s: Option<f64>,
}

impl Resources {
    /// Starts counting for the threads whose names begin with `threads`. The peak of memory, which is that
    /// of the whole process, starts anew if the system lets it.
    pub fn start(threads: &str) -> Self {
        // 5 resets the peak of the resident set, see proc(5).
        let _ = fs::write("/proc/self/clear_refs", "5");
        Self {
            threads: threads.into(),
            cpu_at_start_s: threads_cpu_s(threads),
        }
    }

    /// Processor time of the threads since the start (s), user and system.
    pub fn cpu_s(&self) -> Option<f64> {
        Some(threads_cpu_s(&self.threads)? - self.cpu_at_start_s?)
    }

    /// Largest resident set of the process since the start (MB, 10^6 bytes).
    pub fn max_rss_mb(&self) -> Option<f64> {
        peak_mb(&fs::read_to_string("/proc/self/status").ok()?)
    }
}

/// Sum over the threads whose names begin with `prefix`.
fn threads_cpu_s(prefix: &str) -> Option<f64> {
    let mut sum = None;
    for task in fs::read_dir("/proc/self/task").ok()?.flatten() {
        // A thread may end while the list is read.
        let Ok(stat) = fs::read_to_string(task.path().join("stat")) else {
            continue;
        };
        if name(&stat).is_some_and(|name| name.starts_with(prefix)) {
            sum = Some(sum.unwrap_or(0.0) + cpu_s(&stat)?);
        }
    }
    sum
}

/// Field 2 of proc(5), the name.
fn name(stat: &str) -> Option<&str> {
    let (before, _) = stat.rsplit_once(')')?;
    Some(before.split_once('(')?.1)
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
        assert_eq!(name(stat), Some("a) b (c"));
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
    fn a_thread_uses_time_and_its_process_memory() {
        let watched = std::thread::Builder::new().name("watched-0".into());
        let used = watched.spawn(|| {
            let used = Resources::start("watched-");
            (used.max_rss_mb(), used.cpu_s())
        });
        let (memory, time) = used.unwrap().join().unwrap();
        assert!(memory.is_some_and(|mb| mb > 0.5));
        assert!(time.is_some_and(|s| s >= 0.0));
        assert_eq!(Resources::start("nobody").cpu_s(), None);
    }
}
