//! Opening a crack dissipates the fracture energy whatever the size of the element: the crack band.
//!
//! `cargo run --release -p fe-materials --example crack_energy`

use fe_materials::concrete::ConcreteScalars;
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters, TensionSoftening};
use fe_materials::material::PointContext;
use fe_materials::point::{Control, PointDriver, Segment};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let c = ConcreteScalars::from_characteristic(30.0)?;
    let p = FixedCrackParameters {
        tension_softening: TensionSoftening::Linear,
        ..FixedCrackParameters::from_strength(c.fcm_mpa, c.fctm_mpa, c.young_mpa)
    };
    let law = FixedCrack::new(p, None)?;
    println!("fracture energy {:.5} N/mm", p.fracture_energy);
    for width in [10.0, 30.0, 100.0] {
        let open = 2.1 * p.fracture_energy / (p.ft_mpa * width);
        let mut controls = vec![Control::Stress(0.0); 6];
        controls[0] = Control::Strain(open);
        let mut point = PointDriver::new(&law, PointContext::new(width))?;
        point.run(&[Segment::new(controls, 5000)])?;
        let work: f64 = point
            .history()
            .rows()
            .windows(2)
            .map(|w| 0.5 * (w[0].stress[0] + w[1].stress[0]) * (w[1].strain[0] - w[0].strain[0]))
            .sum();
        println!("  band of {width:5.1} mm: {:.5} N/mm", work * width);
        assert!((work * width / p.fracture_energy - 1.0).abs() < 1e-4);
    }
    Ok(())
}
