//! How long work reports its progress, and receives the request to stop.

use std::ops::ControlFlow;

use crate::error::{Error, Result};

/// Where long work is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step<'a> {
    /// The current task, such as a file's name.
    pub task: &'a str,
    /// How much of it is done.
    pub done: u64,
    /// The total amount, if it is known.
    pub total: Option<u64>,
    /// What is counted.
    pub unit: Unit,
}

/// What [`Step`] counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Bytes of a file.
    Bytes,
    /// Frames of movement.
    Frames,
    /// Anything else that can be counted.
    Items,
}

/// Hears of every [`Step`] and says whether to go on; stopping leaves the corpus as it was.
pub struct Progress<'a>(&'a mut dyn FnMut(Step<'_>) -> ControlFlow<()>);

impl<'a> Progress<'a> {
    /// Returns progress that calls `hear` at each step.
    pub fn new(hear: &'a mut dyn FnMut(Step<'_>) -> ControlFlow<()>) -> Self {
        Self(hear)
    }

    /// Reports a step.
    ///
    /// # Errors
    /// [`Error::Stopped`] where the listener says so.
    pub fn tell(&mut self, step: Step<'_>) -> Result<()> {
        match (self.0)(step) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Error::Stopped),
        }
    }
}

/// Hears nothing and never stops.
pub fn unheard(_: Step<'_>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
