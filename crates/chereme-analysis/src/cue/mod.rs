//! Captured cued speech: models of hand and face, restoration of hidden markers, recognisers, targets, phases.
//!
//! Lengths are millimetres here, as marker systems write them; times are seconds; angles are radians.
//! After Gibert, Bailly, Elisei, Beautemps & Brun, *Evaluation of a speech cuer* (2004).
//!
//! | module | holds |
//! |---|---|
//! | [`cue_labels`] | the names of the markers of hand and face |
//! | [`rigid`] | the motion of head and forearm |
//! | [`pca`] | components, plain and guided |
//! | [`cue_hand`] | markers from angles, and restoration of hidden markers with a predicted error |
//! | [`cue_face`] | seven guided components, and the weights of the throat |
//! | [`gauss`] | recognisers of shapes and placements, with confusion tables |
//! | [`session`] | takes of one cuer: fingertips, bends, gestures of keys, recognition |
//! | [`cue_phases`] | begin and arrival of hand and fingers against the sounds |
//! | [`cue_targets`] | target frames of keys, arrival of the hand, quartiles |
//! | `generate` | for tests: generated sessions with known truth, from a seed |
//! | `linear`, `terms` | small matrices; the terms of the hand's regression |

pub mod cue_face;
pub mod cue_hand;
pub mod cue_labels;
pub mod cue_phases;
pub mod cue_targets;
mod cue_terms;
pub mod gauss;
#[cfg(any(test, feature = "testing"))]
#[path = "tests/generate/mod.rs"]
pub mod generate;
pub mod linear;
pub mod pca;
#[cfg(test)]
mod phase_tests;
pub mod rigid;
pub mod session;
#[cfg(test)]
mod tests;

/// The reason why a model cannot be learned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum ModelError {
    /// There are too few frames.
    #[error("{found} frames or examples can be used; {least} are needed, all of one length")]
    FewFrames {
        /// The number of frames.
        found: usize,
        /// The number of frames needed.
        least: usize,
    },
    /// A number is missing in every frame, or does not exist.
    #[error("number {0} of the frames is seen in none of them")]
    NeverSeen(usize),
    /// The equations have no unique solution.
    #[error("the frames do not differ enough: the equations have no one solution")]
    Singular,
}
