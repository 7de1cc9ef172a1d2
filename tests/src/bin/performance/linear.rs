//! Linear solutions over meshes, beside PARDISO.

use std::error::Error;
use std::fmt::Write;
use std::hint::black_box;
use std::time::Instant;

use fe_core::assembly::{Assembled, Assembler};
use fe_core::element::{ElementSystem, EvaluationContext};
use fe_core::material::Operator;
use fe_core::model::Model;
use fe_core::state::StateStore;
use fe_elements::HexRule;
use fe_solver::linear::{DirectSolver, LinearSolver, Ordering};
use fe_tests::beam::bare_beam;
use fe_tests::laws::elastic;
use fe_tests::pardiso;
use fe_tests::solve::solve;

use crate::median;

/// Meshes from small to large, and how often each is measured.
const MESHES: [([usize; 3], usize); 5] = [
    ([60, 4, 1], 15),
    ([60, 4, 2], 15),
    ([88, 6, 1], 15),
    ([176, 12, 4], 3),
    ([300, 20, 8], 1),
];

/// PARDISO is not asked for more equations.
const LARGEST_FOR_PARDISO: usize = 200_000;

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

/// Times (ms).
#[derive(Clone, Copy)]
struct Times {
    assembly: f64,
    /// The elements of it.
    elements: f64,
    analysis: f64,
    factorisation: f64,
    /// The factorisation on two threads.
    on_two: f64,
    solution: f64,
    /// Everything from the grid to the reactions.
    whole: f64,
}

/// The linear problem of one mesh.
struct Linear {
    cells: [usize; 3],
    equations: usize,
    entries: usize,
    flops: f64,
    ordering: Ordering,
    times: Times,
    memory: f64,
    reaction: f64,
    pardiso: Option<pardiso::Reference>,
}

impl Linear {
    /// Name of the mesh.
    fn mesh(&self) -> String {
        let [x, y, z] = self.cells;
        format!("{x}x{y}x{z}")
    }
}

/// Free equations along the beam.
fn along(model: &Model, free: &[u32]) -> Vec<u32> {
    let x = |equation: &u32| {
        let (node, _) = model.dofs().owner(free[*equation as usize] as usize);
        model.mesh().nodes()[node][0]
    };
    let mut order: Vec<u32> = (0..free.len() as u32).collect();
    order.sort_by(|a, b| x(a).total_cmp(&x(b)));
    order
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

    let mut assembler = Assembler::new(&beam.model, &beam.conditions)?;
    let mut state = StateStore::new(beam.model.elements());
    let rest = vec![0.0; beam.model.dofs().len()];
    let mut out = Assembled::default();
    let ctx = EvaluationContext::new(Operator::Secant);
    let assembly = median(times, || {
        let _ = assembler.evaluate(&beam.model, &rest, &mut state, &ctx, &mut out);
    });
    let mut system = (vec![0.0; 60], vec![0.0; 60 * 60]);
    let elements = median(times, || {
        for element in beam.model.elements() {
            let out = ElementSystem {
                force: &mut system.0,
                stiffness: &mut system.1,
            };
            // The elastic law has no history.
            let _ = black_box(element.evaluate(&rest[..60], &[], &mut [], &ctx, out));
        }
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
    let order = along(&beam.model, assembler.free());
    let pardiso = if stats.equations < LARGEST_FOR_PARDISO {
        pardiso::measure(&pattern, &out.matrix, &order, times)?
    } else {
        None
    };
    Ok(Linear {
        cells,
        equations: stats.equations,
        entries: stats.nnz_factor,
        flops: stats.factor_flops,
        ordering: stats.ordering,
        times: Times {
            assembly: 1e3 * assembly,
            elements: 1e3 * elements,
            analysis: 1e3 * analysis,
            factorisation: 1e3 * factorisation,
            on_two: 1e3 * on_two,
            solution: 1e3 * solution,
            whole: 1e3 * whole,
        },
        memory,
        reaction,
        pardiso,
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

pub fn section(text: &mut String) -> Result<(), Box<dyn Error>> {
    let dense = dense_rate();
    writeln!(
        text,
        "## Linear solution\n\nThe bare beam of 3050 x 305 x 75 mm with 8 points per element, one thread. Product of dense \
         matrices of 1200 on the same thread: {dense:.1} Gflop/s. Memory is the largest of the process up to there. Operations are those of a factor that stores no zeros.\n\n\
         | mesh | equations | order | entries of the factor, 10^6 | Gflop | assembly, ms | of it elements | analysis, ms | factorisation, ms | of the dense rate | on two threads, ms | solution, ms | from grid to reactions, ms | memory, MiB | reaction, N |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    )?;
    let mut rows = Vec::new();
    for (cells, times) in MESHES {
        let row = linear(cells, times)?;
        let Times {
            assembly,
            elements,
            analysis,
            factorisation,
            on_two,
            solution,
            whole,
        } = row.times;
        let order = match row.ordering {
            Ordering::MinimumDegree => "minimum degree",
            _ => "both ends",
        };
        writeln!(
            text,
            "| {} | {} | {order} | {:.2} | {:.3} | {assembly:.2} | {elements:.2} | {analysis:.1} | {factorisation:.1} | {:.0} % | {on_two:.1} | \
             {solution:.2} | {whole:.0} | {:.0} | {:.2} |",
            row.mesh(),
            row.equations,
            row.entries as f64 / 1e6,
            row.flops / 1e9,
            row.flops / 1e7 / (1e-3 * factorisation) / dense,
            row.memory,
            row.reaction,
        )?;
        eprintln!("{}: {factorisation:.1} ms", row.mesh());
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
        grows(|r| r.times.assembly),
        grows(|r| r.entries as f64),
        grows(|r| r.times.factorisation),
        grows(|r| r.times.solution),
        grows(|r| r.memory),
    )?;
    beside_pardiso(text, &rows)?;
    text.push_str(PEERS);
    Ok(())
}

/// The same matrices by PARDISO.
fn beside_pardiso(text: &mut String, rows: &[Linear]) -> std::fmt::Result {
    if rows.iter().all(|r| r.pardiso.is_none()) {
        return writeln!(text, "PARDISO was not at hand.\n");
    }
    writeln!(
        text,
        "Beside PARDISO of Intel's oneMKL, `mtype` 2, in the same run, after ours, the same matrices on one thread; of its own two orders (METIS, minimum degree) and that along \
         the beam the one that factorises fastest. Medians, ms:\n\n\
         | mesh | analysis, ours | PARDISO | factorisation, ours | PARDISO | its order | PARDISO over ours | solution, ours | PARDISO |\n\
         |---|---|---|---|---|---|---|---|---|"
    )?;
    for row in rows {
        let Times {
            analysis,
            factorisation,
            solution,
            ..
        } = row.times;
        let Some(p) = &row.pardiso else { continue };
        writeln!(
            text,
            "| {} | {analysis:.1} | {:.1} | {factorisation:.1} | {:.1} | {} | {:.2} | {solution:.2} | {:.2} |",
            row.mesh(),
            p.analysis,
            p.factorisation,
            p.order.replace('-', " "),
            p.factorisation / factorisation,
            p.solution,
        )?;
    }
    writeln!(text)
}

const PEERS: &str = "CPU seconds and memory of other programs for the same problem, measured elsewhere on a like machine, not in the same run \
(whole run for CalculiX, one solution or iteration for the others):\n\n\
| mesh | CalculiX 2.20 | Kratos | FElupe 11.3 | Akantu | OpenSees, 27 points |\n|---|---|---|---|---|---|\n\
| 60x4x1 | 0.12 s, 26 MB | 0.15 to 0.19 s, 153 MB | 0.10 to 0.12 s, 136 MB | 0.12 to 0.13 s, 146 MB | 0.52 to 0.55 s, 80 MB |\n\
| 60x4x2 | 0.30 s, 45 MB | 0.39 s, 200 MB | 0.34 s, 192 MB | 0.26 s, 232 MB | 1.40 s, 125 MB |\n\
| 88x6x1 | 0.35 s, 44 MB | 0.51 s, 217 MB | 0.36 s, 204 MB | 0.32 s, 251 MB | 1.35 s, 120 MB |\n\n";
