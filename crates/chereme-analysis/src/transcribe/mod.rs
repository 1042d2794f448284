//! Transcribes movement: infers the HamNoSys with which a captured or synthesised sign would be written.
//!
//! [`transcribe_clip`] reads one token (a few seconds of a clip) and returns each feature of the notation with
//! its residual and its runner-up: handshapes by joint angles, the hand's axis and palm by directions,
//! places by the distance to where the animator would put the hand, movement by the stretches between
//! minima of speed. The meaning of each category in numbers comes from the tables that the animator uses
//! ([`chereme_sign::hamnosys::angles`], [`sites`] and the [`BodyLanguage`]), so that transcription inverts
//! animation.
//!
//! Readings compete by penalties in nepers, which are natural logarithms: a reading with one neper more is
//! e times less likely. A longer notation costs nepers, as does a hand that is far from its notated place.
//!
//! [`sites`]: chereme_sign::hamnosys::sites
//!
//! | module | holds |
//! |---|---|
//! | `scene` | trajectories of the hands in the signer's own space, frame by frame |
//! | `denoise` | smoothing of joints that tremble from frame to frame |
//! | `shape`, `aim`, `place` | the nearest handshape, direction, palm, place |
//! | `path`, `acts` | paths through space; the acts of a hand |
//! | `hands` | symmetry of the two hands |
//! | `tree` | the sign's tree and its features |
//! | `precision` | how exactly the hands hold the intended directions and handshapes |
//! | `resynthesis` | verification of movements, places and orientations by re-synthesis |
//! | `tuned` | the tuned numbers, which are data: `schema/notation/reading.json` |

mod acts;
mod aim;
mod denoise;
mod precision;
mod resynthesis;
mod transcribe_hands;
pub(crate) mod transcribe_path;
mod transcribe_place;
mod transcribe_scene;
mod transcribe_shape;
mod transcribe_tree;
mod transcribe_tuned;
mod transcribe_words;

#[cfg(test)]
mod table_tests;
#[cfg(test)]
pub(crate) mod tests;

use chereme_motion::{BodyAnatomy, BodySide, Clip, HandCorrection, TimeSpan};
use chereme_sign::hamnosys::{BodyLanguage, BodyPlace, HamnosysSign, NonmanualActs, NotatedSign};
use serde::Serialize;

pub use resynthesis::MOST_TRIALS;
pub use resynthesis::replaced::list_single_acts;
pub use transcribe_tree::HeldReading;

use transcribe_tuned::tuned;

/// Settings of a transcription.
#[derive(Debug, Clone, PartialEq)]
pub struct TranscribeOptions {
    /// The dominant hand. The notation of a left-handed signer is that of a right-handed one: left and
    /// right are exchanged.
    pub dominant: BodySide,
    /// The body language: the meaning of each category of notation in numbers.
    pub language: BodyLanguage,
    /// Whether directions or palms half-way between two are candidates.
    pub between: bool,
    /// The longest token in seconds.
    pub longest: f64,
    /// Expected distance (m) between a hand and its intended place: some of the body's places are an
    /// average person's, and signers are not exact. Longer notation must be nearer by a share of this.
    pub slack: f64,
    /// Corrections of the finger angles of the right and the left hand, as the signer's takes show them.
    pub hands: [HandCorrection; 2],
}

impl Default for TranscribeOptions {
    /// Settings for a captured signer: right-handed, the program's own body language, half-way directions,
    /// tokens of at most 60 seconds, and 2 cm of slack about places; less if the hands keep their
    /// directions as exactly as synthesised ones.
    fn default() -> Self {
        Self {
            dominant: BodySide::Right,
            language: BodyLanguage::default_body_language().clone(),
            between: true,
            longest: 60.0,
            slack: 0.02,
            hands: [HandCorrection::default(); 2],
        }
    }
}

impl TranscribeOptions {
    /// Returns the settings for synthesised movement, whose hands are within 4 mm of their places.
    #[must_use]
    pub fn synthesised_options() -> Self {
        Self {
            slack: tuned().reading.made,
            ..Self::default()
        }
    }
}

/// The reason why a token cannot be transcribed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TranscribeError {
    /// The clip has no frames.
    #[error("the clip has no frames; transcribe a stretch of at least one")]
    Empty,
    /// The clip is longer than a token may be.
    #[error("{seconds:.0} s are too long for one sign; give the span of a token of at most {most:.0} s")]
    TooLong {
        /// Its length in seconds.
        seconds: f64,
        /// The longest length in seconds.
        most: f64,
    },
    /// The skeleton has no arm on a trunk.
    #[error("the skeleton has no arm with shoulder, elbow and wrist on a trunk; name them in a roles file")]
    NoBody,
}

/// The notation of a token, with the error of each feature.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TokenTranscription {
    /// The notation.
    pub sign: HamnosysSign,
    /// The features, in the order of the notation.
    pub features: Vec<NotationFeature>,
    /// The first posture and then each action, in the order of the notation.
    pub stages: Vec<TranscriptionStage>,
    /// The frames of the sign itself, without the paths from and to rest: its first, and the one after its
    /// last.
    pub frames: (usize, usize),
    /// The acts of trunk, head and shoulders. Only re-synthesis reads them.
    #[serde(skip_serializing_if = "NonmanualActs::is_empty")]
    pub nonmanual: NonmanualActs,
    /// Warnings: features that could not be read, with the reasons.
    pub findings: Vec<String>,
}

/// The posture that a sign begins with, or one of its actions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TranscriptionStage {
    /// The number of the action, from 1; `None` for the first posture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub action: Option<usize>,
    /// The hand, if each hand acts for itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hand: Option<BodySide>,
    /// Its first frame, and the one after its last, repetitions included.
    pub frames: (usize, usize),
    /// Its HamNoSys.
    pub text: String,
}

/// One feature of the notation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NotationFeature {
    /// The kind of feature.
    pub kind: FeatureKind,
    /// The hand; `None` if the feature concerns both.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hand: Option<BodySide>,
    /// The frame in which it was measured, or the first frame of a movement.
    pub frame: usize,
    /// The frames of the posture or action that it belongs to: the first, and the one after the last.
    pub frames: (usize, usize),
    /// The number of the action it belongs to, from 1; `None` for the first posture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub action: Option<usize>,
    /// The value in words.
    pub value: String,
    /// Its HamNoSys; empty if the value is written by omission.
    pub text: String,
    /// The distance between the movement and this value, in [`unit`](Self::unit). If re-synthesis replaced the first value,
    /// how far the re-synthesised hands are from the observed ones, on average; the first value is the runner-up.
    pub residual: f64,
    /// The unit of residuals.
    pub unit: ResidualUnit,
    /// The second best value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub runner_up: Option<RunnerUp>,
}

/// The kinds of features.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FeatureKind {
    /// The hands that act, and their symmetry.
    Hands,
    /// The handshape.
    Handshape,
    /// The direction of the hand's axis.
    Direction,
    /// The direction of the palm.
    Palm,
    /// The place.
    Location,
    /// The distance of the hand from its place, or of the hands from each other.
    Contact,
    /// The kind of movement.
    Movement,
    /// The direction of a movement, or the axis of a circle.
    Course,
    /// The size of a movement.
    Size,
    /// The manner of a movement: fast, slow, tense, sudden stop, after a rest.
    Manner,
    /// The number of repetitions.
    Repetition,
}

impl FeatureKind {
    /// Returns its name.
    #[must_use]
    pub fn feature_kind_name(self) -> &'static str {
        match self {
            Self::Hands => "hands",
            Self::Handshape => "handshape",
            Self::Direction => "direction",
            Self::Palm => "palm",
            Self::Location => "location",
            Self::Contact => "contact",
            Self::Movement => "movement",
            Self::Course => "course",
            Self::Size => "size",
            Self::Manner => "manner",
            Self::Repetition => "repetition",
        }
    }
}

/// The unit of a residual.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum ResidualUnit {
    /// Degrees.
    #[serde(rename = "deg")]
    Degrees,
    /// Centimetres.
    #[serde(rename = "cm")]
    Centimetres,
    /// A fraction of the value that it is compared with.
    #[serde(rename = "share")]
    Share,
}

impl ResidualUnit {
    /// Returns the unit's symbol.
    #[must_use]
    pub fn residual_unit_symbol(self) -> &'static str {
        match self {
            Self::Degrees => "°",
            Self::Centimetres => " cm",
            Self::Share => "",
        }
    }
}

/// The second best value of a feature.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunnerUp {
    /// The value in words.
    pub value: String,
    /// Its HamNoSys.
    pub text: String,
    /// The distance between the movement and this value, in the unit of the feature.
    pub residual: f64,
}

/// Returns the notation of a token: of the whole clip, which should hold one sign and little else.
///
/// `anatomy` belongs to the clip's skeleton. Paths from and to hands at rest are left out; a clip that
/// begins within the sign is read as a whole.
///
/// # Errors
/// [`TranscribeError`]: no frames, longer than a token, or no arm on a trunk.
pub fn transcribe_clip(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    options: &TranscribeOptions,
) -> Result<TokenTranscription, TranscribeError> {
    looked_at(clip, anatomy, options, None)
}

/// Synthesises movement from notation, on the body that is transcribed.
pub trait NotationSynthesiser {
    /// Returns the body at the moment when it reaches the first posture of a sign, as a clip of one frame;
    /// `None` if that cannot be synthesised.
    fn synthesise_first_posture(&self, sign: &NotatedSign) -> Option<Clip>;

    /// Like [`synthesise_first_posture`](Self::synthesise_first_posture), for many signs; implementations may work on several at once.
    fn begin_all(&self, signs: &[NotatedSign]) -> Vec<Option<Clip>> {
        signs.iter().map(|sign| self.synthesise_first_posture(sign)).collect()
    }

    /// Returns the movement of a sign without the paths from and to rest; `None` if that cannot be
    /// synthesised.
    fn synthesise_notated_sign(&self, sign: &NotatedSign) -> Option<Clip>;

    /// Like [`performs`](Self::synthesise_notated_sign), for many signs; implementations may work on several at once.
    fn perform_all(&self, signs: &[NotatedSign]) -> Vec<Option<Clip>> {
        signs.iter().map(|sign| self.synthesise_notated_sign(sign)).collect()
    }
}

/// Like [`transcribe_clip`], for movement that was synthesised from notation: verifies movements and places by
/// re-synthesis.
///
/// Right notation, animated again, moves the hands exactly as observed. If the first reading does not, similar movements
/// are animated, and properties are replaced one after the other while the hands come nearer. A movement that comes much
/// nearer replaces the first one with its features, and a finding names both.
///
/// Acts of trunk, head and shoulders move the hands and their places. So they are read first, by the joints that they turn.
///
/// The animator pushes a hand out of the trunk that should touch it, keeps it clear of the other hand, stops it at
/// its joint limits, and lets it give way to its arm within the room of its place. Such a hand is not at its notated
/// place, but the right place puts it exactly at the observed position. If the first reading misses it, alternative
/// readings are synthesised, at most [`MOST_TRIALS`] of movements and places. One that puts the hands within millimetres
/// of their observed positions is reported; or, since a misread movement displaces them, one whose first posture alone does so,
/// or one that misses them by much less than the first. If other orientations bring the hands much nearer to the observed
/// ones, they are read. Findings report what is not explained. Captured movement is never reproduced that exactly: use
/// [`transcribe_clip`] for it.
///
/// # Errors
///
/// The same as [`transcribe_clip`]'s.
pub fn transcribe_proven(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    options: &TranscribeOptions,
    performs: &dyn NotationSynthesiser,
) -> Result<TokenTranscription, TranscribeError> {
    looked_at(clip, anatomy, options, Some(performs))
}

fn looked_at(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    options: &TranscribeOptions,
    performs: Option<&dyn NotationSynthesiser>,
) -> Result<TokenTranscription, TranscribeError> {
    // Synthesised movement has no noise, but its fast repetitions look like some.
    let steadied = match performs {
        Some(_) => None,
        None => denoise::steady_trembling_clip(clip),
    };
    let clip = steadied.as_ref().map_or(clip, |steadied| &steadied.clip);
    let mut transcription = read_scene(clip, anatomy, options, |sight| {
        resynthesis::write_verified_notation(sight, performs)
    })?;
    if let Some(denoise::SteadiedClip { most, joints, .. }) = steadied {
        transcription.findings.push(format!(
            "{joints} joints tremble from frame to frame, by {most:.1}° at most: they were smoothed"
        ));
    }
    Ok(transcription)
}

/// Reads the readings of a scene by a function; hands as exact as synthesised ones are read with less slack about places.
fn read_scene<T>(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    options: &TranscribeOptions,
    read: impl for<'s> FnOnce(&'s transcribe_tree::SceneReadings<'s>) -> T,
) -> Result<T, TranscribeError> {
    let scene = transcribe_scene::SignerScene::read_signer_scene(clip, anatomy, options)?;
    let sight = transcribe_tree::SceneReadings::new(&scene, options);
    let slack = precision::expected_place_slack(&scene, &sight);
    if options.slack <= slack {
        return Ok(read(&sight));
    }
    let closer = TranscribeOptions {
        slack,
        ..options.clone()
    };
    let scene = transcribe_scene::SignerScene::read_signer_scene(clip, anatomy, &closer)?;
    Ok(read(&transcribe_tree::SceneReadings::new(&scene, &closer)))
}

/// Returns the postures of a sign at its holds: fingers, place and palm of each hand, each at its own time.
///
/// `sign` counts from the clip's first frame, and the clip should show 0.4 s on both sides of it.
///
/// # Errors
/// The same as [`transcribe_clip`]'s.
pub fn transcribe_holds(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    options: &TranscribeOptions,
    sign: TimeSpan,
) -> Result<Vec<HeldReading>, TranscribeError> {
    let steadied = denoise::steady_trembling_clip(clip);
    let clip = steadied.as_ref().map_or(clip, |steadied| &steadied.clip);
    read_scene(clip, anatomy, options, |sight| {
        transcribe_tree::read_held_postures(sight, sign)
    })
}

/// Returns whether two handshapes look the same: their angles differ by less than a degree, which is below
/// the error of measurement.
#[must_use]
pub fn looks_the_same(
    a: &chereme_sign::hamnosys::Handshape,
    b: &chereme_sign::hamnosys::Handshape,
    language: &BodyLanguage,
) -> bool {
    transcribe_shape::is_same(a, b, language)
}

/// Returns the distance (m) between a hand in a frame and a notated place, and the distance between the
/// goals of that place and of a second one; `symmetric` if both hands act alike.
pub fn off_place(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    options: &TranscribeOptions,
    frame: usize,
    place: &BodyPlace,
    other: Option<&BodyPlace>,
    symmetric: bool,
) -> Result<Option<(f64, f64)>, TranscribeError> {
    let scene = transcribe_scene::SignerScene::read_signer_scene(clip, anatomy, options)?;
    Ok(transcribe_tree::off_place(
        &scene, options, frame, place, other, symmetric,
    ))
}

/// The best of many candidates, with its residual and the runner-up.
#[derive(Debug, Clone, PartialEq)]
struct BestReading<T> {
    best: T,
    residual: f64,
    runner_up: Option<(T, f64)>,
}

impl<T: Clone> BestReading<T> {
    /// Picks the lowest score among values with residuals and scores; the list must not be empty.
    fn pick_best_reading(mut all: Vec<(T, f64, f64)>) -> Self {
        all.sort_by(|a, b| a.2.total_cmp(&b.2));
        Self {
            best: all[0].0.clone(),
            residual: all[0].1,
            runner_up: all.get(1).map(|next| (next.0.clone(), next.1)),
        }
    }

    /// Converts the residuals from radians to degrees.
    fn residuals_to_degrees(self) -> Self {
        Self {
            residual: self.residual.to_degrees(),
            runner_up: self.runner_up.map(|(value, residual)| (value, residual.to_degrees())),
            ..self
        }
    }
}
