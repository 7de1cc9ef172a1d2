//! Uniaxial and confined compression of a C30: a point under strain control along one axis and stress
//! control across it.
//!
//! `cargo run --release -p fe-materials --example concrete_point`

use fe_materials::concrete::{ConcreteScalars, Isochoric};
use fe_materials::material::PointContext;
use fe_materials::point::{Control, PointDriver, Segment};

/// Largest compressive stress along x with a lateral pressure (MPa).
fn strength(law: &Isochoric, pressure: f64) -> Result<f64, Box<dyn std::error::Error>> {
    let (side, none) = (Control::Stress(-pressure), Control::Stress(0.0));
    let mut point = PointDriver::new(law, PointContext::new(0.0))?;
    point.run(&[
        Segment::new(vec![side, side, side, none, none, none], 10),
        Segment::new(
            vec![Control::Strain(-0.01), side, side, none, none, none],
            100,
        ),
    ])?;
    let stresses = point.history().rows().iter().map(|row| -row.stress[0]);
    Ok(stresses.fold(0.0, f64::max))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let concrete = ConcreteScalars::from_characteristic(30.0)?;
    let law = Isochoric::new(&concrete)?;
    for pressure in [0.0, 1.0, 2.0, 5.0] {
        let strength = strength(&law, pressure)?;
        println!("lateral pressure {pressure:3.1} MPa: strength {strength:6.2} MPa");
    }
    let uniaxial = strength(&law, 0.0)?;
    assert!((uniaxial / concrete.fcm_mpa - 1.0).abs() < 1e-3);
    Ok(())
}
