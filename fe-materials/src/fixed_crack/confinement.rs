//! Compressive histories, and confinement: concrete that is pressed from the sides is stronger than a cylinder.

use nalgebra::{Matrix3, Vector3};

use super::FixedCrack;
use super::curves::Compression;

/// What pressure across an axis does to the compression along it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Confinement {
    /// Nothing.
    #[default]
    None,
    /// Strength and the strains of the whole compression curve are scaled by
    ///
    /// K = 1 + 0.92 x - 0.76 x^2 + 4.1 y,  x = (p_1 - p_2)/fcm <= 1,  y = p_2/fcm,
    ///
    /// p_1 >= p_2 >= 0 being the pressures on the other two axes (Vecchio 1992, after Kupfer, Hilsdorf and Ruesch 1969 in
    /// two axes and Richart, Brandtzaeg and Brown 1928 in three, at second hand): 1.16 where two axes are pressed alike, 1.28
    /// where one is pressed half as much as the other.
    Vecchio,
}

/// K = 1 + LINEAR x - SQUARE x^2 + TRIAXIAL y.
const LINEAR: f64 = 0.92;
const SQUARE: f64 = 0.76;
const TRIAXIAL: f64 = 4.1;
/// Pressure over fcm that rounding leaves across a free axis.
const ROUNDING: f64 = 1e-12;

/// Factor K of axis `i` under the `pressures` (MPa) on all axes, and its derivatives with respect to them.
fn factor(fcm: f64, pressures: &[f64; 3], i: usize) -> (f64, [f64; 3]) {
    let mut slopes = [0.0; 3];
    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
    let (most, least) = if pressures[k] > pressures[j] {
        (k, j)
    } else {
        (j, k)
    };
    if pressures[most] <= ROUNDING * fcm {
        return (1.0, slopes);
    }
    let difference = (pressures[most] - pressures[least]) / fcm;
    let x = difference.min(1.0);
    let by_x = if difference < 1.0 {
        (LINEAR - 2.0 * SQUARE * x) / fcm
    } else {
        0.0
    };
    slopes[most] = by_x;
    slopes[least] = TRIAXIAL / fcm - by_x;
    let in_two = LINEAR * x - SQUARE * x * x;
    let factor = 1.0 + in_two + TRIAXIAL * pressures[least] / fcm;
    (factor, slopes)
}

impl FixedCrack {
    /// The compressive histories at a step's end.
    #[inline]
    pub(super) fn pressed(&self, strains: &Pressed<'_>, compression: &Compression) -> [f64; 3] {
        if self.p.confinement == Confinement::None {
            return [0, 1, 2].map(|i| strains.grown(i, 1.0));
        }
        self.confined(strains, compression).map(|growth| growth.kc)
    }

    /// Their derivatives with respect to the strains.
    #[inline(never)]
    pub(super) fn pressed_slopes(
        &self,
        strains: &Pressed<'_>,
        compression: &Compression,
    ) -> [[f64; 3]; 3] {
        if self.p.confinement == Confinement::None {
            let mut slopes = [[0.0; 3]; 3];
            for i in 0..3 {
                if strains.grown(i, 1.0) > strains.kc[i] {
                    slopes[i][i] = -strains.relaxation;
                }
            }
            return slopes;
        }
        self.confined(strains, compression)
            .map(|growth| growth.slopes)
    }

    /// Both; apart, so that points that nothing confines do not pay for it. The pressures are those of axes without
    /// confinement: so they do not depend on the step that leads to them.
    #[inline(never)]
    fn confined(&self, strains: &Pressed<'_>, compression: &Compression) -> [Growth; 3] {
        let Pressed {
            e,
            kc,
            driven,
            relaxation,
        } = strains;
        let mut pressures = [0.0; 3];
        // Derivatives of the pressures with respect to the strains.
        let mut rates = Matrix3::zeros();
        for j in (0..3).filter(|&j| e[j] < 0.0) {
            let by = driven[j];
            let (modulus, by_kc) = compression.secant(kc[j].max(-e[by]));
            pressures[j] = -modulus * e[j];
            rates[(j, j)] -= modulus;
            if -e[by] > kc[j] {
                rates[(j, by)] += by_kc * e[j];
            }
        }
        std::array::from_fn(|i| {
            let (factor, by_pressure) = factor(self.p.fcm_mpa, &pressures, i);
            let grown = strains.grown(i, factor);
            let mut slopes = Vector3::zeros();
            if grown > kc[i] {
                slopes = rates.tr_mul(&Vector3::from(by_pressure));
                slopes *= relaxation * e[i] / (factor * factor);
                slopes[i] -= relaxation / factor;
            }
            Growth {
                kc: grown,
                slopes: slopes.into(),
            }
        })
    }
}

/// What presses the axes in a step.
#[derive(Debug)]
pub(super) struct Pressed<'a> {
    /// Strains along the axes.
    pub(super) e: &'a [f64; 3],
    /// Histories before the step.
    pub(super) kc: &'a [f64; 3],
    /// The axis that drives the history of each.
    pub(super) driven: [usize; 3],
    /// Share by which histories grow.
    pub(super) relaxation: f64,
}

impl Pressed<'_> {
    /// History of axis `i`, which grows with its strain over a factor.
    #[inline]
    fn grown(&self, i: usize, factor: f64) -> f64 {
        let excess = -self.e[i] / factor - self.kc[i];
        self.kc[i] + self.relaxation * excess.max(0.0)
    }
}

/// A compressive history and its derivatives with respect to the strains along the axes.
#[derive(Debug, Clone, Copy)]
struct Growth {
    kc: f64,
    slopes: [f64; 3],
}
