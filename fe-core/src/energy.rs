//! Energy balance of a path, part by part.
//!
//! Between two recorded states the work of the internal forces of an element is, by the trapezoidal rule,
//! dW = (f_n + f_(n+1)) . (u_(n+1) - u_n)/2, and the external work likewise, with the reactions where
//! displacements are prescribed. What an element stores is its free energy, or what unloading along the secant gives
//! back where its law states none. What it does not store it has dissipated: D = W - psi.
//!
//! In equilibrium the external work is the sum of the internal works; the gap is the work of the residuals.

use rayon::prelude::*;

use crate::element::{Element, ElementError, ElementSystem, EvaluationContext, PointSample};
use crate::kinematics::{Kinematics, Solid};
use crate::model::{Conditions, Model, ModelError};
use crate::voigt::{principal, stress_along, stress_tensor};
use nalgebra::Vector6;

/// Energies of one part of a model (N mm).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PartEnergy {
    /// Work of the internal forces so far.
    pub work: f64,
    /// Recoverable share of it.
    pub stored: f64,
}

impl PartEnergy {
    /// Dissipated energy (N mm).
    pub fn dissipated(&self) -> f64 {
        self.work - self.stored
    }
}

/// What an element is like at the state to be weighed.
#[derive(Debug, Clone, Copy)]
pub struct ElementAt<'s> {
    /// Its DOFs.
    pub dofs: &'s [u32],
    /// Its internal variables.
    pub state: &'s [f64],
    /// Its internal force (N), if it is known.
    pub force: Option<&'s [f64]>,
}

/// What one element was like at a state.
#[derive(Debug, Clone, Default)]
struct Seen {
    force: Vec<f64>,
    energy: PartEnergy,
}

/// Share of work and stored energy by which the dissipation of a step may be negative.
pub const RULE: f64 = 0.02;
/// Share of the turnover by which it may be.
pub const ROUNDING: f64 = 1e-6;
/// Energy (N mm) that it may be at any rate, as in a body moved without strain.
pub const LEAST: f64 = 1e-12;

/// Energies (N mm) of a whole model from one state to the next.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Change {
    /// Work of the internal forces.
    pub work: f64,
    /// Change of the recoverable energy.
    pub stored: f64,
    /// Sizes of all works done so far, element by element.
    pub turnover: f64,
}

impl Change {
    /// Dissipated energy (N mm).
    pub fn dissipated(&self) -> f64 {
        self.work - self.stored
    }

    /// Whether energy has been created: a negative dissipation of more than what the trapezoidal rule may err by, the share
    /// [`RULE`] of what has been done and stored, and rounding, the share [`ROUNDING`] of the turnover and [`LEAST`].
    pub fn creates_energy(&self) -> bool {
        let size = self.work.abs() + self.stored.abs();
        self.dissipated() < -RULE * size - ROUNDING * self.turnover - LEAST
    }
}

/// Accounts for the work done on the elements of a model. Starts in the undeformed, unloaded model.
///
/// A new state is [weighed](Self::weigh) while it is on trial, and [settled](Self::settle) when it is accepted.
#[derive(Debug, Default)]
pub struct Ledger {
    elements: Vec<Seen>,
    weighed: Vec<Seen>,
    at: Totals,
    next: Totals,
}

/// What the books say of the whole model.
#[derive(Debug, Clone, Default)]
struct Totals {
    displacement: Vec<f64>,
    external: Vec<f64>,
    external_work: f64,
    /// From the state before.
    change: Change,
}

impl Ledger {
    /// Goes on from displacement `u`, under conditions or with elements and DOFs that may be others than before: what was
    /// added does no work up to there. The state there is to be weighed and settled first.
    pub fn rebase(&mut self, u: &[f64]) {
        self.at.displacement = u.to_vec();
        self.at.external = vec![0.0; u.len()];
    }

    /// Weighs an equilibrium, in which element e is like `element(e)`, against the last one settled.
    ///
    /// # Errors
    ///
    /// [`ModelError::Element`], also for an element whose energies are not finite, and [`ModelError::Foreign`] or
    /// [`ModelError::ForeignConditions`] for displacements or conditions of another model.
    pub fn weigh<'s>(
        &mut self,
        model: &Model,
        conditions: &Conditions,
        (lambda, u): (f64, &[f64]),
        element: impl Fn(usize) -> ElementAt<'s> + Sync,
    ) -> Result<Change, ModelError> {
        ModelError::same("displacements", u.len(), model.dofs().len())?;
        conditions.admit(model)?;
        self.at.displacement.resize(u.len(), 0.0);
        self.at.external.resize(u.len(), 0.0);
        let before = &self.at.displacement;
        self.elements
            .resize_with(model.elements().len(), Seen::default);
        self.weighed
            .resize_with(model.elements().len(), Seen::default);
        let failed = self
            .weighed
            .par_iter_mut()
            .zip(&self.elements)
            .enumerate()
            .filter_map(|(e, (now, seen))| {
                let own = model.elements()[e].as_ref();
                let followed = now.follow(seen, own, (before, u), element(e));
                followed.err().map(|source| (e, source))
            });
        // The first element that fails, whatever the order in which threads come to them.
        if let Some((e, source)) = failed.min_by_key(|(e, _)| *e) {
            return Err(model.locate(e, source));
        }
        let mut external = vec![0.0; u.len()];
        conditions.external(lambda, &mut external);
        let mut internal = vec![0.0; u.len()];
        for (e, now) in self.weighed.iter().enumerate() {
            for (d, f) in element(e).dofs.iter().zip(&now.force) {
                internal[*d as usize] += f;
            }
        }
        for &d in conditions.prescribed().keys() {
            external[d] = internal[d];
        }
        let advanced: f64 = (0..u.len())
            .map(|d| 0.5 * (self.at.external[d] + external[d]) * (u[d] - before[d]))
            .sum();
        let mut change = Change::default();
        for (now, seen) in self.weighed.iter().zip(&self.elements) {
            change.work += now.energy.work - seen.energy.work;
            change.stored += now.energy.stored - seen.energy.stored;
            change.turnover += now.energy.work.abs();
        }
        self.next = Totals {
            displacement: u.to_vec(),
            external,
            external_work: self.at.external_work + advanced,
            change,
        };
        Ok(change)
    }

    /// The state weighed last is accepted.
    pub fn settle(&mut self) {
        std::mem::swap(&mut self.elements, &mut self.weighed);
        std::mem::swap(&mut self.at, &mut self.next);
    }

    /// Energies of the last step settled.
    pub const fn last_change(&self) -> Change {
        self.at.change
    }

    /// Work of loads and reactions so far (N mm).
    pub const fn external_work(&self) -> f64 {
        self.at.external_work
    }

    /// Energies of `parts` parts, element e belonging to part `part[e]`.
    pub fn parts(&self, part: &[usize], parts: usize) -> Vec<PartEnergy> {
        let mut sums = vec![PartEnergy::default(); parts];
        for (&p, e) in part.iter().zip(&self.elements) {
            if let Some(sum) = sums.get_mut(p) {
                sum.work += e.energy.work;
                sum.stored += e.energy.stored;
            }
        }
        sums
    }

    /// Gap of the balance relative to the external work: 1 - sum of the internal works over it.
    pub fn gap(&self) -> f64 {
        let internal: f64 = self.elements.iter().map(|e| e.energy.work).sum();
        if self.at.external_work == 0.0 {
            0.0
        } else {
            1.0 - internal / self.at.external_work
        }
    }
}

impl Seen {
    fn follow(
        &mut self,
        before: &Self,
        element: &dyn Element,
        (old, new): (&[f64], &[f64]),
        at: ElementAt<'_>,
    ) -> Result<(), ElementError> {
        let u: Vec<f64> = at.dofs.iter().map(|&d| new[d as usize]).collect();
        self.force.clear();
        if let Some(force) = at.force {
            self.force.extend_from_slice(force);
        } else {
            self.force.resize(u.len(), 0.0);
            let mut trial = at.state.to_vec();
            let system = ElementSystem {
                force: &mut self.force,
                stiffness: &mut [],
            };
            let frozen = EvaluationContext::frozen();
            element.evaluate(&u, at.state, &mut trial, &frozen, system)?;
        }
        let mut work = before.energy.work;
        for (i, &d) in at.dofs.iter().enumerate() {
            let last = before.force.get(i).copied().unwrap_or(0.0);
            work += 0.5 * (last + self.force[i]) * (u[i] - old[d as usize]);
        }
        let half: f64 = self.force.iter().zip(&u).map(|(f, u)| 0.5 * f * u).sum();
        let stored = element.free_energy(&u, at.state)?.unwrap_or(half);
        if !(work.is_finite() && stored.is_finite()) {
            return Err(ElementError::Energy { work, stored });
        }
        self.energy = PartEnergy { work, stored };
        Ok(())
    }
}

/// Energy dissipated by the tensile principal stresses of cracked points of a solid: cracking. What else the
/// solid dissipates is crushing.
///
/// For laws that unload to the origin, the dissipation of a stress between two states is
/// (sigma_n : eps_(n+1) - sigma_(n+1) : eps_n)/2; here sigma is the tensile part.
#[derive(Debug, Clone, Default)]
pub struct Cracking {
    points: Vec<SeenPoint>,
    next: usize,
    dissipated: f64,
    largest: f64,
}

/// A point at the last state.
#[derive(Debug, Clone, Copy)]
struct SeenPoint {
    strain: Vector6<f64>,
    /// Its tensile part once the point has cracked.
    stress: Vector6<f64>,
    cracked: bool,
}

impl Cracking {
    /// Begins a state. Its points are then shown one by one, in the same order as those of the state before.
    pub const fn begin(&mut self) {
        self.next = 0;
        self.largest = 0.0;
    }

    /// Takes a point of a solid.
    pub fn point(&mut self, sample: &PointSample<'_>) {
        if sample.strain.len() != Solid::LEN || sample.stress.len() != Solid::LEN {
            return;
        }
        let strain = Vector6::from_column_slice(sample.strain);
        let stress = Vector6::from_column_slice(sample.stress);
        let Some(seen) = self.points.get_mut(self.next) else {
            self.next += 1;
            self.points.push(SeenPoint {
                strain,
                stress,
                cracked: false,
            });
            return;
        };
        self.next += 1;
        if !seen.cracked && sample.report.crack_strain <= 0.0 {
            (seen.strain, seen.stress) = (strain, stress);
            return;
        }
        if !seen.cracked {
            (seen.stress, seen.cracked) = (tensile(&seen.stress).0, true);
        }
        let (stress, largest) = tensile(&stress);
        self.largest = self.largest.max(largest);
        self.dissipated +=
            sample.volume * 0.5 * (seen.stress.dot(&strain) - stress.dot(&seen.strain));
        (seen.strain, seen.stress) = (strain, stress);
    }

    /// Largest principal tension (MPa) of a cracked point in the state shown last. No more than the tensile strength, unless
    /// cracks lock: fixed axes from which the principal stress turns away (Rots 1988).
    pub const fn largest_tension(&self) -> f64 {
        self.largest
    }

    /// Energy dissipated so far (N mm).
    pub const fn dissipated(&self) -> f64 {
        self.dissipated
    }
}

/// Tensile part of a stress, its positive principal values, and the largest of them.
fn tensile(stress: &Vector6<f64>) -> (Vector6<f64>, f64) {
    let (values, axes) = principal(&stress_tensor(stress));
    let positive = values.map(|s| s.max(0.0));
    (stress_along(&axes, &positive), positive[0])
}
