//! Bending stiffness along axis 1 of a stack of plies at 0, 90 and 0 degrees, from the work of one shell that is bent
//! to a cylinder, against laminate theory.

use std::sync::Arc;

use fe_core::element::{Element, ElementSystem, EvaluationContext};
use fe_core::material::Operator;
use fe_core::shape::quad8;
use fe_elements::{Layer, QuadRule, Shell8, ShellSection};
use fe_materials::{Lamina, LaminaParameters};

const PLY_MM: f64 = 0.5;
const CURVATURE: f64 = 1e-4;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let lamina = Lamina::new(&LaminaParameters {
        young_1_mpa: 135e3,
        young_2_mpa: 9e3,
        shear_mpa: 5e3,
        poisson_12: 0.3,
        strength_mpa: 1500.0,
    })?;
    let ply = |angle_deg| Layer {
        thickness_mm: PLY_MM,
        angle_deg,
        law: Arc::new(lamina),
        shear_mpa: [5e3, 3e3],
    };
    let section = ShellSection::new([0.0, 90.0, 0.0].map(ply).to_vec());

    // A square of 40 mm in the x-y plane.
    let coords = quad8::NODES.map(|[x, y]| [20.0 * x, 20.0 * y, 0.0]);
    let nodes = std::array::from_fn(|a| a);
    let axis_1 = [1.0, 0.0, 0.0];
    let shell = Shell8::new(nodes, &coords, &section, QuadRule::Reduced, axis_1)?;

    // w = -k x^2/2 with the rotation k x about y.
    let u: Vec<f64> = coords
        .iter()
        .flat_map(|[x, _, _]| {
            let (w, turn) = (-0.5 * CURVATURE * x * x, CURVATURE * x);
            [0.0, 0.0, w, 0.0, turn, 0.0]
        })
        .collect();
    let mut force = vec![0.0; u.len()];
    let out = ElementSystem {
        force: &mut force,
        stiffness: &mut [],
    };
    let ctx = EvaluationContext::new(Operator::None);
    shell.evaluate(&u, &[], &mut [], &ctx, out)?;
    let work: f64 = u.iter().zip(&force).map(|(u, f)| u * f).sum();
    let stiffness = work / (CURVATURE.powi(2) * 1600.0);

    // The middle ply counts little: D11 = (26 Q11 + Q22) t^3/12.
    let q = lamina.stiffness();
    let theory = (26.0 * q[(0, 0)] + q[(1, 1)]) * PLY_MM.powi(3) / 12.0;
    println!("{stiffness:.1} N mm, laminate theory {theory:.1} N mm");
    assert!((stiffness / theory - 1.0).abs() < 1e-10);
    Ok(())
}
