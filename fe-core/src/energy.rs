//! Energy balance of a path, part by part.
//!
//! Between two recorded states the work of the internal forces of an element is, by the trapezoidal rule,
//! dW = (f_n + f_(n+1)) . (u_(n+1) - u_n)/2, and the external work likewise, with the reactions where
//! displacements are prescribed. What an element stores is its free energy, or f . u/2 where its law states none
//! (exact for laws that unload to the origin). What it does not store it has dissipated: D = W - psi.
//!
//! In equilibrium the external work is the sum of the internal works; the gap is the work of the residuals.

use rayon::prelude::*;

use crate::element::{ElementError, ElementSystem, EvaluationContext, PointSample};
use crate::kinematics::{Kinematics, Solid};
use crate::model::{Conditions, Model, ModelError};
use crate::state::StateStore;
use crate::voigt::{stress_tensor, stress_voigt};
use nalgebra::{Matrix3, Vector6};

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

/// What one element was like when it was last recorded.
#[derive(Debug, Clone, Default)]
struct Last {
    force: Vec<f64>,
    work: f64,
    stored: f64,
}

/// Accounts for the work done on the parts of a model. Starts in the undeformed, unloaded model.
#[derive(Debug)]
pub struct Ledger {
    /// Part of every element.
    part: Vec<usize>,
    parts: usize,
    elements: Vec<Last>,
    displacement: Vec<f64>,
    external: Vec<f64>,
    external_work: f64,
}

impl Ledger {
    /// A ledger of `parts` parts in which element e belongs to part `part[e]`.
    pub fn new(part: Vec<usize>, parts: usize) -> Self {
        Self {
            elements: vec![Last::default(); part.len()],
            parts,
            part,
            displacement: Vec::new(),
            external: Vec::new(),
            external_work: 0.0,
        }
    }

    /// Goes on with a model that has more elements or DOFs, displaced by `u`: what was added does no work
    /// up to there.
    pub fn rebase(&mut self, u: &[f64]) {
        self.displacement = u.to_vec();
        self.external = vec![0.0; u.len()];
    }

    /// Records an accepted state of a stage.
    ///
    /// # Errors
    ///
    /// [`ModelError::Element`].
    pub fn record(
        &mut self,
        model: &Model,
        conditions: &Conditions,
        lambda: f64,
        u: &[f64],
        state: &StateStore,
    ) -> Result<(), ModelError> {
        self.displacement.resize(u.len(), 0.0);
        self.external.resize(u.len(), 0.0);
        let before = &self.displacement;
        self.elements
            .par_iter_mut()
            .take(model.elements().len())
            .enumerate()
            .try_for_each(|(e, last)| {
                let (own, old) = (model.gather(e, u), model.gather(e, before));
                last.advance(model, e, (&old, &own), state.committed(e))
                    .map_err(|source| model.locate(e, source))
            })?;
        let mut external = vec![0.0; u.len()];
        conditions.external(lambda, &mut external);
        let mut internal = vec![0.0; u.len()];
        for (element, last) in model.elements().iter().zip(&self.elements) {
            for (d, f) in model
                .dofs()
                .element_dofs(element.as_ref())
                .iter()
                .zip(&last.force)
            {
                internal[*d as usize] += f;
            }
        }
        for &d in conditions.prescribed().keys() {
            external[d] = internal[d];
        }
        for d in 0..u.len() {
            self.external_work +=
                0.5 * (self.external[d] + external[d]) * (u[d] - self.displacement[d]);
        }
        self.external = external;
        self.displacement.copy_from_slice(u);
        Ok(())
    }

    /// Work of loads and reactions so far (N mm).
    pub const fn external_work(&self) -> f64 {
        self.external_work
    }

    /// Energies of every part.
    pub fn parts(&self) -> Vec<PartEnergy> {
        let mut sums = vec![PartEnergy::default(); self.parts];
        for (&p, e) in self.part.iter().zip(&self.elements) {
            if let Some(sum) = sums.get_mut(p) {
                sum.work += e.work;
                sum.stored += e.stored;
            }
        }
        sums
    }

    /// Gap of the balance relative to the external work: 1 - sum of the internal works over it.
    pub fn gap(&self) -> f64 {
        let internal: f64 = self.elements.iter().map(|e| e.work).sum();
        if self.external_work == 0.0 {
            0.0
        } else {
            1.0 - internal / self.external_work
        }
    }
}

impl Last {
    fn advance(
        &mut self,
        model: &Model,
        e: usize,
        (old, u): (&[f64], &[f64]),
        state: &[f64],
    ) -> Result<(), ElementError> {
        let element = &model.elements()[e];
        let mut force = vec![0.0; u.len()];
        let mut trial = state.to_vec();
        let system = ElementSystem {
            force: &mut force,
            stiffness: &mut [],
        };
        element.evaluate(u, state, &mut trial, &EvaluationContext::frozen(), system)?;
        self.force.resize(u.len(), 0.0);
        for i in 0..u.len() {
            self.work += 0.5 * (self.force[i] + force[i]) * (u[i] - old[i]);
        }
        let half: f64 = force.iter().zip(u).map(|(f, u)| 0.5 * f * u).sum();
        self.stored = element.free_energy(u, state).unwrap_or(half);
        self.force = force;
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
    points: Vec<Seen>,
    next: usize,
    dissipated: f64,
}

/// A point at the last state.
#[derive(Debug, Clone, Copy)]
struct Seen {
    strain: Vector6<f64>,
    /// Its tensile part once the point has cracked.
    stress: Vector6<f64>,
    cracked: bool,
}

impl Cracking {
    /// Begins a state. Its points are then shown one by one, in the same order as those of the state before.
    pub const fn begin(&mut self) {
        self.next = 0;
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
            self.points.push(Seen {
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
            (seen.stress, seen.cracked) = (tensile(&seen.stress), true);
        }
        let stress = tensile(&stress);
        self.dissipated +=
            sample.volume * 0.5 * (seen.stress.dot(&strain) - stress.dot(&seen.strain));
        (seen.strain, seen.stress) = (strain, stress);
    }

    /// Energy dissipated so far (N mm).
    pub const fn dissipated(&self) -> f64 {
        self.dissipated
    }
}

/// Tensile part of a stress: its positive principal values.
fn tensile(stress: &Vector6<f64>) -> Vector6<f64> {
    let tensor = stress_tensor(stress);
    let eigen = tensor.symmetric_eigen();
    let mut positive = Matrix3::zeros();
    for k in 0..3 {
        let axis = eigen.eigenvectors.column(k);
        positive += eigen.eigenvalues[k].max(0.0) * axis * axis.transpose();
    }
    stress_voigt(&positive)
}
