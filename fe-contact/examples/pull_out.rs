//! How strong is the bond of a sheet, and what does the shape of its curve matter?
//!
//! A strip on a rigid face obeys E_f t_f s'' = tau(s). Integrated from the free end, with a small slip there, it tells
//! force and displacement at the loaded end. All three curves of Lu et al. (2005) enclose the same fracture
//! energy, so that a long strip carries the same force: sqrt(2 G_f E_f t_f), 152.6 N per mm of width here.

use fe_contact::envelope::LuJoint;
use fe_contact::{Envelope, PullOut};

/// E_f t_f of one ply of carbon fibres (N/mm).
const MEMBRANE: f64 = 228_000.0 * 0.165;
const LENGTH: f64 = 400.0;

/// Slip (mm) and force per width (N/mm) at the loaded end for a slip of the free end.
fn pull(bond: &dyn Envelope, free: f64) -> (f64, f64) {
    let steps = 8000;
    let h = LENGTH / f64::from(steps);
    let (mut slip, mut slope) = (free, 0.0);
    for _ in 0..steps {
        // Midpoint rule.
        let middle = slip + 0.5 * h * slope;
        let bend = bond.stress(slip) / MEMBRANE;
        let at_middle = slope + 0.5 * h * bend;
        slip += h * at_middle;
        slope += h * bond.stress(middle) / MEMBRANE;
    }
    (slip, MEMBRANE * slope)
}

fn main() -> Result<(), fe_core::material::MaterialError> {
    let joint = LuJoint::from_cylinder_strength(35.5, 1.0);
    let bilinear = joint.bilinear()?;
    let strip = PullOut::new(bilinear, MEMBRANE)?;
    println!("closed form: {:.2} N/mm", strip.ultimate());
    println!(
        "length that carries 97 % of it: {:.1} mm",
        strip.effective_length(0.97)
    );

    let curves: [Box<dyn Envelope>; 3] = [
        Box::new(bilinear),
        Box::new(joint.simplified()?),
        Box::new(joint.precise(160.0)?),
    ];
    for bond in curves {
        let mut strength = 0.0_f64;
        for exponent in -100..0 {
            let (slip, force) = pull(bond.as_ref(), 10.0_f64.powf(0.1 * f64::from(exponent)));
            // Up to 2 mm: long before the debonded part reaches the free end.
            if slip < 2.0 {
                strength = strength.max(force);
            }
        }
        println!("{:32} {strength:.2} N/mm", bond.name());
        assert!((strength / 152.60 - 1.0).abs() < 0.005);
    }
    Ok(())
}
