//! How long work tells where it is, and hears that it should stop.

use std::ops::ControlFlow;

use crate::error::{Error, Result};

/// Where long work is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step<'a> {
    /// What is being done, such as a file's name.
    pub task: &'a str,
    /// How much of it is done.
    pub done: u64,
    /// How much there is, where that is known.
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
    /// Returns progress that is told to `hear`.
    pub fn new(hear: &'a mut dyn FnMut(Step<'_>) -> ControlFlow<()>) -> Self {
        Self(hear)
    }

    /// Tells where the work is.
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
