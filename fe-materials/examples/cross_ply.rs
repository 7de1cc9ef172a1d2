//! A 90/0 laminate of carbon sheets: mean stress and how close the fibres are to rupture.
//!
//! `cargo run --release -p fe-materials --example cross_ply`

use fe_materials::material::{Material, PointContext};
use fe_materials::point::{Control, PointDriver, Segment};
use fe_materials::{Lamina, LaminaParameters, Laminate, Ply};
use nalgebra::Vector3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let lamina = Lamina::new(&LaminaParameters {
        young_1_mpa: 228e3,
        young_2_mpa: 10.0,
        shear_mpa: 10.0,
        poisson_12: 0.0,
        strength_mpa: 3790.0,
    })?;
    let ply = |angle_deg| Ply {
        lamina,
        angle_deg,
        thickness_mm: 0.165,
    };
    let law = Laminate::new(vec![ply(90.0), ply(0.0)])?;
    let mut point = PointDriver::new(&law, PointContext::new(0.0))?;
    let stretched = vec![
        Control::Strain(0.01),
        Control::Stress(0.0),
        Control::Stress(0.0),
    ];
    point.run(&[Segment::new(stretched, 1)])?;
    let row = &point.history().rows()[1];
    let utilisation = law
        .report(&Vector3::from_column_slice(&row.strain), &row.state)
        .utilisation;
    println!(
        "mean stress {:.1} MPa over {:.3} mm, utilisation of the fibres {utilisation:.4}",
        row.stress[0],
        law.thickness_mm()
    );
    assert!((utilisation - 0.01 * 228e3 / 3790.0).abs() < 1e-9);
    Ok(())
}
