//! Protects what a hexahedron is built from: crack-band width of its shape, refusal of cells and widths that cannot be.

use std::sync::Arc;

use fe_core::element::ElementError;
use fe_core::shape::hex20::NODES;
use fe_elements::{BandWidth, Hex20, HexRule};
use fe_materials::Elastic;

/// A box of 60 mm x 40 mm x 20 mm.
fn cell() -> [[f64; 3]; 20] {
    NODES.map(|[x, y, z]| [30.0 * x, 20.0 * y, 10.0 * z])
}

fn build(coords: &[[f64; 3]; 20], rule: HexRule, band: BandWidth) -> Result<Hex20, ElementError> {
    let law = Arc::new(Elastic::new(30_000.0, 0.2).unwrap());
    Hex20::new(std::array::from_fn(|a| a), coords, rule, law, band)
}

/// Targets: (48 000/8)^(1/3) and (48 000/27)^(1/3) mm; 0.8 sqrt(60 x 40) mm for cracks seen along z, for a normal of any
/// length; the number given.
#[test]
fn crack_band_widths() {
    let in_plane = |normal| BandWidth::InPlane {
        normal,
        factor: 0.8,
    };
    for (rule, band, width) in [
        (HexRule::Reduced, BandWidth::CubeRoot, 6000.0_f64.cbrt()),
        (
            HexRule::Full,
            BandWidth::CubeRoot,
            (48_000.0 / 27.0_f64).cbrt(),
        ),
        (
            HexRule::Reduced,
            in_plane([0.0, 0.0, 1.0]),
            0.8 * 2400.0_f64.sqrt(),
        ),
        (
            HexRule::Reduced,
            in_plane([0.0, 0.0, -3.0]),
            0.8 * 2400.0_f64.sqrt(),
        ),
        (
            HexRule::Reduced,
            in_plane([0.0, 0.0, 1e-200]),
            0.8 * 2400.0_f64.sqrt(),
        ),
        (
            HexRule::Reduced,
            in_plane([0.0, 0.0, 1e200]),
            0.8 * 2400.0_f64.sqrt(),
        ),
        (HexRule::Full, BandWidth::Fixed(25.0), 25.0),
    ] {
        let element = build(&cell(), rule, band).unwrap();
        assert!(
            (element.band_width() - width).abs() < 1e-12 * width,
            "{band:?}"
        );
        assert!((element.volume() - 48_000.0).abs() < 1e-8);
    }
}

/// A width that is not a positive number is refused with the quantity.
#[test]
fn impossible_widths_are_refused() {
    let flat = BandWidth::InPlane {
        normal: [0.0; 3],
        factor: 1.0,
    };
    let numberless = BandWidth::InPlane {
        normal: [f64::NAN, 0.0, 1.0],
        factor: 1.0,
    };
    for band in [
        BandWidth::Fixed(0.0),
        BandWidth::Fixed(f64::NAN),
        flat,
        numberless,
    ] {
        let error = build(&cell(), HexRule::Reduced, band).unwrap_err();
        assert!(error.to_string().contains("crack-band width"), "{error}");
    }
}

/// A cell turned inside out is refused with the point and the determinant.
#[test]
fn inverted_cells_are_refused() {
    let mirrored = cell().map(|[x, y, z]| [-x, y, z]);
    let error = build(&mirrored, HexRule::Reduced, BandWidth::CubeRoot).unwrap_err();
    assert!(
        matches!(error, ElementError::Jacobian { point: 0, determinant } if determinant < 0.0),
        "{error}"
    );
}

/// Two corners of one edge exchanged, as by a slip in a list of nodes, are refused whatever the rule sees.
#[test]
fn exchanged_corners_are_refused() {
    for edge in [0, 1, 2, 3].map(|a| [[a, (a + 1) % 4], [a + 4, (a + 1) % 4 + 4], [a, a + 4]]) {
        for [a, b] in edge {
            let mut coords = cell();
            coords.swap(a, b);
            for rule in [HexRule::Reduced, HexRule::Irons, HexRule::Full] {
                let error = build(&coords, rule, BandWidth::CubeRoot).unwrap_err();
                let folded = matches!(error, ElementError::Jacobian { .. });
                assert!(folded, "{a} {b} {rule:?}: {error}");
            }
        }
    }
}

/// A corner pulled into the cell folds it near there only: at the 2x2x2 points the map looks sound, at those of 3x3x3 not.
#[test]
fn a_folded_corner_is_refused() {
    let mut folded = cell();
    let (near, far) = (folded[0], folded[6]);
    for k in 0..3 {
        folded[0][k] += 0.3 * (far[k] - near[k]);
    }
    let error = build(&folded, HexRule::Reduced, BandWidth::CubeRoot).unwrap_err();
    assert!(
        matches!(error, ElementError::Jacobian { point: 0, .. }),
        "{error}"
    );
}
