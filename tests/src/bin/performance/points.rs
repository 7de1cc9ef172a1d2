//! What elements cost without laws, and laws without elements.

use std::error::Error;
use std::fmt::Write;
use std::hint::black_box;

use fe_core::element::{Element, ElementSystem, EvaluationContext};
use fe_core::kinematics::Solid;
use fe_core::material::{Material, Operator, PointContext};
use fe_core::shape::hex20::NODES;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::VonMises;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};
use fe_tests::laws::elastic;
use nalgebra::Vector6;

use crate::median;

/// Evaluations in a row, of which the median of so many is taken.
const ROW: usize = 1000;
const ROWS: usize = 31;

/// Microseconds of one piece of work.
fn microseconds(mut work: impl FnMut()) -> f64 {
    let row = median(ROWS, || {
        for _ in 0..ROW {
            work();
        }
    });
    1e6 * row / ROW as f64
}

pub fn section(text: &mut String) -> Result<(), Box<dyn Error>> {
    elements(text)?;
    laws(text)
}

/// A distorted hexahedron of 50 mm with Hooke's law.
fn elements(text: &mut String) -> Result<(), Box<dyn Error>> {
    text.push_str(
        "## One hexahedron, one point\n\nA distorted hexahedron with Hooke's law, which is symmetric, µs; unsymmetric ones and other elements: `cargo bench -p fe-elements`.\n\n\
         | points | stiffness and forces | forces | forces, by the point |\n|---|---|---|---|\n",
    );
    let coords = NODES.map(|[x, y, z]| [25.0 * x + 2.0 * y * z, 25.0 * y + x, 25.0 * z - x * y]);
    for (points, rule) in [
        (8, HexRule::Reduced),
        (14, HexRule::Irons),
        (27, HexRule::Full),
    ] {
        let (nodes, law) = (std::array::from_fn(|i| i), elastic(30e3, 0.2)?);
        let element = Hex20::new(nodes, &coords, rule, law, BandWidth::CubeRoot)?;
        let u: [f64; 60] = std::array::from_fn(|i| 1e-3 * (i as f64).sin());
        let mut force = [0.0; 60];
        let mut time = |operator, stiffness: &mut [f64]| {
            let ctx = EvaluationContext::new(operator);
            microseconds(|| {
                let out = ElementSystem {
                    force: &mut force,
                    stiffness: &mut *stiffness,
                };
                let _ = black_box(element.evaluate(&u, &[], &mut [], &ctx, out));
            })
        };
        let both = time(Operator::Secant, &mut vec![0.0; 60 * 60]);
        let forces = time(Operator::None, &mut []);
        let by_point = forces / f64::from(points);
        writeln!(
            text,
            "| {points} | {both:.1} | {forces:.2} | {by_point:.3} |"
        )?;
    }
    Ok(())
}

/// Laws for the points of a hexahedron at once.
fn laws(text: &mut String) -> Result<(), Box<dyn Error>> {
    text.push_str(
        "\nLaws for the 14 points of a hexahedron together, by the point, ns; other laws: `cargo bench -p fe-materials`.\n\n\
         | law | state | stress and tangent | stress |\n|---|---|---|---|\n",
    );
    let beams = FixedCrackParameters::from_strength(38.0, 2.9, 33_000.0);
    let beams = FixedCrack::new(beams, None)?;
    let metal = VonMises::new(200e3, 0.3, 400.0, 2e3)?;
    let mut row = |name: &str, law: &dyn Material<Solid>, state: &str, strain: [f64; 6]| {
        let time = |operator| update(law, &Vector6::from(strain), operator);
        let (both, stress) = (time(Operator::Tangent)?, time(Operator::None)?);
        writeln!(text, "| {name} | {state} | {both:.0} | {stress:.0} |")?;
        Ok::<(), Box<dyn Error>>(())
    };
    for (state, strain) in [
        ("sound, in tension", [3e-5, 1e-5, 1e-5, 2e-6, -1e-6, 2e-6]),
        ("cracked", [8e-4, -1e-4, -2e-4, 2e-4, -1e-4, 3e-4]),
        ("in compression", [-3e-4, 6e-5, 6e-5, 2e-5, -1e-5, 3e-5]),
        ("crushing", [-4e-3, 6e-4, 6e-4, 2e-4, -1e-4, 3e-4]),
    ] {
        row("fixed crack", &beams, state, strain)?;
    }
    for (state, size) in [("elastic", 1e-4), ("plastic", 1e-3)] {
        let strain = [6.0, -2.0, -3.0, 2.0, 0.0, 1.0].map(|e| size * e);
        row("von Mises", &metal, state, strain)?;
    }
    text.push('\n');
    Ok(())
}

/// Time (ns) of an update of one of 14 points, from a strain to one larger by a tenth.
fn update(
    law: &dyn Material<Solid>,
    strain: &Vector6<f64>,
    operator: Operator,
) -> Result<f64, Box<dyn Error>> {
    const POINTS: usize = 14;
    let ctx = PointContext {
        operator,
        ..PointContext::new(50.0)
    };
    let mut virgin = vec![0.0; law.state_len() * POINTS];
    for state in virgin.chunks_exact_mut(law.state_len().max(1)) {
        law.init_state(state);
    }
    let (mut state, mut trial) = (virgin.clone(), virgin.clone());
    law.update_many(
        &[*strain; POINTS],
        (&virgin, &mut state),
        &ctx,
        &mut |_, _| (),
    )
    .map_err(|(_, e)| e)?;
    let strains = [*strain * 1.1; POINTS];
    let time = microseconds(|| {
        let _ = law.update_many(&strains, (&state, &mut trial), &ctx, &mut |_, answer| {
            black_box(answer);
        });
    });
    Ok(1e3 * time / POINTS as f64)
}
