//! How far the peak moves when the same beam is stepped and meshed more finely: the numerical error beside an answer.

use serde::Serialize;

/// What peaks move by as cracks fall otherwise, on another mesh or another branch, and which the finer mesh of one beam can
/// miss by chance: about twice the root mean square of its changes in the beams whose trust is not low, 3.6 to 4.4 % as laws
/// and paths changed (`docs/accuracy.md`).
pub const CHANCE: f64 = 0.08;
/// Elements of the finer mesh along and up over those of the mesh.
pub const REFINEMENT: f64 = 1.5;

/// The same beam stepped and meshed more finely.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NumericalError {
    /// Error bar of the peak, relative to it: the larger of the distances to the extrapolated peaks, no less than
    /// [`CHANCE`].
    pub error_bar: f64,
    /// With steps half as long.
    pub half_steps: Variation,
    /// With the finer mesh.
    pub finer_mesh: Variation,
    /// Elements of the finer mesh along, up and across.
    pub mesh: String,
}

/// The peak of one variation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Variation {
    /// Peak load (kN).
    pub peak_load_kn: f64,
    /// Its change relative to the peak.
    pub change: f64,
    /// Peak load extrapolated to steps or elements of no size, P + (P' - P) r/(r - 1) for sizes r times smaller
    /// (Richardson 1911, first order) (kN); an estimate only where both runs follow one branch.
    pub extrapolated_peak_load_kn: f64,
}

impl Variation {
    fn new(peak_kn: f64, varied_kn: f64, ratio: f64) -> Self {
        let change = varied_kn - peak_kn;
        Self {
            peak_load_kn: varied_kn,
            change: change / peak_kn,
            extrapolated_peak_load_kn: peak_kn + change * ratio / (ratio - 1.0),
        }
    }
}

impl NumericalError {
    /// Compares the peak (kN) with that of half the steps and of a finer `mesh`.
    pub fn new(peak_kn: f64, halved_kn: f64, (finer_kn, mesh): (f64, String)) -> Self {
        let half_steps = Variation::new(peak_kn, halved_kn, 2.0);
        let finer_mesh = Variation::new(peak_kn, finer_kn, REFINEMENT);
        let far = |v: Variation| (v.extrapolated_peak_load_kn / peak_kn - 1.0).abs();
        Self {
            error_bar: far(half_steps).max(far(finer_mesh)).max(CHANCE),
            half_steps,
            finer_mesh,
            mesh,
        }
    }

    /// What the line of a beam says.
    pub fn line(&self) -> String {
        let (steps, mesh) = (&self.half_steps, &self.finer_mesh);
        format!(
            "+-{:.0} % (half the steps {:.1} kN, {:+.1} %; mesh {} {:.1} kN, {:+.1} %)",
            100.0 * self.error_bar,
            steps.peak_load_kn,
            100.0 * steps.change,
            self.mesh,
            mesh.peak_load_kn,
            100.0 * mesh.change,
        )
    }
}

#[cfg(test)]
mod tests {
    //! Protects the arithmetic of the numerical error.
    use super::*;

    #[test]
    fn the_bar_reaches_the_farther_extrapolated_peak() {
        let error = NumericalError::new(200.0, 202.0, (190.0, "90x6x1".into()));
        let (steps, mesh) = (error.half_steps, error.finer_mesh);
        assert!((steps.change - 0.01).abs() < 1e-15);
        assert!((mesh.change + 0.05).abs() < 1e-15);
        assert!((steps.extrapolated_peak_load_kn - 204.0).abs() < 1e-12);
        assert!((mesh.extrapolated_peak_load_kn - 170.0).abs() < 1e-12);
        assert!((error.error_bar - 0.15).abs() < 1e-15);
        assert_eq!(
            error.line(),
            "+-15 % (half the steps 202.0 kN, +1.0 %; mesh 90x6x1 190.0 kN, -5.0 %)"
        );
        let steps = NumericalError::new(200.0, 210.0, (201.0, String::new()));
        assert!((steps.error_bar - 0.10).abs() < 1e-15);
    }

    #[test]
    fn no_bar_is_shorter_than_chance() {
        let error = NumericalError::new(200.0, 200.0, (201.0, String::new()));
        assert_eq!(error.error_bar, CHANCE);
    }
}
