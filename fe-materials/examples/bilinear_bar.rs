//! A reinforcing bar through one cycle of strain, with both kinds of hardening.
//!
//! `cargo run --release -p fe-materials --example bilinear_bar`

use fe_materials::material::PointContext;
use fe_materials::point::{Control, PointDriver, Segment};
use fe_materials::{Biso, Hardening};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // E = 200 GPa, fy = 460 MPa, and a tangent of E/100 in total strain after yielding.
    let bar = Biso::hot_rolled(200e3, 460.0, 2e3)?;
    let to = |strain| Segment::new(vec![Control::Strain(strain)], 20);
    let mut last = [0.0; 2];
    for (stress, hardening) in last
        .iter_mut()
        .zip([Hardening::Isotropic, Hardening::Kinematic])
    {
        let law = bar.with_hardening(hardening);
        let mut point = PointDriver::new(&law, PointContext::new(0.0))?;
        point.run(&[to(0.01), to(-0.01), to(0.0)])?;
        println!("{hardening:?}");
        for row in point.history().rows().iter().step_by(20) {
            println!(
                "  strain {:7.4}  stress {:9.3} MPa",
                row.strain[0], row.stress[0]
            );
            *stress = row.stress[0];
        }
    }
    // Kinematic hardening keeps the size of the elastic range, isotropic hardening widens it.
    assert!((last[0] - 515.774).abs() < 1e-3);
    assert!((last[1] - 455.4).abs() < 1e-3);
    Ok(())
}
