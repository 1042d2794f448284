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

/// Something that hears of the steps of long work, such as a progress bar or a closure.
pub trait ProgressListener {
    /// Hears of a step, and decides whether the work goes on.
    fn hear_progress_step(&mut self, step: ProgressStep<'_>) -> ControlFlow<()>;
}

impl<F: FnMut(ProgressStep<'_>) -> ControlFlow<()>> ProgressListener for F {
    fn hear_progress_step(&mut self, step: ProgressStep<'_>) -> ControlFlow<()> {
        self(step)
    }
}

/// Receiver of every [`ProgressStep`], which decides whether to go on; stopping leaves the corpus unchanged.
pub struct ProgressReceiver<'a>(Option<&'a mut dyn ProgressListener>);

impl<'a> ProgressReceiver<'a> {
    /// Returns progress that a listener hears.
    pub fn new(listener: &'a mut dyn ProgressListener) -> Self {
        Self(Some(listener))
    }

    /// Returns a receiver that nobody listens to, and that never stops the work.
    #[must_use]
    pub fn silent_progress() -> Self {
        Self(None)
    }

    /// Reports a step.
    ///
    /// # Errors
    /// [`CorpusError::Stopped`] if the receiver asks to stop.
    pub fn report_step(&mut self, step: ProgressStep<'_>) -> CorpusResult<()> {
        let heard = self.0.as_mut().map(|listener| listener.hear_progress_step(step));
        match heard {
            Some(ControlFlow::Break(())) => Err(CorpusError::Stopped),
            _ => Ok(()),
        }
    }

    /// Reports the amount of a task that is done, and the total amount if it is known.
    ///
    /// # Errors
    /// [`CorpusError::Stopped`] if the receiver asks to stop.
    pub fn report_amount(&mut self, unit: ProgressUnit, task: &str, done: u64, total: Option<u64>) -> CorpusResult<()> {
        self.report_step(ProgressStep {
            task,
            done,
            total,
            unit,
        })
    }

    /// Reports that `done` of all items of a task are done.
    ///
    /// # Errors
    /// [`CorpusError::Stopped`] if the receiver asks to stop.
    pub fn report_items(&mut self, task: &str, done: usize, total: usize) -> CorpusResult<()> {
        self.report_amount(ProgressUnit::Items, task, done as u64, Some(total as u64))
    }

    /// Reports that `done` of all frames of a task are done.
    ///
    /// # Errors
    /// [`CorpusError::Stopped`] if the receiver asks to stop.
    pub fn report_frames(&mut self, task: &str, done: usize, total: usize) -> CorpusResult<()> {
        self.report_amount(ProgressUnit::Frames, task, done as u64, Some(total as u64))
    }
}

/// Ignores the step and never stops.
pub fn ignore_progress_step(_: ProgressStep<'_>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
