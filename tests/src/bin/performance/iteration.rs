//! One iteration with concrete, by phase.

use std::error::Error;
use std::fmt::Write;
use std::hint::black_box;
use std::sync::Arc;

use fe_core::element::EvaluationContext;
use fe_core::kinematics::Solid;
use fe_core::material::{Material, Operator};
use fe_elements::HexRule;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_solver::stage::Stage;
use fe_tests::beam::bare_beam;

use crate::median;

/// One iteration on the cracked beam, by phase.
pub fn section(text: &mut String) -> Result<(), Box<dyn Error>> {
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
