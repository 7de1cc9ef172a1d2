//! A bar that crosses two hexahedra obliquely, and its share of the force at a uniform strain.

use std::sync::Arc;

use fe_core::element::{Element, ElementSystem, EvaluationContext};
use fe_core::grid::GridBuilder;
use fe_core::material::Operator;
use fe_elements::{Bar, embed};
use fe_materials::Biso;

const STRAIN: f64 = 1e-3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut grid = GridBuilder::new();
    grid.add_box(
        "concrete",
        &[0.0, 100.0, 200.0],
        &[0.0, 100.0],
        &[0.0, 100.0],
    );
    let mesh = grid.finish()?;
    let bar = Bar {
        name: "stirrup leg".into(),
        polyline: vec![[20.0, 20.0, 50.0], [180.0, 80.0, 50.0]],
        area_mm2: 78.5,
        law: Arc::new(Biso::hot_rolled(200e3, 460.0, 2e3)?),
        dowel: None,
    };
    let length = bar.length_mm();
    let elements = embed(&[bar], &mesh, &["concrete"])?;
    println!("{} pieces of {length:.2} mm in all", elements.len());

    // Both cells stretched along x: the work of the bar is N eps L with eps = STRAIN cos^2.
    let ctx = EvaluationContext::new(Operator::None);
    let mut work = 0.0;
    for element in &elements {
        let ux = |&n: &usize| [STRAIN * mesh.nodes()[n][0], 0.0, 0.0];
        let u: Vec<f64> = element.nodes().iter().flat_map(ux).collect();
        let mut state = vec![0.0; element.state_len()];
        element.init_state(&mut state);
        let mut trial = state.clone();
        let mut force = [0.0; 60];
        let out = ElementSystem {
            force: &mut force,
            stiffness: &mut [],
        };
        element.evaluate(&u, &state, &mut trial, &ctx, out)?;
        work += force.iter().zip(&u).map(|(f, u)| f * u).sum::<f64>();
    }
    let strain = STRAIN * (160.0 / length).powi(2);
    let exact = 200e3 * 78.5 * strain * strain * length;
    println!("work {work:.3} N mm, exact {exact:.3} N mm");
    assert!((work / exact - 1.0).abs() < 1e-12);
    Ok(())
}
