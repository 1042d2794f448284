//! Progress reports of long work, and requests to stop it.

use std::ops::ControlFlow;

use crate::error::{Error, Result};

/// The current state of long work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step<'a> {
    /// The current task, such as a file's name.
    pub task: &'a str,
    /// The amount that is done.
    pub done: u64,
    /// The total amount, if it is known.
    pub total: Option<u64>,
    /// The unit of the amounts.
    pub unit: Unit,
}

/// Unit of the amounts in a [`Step`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Bytes of a file.
    Bytes,
    /// Frames of movement.
    Frames,
    /// Anything else that can be counted.
    Items,
}

/// Receiver of every [`Step`], which decides whether to go on; stopping leaves the corpus unchanged.
pub struct Progress<'a>(&'a mut dyn FnMut(Step<'_>) -> ControlFlow<()>);

impl<'a> Progress<'a> {
    /// Returns progress that calls `hear` at each step.
    pub fn new(hear: &'a mut dyn FnMut(Step<'_>) -> ControlFlow<()>) -> Self {
        Self(hear)
    }

    /// Reports a step.
    ///
    /// # Errors
    /// [`Error::Stopped`] if the receiver asks to stop.
    pub fn report(&mut self, step: Step<'_>) -> Result<()> {
        match (self.0)(step) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(Error::Stopped),
        }
    }
}

/// Ignores the step and never stops.
pub fn unheard(_: Step<'_>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}
