//! Comparison of a tangent with finite differences of the function it belongs to.

/// A tangent entry that disagrees with differences.
#[derive(Debug, Clone, Copy)]
pub(super) struct Disagreement {
    pub(super) row: usize,
    pub(super) column: usize,
    pub(super) given: f64,
    pub(super) difference: f64,
}

impl Disagreement {
    const fn size(&self) -> f64 {
        (self.given - self.difference).abs()
    }
}

/// Verdict on a tangent.
#[derive(Debug, Clone, Copy)]
pub(super) enum Verdict {
    /// Every column agrees within the tolerance; the largest disagreement.
    Agrees(f64),
    /// Some columns disagree, but by less than their one-sided differences do: a kink.
    Kink,
    /// A column disagrees without that excuse.
    Wrong(Disagreement),
}

/// Share of a step at which columns that disagree are looked at again.
const SHORTER: f64 = 0.125;

/// Differences of a function of `n` variables with `n` values.
#[derive(Debug)]
pub(super) struct Differences {
    x: Vec<f64>,
    up: Vec<f64>,
    down: Vec<f64>,
    /// Disagreement of the one-sided differences, by row.
    jumps: Vec<f64>,
    /// Step of each variable.
    steps: Vec<f64>,
}

impl Differences {
    /// Steps of `factor` times the amplitude of each variable; a short list of amplitudes is repeated.
    pub(super) fn new(n: usize, amplitude: &[f64], factor: f64) -> Self {
        Self {
            x: vec![0.0; n],
            up: vec![0.0; n],
            down: vec![0.0; n],
            jumps: vec![0.0; n],
            steps: (0..n)
                .map(|j| factor * amplitude[j % amplitude.len()])
                .collect(),
        }
    }

    /// Compares the tangent `entry(i, j)` at `x`, where the function has the values `f`, with central
    /// differences, and the columns that disagree with those of a shorter step.
    ///
    /// # Errors
    ///
    /// What `function` returns.
    pub(super) fn compare<E>(
        &mut self,
        x: &[f64],
        f: &[f64],
        tolerance: f64,
        entry: impl Fn(usize, usize) -> f64,
        mut function: impl FnMut(&[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<Verdict, E> {
        let mut worst = 0.0_f64;
        let mut kink = false;
        for column in 0..x.len() {
            let h = self.steps[column];
            let given = |i| entry(i, column);
            let mut miss = self.column(x, f, (column, h), given, &mut function)?;
            let mut jump = 0.0;
            if miss.size() > tolerance {
                let wide = self.jumps.clone();
                miss = self.column(x, f, (column, SHORTER * h), given, &mut function)?;
                jump = self.jumps.iter().fold(0.0_f64, |most, j| most.max(j.abs()));
                // Curvature, in proportion to the step, can hide a kink.
                let kink = (self.jumps[miss.row] - SHORTER * wide[miss.row]) / (1.0 - SHORTER);
                jump = jump.max(kink.abs());
            }
            if miss.size() <= tolerance {
                worst = worst.max(miss.size());
            } else if jump >= miss.size() {
                kink = true;
            } else {
                return Ok(Verdict::Wrong(miss));
            }
        }
        Ok(if kink {
            Verdict::Kink
        } else {
            Verdict::Agrees(worst)
        })
    }

    /// Largest disagreement of one column with central differences of step `h`; keeps how far the one-sided differences
    /// disagree with one another.
    fn column<E>(
        &mut self,
        x: &[f64],
        f: &[f64],
        (column, h): (usize, f64),
        given: impl Fn(usize) -> f64,
        function: &mut impl FnMut(&[f64], &mut [f64]) -> Result<(), E>,
    ) -> Result<Disagreement, E> {
        self.x.copy_from_slice(x);
        self.x[column] = x[column] + h;
        let above = self.x[column] - x[column];
        function(&self.x, &mut self.up)?;
        self.x[column] = x[column] - h;
        let below = x[column] - self.x[column];
        function(&self.x, &mut self.down)?;
        let central = |i: usize| Disagreement {
            row: i,
            column,
            given: given(i),
            difference: (self.up[i] - self.down[i]) / (above + below),
        };
        let mut worst = central(0);
        for i in 0..f.len() {
            let (forward, backward) = ((self.up[i] - f[i]) / above, (f[i] - self.down[i]) / below);
            self.jumps[i] = forward - backward;
            let here = central(i);
            if here.size().is_nan() || here.size() > worst.size() {
                worst = here;
            }
        }
        Ok(worst)
    }
}

/// Euclidean norm of a vector, Frobenius norm of a matrix.
pub(super) fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// a/b, and 0 where both vanish.
pub(super) fn ratio(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a / b }
}

#[cfg(test)]
mod tests {
    //! Protects the verdicts: right, wrong, and at a kink.
    use super::*;

    fn verdict(f: fn(f64) -> f64, x: f64, slope: f64) -> Verdict {
        Differences::new(1, &[1.0], 1e-5)
            .compare(
                &[x],
                &[f(x)],
                1e-6,
                |_, _| slope,
                |x, out| {
                    out[0] = f(x[0]);
                    Ok::<(), ()>(())
                },
            )
            .unwrap()
    }

    #[test]
    fn tells_a_wrong_slope_from_a_kink() {
        assert!(matches!(
            verdict(f64::sin, 0.3, 0.3_f64.cos()),
            Verdict::Agrees(_)
        ));
        assert!(matches!(
            verdict(f64::sin, 0.3, 1.01 * 0.3_f64.cos()),
            Verdict::Wrong(_)
        ));
        assert!(matches!(verdict(f64::abs, 0.0, 1.0), Verdict::Kink));
        assert!(matches!(verdict(f64::abs, 0.0, 5.0), Verdict::Wrong(_)));
        let curved = |x: f64| x.abs() - 6e5 * x * x;
        assert!(matches!(verdict(curved, 0.0, 1.0), Verdict::Kink));
        // A kink within the first step but outside the second is no obstacle.
        assert!(matches!(verdict(f64::abs, 5e-6, 1.0), Verdict::Agrees(_)));
        assert!(matches!(
            verdict(f64::sin, 0.3, f64::NAN),
            Verdict::Wrong(_)
        ));
    }
}
