//! One random path of an element, with every demand made on a step.

use nalgebra::DMatrix;

use super::difference::{Differences, Verdict, norm, ratio};
use super::failure::{CheckFailure, Place, equal, finite};
use super::rigid::Motion;
use super::settings::ElementCheck;
use crate::element::{Element, ElementSystem, EvaluationContext};
use crate::material::Operator;

/// Share of the norm of a matrix by which another order of its sums may differ.
const ROUNDING: f64 = 1e-13;

/// Share of the largest eigenvalue that rounding may leave where a rigid motion has none.
const NO_EIGENVALUE: f64 = 1e-9;

/// Share of the largest force by which the state just written may change it.
const DRIFT: f64 = 1e-10;

/// An element on one path.
#[derive(Debug)]
pub(super) struct Drive<'a> {
    element: &'a dyn Element,
    check: &'a ElementCheck,
    pub(super) place: Place,
    pub(super) base: Vec<f64>,
    /// Norm of the stiffness of the virgin state.
    stiffness: f64,
    /// Largest force so far.
    force: f64,
    n: usize,
}

/// Force, full stiffness and new state.
#[derive(Debug)]
pub(super) struct Answer {
    force: Vec<f64>,
    stiffness: Vec<f64>,
    pub(super) state: Vec<f64>,
}

impl<'a> Drive<'a> {
    pub(super) fn start(
        element: &'a dyn Element,
        check: &'a ElementCheck,
        path: usize,
        n: usize,
    ) -> Result<Self, CheckFailure> {
        let mut drive = Self {
            element,
            check,
            place: Place { path, step: 0 },
            base: vec![f64::NAN; element.state_len()],
            stiffness: 0.0,
            force: 0.0,
            n,
        };
        element.init_state(&mut drive.base);
        finite(drive.place, &drive.base, state_label)?;
        let virgin = drive.evaluate(&vec![0.0; n], Operator::Tangent, f64::NAN)?;
        finite(drive.place, &virgin.stiffness, |_| {
            "virgin stiffness".to_owned()
        })?;
        drive.stiffness = norm(&virgin.stiffness);
        Ok(drive)
    }

    /// One evaluation; `trial` holds `junk` before.
    fn evaluate(&self, u: &[f64], operator: Operator, junk: f64) -> Result<Answer, CheckFailure> {
        let ctx = EvaluationContext {
            relaxation: self.check.relaxation,
            ..EvaluationContext::new(operator)
        };
        self.evaluate_in(u, &ctx, junk)
    }

    fn evaluate_in(
        &self,
        u: &[f64],
        ctx: &EvaluationContext,
        junk: f64,
    ) -> Result<Answer, CheckFailure> {
        let (n, operator) = (self.n, ctx.operator);
        let entries = if operator == Operator::None { 0 } else { n * n };
        let mut answer = Answer {
            force: vec![0.0; n],
            stiffness: vec![0.0; entries],
            state: vec![junk; self.base.len()],
        };
        let out = ElementSystem {
            force: &mut answer.force,
            stiffness: &mut answer.stiffness,
        };
        self.element
            .evaluate(u, &self.base, &mut answer.state, ctx, out)
            .map_err(|source| CheckFailure::element(self.place, source))?;
        if !answer.stiffness.is_empty() && !self.element.unsymmetric() {
            for i in 0..n {
                for j in i + 1..n {
                    answer.stiffness[j * n + i] = answer.stiffness[i * n + j];
                }
            }
        }
        Ok(answer)
    }

    /// Takes what the step latches into the base state.
    pub(super) fn latch(&mut self, answer: &Answer) {
        self.element.latch(&answer.state, &mut self.base);
    }

    /// The state just written, from which the element goes on, gives the same force again.
    pub(super) fn settle(&mut self, u: &[f64], answer: Answer) -> Result<(), CheckFailure> {
        self.base = answer.state;
        // What is relaxed goes on with time.
        if self.check.relaxation < 1.0 {
            return Ok(());
        }
        let again = self.evaluate(u, Operator::None, f64::NAN)?.force;
        let largest = answer.force.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        self.force = self.force.max(largest);
        let limit = DRIFT * self.force;
        let pairs = answer.force.iter().zip(&again).enumerate();
        for (i, (&first, &second)) in pairs {
            if second.is_nan() || (first - second).abs() > limit {
                return Err(CheckFailure::ForceDrift {
                    place: self.place,
                    component: self.label(i),
                    first,
                    second,
                    limit,
                });
            }
        }
        Ok(())
    }

    /// The secant operator, of which the upper triangle counts, has no negative eigenvalue.
    pub(super) fn secant(&self, u: &[f64]) -> Result<(), CheckFailure> {
        let stiffness = self.evaluate(u, Operator::Secant, f64::NAN)?.stiffness;
        let label = |k| format!("secant operator ({}, {})", k / self.n, k % self.n);
        finite(self.place, &stiffness, label)?;
        let eigenvalues = DMatrix::from_fn(self.n, self.n, |i, j| {
            stiffness[i.min(j) * self.n + i.max(j)]
        })
        .symmetric_eigenvalues();
        let (least, largest) = (eigenvalues.min(), eigenvalues.amax());
        if least < -NO_EIGENVALUE * largest {
            return Err(CheckFailure::SecantNegative {
                place: self.place,
                least,
                largest,
            });
        }
        Ok(())
    }

    /// Largest force of a motion of the virgin element, relative to stiffness times displacement; none of one that moves no
    /// node, as turning a bar about its axis does.
    pub(super) fn rigid(&self, motion: &Motion) -> Result<f64, CheckFailure> {
        let largest = motion.values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if largest == 0.0 {
            return Ok(0.0);
        }
        let scale = self.check.amplitude[0] / largest;
        let u: Vec<f64> = motion.values.iter().map(|v| scale * v).collect();
        let force = self.evaluate(&u, Operator::None, f64::NAN)?.force;
        let unit = self.stiffness * self.check.amplitude[0];
        let limit = self.check.rigid_tolerance * unit;
        let mut worst = 0.0_f64;
        for (i, &f) in force.iter().enumerate() {
            if f.is_nan() || f.abs() > limit {
                return Err(CheckFailure::RigidBody {
                    motion: motion.name,
                    component: self.label(i),
                    force: f,
                    limit,
                });
            }
            worst = worst.max(ratio(f.abs(), unit));
        }
        Ok(worst)
    }

    /// The answer with the stiffness: finite, and the same again with other junk and forces only.
    pub(super) fn repeatable(&self, u: &[f64], junk: f64) -> Result<Answer, CheckFailure> {
        let force_label = |i| format!("force {}", self.label(i));
        let stiffness_label = |k| format!("stiffness ({}, {})", k / self.n, k % self.n);
        let first = self.evaluate(u, Operator::Tangent, f64::NAN)?;
        finite(self.place, &first.state, state_label)?;
        finite(self.place, &first.force, force_label)?;
        finite(self.place, &first.stiffness, stiffness_label)?;
        let second = self.evaluate(u, Operator::Tangent, junk)?;
        let between = "with other numbers in the trial state before the evaluation";
        equal(
            self.place,
            &first.stiffness,
            &second.stiffness,
            between,
            stiffness_label,
        )?;
        let without = self.evaluate(u, Operator::None, f64::NAN)?;
        for (other, between) in [
            (second, between),
            (without, "asked for without a stiffness"),
        ] {
            equal(self.place, &first.force, &other.force, between, force_label)?;
            equal(self.place, &first.state, &other.state, between, state_label)?;
        }
        if self.element.unsymmetric() && self.element.fills_symmetric_part() {
            self.symmetric_part(u, &first)?;
        }
        Ok(first)
    }

    /// The symmetric part asked for is that of the stiffness.
    fn symmetric_part(&self, u: &[f64], whole: &Answer) -> Result<(), CheckFailure> {
        let ctx = EvaluationContext {
            relaxation: self.check.relaxation,
            symmetric_part: true,
            ..EvaluationContext::new(Operator::Tangent)
        };
        let part = self.evaluate_in(u, &ctx, f64::NAN)?.stiffness;
        let limit = ROUNDING * norm(&whole.stiffness);
        for row in 0..self.n {
            for column in row..self.n {
                let [ij, ji] = [row * self.n + column, column * self.n + row];
                let expected = whole.stiffness[ij].midpoint(whole.stiffness[ji]);
                let given = part[ij];
                if given.is_nan() || (given - expected).abs() > limit {
                    return Err(CheckFailure::SymmetricPart {
                        place: self.place,
                        row,
                        column,
                        given,
                        expected,
                    });
                }
            }
        }
        Ok(())
    }

    /// Resultant of the nodal forces conjugate to a motion, relative to the sum of its terms.
    pub(super) fn balance(&self, motion: &Motion, answer: &Answer) -> Result<f64, CheckFailure> {
        let terms = answer.force.iter().zip(&motion.values).map(|(f, m)| f * m);
        let scale: f64 = terms.clone().map(f64::abs).sum();
        let value: f64 = terms.sum();
        let limit = self.check.balance_tolerance * scale;
        if value.abs() > limit {
            return Err(CheckFailure::Unbalanced {
                place: self.place,
                resultant: motion.resultant,
                value,
                limit,
            });
        }
        Ok(ratio(value.abs(), scale))
    }

    /// Worst relative disagreement of the stiffness; `None` at a kink.
    pub(super) fn tangent(
        &self,
        u: &[f64],
        answer: &Answer,
        differences: &mut Differences,
    ) -> Result<Option<f64>, CheckFailure> {
        let scale = self.stiffness.max(norm(&answer.stiffness));
        let limit = self.check.tangent_tolerance * scale;
        let verdict = differences.compare(
            u,
            &answer.force,
            limit,
            |i, j| answer.stiffness[i * self.n + j],
            |x, out| {
                out.copy_from_slice(&self.evaluate(x, Operator::None, f64::NAN)?.force);
                Ok(())
            },
        )?;
        match verdict {
            Verdict::Agrees(worst) => Ok(Some(ratio(worst, scale))),
            Verdict::Kink => Ok(None),
            Verdict::Wrong(d) => Err(CheckFailure::Tangent {
                place: self.place,
                row: format!("force {}", self.label(d.row)),
                column: self.label(d.column),
                given: d.given,
                difference: d.difference,
                limit,
            }),
        }
    }

    /// DOF and node of a component.
    fn label(&self, i: usize) -> String {
        let dofs = self.element.dofs();
        format!("{} of node {}", dofs[i % dofs.len()], i / dofs.len())
    }
}

fn state_label(i: usize) -> String {
    format!("state variable {i}")
}
