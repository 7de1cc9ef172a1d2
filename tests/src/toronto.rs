//! Panels tested in pure shear in Toronto.
//!
//! Source: Vecchio and Collins (1982; 1986), 890 mm x 890 mm x 70 mm, largest aggregate 6 mm, two layers of welded wires mostly 50 mm
//! apart; known at second hand, reinforcement and strengths from two places, loads from one.

use std::sync::Arc;

use fe_materials::concrete::{Calibration, Ottosen};
use fe_materials::fixed_crack::{FixedCrack, FixedCrackParameters};

use crate::cube::Failure;
use crate::panel::{Panel, Smeared};

/// Largest aggregate (mm).
pub const AGGREGATE_MM: f64 = 6.0;
/// Distance of the wires (mm).
pub const SPACING_MM: f64 = 50.0;
/// Shear strain to which the panels are followed (-).
const DRIFT: f64 = 0.02;
/// Hardening modulus of the wires (MPa), assumed: one thousandth of Young's.
const HARDENING_MPA: f64 = 200.0;

/// What ended a test.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The panel failed.
    Failure,
    /// It failed as it cracked.
    Cracking,
    /// An edge failed: the panel would have carried more.
    Edge,
}

/// A test.
#[derive(Debug, Clone, Copy)]
pub struct Test {
    /// Name.
    pub name: &'static str,
    /// Cylinder strength (MPa).
    pub fc_mpa: f64,
    /// Reinforcement along x and y.
    pub steel: [Smeared; 2],
    /// Largest shear stress (MPa).
    pub stress_mpa: f64,
    /// What ended it.
    pub end: End,
}

const fn test(
    name: &'static str,
    fc_mpa: f64,
    x: (f64, f64),
    y: (f64, f64),
    (stress_mpa, end): (f64, End),
) -> Test {
    let steel = [
        Smeared {
            ratio: x.0,
            yield_mpa: x.1,
        },
        Smeared {
            ratio: y.0,
            yield_mpa: y.1,
        },
    ];
    Test {
        name,
        fc_mpa,
        steel,
        stress_mpa,
        end,
    }
}

/// Panels under monotonic pure shear; PV1, PV14 and PV15 are left out, of which no load at failure is at hand.
pub const TESTS: [Test; 20] = [
    test(
        "PV2",
        23.5,
        (0.0018, 428.0),
        (0.0018, 428.0),
        (1.16, End::Cracking),
    ),
    test(
        "PV3",
        26.6,
        (0.00483, 662.0),
        (0.00483, 662.0),
        (3.07, End::Failure),
    ),
    test(
        "PV4",
        26.6,
        (0.01056, 242.0),
        (0.01056, 242.0),
        (2.89, End::Failure),
    ),
    test(
        "PV5",
        28.3,
        (0.00742, 621.0),
        (0.00742, 621.0),
        (4.24, End::Failure),
    ),
    test(
        "PV6",
        29.8,
        (0.01785, 266.0),
        (0.01785, 266.0),
        (4.55, End::Failure),
    ),
    test(
        "PV7",
        31.0,
        (0.01785, 453.0),
        (0.01785, 453.0),
        (6.81, End::Edge),
    ),
    test(
        "PV8",
        29.8,
        (0.02616, 462.0),
        (0.02616, 462.0),
        (6.67, End::Edge),
    ),
    test(
        "PV9",
        11.6,
        (0.01785, 455.0),
        (0.01785, 455.0),
        (3.74, End::Failure),
    ),
    test(
        "PV10",
        14.5,
        (0.01785, 276.0),
        (0.00999, 276.0),
        (3.97, End::Failure),
    ),
    test(
        "PV11",
        15.6,
        (0.01785, 235.0),
        (0.01306, 235.0),
        (3.56, End::Failure),
    ),
    test(
        "PV12",
        16.0,
        (0.01785, 469.0),
        (0.00446, 269.0),
        (3.13, End::Failure),
    ),
    test(
        "PV13",
        18.2,
        (0.01785, 248.0),
        (0.0, 0.0),
        (2.01, End::Failure),
    ),
    test(
        "PV16",
        21.7,
        (0.0074, 255.0),
        (0.0074, 255.0),
        (2.14, End::Failure),
    ),
    test(
        "PV18",
        19.5,
        (0.01785, 431.0),
        (0.00315, 412.0),
        (3.04, End::Failure),
    ),
    test(
        "PV19",
        19.0,
        (0.01785, 458.0),
        (0.00713, 299.0),
        (3.95, End::Failure),
    ),
    test(
        "PV20",
        19.6,
        (0.01785, 460.0),
        (0.00885, 297.0),
        (4.26, End::Failure),
    ),
    test(
        "PV21",
        19.5,
        (0.01785, 458.0),
        (0.01296, 302.0),
        (5.03, End::Failure),
    ),
    test(
        "PV22",
        19.6,
        (0.01785, 458.0),
        (0.01524, 420.0),
        (6.07, End::Failure),
    ),
    test(
        "PV26",
        21.3,
        (0.01785, 456.0),
        (0.01009, 463.0),
        (5.41, End::Failure),
    ),
    test(
        "PV27",
        20.5,
        (0.01785, 442.0),
        (0.01785, 442.0),
        (6.35, End::Failure),
    ),
];

impl Test {
    /// Parameters of the default law; tensile strength and modulus of the fib Model Code 2010, 5.1,
    /// also below the 16 MPa at which its tables begin.
    pub fn concrete(&self) -> FixedCrackParameters {
        let fc = self.fc_mpa;
        let young = 21_500.0 * (fc / 10.0).cbrt();
        FixedCrackParameters::from_strength(fc, tensile(fc), young)
    }

    /// Whether both reinforcements are alike.
    pub fn is_equal(&self) -> bool {
        self.steel[0] == self.steel[1]
    }

    /// Largest shear stress (MPa) with a concrete, over that of the test; one crack per side of `side_mm`.
    ///
    /// # Errors
    ///
    /// What [`Panel::shear`] does not admit.
    pub fn ratio(&self, concrete: FixedCrackParameters, side_mm: f64) -> Result<f64, Failure> {
        let calibration = Calibration::model_code(self.fc_mpa, tensile(self.fc_mpa));
        let onset = Ottosen::new(&calibration)?;
        let panel = Panel {
            side_mm,
            concrete: Arc::new(FixedCrack::new(concrete, Some(onset))?),
            steel: self.steel,
            hardening_mpa: HARDENING_MPA,
        };
        Ok(panel.shear(DRIFT)?.largest_mpa / self.stress_mpa)
    }
}

fn tensile(fc_mpa: f64) -> f64 {
    0.3 * (fc_mpa - 8.0).powf(2.0 / 3.0)
}
