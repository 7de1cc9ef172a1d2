//! Assembly on a fixed pattern, parallel over elements, bit-identical for any number of threads.

mod scatter;

use rayon::prelude::*;

use crate::element::{ElementError, ElementSystem, EvaluationContext};
use crate::material::Operator;
use crate::model::{Conditions, Model, ModelError};
use crate::sparsity::{MatrixValues, Sparsity};
use crate::state::StateStore;

use scatter::{NONE, Scatter};

/// Elements that each thread evaluates before their contributions are added in order. The matrices of so many
/// hexahedra, 460 kB, stay in cache.
const BATCH: usize = 16;

/// Equation numbers, sparsity pattern and scatter map of a model under given constraints.
///
/// Elements are evaluated in parallel into buffers of their own and then added one after the other
/// in element order, so the result does not depend on the number of threads.
#[derive(Debug)]
pub struct Assembler {
    equation: Vec<u32>,
    free: Vec<u32>,
    element_dofs: Vec<Vec<u32>>,
    /// Where the forces of each element begin, and where those of the last end.
    force_starts: Vec<usize>,
    pattern: Sparsity,
    scatter: Vec<Scatter>,
    rate: Vec<f64>,
    unsymmetric: bool,
    slots: Vec<Slot>,
}

/// Buffers of one element.
#[derive(Debug, Clone, Default)]
struct Slot {
    u: Vec<f64>,
    force: Vec<f64>,
    stiffness: Vec<f64>,
}

/// Result of one evaluation of a model.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Assembled {
    /// Internal force (N) on all DOFs.
    pub internal: Vec<f64>,
    /// Stiffness (N/mm) of the free equations.
    pub matrix: MatrixValues,
    /// K_fc p: force (N) on the free equations per unit of the load factor, which moves the prescribed
    /// pattern p.
    pub coupling: Vec<f64>,
    /// Internal forces (N) of the elements, see [`Assembler::force_range`].
    pub element_forces: Vec<f64>,
}

impl Assembler {
    /// Builds the pattern and the scatter map once.
    ///
    /// # Errors
    ///
    /// [`ModelError::ForeignConditions`] for those of another model, as far as the numbers of DOFs tell.
    pub fn new(model: &Model, conditions: &Conditions) -> Result<Self, ModelError> {
        let n = model.dofs().len();
        conditions.admit(model)?;
        let mut equation = vec![NONE; n];
        let mut free = Vec::with_capacity(n);
        let mut rate = vec![0.0; n];
        for d in 0..n {
            if let Some(&r) = conditions.prescribed().get(&d) {
                rate[d] = r;
            } else {
                equation[d] = free.len() as u32;
                free.push(d as u32);
            }
        }
        let element_dofs: Vec<Vec<u32>> = model
            .elements()
            .iter()
            .map(|e| model.dofs().element_dofs(e.as_ref()))
            .collect();
        let equations: Vec<Vec<u32>> = element_dofs
            .iter()
            .map(|dofs| dofs.iter().map(|&d| equation[d as usize]).collect())
            .collect();
        let pattern = Sparsity::from_groups(free.len(), equations.iter().map(Vec::as_slice));
        let scatter = scatter::scatter(&pattern, &equations);
        let ends = element_dofs.iter().scan(0, |end, dofs| {
            *end += dofs.len();
            Some(*end)
        });
        let force_starts = std::iter::once(0).chain(ends).collect();
        let unsymmetric = model.elements().iter().any(|e| e.unsymmetric());
        let slots = vec![
            Slot::default();
            (BATCH * rayon::current_num_threads()).min(model.elements().len())
        ];
        Ok(Self {
            equation,
            free,
            element_dofs,
            force_starts,
            pattern,
            scatter,
            rate,
            unsymmetric,
            slots,
        })
    }

    /// Pattern of the free equations.
    pub const fn pattern(&self) -> &Sparsity {
        &self.pattern
    }

    /// DOF index of each free equation.
    pub fn free(&self) -> &[u32] {
        &self.free
    }

    /// Number of the free equation of a DOF; `None` for one that is constrained or not there.
    pub fn equation(&self, dof: usize) -> Option<usize> {
        let equation = *self.equation.get(dof)?;
        (equation != NONE).then_some(equation as usize)
    }

    /// Rate of the prescribed pattern on every DOF (mm per unit of the load factor), zero on free ones.
    pub fn rate(&self) -> &[f64] {
        &self.rate
    }

    /// DOFs of an element.
    pub fn element_dofs(&self, element: usize) -> &[u32] {
        &self.element_dofs[element]
    }

    /// Where the forces of an element are in [`Assembled::element_forces`].
    pub fn force_range(&self, element: usize) -> std::ops::Range<usize> {
        self.force_starts[element]..self.force_starts[element + 1]
    }

    /// Whether a DOF is constrained.
    pub fn is_constrained(&self, dof: usize) -> bool {
        self.equation[dof] == NONE
    }

    /// Whether the consistent tangent is assembled as unsymmetric.
    pub const fn is_unsymmetric(&self) -> bool {
        self.unsymmetric
    }

    /// Internal force and, unless `ctx` asks for forces only, stiffness at displacement `u`.
    ///
    /// Reads the base state, writes the trial state.
    ///
    /// # Errors
    ///
    /// [`ModelError::Element`] of the first element in order that failed, and [`ModelError::Foreign`] for another model
    /// than that of [`Self::new`], or displacements or states of another one, as far as numbers tell.
    pub fn evaluate(
        &mut self,
        model: &Model,
        u: &[f64],
        state: &mut StateStore,
        ctx: &EvaluationContext,
        out: &mut Assembled,
    ) -> Result<(), ModelError> {
        self.admit(model, u, state)?;
        let with_matrix = ctx.operator != Operator::None;
        let tangent = self.unsymmetric && ctx.operator == Operator::Tangent;
        let unsymmetric = tangent && !ctx.symmetric_part;
        reset(&mut out.internal, self.equation.len());
        out.element_forces.clear();
        if with_matrix {
            let nnz = self.pattern.nnz();
            reset(&mut out.matrix.lower, nnz);
            reset(&mut out.matrix.upper, if unsymmetric { nnz } else { 0 });
            reset(&mut out.coupling, self.free.len());
        }
        let (offsets, base, trial) = state.split();
        let mut rest = trial;
        let together = self.slots.len().max(1);
        for first in (0..model.elements().len()).step_by(together) {
            let batch = first..(first + together).min(model.elements().len());
            let mut jobs: Vec<Job<'_>> = Vec::with_capacity(batch.len());
            for (slot, e) in self.slots.iter_mut().zip(batch.clone()) {
                let (own, tail) = rest.split_at_mut(offsets[e + 1] - offsets[e]);
                rest = tail;
                jobs.push(Job {
                    element: e,
                    slot,
                    trial: own,
                });
            }
            let dofs = &self.element_dofs;
            let results: Vec<Result<(), ElementError>> = jobs
                .par_iter_mut()
                .map(|job| {
                    let committed = &base[offsets[job.element]..offsets[job.element + 1]];
                    job.run(model, &dofs[job.element], u, committed, ctx)
                })
                .collect();
            for (result, e) in results.into_iter().zip(batch.clone()) {
                result.map_err(|source| model.locate(e, source))?;
            }
            for (k, e) in batch.enumerate() {
                let dofs = &self.element_dofs[e];
                out.element_forces.extend_from_slice(&self.slots[k].force);
                for (&d, f) in dofs.iter().zip(&self.slots[k].force) {
                    out.internal[d as usize] += f;
                }
                if with_matrix {
                    let element = &model.elements()[e];
                    let full = !element.fills_upper(ctx);
                    if full && ctx.symmetric_part {
                        fill_symmetric_part(&mut self.slots[k].stiffness, dofs.len());
                    }
                    let full = full && !ctx.symmetric_part;
                    self.add_matrix(e, &self.slots[k].stiffness, full, out);
                }
            }
        }
        Ok(())
    }

    /// Refuses what is not of the model that was numbered.
    fn admit(&self, model: &Model, u: &[f64], state: &StateStore) -> Result<(), ModelError> {
        let (dofs, sizes) = (model.dofs().len(), model.sizes());
        ModelError::same("numbered DOFs", self.equation.len(), dofs)?;
        ModelError::same("numbered elements", self.element_dofs.len(), sizes.len())?;
        for (size, numbered) in sizes.iter().zip(&self.element_dofs) {
            ModelError::same("numbered DOFs of an element", numbered.len(), size.dofs)?;
        }
        model.admit(u, state)
    }

    /// Adds the matrix of element `e`, of which only the upper triangle counts unless it is `full`.
    fn add_matrix(&self, e: usize, stiffness: &[f64], full: bool, out: &mut Assembled) {
        let MatrixValues { lower, upper } = &mut out.matrix;
        if full {
            self.scatter[e].add_unsymmetric(stiffness, lower, upper);
        } else {
            self.scatter[e].add_symmetric(stiffness, lower);
            if !upper.is_empty() {
                self.scatter[e].add_symmetric(stiffness, upper);
            }
        }
        let dofs = &self.element_dofs[e];
        let n = dofs.len();
        for (j, &dj) in dofs.iter().enumerate() {
            let rate = self.rate[dj as usize];
            if rate == 0.0 {
                continue;
            }
            for (i, &di) in dofs.iter().enumerate() {
                let row = self.equation[di as usize];
                if row != NONE {
                    let (a, b) = if full || i <= j { (i, j) } else { (j, i) };
                    out.coupling[row as usize] += stiffness[a * n + b] * rate;
                }
            }
        }
    }
}

/// One element of a batch.
struct Job<'a> {
    element: usize,
    slot: &'a mut Slot,
    trial: &'a mut [f64],
}

impl Job<'_> {
    fn run(
        &mut self,
        model: &Model,
        dofs: &[u32],
        u: &[f64],
        committed: &[f64],
        ctx: &EvaluationContext,
    ) -> Result<(), ElementError> {
        let with_matrix = ctx.operator != Operator::None;
        let Slot {
            u: local,
            force,
            stiffness,
        } = &mut *self.slot;
        local.clear();
        local.extend(dofs.iter().map(|&d| u[d as usize]));
        reset(force, dofs.len());
        if with_matrix {
            reset(stiffness, dofs.len() * dofs.len());
        }
        let matrix = if with_matrix {
            &mut stiffness[..]
        } else {
            &mut []
        };
        let out = ElementSystem {
            force,
            stiffness: matrix,
        };
        model.elements()[self.element].evaluate(local, committed, self.trial, ctx, out)
    }
}

/// Puts the symmetric part of an `n` x `n` matrix into its upper triangle.
fn fill_symmetric_part(matrix: &mut [f64], n: usize) {
    for i in 0..n {
        for j in i + 1..n {
            matrix[i * n + j] = matrix[i * n + j].midpoint(matrix[j * n + i]);
        }
    }
}

/// Sets a buffer to `n` zeros.
fn reset(buffer: &mut Vec<f64>, n: usize) {
    buffer.clear();
    buffer.resize(n, 0.0);
}
