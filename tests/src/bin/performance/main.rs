//! Measures time and memory and writes `docs/performance.md`; on an idle machine, about four minutes.

mod iteration;
mod linear;
mod metal;
mod points;

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use fe_tests::provenance::commit;

const COMMAND: &str = "tests/performance.sh";

/// Median time (s) of a piece of work.
pub fn median(times: usize, mut work: impl FnMut()) -> f64 {
    let mut all: Vec<f64> = (0..times)
        .map(|_| {
            let begin = Instant::now();
            work();
            begin.elapsed().as_secs_f64()
        })
        .collect();
    all.sort_by(f64::total_cmp);
    all[all.len() / 2]
}

fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let has = |flag: &str| info.contains(flag);
    let unit = if has("avx512f") {
        "AVX-512"
    } else if has("avx2") {
        "AVX2"
    } else {
        "no AVX2"
    };
    let name = info.lines().find_map(|l| l.strip_prefix("model name"));
    let name = name.map_or("unknown processor", |n| {
        n.trim_start_matches([' ', '\t', ':'])
    });
    format!("{name}, {unit}")
}

fn main() -> Result<(), Box<dyn Error>> {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let commit = commit();
    let mut text = format!(
        "# Time and memory\n\nWritten at commit {commit} by\n\n```console\n$ {COMMAND}\n```\n\non {}. Times are medians on one thread; another \
         machine, or a busy one, gives others. What beams cost is in [beams.md](beams.md).\n\n",
        processor()
    );
    let sections = one.install(|| -> Result<String, String> {
        let mut text = String::new();
        let say = |e: Box<dyn Error>| e.to_string();
        points::section(&mut text).map_err(say)?;
        iteration::section(&mut text).map_err(say)?;
        metal::section(&mut text).map_err(say)?;
        linear::section(&mut text).map_err(say)?;
        Ok(text)
    })?;
    text.push_str(&sections);
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/performance.md");
    std::fs::write(docs, text.trim_end().to_owned() + "\n")?;
    Ok(())
}
