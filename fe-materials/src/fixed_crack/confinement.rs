//! Confinement: concrete that is pressed from the sides is stronger than a cylinder.

/// What pressure across an axis does to the compression along it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Deserialize)]
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

impl Confinement {
    /// Factor K of axis `i` under the `pressures` (MPa) on all axes, and its derivatives with respect to them.
    pub(super) fn factor(self, fcm: f64, pressures: &[f64; 3], i: usize) -> (f64, [f64; 3]) {
        let mut slopes = [0.0; 3];
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (most, least) = if pressures[k] > pressures[j] {
            (k, j)
        } else {
            (j, k)
        };
        if self == Self::None || pressures[most] <= ROUNDING * fcm {
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
}
