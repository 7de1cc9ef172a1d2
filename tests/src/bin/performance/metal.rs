//! The von Mises beam beside `CalculiX`.

use std::error::Error;
use std::fmt::Write;
use std::sync::Arc;

use fe_core::kinematics::Solid;
use fe_core::material::Material;
use fe_elements::HexRule;
use fe_materials::VonMises;
use fe_solver::control::StepControl;
use fe_solver::newton::{NewtonRaphson, NewtonSettings};
use fe_tests::beam::{BareBeam, bare_beam};
use fe_tests::calculix::{self, Metal, Reference, own_cpu_s};
use fe_tests::solve::run;

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
pub fn section(text: &mut String) -> Result<(), Box<dyn Error>> {
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
