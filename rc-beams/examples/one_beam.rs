//! The beam A-SO3-1, bent through its first cracks by a program; its stiffness before them against beam theory.

use std::io;

use fe_solver::recorder::{Continue, StepView};
use fe_solver::secant::SecantAnderson;
use rc_beams::analysis::{Observer, Reading, Stepping, analyse};
use rc_beams::build::{Beam, ModelSettings};
use rc_beams::options::Preset;
use rc_beams::spec::{BUILTIN, read};

/// Deflection (mm) and load (kN) of every accepted step.
#[derive(Default)]
struct Curve(Vec<[f64; 2]>);

impl Observer for Curve {
    fn step(&mut self, _: &StepView<'_>, _: usize, reading: &Reading) -> io::Result<Continue> {
        self.0.push([reading.deflection_mm, reading.load_kn]);
        Ok(Continue::Yes)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut built_in = BUILTIN.iter().filter(|(name, _)| *name == "A-SO3-1");
    let (name, text) = built_in.next().ok_or("no such beam")?;
    let specimen = read(name, text).map_err(|errors| format!("{errors:?}"))?;
    let settings = ModelSettings::new(Preset::default(), &specimen);
    let beam = Beam::new(&specimen, &settings)?;
    let stepping = Stepping {
        initial_mm: 0.02,
        longest_share: 0.01,
        until_mm: 0.4,
        to_the_end: true,
        criterion: 1e-3,
    };
    let (mut driver, mut curve) = (SecantAnderson::default(), Curve::default());
    analyse(&beam, None, &stepping, &mut driver, &mut curve)?;
    for [deflection, load] in &curve.0 {
        println!("{deflection:6.3} mm {load:7.2} kN");
    }
    // Two loads P/2 at a = 760 mm from the supports of l = 1830 mm: w/P = a (3 l^2 - 4 a^2)/(48 E I) + a/(2 (5/6) G A), with
    // the four bars of 32 mm in I.
    let (a, l, young, area) = (760.0, 1830.0, 25_000.0, 150.0 * 305.0);
    let steel = (200_000.0 / young - 1.0) * 4.0 * 804.25 * 101.5_f64.powi(2);
    let inertia = area * 305.0_f64.powi(2) / 12.0 + steel;
    let bending = a * (3.0 * l * l - 4.0 * a * a) / (48.0 * young * inertia);
    let shear = a / (2.0 * 5.0 / 6.0 * young / 2.4 * area);
    let theory = 1e-3 / (bending + shear);
    let [deflection, load] = curve.0[0];
    let stiffness = load / deflection;
    println!("{stiffness:.1} kN/mm before the first crack, {theory:.1} by beam theory");
    // Plates of 100 mm shorten the span a little.
    assert!((stiffness / theory - 1.05).abs() < 0.05);
    Ok(())
}
