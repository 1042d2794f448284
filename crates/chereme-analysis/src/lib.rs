//! Turns movement into annotations and scores: transcription, similarity, measurements, proposals.
//!
//! | module | holds |
//! |---|---|
//! | [`agreement`](mod@agreement) | how far annotators agree: on values, on spans, on both |
//! | [`align`](mod@align) | the shift at which two signals of one event are most similar |
//! | [`cue`](mod@cue) | captured cued speech: models, restoration, recognisers, targets, generated sessions |
//! | [`cut`](mod@cut) | a take cut into signs, and hands into phases of movement |
//! | [`detect`] | detectors behind one trait: spans, fields, values and confidences |
//! | [`dtw`] | dynamic time warping: alignments, distances, nearest neighbours |
//! | [`kinematics`](mod@kinematics) | speed, aperture and palm direction of the hands, frame by frame |
//! | [`map`] | a map of things by similarity |
//! | [`measure`](mod@measure) | the size and duration of movements of a known kind |
//! | [`nonmanuals`] | proposals for brows, lids, gaze, mouth and head from curves of a face |
//! | [`phases`] | similarity of two expressions of the face, phase by phase |
//! | [`random`] | random numbers from a seed |
//! | [`score`](mod@score) | similarity of two performances, component by component, with their alignment |
//! | [`statistics`] | tests, effects and intervals for answers of people |
//! | [`strokes`](mod@strokes) | transitions of wrists and fingers between two minima of their speed |
//! | [`transcribe`](mod@transcribe) | the notation of a sign: HamNoSys with residuals |

pub mod agreement;
pub mod align;
pub mod cue;
pub mod cut;
pub mod detect;
pub mod dtw;
pub mod kinematics;
pub mod map;
pub mod measure;
pub mod nonmanuals;
pub mod phases;
pub mod random;
pub mod score;
pub mod statistics;
pub mod strokes;
pub mod transcribe;

#[cfg(test)]
#[path = "../../../tests/shared/golden.rs"]
mod golden;
#[cfg(test)]
mod tests;
#[cfg(test)]
#[path = "../../../tests/shared/tuned_faults.rs"]
mod tuned_faults;

pub use kinematics::{ClipKinematicCurves, compute_kinematic_curves};
pub use measure::measure_hand_movement;
pub use score::{ClipSimilarityScore, ScoreError, ScoreOptions, score_clips};
pub use transcribe::{TokenTranscription, transcribe_clip};
