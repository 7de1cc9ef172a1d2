//! Time of a bare and of a strengthened beam through their first diagonal cracks, up to 1 mm at the default settings, without
//! output; one thread. Whole paths, and what a run writes beside them: `rc-beams run`, whose times `docs/beams.md` has.

use criterion::{Criterion, criterion_group, criterion_main};
use fe_solver::secant::SecantAnderson;
use rc_beams::analysis::{Observer, Stepping, analyse};
use rc_beams::build::{Beam, ModelSettings};
use rc_beams::options::Preset;
use rc_beams::spec::{BUILTIN, read};

/// Looks at nothing.
struct Blind;

impl Observer for Blind {}

fn beam(c: &mut Criterion) {
    let stepping = Stepping {
        initial_mm: 0.01,
        longest_share: 0.01,
        until_mm: 1.0,
        to_the_end: true,
        criterion: 1e-3,
    };
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    let mut group = c.benchmark_group("beam");
    group.sample_size(10);
    for name in ["A-SO3-1", "A-SO3-2"] {
        let mut built_in = BUILTIN.iter();
        let (_, text) = built_in.find(|(n, _)| *n == name).expect("a beam");
        let specimen = read(name, text).expect("a specimen");
        let settings = ModelSettings::new(Preset::default(), &specimen);
        let beam = Beam::new(&specimen, &settings).expect("a model");
        group.bench_function(format!("{name} to 1 mm"), |b| {
            one.install(|| {
                b.iter(|| {
                    let mut driver = SecantAnderson::default();
                    analyse(&beam, None, &stepping, &mut driver, &mut Blind).expect("a path")
                });
            });
        });
    }
    group.finish();
}

criterion_group!(benches, beam);
criterion_main!(benches);
