//! One random path of a law, with every demand made on a step.

use super::difference::{Differences, Verdict, norm, ratio};
use super::failure::{CheckFailure, Place, equal, finite};
use super::random::Random;
use super::settings::{MaterialCheck, MaterialReport};
use crate::kinematics::Kinematics;
use crate::material::{Material, Operator, Response, state_labels};

/// A law, its history, and the scales that tolerances refer to.
#[derive(Debug)]
pub(super) struct Walk<'a, K: Kinematics> {
    pub(super) law: &'a dyn Material<K>,
    pub(super) check: &'a MaterialCheck,
    pub(super) place: Place,
    random: Random,
    differences: Differences,
    pub(super) strain: K::Vector,
    pub(super) committed: Vec<f64>,
    /// Norm of the tangent of the virgin state.
    stiffness: f64,
    /// Largest stress so far.
    stress: f64,
}

/// An answer with the state that was written beside it.
#[derive(Debug)]
pub(super) struct Answer<K: Kinematics> {
    pub(super) response: Response<K>,
    pub(super) state: Vec<f64>,
}

impl<'a, K: Kinematics> Walk<'a, K> {
    /// The virgin law at zero strain.
    pub(super) fn start(
        law: &'a dyn Material<K>,
        check: &'a MaterialCheck,
        path: usize,
    ) -> Result<Self, CheckFailure> {
        let mut walk = Self {
            law,
            check,
            place: Place { path, step: 0 },
            random: Random::new(check.seed ^ path as u64),
            differences: Differences::new(K::LEN, &check.amplitude, check.difference_step),
            strain: K::vector(&vec![0.0; K::LEN]),
            committed: vec![f64::NAN; law.state_len()],
            stiffness: 0.0,
            stress: 0.0,
        };
        law.init_state(&mut walk.committed);
        finite(walk.place, &walk.committed, |i| walk.state_label(i))?;
        let virgin = walk.update(&walk.strain, Operator::Tangent, &walk.committed, f64::NAN)?;
        let tangent = entries::<K>(&virgin.response.tangent);
        finite(walk.place, &tangent, |_| "virgin tangent".to_owned())?;
        walk.stiffness = norm(&tangent);
        Ok(walk)
    }

    /// Checks the update to `strain` and takes it.
    pub(super) fn step(
        &mut self,
        step: usize,
        strain: &K::Vector,
        report: &mut MaterialReport,
    ) -> Result<(), CheckFailure> {
        self.place.step = step;
        let answer = self.repeatable(strain)?;
        self.together(strain)?;
        let largest = K::components(&answer.response.stress)
            .iter()
            .fold(0.0_f64, |m, s| m.max(s.abs()));
        self.stress = self.stress.max(largest);
        report.steps += 1;
        let again = self.update(strain, Operator::None, &answer.state, f64::NAN)?;
        let drift = self.drift(&answer, &again, "from the state just written")?;
        report.worst_drift = report.worst_drift.max(drift);
        report.least_pivot = report.least_pivot.min(self.secant(strain, &answer)?);
        let mut base = self.committed.clone();
        self.law.latch(&answer.state, &mut base);
        let latched = self.update(strain, Operator::Tangent, &base, f64::NAN)?;
        self.drift(&answer, &latched, "after what the step latches")?;
        match self.tangent(strain, &base, &latched)? {
            Some(error) => report.worst_tangent = report.worst_tangent.max(error),
            None => report.kinks += 1,
        }
        if let Some(dissipation) = self.dissipation(strain, &answer)? {
            let least = report.least_dissipation.unwrap_or(f64::INFINITY);
            report.least_dissipation = Some(least.min(dissipation));
        }
        self.strain = *strain;
        self.committed = answer.state;
        Ok(())
    }

    /// One update; `trial` holds `junk` before.
    pub(super) fn update(
        &self,
        strain: &K::Vector,
        operator: Operator,
        committed: &[f64],
        junk: f64,
    ) -> Result<Answer<K>, CheckFailure> {
        let mut state = vec![junk; committed.len()];
        let ctx = self.check.context.with_operator(operator);
        match self.law.update(strain, committed, &mut state, &ctx) {
            Ok(response) => Ok(Answer { response, state }),
            Err(source) => Err(CheckFailure::material(self.place, source)),
        }
    }

    /// The answer with the tangent: finite, and the same again with other junk and without operator.
    fn repeatable(&mut self, strain: &K::Vector) -> Result<Answer<K>, CheckFailure> {
        let first = self.update(strain, Operator::Tangent, &self.committed, f64::NAN)?;
        let tangent = entries::<K>(&first.response.tangent);
        finite(self.place, &first.state, |i| self.state_label(i))?;
        finite(
            self.place,
            K::components(&first.response.stress),
            stress_label::<K>,
        )?;
        finite(self.place, &tangent, tangent_label::<K>)?;
        let junk = self.random.uniform(-1e3, 1e3);
        let second = self.update(strain, Operator::Tangent, &self.committed, junk)?;
        let between = "with other numbers in the trial state before the update";
        self.same(&first, &second, between)?;
        let again = entries::<K>(&second.response.tangent);
        equal(self.place, &tangent, &again, between, tangent_label::<K>)?;
        let without = self.update(strain, Operator::None, &self.committed, f64::NAN)?;
        self.same(&first, &without, "asked for without an operator")?;
        Ok(first)
    }

    /// Relative change of stress from one answer at a strain to another.
    fn drift(
        &self,
        answer: &Answer<K>,
        again: &Answer<K>,
        between: &'static str,
    ) -> Result<f64, CheckFailure> {
        let stress = K::components(&answer.response.stress);
        let limit = self.check.drift_tolerance * self.stress;
        let mut worst = 0.0_f64;
        for (i, (&first, &second)) in stress
            .iter()
            .zip(K::components(&again.response.stress))
            .enumerate()
        {
            let change = (first - second).abs();
            if change.is_nan() || change > limit {
                return Err(CheckFailure::Drift {
                    place: self.place,
                    component: K::STRESS_LABELS[i],
                    first,
                    second,
                    between,
                    limit,
                });
            }
            worst = worst.max(change);
        }
        Ok(ratio(worst, self.stress))
    }

    /// Smallest pivot of the secant operator, relative to the virgin stiffness.
    fn secant(&self, strain: &K::Vector, answer: &Answer<K>) -> Result<f64, CheckFailure> {
        let secant = self.update(strain, Operator::Secant, &self.committed, f64::NAN)?;
        self.same(answer, &secant, "asked for with the secant operator")?;
        let mut matrix = entries::<K>(&secant.response.tangent);
        finite(self.place, &matrix, tangent_label::<K>)?;
        self.symmetric("secant operator", &matrix, 1e-12 * norm(&matrix))?;
        let n = K::LEN;
        let mut least = f64::INFINITY;
        for index in 0..n {
            let pivot = matrix[index * n + index];
            if pivot.is_nan() || pivot <= 0.0 {
                return Err(CheckFailure::SecantIndefinite {
                    place: self.place,
                    index,
                    pivot,
                });
            }
            least = least.min(pivot);
            for i in index + 1..n {
                let factor = matrix[i * n + index] / pivot;
                for j in index + 1..n {
                    matrix[i * n + j] -= factor * matrix[index * n + j];
                }
            }
        }
        Ok(ratio(least, self.stiffness))
    }

    fn symmetric(
        &self,
        operator: &'static str,
        matrix: &[f64],
        limit: f64,
    ) -> Result<(), CheckFailure> {
        let n = K::LEN;
        for row in 0..n {
            for column in row + 1..n {
                let (upper, lower) = (matrix[row * n + column], matrix[column * n + row]);
                if (upper - lower).abs() > limit {
                    return Err(CheckFailure::Unsymmetric {
                        place: self.place,
                        operator,
                        row,
                        column,
                        upper,
                        lower,
                        limit,
                    });
                }
            }
        }
        Ok(())
    }

    /// Worst relative disagreement of the tangent of an update from `base`; `None` at a kink.
    fn tangent(
        &mut self,
        strain: &K::Vector,
        base: &[f64],
        answer: &Answer<K>,
    ) -> Result<Option<f64>, CheckFailure> {
        let (law, place) = (self.law, self.place);
        let ctx = self.check.context.with_operator(Operator::None);
        let mut scratch = vec![0.0; base.len()];
        let tangent = &answer.response.tangent;
        let matrix = entries::<K>(tangent);
        let scale = self.stiffness.max(norm(&matrix));
        let limit = self.check.tangent_tolerance * scale;
        if !law.unsymmetric_tangent() {
            self.symmetric("tangent", &matrix, limit)?;
        }
        let verdict = self.differences.compare(
            K::components(strain),
            K::components(&answer.response.stress),
            limit,
            |i, j| K::entry(tangent, i, j),
            |x, out| {
                let moved = law
                    .update(&K::vector(x), base, &mut scratch, &ctx)
                    .map_err(|source| CheckFailure::material(place, source))?;
                out.copy_from_slice(K::components(&moved.stress));
                Ok(())
            },
        )?;
        match verdict {
            Verdict::Agrees(worst) => Ok(Some(ratio(worst, scale))),
            Verdict::Kink => Ok(None),
            Verdict::Wrong(d) => Err(CheckFailure::Tangent {
                place,
                row: K::STRESS_LABELS[d.row].into(),
                column: K::STRAIN_LABELS[d.column].into(),
                given: d.given,
                difference: d.difference,
                limit,
            }),
        }
    }

    /// sigma_(n+1) : d_eps - d_psi, if the law has a free energy.
    fn dissipation(
        &self,
        strain: &K::Vector,
        answer: &Answer<K>,
    ) -> Result<Option<f64>, CheckFailure> {
        let energy = |e: &K::Vector, state| self.law.free_energy(e, state, &self.check.context);
        let before = energy(&self.strain, &self.committed);
        let after = energy(strain, &answer.state);
        let (Some(before), Some(after)) = (before, after) else {
            return Ok(None);
        };
        finite(self.place, &[before, after], |_| "free energy".into())?;
        let (old, new) = (K::components(&self.strain), K::components(strain));
        let stress = K::components(&answer.response.stress);
        let terms = (0..K::LEN).map(|i| stress[i] * (new[i] - old[i]));
        let work: f64 = terms.clone().sum();
        let scale = terms.map(f64::abs).sum::<f64>() + before.abs() + after.abs();
        let dissipation = work - (after - before);
        let limit = -self.check.dissipation_tolerance * scale;
        if dissipation.is_nan() || dissipation < limit {
            return Err(CheckFailure::Dissipation {
                place: self.place,
                dissipation,
                limit,
            });
        }
        Ok(Some(dissipation))
    }

    /// Stress and state of two answers agree to the last bit.
    pub(super) fn same(
        &self,
        first: &Answer<K>,
        second: &Answer<K>,
        between: &'static str,
    ) -> Result<(), CheckFailure> {
        let stresses = [first, second].map(|a| K::components(&a.response.stress));
        equal(
            self.place,
            stresses[0],
            stresses[1],
            between,
            stress_label::<K>,
        )?;
        equal(self.place, &first.state, &second.state, between, |i| {
            self.state_label(i)
        })
    }

    fn state_label(&self, i: usize) -> String {
        format!("state variable {}", state_labels(self.law.state_vars())[i])
    }
}

fn stress_label<K: Kinematics>(i: usize) -> String {
    format!("stress {}", K::STRESS_LABELS[i])
}

pub(super) fn tangent_label<K: Kinematics>(k: usize) -> String {
    let (i, j) = (k / K::LEN, k % K::LEN);
    format!(
        "operator d({})/d({})",
        K::STRESS_LABELS[i],
        K::STRAIN_LABELS[j]
    )
}

/// Entries of a tangent by rows.
pub(super) fn entries<K: Kinematics>(tangent: &K::Tangent) -> Vec<f64> {
    let n = K::LEN;
    (0..n * n)
        .map(|k| K::entry(tangent, k / n, k % n))
        .collect()
}
