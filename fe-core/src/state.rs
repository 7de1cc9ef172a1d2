//! Committed, base and trial history of every element.

use std::ops::Range;

use crate::element::Element;
use crate::model::ModelError;

/// Internal variables of all elements in flat arrays.
///
/// Laws read `base` and write `trial`. `base` equals `committed` at the start of a step; during the
/// step it takes up only what has been latched (the axes of new cracks). [`Self::commit`],
/// [`Self::roll_back`], [`Self::set_base`] and [`Self::advance`] change `committed` or `base` wholesale.
#[derive(Debug, Clone, PartialEq)]
pub struct StateStore {
    offsets: Vec<usize>,
    committed: Vec<f64>,
    base: Vec<f64>,
    trial: Vec<f64>,
}

impl StateStore {
    /// Virgin state of `elements`.
    pub fn new(elements: &[Box<dyn Element>]) -> Self {
        let mut offsets = vec![0];
        for e in elements {
            offsets.push(offsets[offsets.len() - 1] + e.state_len());
        }
        let mut committed = vec![0.0; offsets[elements.len()]];
        for (e, w) in elements.iter().zip(offsets.windows(2)) {
            e.init_state(&mut committed[w[0]..w[1]]);
        }
        Self {
            offsets,
            base: committed.clone(),
            trial: committed.clone(),
            committed,
        }
    }

    /// Takes over the committed variables of a model whose elements are the first ones of this.
    ///
    /// # Errors
    ///
    /// [`ModelError::Foreign`] if they are not, as far as the numbers of their variables tell; nothing is taken over then.
    pub fn adopt(&mut self, other: &Self) -> Result<(), ModelError> {
        let (found, expected) = (other.elements(), self.elements());
        if found > expected {
            ModelError::same("elements taken over", found, expected)?;
        }
        for (theirs, own) in other.offsets.iter().zip(&self.offsets) {
            ModelError::same("history variables taken over", *theirs, *own)?;
        }
        let n = other.committed.len();
        self.committed[..n].copy_from_slice(&other.committed);
        self.roll_back();
        Ok(())
    }

    /// Number of elements.
    pub(crate) const fn elements(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Where an element's variables lie.
    pub fn range(&self, element: usize) -> Range<usize> {
        self.offsets[element]..self.offsets[element + 1]
    }

    /// State at the end of the last accepted step.
    pub fn committed(&self, element: usize) -> &[f64] {
        &self.committed[self.range(element)]
    }

    /// All committed variables, for checkpoints.
    pub fn all_committed(&self) -> &[f64] {
        &self.committed
    }

    /// State of the last evaluation.
    pub fn trial(&self, element: usize) -> &[f64] {
        &self.trial[self.range(element)]
    }

    /// Base and trial arrays with the element offsets, for one evaluation.
    pub(crate) fn split(&mut self) -> (&[usize], &[f64], &mut [f64]) {
        (&self.offsets, &self.base, &mut self.trial)
    }

    /// Lets every element latch what must not change any more within the step. Returns whether that changes the history of
    /// the next evaluations.
    pub fn latch(&mut self, elements: &[Box<dyn Element>]) -> bool {
        let mut changed = false;
        for (e, w) in elements.iter().zip(self.offsets.windows(2)) {
            changed |= e.latch(&self.trial[w[0]..w[1]], &mut self.base[w[0]..w[1]]);
        }
        changed
    }

    /// Makes the trial state the base of the next evaluations, without accepting it: a state passed
    /// through on the way to the end of the step.
    pub fn advance(&mut self) {
        self.base.copy_from_slice(&self.trial);
    }

    /// History variables that the evaluations read, where they differ from the committed ones (indices in
    /// [`Self::all_committed`]): what has been latched or passed through since the last accepted step.
    pub fn base_changes(&self) -> Vec<(u32, f64)> {
        let pairs = self.base.iter().zip(&self.committed).enumerate();
        pairs
            .filter(|(_, (base, committed))| base.to_bits() != committed.to_bits())
            .map(|(i, (base, _))| (i as u32, *base))
            .collect()
    }

    /// Makes the committed state with `changes` the base of the next evaluations, see [`Self::base_changes`].
    /// Returns whether every index is one of this store; if not, nothing is changed.
    pub fn set_base(&mut self, changes: &[(u32, f64)]) -> bool {
        let n = self.committed.len();
        if changes.iter().any(|&(i, _)| i as usize >= n) {
            return false;
        }
        self.roll_back();
        for &(i, value) in changes {
            self.base[i as usize] = value;
        }
        true
    }

    /// Accepts the trial state.
    pub fn commit(&mut self) {
        self.committed.copy_from_slice(&self.trial);
        self.base.copy_from_slice(&self.trial);
    }

    /// Returns to the committed state.
    pub fn roll_back(&mut self) {
        self.base.copy_from_slice(&self.committed);
        self.trial.copy_from_slice(&self.committed);
    }
}
