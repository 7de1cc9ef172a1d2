//! Control of the amplitude of a mode.

use super::linear::Linear;
use super::{Border, PathConstraint};
use crate::anderson::dot;
use crate::error::SolverError;
use crate::stage::Stage;

/// The amplitude of a mode w of the free displacements grows by the length of the step (mm):
/// g = w . du/(w . w) - length.
///
/// With the mode in which a structure fails, a crack that opens or a front that moves on, this is indirect
/// displacement control (de Borst 1987) that needs nobody to name the crack.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mode(Linear);

impl Mode {
    /// Controls a mode, scaled to a largest displacement of 1; `None` if it does not move, or is not finite.
    pub fn new(mut mode: Vec<f64>) -> Option<Self> {
        let largest = mode.iter().fold(0.0_f64, |a, m| a.max(m.abs()));
        if !(largest > 0.0 && mode.iter().all(|m| m.is_finite())) {
            return None;
        }
        // Squares of what is very large or very small are no numbers, or none at all.
        for m in &mut mode {
            *m /= largest;
        }
        let square = dot(&mode, &mode);
        for m in &mut mode {
            *m /= square;
        }
        Some(Self(Linear {
            gradient: mode,
            ..Linear::default()
        }))
    }
}

impl PathConstraint for Mode {
    fn begin(&mut self, stage: &Stage<'_>, length: f64) -> Result<(), SolverError> {
        self.0.begin("mode", stage, length)
    }

    fn linearise(&self, du: &[f64], dlambda: f64, gradient: &mut [f64]) -> Border {
        self.0.linearise(du, dlambda, gradient)
    }
}

#[cfg(test)]
mod tests {
    //! Protects the amplitude: an increment that is a times the mode, scaled to 1, has the amplitude a.
    use super::*;

    #[test]
    fn a_multiple_of_the_mode_has_its_amplitude() {
        let mode = Mode::new(vec![0.0, -4.0, 2.0]).unwrap();
        let mut gradient = [0.0; 3];
        let border = mode.linearise(&[5.0, -3.0, 1.5], 0.0, &mut gradient);
        assert!((border.value - 3.0).abs() < 1e-14, "{border:?}");
        assert!(Mode::new(vec![0.0; 3]).is_none());
        assert!(Mode::new(vec![f64::NAN, 1.0]).is_none());
        assert!(Mode::new(vec![f64::INFINITY, 1.0]).is_none());
    }

    /// Target: that of a mode of entries near 1.
    #[test]
    fn the_size_of_the_mode_does_not_matter() {
        for size in [1e-200, -1e-200, 1.0, 1e200, -1e200, 1e-310] {
            let mode = Mode::new(vec![0.0, -size, 0.5 * size]).unwrap();
            let increment = [0.0, -3.0, 1.5].map(|d| d * size.signum());
            let border = mode.linearise(&increment, 0.0, &mut [0.0; 3]);
            assert!((border.value - 3.0).abs() < 1e-12, "{size}: {border:?}");
        }
    }
}
