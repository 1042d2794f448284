//! Progress reports of long work, and requests to stop it.

use std::ops::ControlFlow;

use crate::error::{CorpusError, CorpusResult};

/// The current state of long work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProgressStep<'a> {
    /// The current task, such as a file's name.
    pub task: &'a str,
    /// The amount that is done.
    pub done: u64,
    /// The total amount, if it is known.
    pub total: Option<u64>,
    /// The unit of the amounts.
    pub unit: ProgressUnit,
}

/// Unit of the amounts in a [`ProgressStep`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ProgressUnit {
    /// Bytes of a file.
    Bytes,
    /// Frames of movement.
    Frames,
    /// Anything else that can be counted.
    Items,
}

/// Receiver of every [`ProgressStep`], which decides whether to go on; stopping leaves the corpus unchanged.
pub struct ProgressReceiver<'a>(&'a mut dyn FnMut(ProgressStep<'_>) -> ControlFlow<()>);

impl<'a> ProgressReceiver<'a> {
    /// Returns progress that calls `hear` at each step.
    pub fn new(hear: &'a mut dyn FnMut(ProgressStep<'_>) -> ControlFlow<()>) -> Self {
        Self(hear)
    }

    /// Reports a step.
    ///
    /// # Errors
    /// [`CorpusError::Stopped`] if the receiver asks to stop.
    pub fn report_step(&mut self, step: ProgressStep<'_>) -> CorpusResult<()> {
        match (self.0)(step) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(CorpusError::Stopped),
        }
    }
}

/// Ignores the step and never stops.
pub fn ignore_progress_step(_: ProgressStep<'_>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
