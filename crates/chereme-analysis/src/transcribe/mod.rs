//! From movement to notation: the signs of HamNoSys that a captured or made sign would be written with.
//!
//! [`transcribe`] looks at one token (a few seconds of a clip) and tells each feature of notation with
//! how far the movement is from it and what would have come next: handshapes by joint angles, the
//! hand's axis and palm by directions, places by distance to those the animator would go to, movement
//! by what is between minima of speed. What the categories mean in numbers comes from the same tables
//! that notation is animated with ([`chereme_sign::hamnosys::angles`], [`sites`] and the
//! [`BodyLanguage`]), so that the one is the other's inverse.
//!
//! [`sites`]: chereme_sign::hamnosys::sites
//!
//! | module | holds |
//! |---|---|
//! | `scene` | the hands in the signer's own space, frame by frame |
//! | `steady` | joints that tremble from frame to frame are smoothed |
//! | `shape`, `aim`, `place` | the nearest handshape, direction, palm, place |
//! | `way`, `acts` | ways through space; what a hand does, act after act |
//! | `hands` | symmetry of the two |
//! | `tree` | the sign's tree and its features |
//! | `proof` | where hands are told to be, proven by performing it |

mod acts;
mod aim;
mod hands;
mod place;
mod proof;
mod scene;
mod shape;
mod steady;
mod tree;
pub(crate) mod way;
mod words;

#[cfg(test)]
mod tests;

use chereme_motion::{Anatomy, Clip, Side};
use chereme_sign::hamnosys::{BodyLanguage, BodyPlace, Sign};
use serde::Serialize;

pub use proof::MOST_POSTURES;

/// How a token is transcribed.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The dominant hand. Notation of a left-handed signer is that of a right-handed one: left and right
    /// are exchanged.
    pub dominant: Side,
    /// What the categories of notation mean in numbers.
    pub language: BodyLanguage,
    /// Whether half-way between two directions or palms may be said.
    pub between: bool,
    /// The longest token in seconds.
    pub longest: f64,
    /// How near a hand comes to a place that is meant, in metres: the body's places, some of them an average
    /// person's, and the signer's care. Notation that takes more to say must be nearer by a share of this.
    pub slack: f64,
}

impl Default for Options {
    /// A captured signer: right-handed, the program's own body language, half-way directions, 60 seconds, and
    /// 2 cm about places.
    fn default() -> Self {
        Self {
            dominant: Side::Right,
            language: BodyLanguage::usual().clone(),
            between: true,
            longest: 60.0,
            slack: 0.02,
        }
    }
}

impl Options {
    /// Returns those for made movement, whose hands are at their places to 4 mm.
    #[must_use]
    pub fn made() -> Self {
        Self {
            slack: MADE,
            ..Self::default()
        }
    }
}

/// How near made hands come to their places, in metres.
const MADE: f64 = 0.004;

/// Why a token cannot be transcribed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TranscribeError {
    /// The clip has no frame.
    #[error("the clip has no frames; transcribe a stretch of at least one")]
    Empty,
    /// It is longer than a token.
    #[error(
        "{seconds:.0} s are too long for one sign; give the span of a token of at most {most:.0} s"
    )]
    TooLong {
        /// How long it is.
        seconds: f64,
        /// How long it may be.
        most: f64,
    },
    /// The skeleton shows no arm on a trunk.
    #[error(
        "the skeleton has no arm with shoulder, elbow and wrist on a trunk; name them in a roles file"
    )]
    NoBody,
}

/// The notation of a token, with how sure each of its features is.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Transcription {
    /// The notation.
    pub sign: Sign,
    /// What was told, in the order of the notation.
    pub features: Vec<Feature>,
    /// The posture at the beginning and what is done after it, in the order of the notation.
    pub stages: Vec<Stage>,
    /// The frames of the sign itself, ways from and to rest cut off: its first, and the one after
    /// its last.
    pub frames: (usize, usize),
    /// What could not be told, and why.
    pub findings: Vec<String>,
}

/// The posture that a sign begins with, or something that is done.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Stage {
    /// The number of the action, from 1; nothing for the posture at the beginning.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub action: Option<usize>,
    /// The hand, where each does something for itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hand: Option<Side>,
    /// Its first frame, and the one after its last, all repetitions counted in.
    pub frames: (usize, usize),
    /// Its HamNoSys.
    pub text: String,
}

/// A feature of the notation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Feature {
    /// What it is about.
    pub kind: FeatureKind,
    /// The hand, where it is about one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hand: Option<Side>,
    /// The frame in which it is seen, or the first frame of what it is about.
    pub frame: usize,
    /// The frames of the posture or action that it belongs to: the first, and the one after the last.
    pub frames: (usize, usize),
    /// The number of the action it belongs to, from 1; nothing for the posture at the beginning.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub action: Option<usize>,
    /// What it is, in words.
    pub value: String,
    /// Its HamNoSys; empty where that is to write nothing.
    pub text: String,
    /// How far the movement is from it.
    pub residual: f64,
    /// The unit of residuals.
    pub unit: Unit,
    /// What would have come next.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub runner_up: Option<RunnerUp>,
}

/// What a feature is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FeatureKind {
    /// Which hands act, and by which symmetry.
    Hands,
    /// The handshape.
    Handshape,
    /// Where the hand's axis points.
    Direction,
    /// Where the palm faces.
    Palm,
    /// The place.
    Location,
    /// How near the hand comes to it, or the hands to each other.
    Contact,
    /// The kind of movement.
    Movement,
    /// Where a movement goes, or the axis of a circle.
    Course,
    /// The size of a movement.
    Size,
    /// In which manner it is done.
    Manner,
    /// How often it is done.
    Repetition,
}

impl FeatureKind {
    /// Returns its name.
    #[must_use]
    pub fn name(self) -> &'static str {
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
pub enum Unit {
    /// Degrees.
    #[serde(rename = "deg")]
    Degrees,
    /// Centimetres.
    #[serde(rename = "cm")]
    Centimetres,
    /// A share of what it is compared with.
    #[serde(rename = "share")]
    Share,
}

impl Unit {
    /// Returns its sign.
    #[must_use]
    pub fn sign(self) -> &'static str {
        match self {
            Self::Degrees => "°",
            Self::Centimetres => " cm",
            Self::Share => "",
        }
    }
}

/// What would have come next.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunnerUp {
    /// What it is, in words.
    pub value: String,
    /// Its HamNoSys.
    pub text: String,
    /// How far the movement is from it, in the unit of the feature.
    pub residual: f64,
}

/// Returns the notation of a token: of the whole clip, which should hold one sign and little else.
///
/// `anatomy` belongs to the clip's skeleton. Ways from and to hands at rest are left out; where the
/// clip begins within the sign, everything is taken for it.
///
/// # Errors
/// [`TranscribeError`]: no frames, longer than a token, or no arm on a trunk.
pub fn transcribe(
    clip: &Clip,
    anatomy: &Anatomy,
    options: &Options,
) -> Result<Transcription, TranscribeError> {
    looked_at(clip, anatomy, options, None)
}

/// Makes movement of notation on the body that is transcribed.
pub trait Performs {
    /// Returns the body as it is when the first posture of a sign is reached, as a clip of one frame; nothing where
    /// that cannot be made.
    fn begins(&self, sign: &Sign) -> Option<Clip>;

    /// As [`begins`](Self::begins), of each of many signs, some of them at the same time where that can be.
    fn begin_all(&self, signs: &[Sign]) -> Vec<Option<Clip>> {
        signs.iter().map(|sign| self.begins(sign)).collect()
    }

    /// Returns the movement of a sign without the ways from and to rest, likewise.
    fn performs(&self, sign: &Sign) -> Option<Clip>;
}

/// As [`transcribe`], of movement that was made from notation: where hands are told to be is proven by performing
/// it.
///
/// A hand that should touch the trunk is moved out of it, one that is turned too far stops, one that has room
/// gives way to its arm: it is not at its place then, but where performing what is meant brings it. Where what is
/// told would bring it elsewhere, what may be meant instead is performed, [`MOST_POSTURES`] at most, and told if it
/// brings the hand to within millimetres of where it is. Nobody else's movement comes back so exactly: captured signs
/// are for [`transcribe`].
///
/// # Errors
/// As there.
pub fn transcribe_proven(
    clip: &Clip,
    anatomy: &Anatomy,
    options: &Options,
    performs: &dyn Performs,
) -> Result<Transcription, TranscribeError> {
    looked_at(clip, anatomy, options, Some(performs))
}

fn looked_at(
    clip: &Clip,
    anatomy: &Anatomy,
    options: &Options,
    performs: Option<&dyn Performs>,
) -> Result<Transcription, TranscribeError> {
    let steadied = steady::steadied(clip);
    let clip = steadied.as_ref().map_or(clip, |steadied| &steadied.clip);
    let scene = scene::Scene::of(clip, anatomy, options)?;
    let sight = tree::Sight::new(&scene, options);
    let mut found = proof::written(&sight, performs);
    if let Some(steady::Steadied { most, joints, .. }) = steadied {
        found.findings.push(format!(
            "{joints} joints tremble from frame to frame, by {most:.1}° at most: they were smoothed"
        ));
    }
    Ok(found)
}

/// Tells whether two handshapes look the same: their angles differ by less than a degree, so that no
/// measurement tells them apart.
#[must_use]
pub fn looks_the_same(
    a: &chereme_sign::hamnosys::Handshape,
    b: &chereme_sign::hamnosys::Handshape,
    language: &BodyLanguage,
) -> bool {
    shape::is_same(a, b, language)
}

/// Returns how far a hand is in a frame from a place that notation names, in metres, and how far the
/// places are from each other where a hand would be sent to; `symmetric` where both hands act alike.
///
/// Nothing where the skeleton lacks the hand or the place.
///
/// # Errors
/// As [`transcribe`]'s.
pub fn off_place(
    clip: &Clip,
    anatomy: &Anatomy,
    options: &Options,
    frame: usize,
    places: (&BodyPlace, Option<&BodyPlace>),
    symmetric: bool,
) -> Result<Option<(f64, f64)>, TranscribeError> {
    let scene = scene::Scene::of(clip, anatomy, options)?;
    Ok(tree::off_place(&scene, options, frame, places, symmetric))
}

/// The best of many, with how far off it is and what came next.
#[derive(Debug, Clone, PartialEq)]
struct Found<T> {
    best: T,
    residual: f64,
    runner_up: Option<(T, f64)>,
}

impl<T: Clone> Found<T> {
    /// Picks the lowest score among values with residuals and scores; there is at least one.
    fn of(mut all: Vec<(T, f64, f64)>) -> Self {
        all.sort_by(|a, b| a.2.total_cmp(&b.2));
        Self {
            best: all[0].0.clone(),
            residual: all[0].1,
            runner_up: all.get(1).map(|next| (next.0.clone(), next.1)),
        }
    }

    /// Turns radians into degrees.
    fn degrees(self) -> Self {
        Self {
            residual: self.residual.to_degrees(),
            runner_up: self
                .runner_up
                .map(|(value, residual)| (value, residual.to_degrees())),
            ..self
        }
    }
}
