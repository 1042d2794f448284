//! `configure_hand_values`: gives the hands other shapes over the spans in which the sign has its own.

use std::ops::Range;

use chereme_motion::glam::DQuat;
use chereme_motion::{BodySide, TimeSpan};
use chereme_sign::words::InterfaceText;
use chereme_sign::{ComponentReading, SignComponent};

use crate::course::TransitionCourse;
use crate::error::StepError;
use crate::ops::component_notes;
use crate::outcome::{GeneratedNote, NoteSubject};
use crate::poses::{self, HandPose};
use crate::work::{JointGroup, WorkingClip};
use std::fmt::{self, Display, Formatter};

use chereme_sign::SignerHandedness;
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::{AnswerSlot, CorpusAsker, NodeAnswers};
use crate::check;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::RecipeError;
use crate::ops::{OperatorDescription, OperatorSyntax, StepOperator, StepOutcome};
use crate::recipe_settings::{PostureTransition, TransitionProfile, ValueChoice};
use crate::sources::{LearnedProfile, MaterialSigner};
use crate::stroke::SignStroke;
use crate::text::{ParsedText, RecipeParser, RecipeTokenKind, write_separated_list};
use crate::units::HandChoice;

/// Settings of `configure right U`, `configure both from LION`, `configure right U, S`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConfigureSettings {
    /// The hands that change.
    #[serde(default = "crate::recipe_settings::dominant_hand_choice")]
    pub hand: HandChoice,
    /// One value for the whole sign, or one for each of its successive configurations.
    pub values: Vec<ValueChoice>,
    /// The transition into and out of each value, and from one to the next.
    #[serde(default, skip_serializing_if = "PostureTransition::is_default")]
    pub via: PostureTransition,
}

/// The postures chosen for each value, on each side.
const CONFIGURE_VALUES_SLOT: AnswerSlot<Vec<HandPose>> = AnswerSlot::new("configure/values");
/// The learned courses of its transitions.
const CONFIGURE_COURSE_SLOT: AnswerSlot<LearnedProfile> = AnswerSlot::new("configure/via");

impl OperatorSyntax for ConfigureSettings {
    const OPERATOR_NAME: &'static str = "configure";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "configure",
        "another-handshape": "configure right U",
        "handshapes-another-sign": "configure both from LION",
        "for-each-shape": "configure right U, _",
        "best-hit-query": "configure right best(configuration=U signer=same)"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        let hand = parser.parse_hand_choice().unwrap_or(HandChoice::Dominant);
        let mut values = vec![parser.parse_value_choice()?];
        while parser.accept_kind(RecipeTokenKind::Comma) {
            values.push(parser.parse_value_choice()?);
        }
        let via = parser.parse_transition()?.unwrap_or_default();
        Ok(Self { hand, values, via })
    }

    fn default_operator() -> Self {
        Self {
            hand: HandChoice::Dominant,
            values: vec![ValueChoice::Value(String::new())],
            via: PostureTransition::default(),
        }
    }
}

impl Display for ConfigureSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "configure {} ", self.hand.hand_choice_name())?;
        write_separated_list(f, &self.values, ", ")?;
        write!(f, "{}", self.via)
    }
}

impl StepOperator for ConfigureSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        check::check_filled_list(Self::OPERATOR_NAME, &self.values, "no value is given")?;
        let mut values = self.values.iter();
        values.try_for_each(|value| check::check_step_choice(Self::OPERATOR_NAME, value))?;
        check::check_step_transition(Self::OPERATOR_NAME, &self.via)
    }

    fn resolve_operator_inputs(&self, ask: &mut CorpusAsker<'_>, setting: &MaterialSigner) -> Result<(), StepError> {
        for &side in self.hand.chosen_sides(setting.handedness) {
            for (n, choice) in self.values.iter().enumerate() {
                if *choice != ValueChoice::Keep {
                    let poses = poses::choose_hand_poses(ask.sources, choice, side, setting)?;
                    ask.put_answer(&CONFIGURE_VALUES_SLOT.numbered_side_slot(n, side), poses);
                }
            }
        }
        ask.ask_learned_courses(&CONFIGURE_COURSE_SLOT, &self.via)
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        let course = given.transition_courses(&CONFIGURE_COURSE_SLOT, &self.via, TransitionProfile::Sigmoid)?;
        let time = self.via.time.map(|time| time.0);
        let mut did = Vec::new();
        for &side in self.hand.chosen_sides(work.handedness) {
            let mut values: Vec<Option<&[HandPose]>> = Vec::with_capacity(self.values.len());
            for (n, choice) in self.values.iter().enumerate() {
                values.push(match choice {
                    ValueChoice::Keep => None,
                    _ => Some(given.required_answer(&CONFIGURE_VALUES_SLOT.numbered_side_slot(n, side))?)
                        .filter(|poses| !poses.is_empty())
                        .map(Vec::as_slice)
                        .ok_or(StepError::Input)
                        .map(Some)?,
                });
            }
            let fingers = &course.fingers;
            did.extend(configure_hand_values(work, side, &values, fingers, time, given.text)?);
        }
        Ok(did.into())
    }

    fn contact_effect_for(&self, handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        Some((
            ContactEffect::Same,
            ContactsToKeep::All(self.hand.chosen_sides(handedness)),
        ))
    }

    fn is_nothing(&self) -> bool {
        self.values == [ValueChoice::Keep]
    }
}

/// The usual time in which a hand changes its shape, in seconds.
const HANDSHAPE_CHANGE_S: f64 = 0.2;

/// Gives the hand of `side` the values, one for the whole sign or one for each span; `None` keeps a span's own.
///
/// Only joints below the wrist change. Between two spans the fingers go from one value to the next, in the time that
/// the sign itself takes for it, or `time`; before the first span and after the last they come from and return to the
/// sign's own movement.
pub(crate) fn configure_hand_values(
    work: &mut WorkingClip,
    side: BodySide,
    values: &[Option<&[HandPose]>],
    course: &TransitionCourse,
    time: Option<f64>,
    operator: &str,
) -> Result<Vec<String>, StepError> {
    if !work.anatomy.has_fingers(side) {
        return Err(StepError::NoFingers(side));
    }
    if work.held_note_indices(side, SignComponent::Configuration).is_empty()
        && work.handedness.signer_dominant_side() == side
    {
        // A value of the sign as a whole belongs to the dominant hand.
        for note in &mut work.notes {
            let is_whole = note.about == NoteSubject::Component(SignComponent::Configuration, None);
            note.hand = note
                .hand
                .or((is_whole && note.value.reading_value().is_some()).then_some(side));
        }
    }
    if values.iter().any(Option::is_some) {
        component_notes::withdraw_hand_notes(work, &[side], operator, |component, feature| {
            component == SignComponent::Configuration && feature.is_some_and(|name| name != "handedness")
        });
    }
    let mut held_notes = work.held_note_indices(side, SignComponent::Configuration);
    if held_notes.is_empty() {
        work.notes.push(GeneratedNote {
            hand: Some(side),
            about: NoteSubject::Component(SignComponent::Configuration, None),
            value: ComponentReading::Unset,
            span: work.rate.frame_range_span(SignStroke::of_work(work)?.frames),
            origin: operator.to_owned(),
        });
        held_notes.push(work.notes.len() - 1);
    }
    let chosen = deal(values, held_notes.len(), side)?;
    let mut did = Vec::new();
    let mut stretches = Vec::with_capacity(held_notes.len());
    for (&note, pose) in held_notes.iter().zip(chosen) {
        let note_frames = work.rate.frames_in(work.notes[note].span);
        let frames = note_frames.start.min(work.frames)..note_frames.end.min(work.frames);
        let joints = match pose {
            None => None,
            Some(pose) => {
                let possible_rotations = poses::hand_pose_rotations(&work.skeleton, &work.anatomy, side, pose);
                let finger_rotations = possible_rotations.ok_or(StepError::NoFingers(side))?;
                did.push(describe_configured_value(&work.notes[note], pose));
                let note = &mut work.notes[note];
                note.value = pose
                    .value
                    .clone()
                    .map_or(ComponentReading::Unset, ComponentReading::Value);
                note.origin = pose.origin.to_string();
                Some(finger_rotations)
            }
        };
        stretches.push(ValueStretch { frames, joints });
    }
    let mut shortest = usize::MAX;
    for joint in work.anatomy.finger_joints(side) {
        let column: Vec<Option<DQuat>> = stretches.iter().map(|s| s.stretch_joint_rotation(joint)).collect();
        if column.iter().any(Option::is_some) {
            let least = overwrite(work, joint, &stretches, &column, course, time);
            shortest = shortest.min(least);
        }
    }
    let is = shortest as f64 * work.rate.frame_time();
    if let Some(asked) = time.filter(|asked| is + work.rate.frame_time() < *asked) {
        did.push(format!(
            "the shape changes in {is:.2} s instead of {asked:.2} s: the sign leaves no more time"
        ));
    }
    work.note_changed_groups([JointGroup::Fingers(side)], operator);
    Ok(did)
}

/// Returns one value for each span.
fn deal<'a>(
    values: &[Option<&'a [HandPose]>],
    held: usize,
    side: BodySide,
) -> Result<Vec<Option<&'a HandPose>>, StepError> {
    let count = |given| StepError::Count { given, held, side };
    if let [Some(poses)] = values {
        return match poses {
            [one] => Ok(vec![Some(one); held]),
            many if many.len() == held => Ok(many.iter().map(Some).collect()),
            many if held == 1 => Ok(vec![many.first()]),
            many => Err(count(many.len())),
        };
    }
    if values.len() != held {
        return Err(count(values.len()));
    }
    Ok(values.iter().map(|poses| poses.and_then(<[HandPose]>::first)).collect())
}

struct ValueStretch {
    frames: Range<usize>,
    joints: Option<Vec<(usize, DQuat)>>,
}

impl ValueStretch {
    fn stretch_joint_rotation(&self, joint: usize) -> Option<DQuat> {
        let joints = self.joints.as_ref()?;
        joints.iter().find(|(j, _)| *j == joint).map(|(_, rotation)| *rotation)
    }
}

/// Writes the key values of one joint over their spans, then the transitions between them; returns the frames of the
/// shortest transition, or more than any movement has.
fn overwrite(
    work: &mut WorkingClip,
    joint: usize,
    stretches: &[ValueStretch],
    values: &[Option<DQuat>],
    course: &TransitionCourse,
    time: Option<f64>,
) -> usize {
    let frames = work.frames;
    let mut shortest = usize::MAX;
    let length = ((time.unwrap_or(HANDSHAPE_CHANGE_S) / work.rate.frame_time()).round() as usize).max(1);
    let source = work.channels[joint].rotations.clone();
    let column = &mut work.channels[joint].rotations;
    for (stretch, value) in stretches.iter().zip(values) {
        if let Some(value) = value {
            column[stretch.frames.clone()].fill(*value);
        }
    }
    for edge in 0..=stretches.len() {
        let before = edge.checked_sub(1).and_then(|n| values[n]);
        let after = values.get(edge).copied().flatten();
        if before.is_none() && after.is_none() {
            continue;
        }
        let from = edge.checked_sub(1).map_or(0, |n| stretches[n].frames.end);
        let to = stretches.get(edge).map_or(frames, |s| s.frames.start).max(from);
        let window = match edge {
            0 => to.saturating_sub(length).max(from)..to,
            _ if edge == stretches.len() => from..(from + length).min(to),
            _ => value_change_frames(from, to, length, time.is_some(), &stretches[edge - 1..=edge]),
        };
        if !window.is_empty() || (edge > 0 && edge < stretches.len()) {
            shortest = shortest.min(window.len());
        }
        let steps = (window.len() + 1) as f64;
        for (n, frame) in window.enumerate() {
            let a = before.unwrap_or(source[frame]);
            let b = after.unwrap_or(source[frame]);
            column[frame] = course.rotation_along_course(a, b, (n + 1) as f64 / steps);
        }
    }
    shortest
}

/// Returns the frames in which one value becomes the next: the gap between their spans or, if a time is asked for, the
/// middle of the gap; if the gap is too short, also up to a third of each span.
fn value_change_frames(from: usize, to: usize, length: usize, asked: bool, spans: &[ValueStretch]) -> Range<usize> {
    let gap = to - from;
    if gap >= length || (gap > 0 && !asked && gap * 2 >= length) {
        let length = if asked { length } else { gap };
        let start = from + (gap - length) / 2;
        return start..start + length;
    }
    let more = (length - gap).div_ceil(2);
    let back = more.min(spans[0].frames.len() / 3);
    let ahead = more.min(spans[1].frames.len() / 3);
    from - back..(to + ahead).min(spans[1].frames.end.max(to))
}

fn describe_configured_value(note: &GeneratedNote, pose: &HandPose) -> String {
    let name = |value: Option<&str>| value.map_or("(no value)".to_owned(), str::to_owned);
    let coding = pose.coding.as_ref().map(|coding| format!(", {coding}"));
    format!(
        "{} becomes {} over {}, from {}{}",
        name(note.value.reading_value()),
        name(pose.value.as_deref()),
        format_shown_span(note.span),
        pose.origin,
        coding.filter(|text| text.len() > 2).unwrap_or_default()
    )
}

fn format_shown_span(span: TimeSpan) -> String {
    format!("{}–{}", span.span_start_instant(), span.span_end_instant())
}
