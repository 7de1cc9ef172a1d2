//! A recorder with a journal in memory.

use std::collections::VecDeque;
use std::io;

use fe_solver::journal::Entry;
use fe_solver::recorder::{Continue, Recorder, StepView};

/// Recalls the steps of an earlier run, keeps those of this one and shows every step.
#[derive(Debug)]
pub struct Journal<S> {
    earlier: VecDeque<Entry>,
    /// Steps of this run, for one that goes on from them.
    pub kept: Vec<Entry>,
    step: S,
}

impl<S: FnMut(&StepView<'_>)> Journal<S> {
    /// A journal of a run that begins with `earlier` steps; `step` sees these too.
    pub fn after(earlier: impl IntoIterator<Item = Entry>, step: S) -> Self {
        Self {
            earlier: earlier.into_iter().collect(),
            kept: Vec::new(),
            step,
        }
    }
}

impl<S: FnMut(&StepView<'_>)> Recorder for Journal<S> {
    fn recall(&mut self) -> io::Result<Option<Entry>> {
        Ok(self.earlier.pop_front())
    }

    fn keep(&mut self, entry: &Entry) -> io::Result<()> {
        self.kept.push(entry.clone());
        Ok(())
    }

    fn step(&mut self, view: &StepView<'_>) -> io::Result<Continue> {
        (self.step)(view);
        Ok(Continue::Yes)
    }
}
