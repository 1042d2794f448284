//! Strings of generated signs with the true times of their signs.

use std::path::Path;
use std::sync::Arc;

use chereme_analysis::random::RandomNumbers;
use chereme_compose::notation::{AnimatorSettings, animate_signs};
use chereme_compose::{GeneratedMovement, MovementMaterial, NoteSubject};
use chereme_motion::glam::DQuat;
use chereme_motion::{Clip, FrameRate, JointChannel, RecordingInstant, TimeSpan};
use chereme_sign::SignComponent;
use chereme_sign::hamnosys::NotatedSign;

use crate::{Result, TrueTake, bodies};

/// How many signs a string has.
const STRING_SIGN_COUNT: usize = 8;
/// The seed of everything.
const STRINGS_SEED: u64 = 56;
/// The tempi: the length of a take as a multiple of the animator's.
const STRING_TEMPI: [f64; 3] = [1.0, 0.75, 0.55];
/// Standard deviations of the noise of each joint, in degrees.
const NOISE_DEGREES: [f64; 3] = [0.0, 0.2, 0.5];

/// Generates strings of signs of one half of the names.
pub(crate) fn generate_strings(folder: &Path, body: &Path, count: usize, is_tuned: bool) -> Result<Vec<TrueTake>> {
    let source = SignSource::open_half(folder, body, is_tuned)?;
    let mut random = RandomNumbers::new(STRINGS_SEED);
    let mut takes = Vec::new();
    for number in 0..count {
        let signs: Vec<&(String, NotatedSign)> = (0..STRING_SIGN_COUNT)
            .map(|_| &source.signs[random.random_below(source.signs.len())])
            .collect();
        takes.extend(source.take(&signs, number, &mut random));
    }
    Ok(takes)
}

/// Generates signs alone.
pub(crate) fn generate_isolated(folder: &Path, body: &Path, count: usize, is_tuned: bool) -> Result<Vec<TrueTake>> {
    let source = SignSource::open_half(folder, body, is_tuned)?;
    let mut random = RandomNumbers::new(STRINGS_SEED + 1);
    let mut takes = Vec::new();
    for number in 0..count {
        let sign = &source.signs[random.random_below(source.signs.len())];
        takes.extend(source.take(&[sign], number, &mut random));
    }
    Ok(takes)
}

struct SignSource {
    stage: MovementMaterial,
    signs: Vec<(String, NotatedSign)>,
}

impl SignSource {
    fn open_half(folder: &Path, body: &Path, is_tuned: bool) -> Result<Self> {
        let mut signs = bodies::signs(folder)?;
        signs.retain(|(name, _)| is_in_tuning_half(name) == is_tuned);
        Ok(Self {
            stage: bodies::stage(body)?,
            signs,
        })
    }

    /// Returns the take of signs; `None` if a sign cannot be performed.
    fn take(&self, signs: &[&(String, NotatedSign)], number: usize, random: &mut RandomNumbers) -> Option<TrueTake> {
        let settings = AnimatorSettings::default();
        let notated: Vec<&NotatedSign> = signs.iter().map(|(_, sign)| sign).collect();
        let made = animate_signs(&notated, &self.stage, &settings).ok()?;
        let tempo = STRING_TEMPI[number % STRING_TEMPI.len()];
        let noise = NOISE_DEGREES[(number / STRING_TEMPI.len()) % NOISE_DEGREES.len()];
        let names: Vec<&str> = signs.iter().map(|(name, _)| name.as_str()).collect();
        Some(TrueTake {
            name: names.join(" "),
            clip: disturbed(&made.clip, tempo, noise, random),
            anatomy: Arc::unwrap_or_clone(made.anatomy.clone()),
            signs: true_spans(&made, tempo),
        })
    }
}

/// Returns the half of a name, as the transcriber's example has it.
fn is_in_tuning_half(name: &str) -> bool {
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    (hash >> 32) & 1 == 0
}

/// Returns the time from the first to the last posture of each sign.
fn true_spans(made: &GeneratedMovement, tempo: f64) -> Vec<TimeSpan> {
    let glosses = made.notes.iter().filter(|note| note.about == NoteSubject::Gloss);
    let retimed = |instant: RecordingInstant| RecordingInstant::from_seconds(instant.instant_seconds() * tempo);
    let hull = |gloss: TimeSpan| {
        let shapes = made.notes.iter().filter(|note| {
            let is_shape = matches!(&note.about, NoteSubject::Component(SignComponent::Configuration, None));
            is_shape && note.span.is_overlapping_span(gloss)
        });
        let inside: Vec<TimeSpan> = shapes.filter_map(|note| note.span.span_intersection(gloss)).collect();
        let start = inside.iter().map(|span| span.span_start_instant()).min()?;
        let end = inside.iter().map(|span| span.span_end_instant()).max()?;
        Some(TimeSpan::span_between(retimed(start), retimed(end)))
    };
    glosses.filter_map(|gloss| hull(gloss.span)).collect()
}

/// Returns the movement at another tempo, with noise in every rotation.
fn disturbed(clip: &Clip, tempo: f64, noise: f64, random: &mut RandomNumbers) -> Clip {
    let rate: FrameRate = clip.clip_frame_rate();
    let frames = ((clip.clip_frame_count() as f64 * tempo) as usize).max(1);
    let retimed = clip.retime_clip(rate, frames, |frame| {
        RecordingInstant::from_seconds(rate.frame_start_instant(frame).instant_seconds() / tempo)
    });
    if noise == 0.0 {
        return retimed;
    }
    let skeleton = retimed.clip_skeleton().clone();
    let mut shaken = |channel: JointChannel| JointChannel {
        rotations: channel
            .rotations
            .into_iter()
            .map(|rotation| {
                let axes = [(); 3].map(|()| random.random_normal() * noise.to_radians());
                (rotation * DQuat::from_scaled_axis(axes.into())).normalize()
            })
            .collect(),
        ..channel
    };
    let channels = retimed.into_channels().into_iter().map(&mut shaken).collect();
    Clip::new(skeleton, rate, channels).expect("finite rotations")
}
