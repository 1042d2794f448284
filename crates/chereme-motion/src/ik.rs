//! Inverse kinematics: moves the elbow and rotates the joints of an arm so that the hand reaches its target.
//!
//! [`two_bone`] is the analytic solution for an arm; it keeps the swivel of the source (the rotation of the elbow about
//! the line from shoulder to wrist). It is continuous if the source is, and if the target does not pass straight behind
//! the shoulder. [`solve_fabrik`] is the iterative method of Aristidou & Lasenby 2011 (Graphical Models 73, DOI
//! 10.1016/j.gmod.2011.05.003) for chains of any length.

mod fabrik;
mod two_bone;

pub use fabrik::{FabrikChain, FabrikOptions, solve_fabrik};
pub use two_bone::{TwoBone, TwoBoneOptions, two_bone};

use glam::DVec3;

/// Why a reach has no solution; a target out of reach is not an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum IkError {
    /// A coordinate or an option is not a finite number.
    #[error("the {0} of the reach is no finite number")]
    NotFinite(&'static str),
    /// A bone has no length, so that its direction is unknown.
    #[error("the {0} has no length, so there is no way to turn it towards a target")]
    ZeroBone(&'static str),
    /// A chain has fewer than two points.
    #[error("a chain of {0} points has no bone to turn; it takes two points at least")]
    Short(usize),
}

fn finite(what: &'static str, points: &[DVec3]) -> Result<(), IkError> {
    if points.iter().all(|point| point.is_finite()) {
        Ok(())
    } else {
        Err(IkError::NotFinite(what))
    }
}

#[cfg(test)]
mod tests;
