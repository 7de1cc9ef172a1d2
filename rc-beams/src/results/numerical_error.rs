//! How far the peak moves when the same beam is stepped and meshed more finely: the numerical error beside an answer.

use serde::Serialize;

/// The same beam stepped and meshed more finely.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NumericalError {
    /// Largest change of the peak, relative to it.
    pub largest_change: f64,
    /// With steps half as long.
    pub half_steps: Variation,
    /// Peak load extrapolated to steps of no length, 2 P(h/2) - P(h) (Richardson 1911, first order) (kN); an estimate only
    /// where both runs follow one branch.
    pub extrapolated_peak_load_kn: f64,
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
}

impl Variation {
    fn new(peak_kn: f64, varied_kn: f64) -> Self {
        Self {
            peak_load_kn: varied_kn,
            change: (varied_kn - peak_kn) / peak_kn,
        }
    }
}

impl NumericalError {
    /// Compares the peak (kN) with that of half the steps and of a finer `mesh`.
    pub fn new(peak_kn: f64, halved_kn: f64, (finer_kn, mesh): (f64, String)) -> Self {
        let half_steps = Variation::new(peak_kn, halved_kn);
        let finer_mesh = Variation::new(peak_kn, finer_kn);
        Self {
            largest_change: half_steps.change.abs().max(finer_mesh.change.abs()),
            half_steps,
            extrapolated_peak_load_kn: 2.0 * halved_kn - peak_kn,
            finer_mesh,
            mesh,
        }
    }

    /// What the line of a beam says.
    pub fn line(&self) -> String {
        let (steps, mesh) = (&self.half_steps, &self.finer_mesh);
        format!(
            "+-{:.1} % (half the steps {:.1} kN, {:+.1} %; mesh {} {:.1} kN, {:+.1} %)",
            100.0 * self.largest_change,
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
    fn the_larger_change_counts_whatever_its_sign() {
        let error = NumericalError::new(200.0, 202.0, (190.0, "90x6x1".into()));
        assert!((error.half_steps.change - 0.01).abs() < 1e-15);
        assert!((error.finer_mesh.change + 0.05).abs() < 1e-15);
        assert!((error.largest_change - 0.05).abs() < 1e-15);
        assert!((error.extrapolated_peak_load_kn - 204.0).abs() < 1e-12);
        assert_eq!(
            error.line(),
            "+-5.0 % (half the steps 202.0 kN, +1.0 %; mesh 90x6x1 190.0 kN, -5.0 %)"
        );
    }
}
