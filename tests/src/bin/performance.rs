//! Measures time and memory and writes `docs/performance.md`; on an idle machine, about four minutes.

use std::error::Error;
use std::fmt::Write;
use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use fe_core::assembly::{Assembled, Assembler};
use fe_core::element::EvaluationContext;
use fe_core::kinematics::Solid;
use fe_core::material::{Material, Operator};
use fe_core::state::StateStore;
use fe_elements::HexRule;
use fe_materials::VonMises;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_solver::control::StepControl;
use fe_solver::linear::{DirectSolver, LinearSolver, Ordering};
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_solver::stage::Stage;
use fe_tests::beam::{BareBeam, bare_beam};
use fe_tests::calculix::{self, Metal, Reference, own_cpu_s};
use fe_tests::laws::elastic;
use fe_tests::provenance::commit;
use fe_tests::solve::{run, solve};

const COMMAND: &str = "tests/performance.sh";

/// Meshes from small to large, and how often each is measured.
const MESHES: [([usize; 3], usize); 5] = [
    ([60, 4, 1], 15),
    ([60, 4, 2], 15),
    ([88, 6, 1], 15),
    ([176, 12, 4], 3),
    ([300, 20, 8], 1),
];

/// Median time (s) of a piece of work.
fn median(times: usize, mut work: impl FnMut()) -> f64 {
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

/// Largest resident memory so far (MiB).
fn memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |k| k / 1024.0)
}

/// Rate of a product of dense matrices on one thread (Gflop/s).
fn dense_rate() -> f64 {
    let n = 1200;
    let a = faer::Mat::<f64>::from_fn(n, n, |i, j| ((i * 7 + j * 3) % 11) as f64 - 5.0);
    let mut c = faer::Mat::<f64>::zeros(n, n);
    let time = median(7, || {
        let one = faer::Par::Seq;
        faer::linalg::matmul::matmul(&mut c, faer::Accum::Replace, &a, &a, 1.0, one);
        black_box(&c);
    });
    2.0 * (n as f64).powi(3) / time / 1e9
}

/// The linear problem of one mesh.
struct Linear {
    cells: [usize; 3],
    equations: usize,
    entries: usize,
    flops: f64,
    ordering: Ordering,
    /// Assembly, analysis, factorisation, the same on two threads, solution, and everything from the grid to the
    /// reactions (s).
    times: [f64; 6],
    memory: f64,
    reaction: f64,
}

fn linear(cells: [usize; 3], times: usize) -> Result<Linear, Box<dyn Error>> {
    let law = elastic(30_000.0, 0.2)?;
    let begin = Instant::now();
    let beam = bare_beam(cells, HexRule::Reduced, &law)?;
    let solved = solve(&beam.model, beam.conditions.clone())?;
    let whole = begin.elapsed().as_secs_f64();
    let uy = fe_core::dof::Dof::Uy;
    let reaction = solved.reaction(&beam.model, &beam.supports, uy);
    let memory = memory();

    let mut assembler = Assembler::new(&beam.model, &beam.conditions);
    let mut state = StateStore::new(beam.model.elements());
    let rest = vec![0.0; beam.model.dofs().len()];
    let mut out = Assembled::default();
    let ctx = EvaluationContext::new(Operator::Secant);
    let assembly = median(times, || {
        let _ = assembler.evaluate(&beam.model, &rest, &mut state, &ctx, &mut out);
    });
    let mut solver = DirectSolver::default();
    let pattern = assembler.pattern().clone();
    let analysis = median(times, || {
        let _ = solver.analyze(&pattern);
    });
    let mut failed = None;
    let factorisation = median(times, || failed = solver.factorize(&out.matrix).err());
    if let Some(error) = failed {
        return Err(error.into());
    }
    let two = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
    let on_two = two.install(|| {
        median(times, || {
            let _ = solver.factorize(&out.matrix);
        })
    });
    let load: Vec<f64> = (0..pattern.len()).map(|i| (i as f64).sin()).collect();
    let solution = median(times, || {
        let mut x = load.clone();
        let _ = solver.solve_in_place(&mut x);
        black_box(x);
    });
    let stats = solver.stats();
    Ok(Linear {
        cells,
        equations: stats.equations,
        entries: stats.nnz_factor,
        flops: stats.factor_flops,
        ordering: stats.ordering,
        times: [assembly, analysis, factorisation, on_two, solution, whole],
        memory,
        reaction,
    })
}

/// Exponent p of y ~ x^p by least squares of the logarithms.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs = || points.iter().map(|(x, y)| (x.ln(), y.ln()));
    let (mx, my) = logs().fold((0.0, 0.0), |a, p| (a.0 + p.0 / n, a.1 + p.1 / n));
    let (xy, xx) = logs().fold((0.0, 0.0), |a, (x, y)| {
        (a.0 + (x - mx) * (y - my), a.1 + (x - mx).powi(2))
    });
    xy / xx
}

fn linear_section(text: &mut String) -> Result<(), Box<dyn Error>> {
    let dense = dense_rate();
    writeln!(
        text,
        "## Linear solution\n\nThe bare beam of 3050 x 305 x 75 mm with 8 points per element, one thread. Product of dense \
         matrices of 1200 on the same thread: {dense:.1} Gflop/s. Memory is the largest of the process up to there. Operations are those of a factor that stores no zeros.\n\n\
         | mesh | equations | order | entries of the factor, 10^6 | Gflop | assembly, ms | analysis, ms | factorisation, ms | of the dense rate | on two threads, ms | solution, ms | from grid to reactions, ms | memory, MiB | reaction, N |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    )?;
    let mut rows = Vec::new();
    for (cells, times) in MESHES {
        let row = linear(cells, times)?;
        let [assembly, analysis, factorisation, on_two, solution, whole] =
            row.times.map(|t| 1e3 * t);
        let order = match row.ordering {
            Ordering::MinimumDegree => "minimum degree",
            _ => "both ends",
        };
        writeln!(
            text,
            "| {}x{}x{} | {} | {order} | {:.2} | {:.3} | {assembly:.2} | {analysis:.1} | {factorisation:.1} | {:.0} % | {on_two:.1} | \
             {solution:.2} | {whole:.0} | {:.0} | {:.2} |",
            row.cells[0],
            row.cells[1],
            row.cells[2],
            row.equations,
            row.entries as f64 / 1e6,
            row.flops / 1e9,
            100.0 * row.flops / 1e9 / row.times[2] / dense,
            row.memory,
            row.reaction,
        )?;
        eprintln!("{:?}: {factorisation:.1} ms", row.cells);
        rows.push(row);
    }
    let grows = |value: fn(&Linear) -> f64| {
        let points = rows.iter().map(|r| (r.equations as f64, value(r)));
        exponent(&points.collect::<Vec<_>>())
    };
    writeln!(
        text,
        "\nWith the equations n grow: assembly n^{:.2}, entries of the factor n^{:.2}, factorisation n^{:.2}, solution n^{:.2}, \
         memory n^{:.2}.\n",
        grows(|r| r.times[0]),
        grows(|r| r.entries as f64),
        grows(|r| r.times[2]),
        grows(|r| r.times[4]),
        grows(|r| r.memory),
    )?;
    text.push_str(PEERS);
    Ok(())
}

/// One iteration on the cracked beam, by phase.
fn iteration_section(text: &mut String) -> Result<(), Box<dyn Error>> {
    let parameters = FixedCrackParameters::from_strength(38.0, 2.9, 33_000.0);
    let law: Arc<dyn Material<Solid>> = Arc::new(FixedCrack::new(parameters, None)?);
    text.push_str(
        "## One iteration with concrete\n\nThe same beam, 60x4x1, of the default law, cracked by a deflection of 0.3 mm; one thread, medians, ms.\n\n\
         | points per element | forces | secant operator, assembled | factorisation | solution |\n|---|---|---|---|---|\n",
    );
    for (name, rule) in [
        ("8", HexRule::Reduced),
        ("14", HexRule::Irons),
        ("27", HexRule::Full),
    ] {
        let beam = bare_beam([60, 4, 1], rule, &law)?;
        let mut reached = beam.bent(0.3)?;
        let u = reached.displacement;
        let mut stage = Stage::new(&beam.model, beam.conditions, &mut reached.state, u.clone())?;
        let [secant, force] = [Operator::Secant, Operator::None].map(EvaluationContext::new);
        let forces = median(31, || {
            let _ = black_box(stage.residual(&u, 0.0, &force));
        });
        let assembly = median(31, || {
            let _ = black_box(stage.residual(&u, 0.0, &secant));
        });
        let residual = stage.residual(&u, 0.0, &secant)?;
        let factorisation = median(31, || {
            let _ = stage.factorise();
        });
        let solution = median(31, || {
            let mut x = residual.clone();
            let _ = stage.solve(&mut x);
            black_box(x);
        });
        let [forces, assembly, factorisation, solution] =
            [forces, assembly, factorisation, solution].map(|t| 1e3 * t);
        writeln!(
            text,
            "| {name} | {forces:.2} | {assembly:.2} | {factorisation:.2} | {solution:.2} |"
        )?;
    }
    text.push('\n');
    Ok(())
}

/// Material, deflection (mm) and increments of the von Mises beam.
const METAL: Metal = Metal {
    young: 30_000.0,
    poisson: 0.2,
    yield_stress: 15.0,
    hardening: 20.0,
};
const DEFLECTION: f64 = 10.0;
const INCREMENTS: usize = 50;
/// Paired runs.
const PAIRS: usize = 3;

/// The von Mises beam: processor time (s), iterations and reaction (N).
fn metal_beam(beam: &BareBeam) -> Result<Reference, Box<dyn Error>> {
    let control = StepControl {
        criterion: 1e-3,
        ..StepControl::new(DEFLECTION / INCREMENTS as f64, DEFLECTION)
    };
    let mut newton = NewtonRaphson::new(NewtonSettings::default());
    let (mut iterations, begin) = (0, own_cpu_s()?);
    let solution = run(
        &beam.model,
        beam.conditions.clone(),
        &control,
        &mut newton,
        |_| iterations += 1,
        |_| {},
    )?;
    Ok(Reference {
        reaction: solution.reaction(&beam.model, &beam.supports, fe_core::dof::Dof::Uy),
        iterations,
        cpu_s: own_cpu_s()? - begin,
    })
}

/// The von Mises beam beside CalculiX, in turn.
fn metal_section(text: &mut String) -> Result<(), Box<dyn Error>> {
    let law: Arc<dyn Material<Solid>> = Arc::new(VonMises::new(
        METAL.young,
        METAL.poisson,
        METAL.yield_stress,
        METAL.hardening,
    )?);
    let beam = bare_beam([60, 4, 1], HexRule::Reduced, &law)?;
    let deck = calculix::deck(&beam, METAL, DEFLECTION, INCREMENTS)?;
    let folder = std::env::temp_dir().join(format!("calculix-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let (mut own, mut other) = (Vec::new(), Vec::new());
    for _ in 0..PAIRS {
        own.push(metal_beam(&beam)?);
        other.extend(calculix::solve(&deck, &folder)?);
    }
    std::fs::remove_dir_all(&folder)?;
    let cost = |mut runs: Vec<Reference>| {
        runs.sort_by(|a, b| a.cpu_s.total_cmp(&b.cpu_s));
        runs.get(runs.len() / 2).copied()
    };
    let say = |run: &Reference| {
        format!(
            "{:.2} s CPU, {} iterations, {:.1} N",
            run.cpu_s, run.iterations, run.reaction
        )
    };
    let (own, other) = (cost(own), cost(other));
    let ours = own.as_ref().map_or_else(String::new, say);
    let theirs = match (&own, &other) {
        (Some(own), Some(other)) => format!(
            "{}, in the same run, in turn: {:.1} times as long",
            say(other),
            other.cpu_s / own.cpu_s
        ),
        _ => "not installed here".to_owned(),
    };
    writeln!(
        text,
        "## Von Mises beam\n\n60x4x1, {DEFLECTION} mm in {INCREMENTS} increments, one thread, medians of {PAIRS} runs. Ours, to a relative \
         residual of 1e-3: {ours}. CalculiX (`ccx`, C3D20R): {theirs}. Elsewhere measured: FElupe (version 11.3) 10.6 to 13 s, 218 \
         iterations.\n"
    )?;
    Ok(())
}

const PEERS: &str = "CPU seconds and memory of other programs for the same problem, measured elsewhere on a like machine, not in the same run \
(whole run for CalculiX, one solution or iteration for the others):\n\n\
| mesh | CalculiX 2.20 | Kratos | FElupe 11.3 | Akantu | OpenSees, 27 points |\n|---|---|---|---|---|---|\n\
| 60x4x1 | 0.12 s, 26 MB | 0.15 to 0.19 s, 153 MB | 0.10 to 0.12 s, 136 MB | 0.12 to 0.13 s, 146 MB | 0.52 to 0.55 s, 80 MB |\n\
| 60x4x2 | 0.30 s, 45 MB | 0.39 s, 200 MB | 0.34 s, 192 MB | 0.26 s, 232 MB | 1.40 s, 125 MB |\n\
| 88x6x1 | 0.35 s, 44 MB | 0.51 s, 217 MB | 0.36 s, 204 MB | 0.32 s, 251 MB | 1.35 s, 120 MB |\n\n";

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
        iteration_section(&mut text).map_err(say)?;
        metal_section(&mut text).map_err(say)?;
        linear_section(&mut text).map_err(say)?;
        Ok(text)
    })?;
    text.push_str(&sections);
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/performance.md");
    std::fs::write(docs, text.trim_end().to_owned() + "\n")?;
    Ok(())
}
