//! Protects the energy of elements installed in a deformed structure whose law states none of its own.

use std::sync::Arc;

use fe_core::element::Element;
use fe_core::shape::hex20;
use fe_core::voigt::isotropic;
use fe_elements::{BandWidth, Hex20, HexRule, Installed};
use fe_tests::laws::Linear;

/// Target: (1/2) E e^2 V of the strain since the installation, V = 8 mm3, within rounding.
#[test]
fn the_energy_is_that_of_the_strain_since() {
    let nodes = std::array::from_fn(|a| a);
    let law = Arc::new(Linear(isotropic(3e4, 0.0)));
    let cube = Hex20::new(
        nodes,
        &hex20::NODES,
        HexRule::Full,
        law,
        BandWidth::CubeRoot,
    )
    .unwrap();
    let stretch = |e: f64| -> Vec<f64> {
        let places = hex20::NODES.iter();
        places.flat_map(|x| [e * x[0], 0.0, 0.0]).collect()
    };
    let installed = Installed::new(Box::new(cube), stretch(1e-3)).unwrap();
    let energy = installed
        .free_energy(&stretch(1.5e-3), &[])
        .unwrap()
        .unwrap();
    let exact = 0.5 * 3e4 * 5e-4_f64.powi(2) * 8.0;
    assert!(
        (energy - exact).abs() < 1e-12 * exact,
        "{energy} for {exact}"
    );
}
