//! Safeguarded Newton iteration on one unknown.

use fe_core::material::MaterialError;
use nalgebra::Matrix6;

/// Iterations after which a root counts as not found; bisection alone needs about 60.
const MAX_ITERATIONS: usize = 200;

/// The last iterate of a search that failed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NotConverged {
    /// Residual in the unit of the search.
    pub(crate) residual: f64,
    pub(crate) iterations: usize,
}

impl NotConverged {
    /// The error of a law; `unit` makes the residual relative.
    pub(crate) fn of(self, law: &'static str, unit: f64) -> MaterialError {
        MaterialError::Return {
            law,
            residual: self.residual / unit,
            iterations: self.iterations,
        }
    }
}

/// Refuses a tangent that is no number: strains from about 1e10 on leave nothing of the strength but rounding.
pub(crate) fn is_number(law: &'static str, tangent: &Matrix6<f64>) -> Result<(), MaterialError> {
    if tangent.iter().all(|d| d.is_finite()) {
        return Ok(());
    }
    let failure = NotConverged {
        residual: f64::NAN,
        iterations: 0,
    };
    Err(failure.of(law, 1.0))
}

/// A root of f, which is continuous with f(low) >= 0 >= f(high), where |f| <= `tolerance` or the bracket
/// has shrunk to rounding. The last call of `f` is at that root.
///
/// `f` returns value and derivative. A Newton step that leaves the bracket, or that did not halve |f|, is
/// replaced by bisection.
pub(crate) fn bracketed_root(
    (mut low, mut high): (f64, f64),
    start: f64,
    tolerance: f64,
    mut f: impl FnMut(f64) -> Result<(f64, f64), NotConverged>,
) -> Result<f64, NotConverged> {
    let mut x = start.max(low).min(high);
    let mut previous = f64::INFINITY;
    let mut residual = f64::NAN;
    for _ in 0..MAX_ITERATIONS {
        let (value, slope) = f(x)?;
        residual = value;
        if value.abs() <= tolerance || high - low <= 2.0 * f64::EPSILON * high.abs() {
            return Ok(x);
        }
        if value > 0.0 {
            low = x;
        } else if value < 0.0 {
            high = x;
        } else {
            break;
        }
        let newton = x - value / slope;
        let inside = newton > low && newton < high;
        x = if inside && value.abs() <= 0.5 * previous {
            newton
        } else {
            low.midpoint(high)
        };
        previous = value.abs();
    }
    Err(NotConverged {
        residual,
        iterations: MAX_ITERATIONS,
    })
}

#[cfg(test)]
mod tests {
    //! Protects the convergence of every return mapping.
    use super::bracketed_root;

    #[test]
    fn smooth_kinked_and_steep_functions() {
        let root = |f: fn(f64) -> (f64, f64), start| {
            bracketed_root((0.0, 10.0), start, 1e-13, |x| Ok(f(x))).unwrap()
        };
        assert!((root(|x| (2.0 - x * x, -2.0 * x), 10.0) - 2.0_f64.sqrt()).abs() < 1e-13);
        // Zero slope at the start, and a kink.
        assert!((root(|x| (2.0 - x * x, -2.0 * x), 0.0) - 2.0_f64.sqrt()).abs() < 1e-13);
        let kink = |x: f64| if x < 1.0 { (1.0, 0.0) } else { (2.0 - x, -1.0) };
        assert!((root(kink, 0.5) - 2.0).abs() < 1e-13);
        // Infinite slope at the root.
        let steep = |x: f64| ((3.0 - x).cbrt(), -1.0 / (3.0 * (3.0 - x).cbrt().powi(2)));
        assert!((root(steep, 9.0) - 3.0).abs() < 1e-13);
        assert!(bracketed_root((0.0, 1.0), 0.5, 0.0, |_| Ok((f64::NAN, 0.0))).is_err());
    }
}
