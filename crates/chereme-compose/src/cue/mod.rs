//! A cuer: cued speech from text or phones, on any body with an arm, fingers and a head.
//!
//! Keys come from [`chereme_sign::cue`], their times from [`PhaseRule`]. The tip of the pointing finger moves between
//! places of the head along minimum-jerk paths that bend around the lips, the fingers change from shape to shape, and
//! arm and hand follow; the mouth speaks the sounds.
//!
//! After Gibert, Bailly, Elisei, Beautemps & Brun, *Evaluation of a speech cuer* (2004).

mod compose_cue_hand;
mod cue_places;
pub mod dikey;
pub(crate) mod leaf;
mod mouth;

pub use crate::cue_timing::{CuePhases, KeySoundTimes, KeyTimes, KeyType, PhaseRule, key_sound_times, plan_key_times};

use chereme_motion::{BodySide, ModelPose, RecordingInstant, TimeSpan};
use chereme_sign::cue::{CuedUtterance, PhoneAlphabet, french, gloss_cue_key};
use chereme_sign::{ComponentReading, SignComponent, cue};

use crate::error::StepError;
use crate::explain::shorten_step_text;
use crate::face::faces_from_curves;
use crate::ops::join;
use crate::outcome::{CueTier, GeneratedNote, NoteSubject};
use crate::poses::HandPose;
use crate::recipe_settings::CueSettings;
use crate::work::{JointGroup, WorkingClip};
use cue_places::{CueHeadSpace, CuePathBow, CueSpot, LIP_CLEARANCE_M};

/// Factor on the usual durations of sounds, for people who cue.
const CUE_PACE_FACTOR: f64 = 1.6;
/// The least time before the first sound, in seconds.
const CUE_LEAD_S: f64 = 0.6;
/// The time for which the hand rests at either end, in seconds.
const CUE_REST_S: f64 = 0.2;
/// The time in which the hand comes to rest, in seconds.
const TO_REST: f64 = 0.4;
/// The shortest silence in which the hand rests, in seconds.
const RESTING_SILENCE_S: f64 = 0.25;
/// The name of the place between utterances.
const AT_REST: &str = "rest";
/// The number of the shape between utterances.
const REST_SHAPE_NUMBER: u8 = 0;

/// A key, or the rest between keys, with the times of hand and fingers.
struct CueTarget {
    placement: String,
    shape: u8,
    spot: CueSpot,
    times: KeyTimes,
    /// The bend of the tip's path to it.
    bow: CuePathBow,
    /// The span of the key's sounds; `None` at rest.
    key: Option<TimeSpan>,
}

/// Reads the text or phones to cue.
pub(crate) fn read_cue_utterance(settings: &CueSettings) -> Result<CuedUtterance, StepError> {
    let mut french = french::PronunciationOptions::default();
    let mut variants = Vec::new();
    for variant in &settings.variants {
        match &**variant {
            "no-liaison" => french.liaison = false,
            "schwa-said" => french.schwa = french::SchwaCondition::Said,
            "schwa-dropped" => french.schwa = french::SchwaCondition::Dropped,
            _ => variants.push(variant.clone()),
        }
    }
    let alphabet = |name: &String| {
        let named_alphabet = PhoneAlphabet::ALL_ALPHABETS
            .into_iter()
            .find(|alphabet| alphabet.alphabet_name() == name);
        named_alphabet.unwrap_or_default()
    };
    let reading = cue::UtteranceReading {
        code: settings.code.clone().unwrap_or_else(|| "french".to_owned()),
        phones: settings.phones.as_ref().map(alphabet),
        variants,
        french,
        pace: Some(settings.pace.map_or(CUE_PACE_FACTOR, |pace| pace.0)),
        dictionary: None,
    };
    let spoken = CuedUtterance::read_cued_utterance(&settings.text, &reading)
        .map_err(|error| StepError::Utterance(Box::new(error)))?;
    if spoken.keys.is_empty() {
        return Err(StepError::Empty(settings.text.clone()));
    }
    Ok(spoken)
}

/// The results of cueing.
pub(crate) struct CueResult {
    pub(crate) did: Vec<String>,
    pub(crate) warnings: Vec<String>,
    pub(crate) residual: f64,
}

/// Cues on the body of `work`, whose first frame is its posture; `shapes` are those of the code, the resting one
/// included.
pub(crate) fn perform_cues(
    work: &mut WorkingClip,
    settings: &CueSettings,
    shapes: &[(u8, HandPose)],
    measured: &CuePhases,
) -> Result<CueResult, StepError> {
    let side = settings.hand.chosen_sides(work.handedness)[0];
    let read = read_cue_utterance(settings)?;
    let model = ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(0));
    let head = CueHeadSpace::from_head_posture(&work.anatomy, &work.skeleton, &model, side).ok_or(StepError::NoHead)?;
    let sounds = key_sound_times(&read.keys).ok_or(StepError::Input)?;
    let times = plan_key_times(&sounds, settings.phase, measured);
    // Before the paths of a very long text are found.
    let least = sounds.last().map_or(0.0, |sound| sound.a3) / work.rate.frame_time();
    join::check_length(work, least.ceil() as usize)?;
    let early = times.first().map_or(0.0, |first| -first.m1.min(first.d1)).max(0.0);
    let raw_lead = (early + CUE_REST_S).max(CUE_LEAD_S);
    let lead = (raw_lead * 1000.0).ceil() / 1000.0;
    let targets = plan_cue_targets(&read, &sounds, &times, &head, lead)?;
    let last = targets
        .last()
        .map_or(0.0, |target| target.times.m2.max(target.times.d2));
    let frame_time = work.rate.frame_time();
    let frames = ((last + CUE_REST_S) / frame_time).ceil().max(1.0) as usize;
    join::check_length(work, frames)?;
    work.resample_channels(&vec![0.0; frames]);
    work.notes.clear();
    work.curves = mouth::mouth_sound_curves(&read, lead, frames, frame_time);
    let residual = compose_cue_hand::move_cueing_hand(work, side, &head, &targets, shapes, &read.code)?;
    write_cue_notes(work, side, settings, &read, &targets, lead);
    let mut warnings: Vec<String> = read.findings.iter().map(ToString::to_string).collect();
    let clear = lips(work, side, &head, &targets, &read.code);
    if let Some((least, frame)) = clear
        && least < LIP_CLEARANCE_M
    {
        warnings.push(format!(
            "the fingertip comes within {:.1} mm of the lips at {}; they should be {:.0} mm free",
            least * 1000.0,
            work.rate.frame_start_instant(frame),
            LIP_CLEARANCE_M * 1000.0
        ));
    }
    work.note_changed_groups(
        [JointGroup::Arm(side), JointGroup::Fingers(side)],
        &shorten_step_text(&settings.to_string()),
    );
    let mut did = vec![format!(
        "{} keys of {} in {:.2} s, phases as {} has them",
        read.keys.len(),
        read.code.id,
        frames as f64 * frame_time,
        settings.phase.phase_rule_name()
    )];
    if settings.phase == PhaseRule::Measured {
        let [pair, vowel, consonant] = measured.counts;
        did.push(format!(
            "measured on {pair} pairs, {vowel} vowels and {consonant} consonants alone"
        ));
    }
    did.extend(
        clear.map(|(least, _)| format!("the fingertip stays {:.1} mm or more outside the lips", least * 1000.0)),
    );
    for key in read.keys.iter().filter(|key| key.or_at.is_some()) {
        let other = key.or_at.as_deref().unwrap_or_default();
        let phone_text = key.phones.concat();
        did.push(format!(
            "{phone_text}: {} here, {other} for some speakers",
            key.placement
        ));
    }
    Ok(CueResult {
        did,
        warnings,
        residual,
    })
}

/// Returns the successive targets of the hand: rest, the keys, and rest in long silences and at the end.
fn plan_cue_targets(
    read: &CuedUtterance,
    sounds: &[KeySoundTimes],
    times: &[KeyTimes],
    head: &CueHeadSpace,
    lead: f64,
) -> Result<Vec<CueTarget>, StepError> {
    let spot = |placement: &str| {
        head.find_cue_spot(placement).ok_or_else(|| StepError::NoMeaning {
            value: placement.to_owned(),
            what: "place of cued speech",
        })
    };
    let moved = |times: KeyTimes| KeyTimes {
        m1: times.m1 + lead,
        m2: times.m2 + lead,
        d1: times.d1 + lead,
        d2: times.d2 + lead,
    };
    let rest = |from: f64, to: f64| -> Result<CueTarget, StepError> {
        Ok(CueTarget {
            placement: AT_REST.to_owned(),
            shape: REST_SHAPE_NUMBER,
            spot: spot(AT_REST)?,
            times: KeyTimes {
                m1: from,
                m2: to,
                d1: from,
                d2: to,
            },
            bow: CuePathBow::default(),
            key: None,
        })
    };
    let shift = (lead * 1e6).round() as i64;
    let mut targets = vec![rest(0.0, 0.0)?];
    for (n, key) in read.keys.iter().enumerate() {
        let mut key_times = moved(times[n]);
        let ends = n.checked_sub(1).map(|n| sounds[n].a3);
        if let Some(end) = ends
            && sounds[n].a1 - end > RESTING_SILENCE_S
        {
            let before = targets[targets.len() - 1].times;
            let from = (end + lead).max(before.m2).max(before.d2);
            // Half of the silence for the path to rest, at most its usual time.
            let to = from + TO_REST.min((sounds[n].a1 - end) / 2.0);
            targets.push(rest(from, to)?);
            key_times.m2 = key_times.m2.max(to + 0.06);
            key_times.d2 = key_times.d2.max(to + 0.06);
            key_times.m1 = key_times.m1.clamp(to, key_times.m2);
            key_times.d1 = key_times.d1.clamp(to, key_times.d2);
        }
        let instant = |seconds: f64| RecordingInstant::from_seconds(seconds).shifted_instant(shift);
        targets.push(CueTarget {
            placement: key.placement.clone(),
            shape: key.shape,
            spot: spot(&key.placement)?,
            times: key_times,
            bow: CuePathBow::default(),
            key: Some(TimeSpan::span_between(instant(sounds[n].a1), instant(sounds[n].a3))),
        });
    }
    let (last, end) = (
        targets[targets.len() - 1].times,
        lead + sounds.last().map_or(0.0, |sound| sound.a3),
    );
    let from = end.max(last.m2).max(last.d2);
    targets.push(rest(from, from + TO_REST)?);
    for n in 1..targets.len() {
        let [before, own] = [&targets[n - 1], &targets[n]];
        let same = before.placement == own.placement && before.shape == own.shape;
        targets[n].bow = if same {
            CuePathBow::repeated_key_bow()
        } else {
            CuePathBow::bow_between_spots(&before.spot, &own.spot, head.size)
        };
    }
    Ok(targets)
}

/// Returns the least distance of the pointing tip from the lips, and its frame.
fn lips(
    work: &WorkingClip,
    side: BodySide,
    head: &CueHeadSpace,
    targets: &[CueTarget],
    code: &cue::CueCode,
) -> Option<(f64, usize)> {
    let faces = faces_from_curves(&work.curves);
    let mut least: Option<(f64, usize)> = None;
    for frame in 0..work.frames {
        let model = ModelPose::from_local_pose(&work.skeleton, &work.local_pose_at(frame));
        let tip = compose_cue_hand::pointing_tip_position(work, &model, side, targets, frame, code)?;
        let face = faces.get(frame).copied().unwrap_or_default();
        let clear = cue_places::lip_clearance(head.model_to_head_point(tip), &face, head.size);
        if least.is_none_or(|(known, _)| clear < known) {
            least = Some((clear, frame));
        }
    }
    least
}

fn write_cue_notes(
    work: &mut WorkingClip,
    side: BodySide,
    settings: &CueSettings,
    read: &CuedUtterance,
    targets: &[CueTarget],
    lead: f64,
) {
    let full_span = work.working_clip_span();
    // A copy stands with every note.
    let from = shorten_step_text(&settings.to_string());
    let mut add = |hand: Option<BodySide>, about: NoteSubject, value: &str, span: TimeSpan| {
        if let Some(span) = span.span_intersection(full_span)
            && !span.is_empty()
        {
            work.notes.push(GeneratedNote {
                hand,
                about,
                value: ComponentReading::Value(value.to_owned()),
                span,
                origin: from.clone(),
            });
        }
    };
    add(None, NoteSubject::Gloss, &settings.text, full_span);
    let shift = (lead * 1e6).round() as i64;
    for phone in &read.phones {
        let symbols = read.code.sampa_symbols(&phone.label, read.alphabet);
        if let (Some(span), Some(symbols)) = (phone.span, symbols)
            && symbols.iter().any(|symbol| !read.code.is_pause(symbol))
        {
            let label = symbols.join(" ");
            add(
                None,
                NoteSubject::Cue(CueTier::Phones),
                &label,
                span.shifted_span(shift),
            );
        }
    }
    let between = |from: f64, to: f64| {
        TimeSpan::span_between(RecordingInstant::from_seconds(from), RecordingInstant::from_seconds(to))
    };
    for (n, target) in targets.iter().enumerate().skip(1) {
        let (before, times) = (&targets[n - 1], target.times);
        let name = |shown_target: &CueTarget| format!("{}-{}", shown_target.placement, shown_target.shape);
        let transition = format!("{}>{}", name(before), name(target));
        add(
            None,
            NoteSubject::Cue(CueTier::Hand),
            &transition,
            between(times.m1, times.m2),
        );
        let transition = format!("{}>{}", before.shape, target.shape);
        add(
            None,
            NoteSubject::Cue(CueTier::Fingers),
            &transition,
            between(times.d1, times.d2),
        );
        let Some(key) = target.key else { continue };
        let next = targets.get(n + 1).map_or(times, |next| next.times);
        let held_span = |from: f64, to: f64| between(from, to.max(from + 0.02));
        let value = gloss_cue_key(&target.placement, target.shape);
        add(None, NoteSubject::Cue(CueTier::Keys), &value, key);
        if let Some(shape) = read.code.find_cue_shape(target.shape) {
            let about = NoteSubject::Component(SignComponent::Configuration, None);
            add(Some(side), about, &shape.configuration, held_span(times.d2, next.d1));
        }
        if let Some(place) = read.code.find_cue_placement(&target.placement) {
            let about = NoteSubject::Component(SignComponent::Placement, None);
            add(Some(side), about, &place.placement, held_span(times.m2, next.m1));
        }
    }
}

#[cfg(test)]
mod tests;
