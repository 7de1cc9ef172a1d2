//! Elements that answer with a constant stiffness.

use fe_core::element::{Element, ElementError, ElementSystem, EvaluationContext};
use fe_core::material::Operator;
use pulp::{Arch, Simd, WithSimd};

use crate::seen::{Seen, View};

/// An element of linear laws, whose stiffness is formed once: f = K u, free energy u . K u/2.
///
/// Plates, layers of adhesive and sheets need no integration in every evaluation. What is sampled comes from the element
/// itself.
pub type Linear = Seen<Constant>;

/// The stiffness (N/mm) of a [`Linear`] element, symmetric, row-major.
#[derive(Debug)]
pub struct Constant(Vec<f64>);

/// Relative difference that rounding makes between f and K u.
const ROUNDING: f64 = 1e-9;

impl Linear {
    /// The element with its stiffness.
    ///
    /// # Errors
    ///
    /// [`ElementError::Input`] for an element that has a history or is found not to be linear and symmetric, or its own
    /// error.
    pub fn new(element: Box<dyn Element>) -> Result<Self, ElementError> {
        let n = element.nodes().len() * element.dofs().len();
        let refuse = |what: &str, value: f64, allowed: &str| ElementError::Input {
            what: what.into(),
            value,
            allowed: allowed.into(),
            remedy: "use the element as it is".into(),
        };
        let variables = element.state_len();
        if variables > 0 {
            return Err(refuse("history of a linear element", variables as f64, "0"));
        }
        if element.unsymmetric() {
            return Err(refuse(
                "unsymmetric stiffness of a linear element",
                1.0,
                "0",
            ));
        }
        let mut stiffness = vec![0.0; n * n];
        let mut force = vec![0.0; n];
        let ctx = EvaluationContext::new(Operator::Tangent);
        let out = ElementSystem {
            force: &mut force,
            stiffness: &mut stiffness,
        };
        element.evaluate(&vec![0.0; n], &[], &mut [], &ctx, out)?;
        for i in 0..n {
            for j in 0..i {
                stiffness[i * n + j] = stiffness[j * n + i];
            }
        }
        let view = Constant(stiffness);
        // Displacements of no particular shape.
        let u: Vec<f64> = (0..n).map(|i| 1e-3 * (1.0 + i as f64).sin()).collect();
        let mut own = vec![0.0; n];
        let ctx = EvaluationContext::new(Operator::None);
        let out = ElementSystem {
            force: &mut own,
            stiffness: &mut [],
        };
        element.evaluate(&u, &[], &mut [], &ctx, out)?;
        let mut expected = force.clone();
        view.add_force(&u, &mut expected);
        let largest = own.iter().fold(0.0_f64, |a, f| a.max(f.abs()));
        let misses = own.iter().zip(&expected).map(|(a, b)| (a - b).abs());
        // What is no number is the worst.
        let worse = |a: f64, b: f64| if a >= b { a } else { b };
        let worst = force.iter().map(|f| f.abs()).chain(misses).fold(0.0, worse);
        if let Some(bad) = view.0.iter().find(|k| !k.is_finite()) {
            let what = "stiffness of a linear element (N/mm)";
            return Err(refuse(what, *bad, "finite numbers"));
        }
        if worst.is_nan() || worst > ROUNDING * largest {
            return Err(refuse(
                "force of a linear element beside K u (N)",
                worst,
                "0",
            ));
        }
        Ok(Self { element, view })
    }
}

impl Constant {
    /// Adds K u.
    fn add_force(&self, u: &[f64], force: &mut [f64]) {
        let stiffness = &self.0;
        Arch::new().dispatch(Product {
            stiffness,
            u,
            force,
        });
    }
}

/// f + K u by columns, compiled for the vector unit found at run time.
struct Product<'a> {
    stiffness: &'a [f64],
    u: &'a [f64],
    force: &'a mut [f64],
}

impl WithSimd for Product<'_> {
    type Output = ();

    // Inlining is what compiles the body for the vector unit of the caller.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for (column, u) in self.stiffness.chunks_exact(self.u.len()).zip(self.u) {
            for (f, k) in self.force.iter_mut().zip(column) {
                *f += k * u;
            }
        }
    }
}

impl View for Constant {
    fn evaluate(
        &self,
        element: &dyn Element,
        u: &[f64],
        (committed, trial): (&[f64], &mut [f64]),
        ctx: &EvaluationContext,
        out: ElementSystem<'_>,
    ) -> Result<(), ElementError> {
        if u.iter().any(|u| !u.is_finite()) {
            return element.evaluate(u, committed, trial, ctx, out);
        }
        self.add_force(u, out.force);
        if ctx.operator != Operator::None {
            for (out, k) in out.stiffness.iter_mut().zip(&self.0) {
                *out += k;
            }
        }
        Ok(())
    }

    fn free_energy(
        &self,
        _: &dyn Element,
        u: &[f64],
        _: &[f64],
    ) -> Result<Option<f64>, ElementError> {
        let mut force = vec![0.0; u.len()];
        self.add_force(u, &mut force);
        let twice: f64 = u.iter().zip(force).map(|(u, f)| u * f).sum();
        Ok(Some(0.5 * twice))
    }
}
