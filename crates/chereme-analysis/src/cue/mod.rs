//! Captured cued speech: models of hand and face, restoration of hidden markers, recognisers, targets, phases.
//!
//! Lengths are millimetres here, as marker systems write them; times are seconds; angles are radians.
//! After Gibert, Bailly, Elisei, Beautemps & Brun, *Evaluation of a speech cuer* (2004).
//!
//! | module | holds |
//! |---|---|
//! | [`labels`] | the names of the markers of hand and face |
//! | [`rigid`] | the motion of head and forearm |
//! | [`pca`] | components, plain and guided |
//! | [`hand`] | angles to markers, and hidden markers restored with their error |
//! | [`face`] | seven guided components, and the weights of the throat |
//! | [`gauss`] | recognisers of shapes and placements, confusion tables |
//! | [`session`] | takes of one cuer: restored, recognised, with the targets and phases of their keys |
//! | [`targets`](mod@targets) | where keys are shown, when the hand arrives, quartiles |
//! | [`generate`] | seeded sessions with known truth |

pub mod face;
pub mod gauss;
pub mod generate;
pub mod hand;
pub mod labels;
pub mod linear;
pub mod pca;
pub mod rigid;
pub mod session;
pub mod targets;
mod terms;
#[cfg(test)]
mod tests;

/// Why no model can be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum ModelError {
    /// There is too little to learn from.
    #[error("{found} frames or examples can be used; {least} are needed, all of one length")]
    FewFrames {
        /// How many there are.
        found: usize,
        /// How many are needed.
        least: usize,
    },
    /// A number is missing in every frame, or does not exist.
    #[error("number {0} of the frames is seen in none of them")]
    NeverSeen(usize),
    /// Equations have no one solution.
    #[error("the frames do not differ enough: the equations have no one solution")]
    Singular,
}
