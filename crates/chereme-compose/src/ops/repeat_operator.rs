//! `repeat`: plays the movement several times, growing or shrinking, faster or slower.

use chereme_motion::BodySide;
use chereme_sign::SignComponent;
use chereme_sign::words::InterfaceText;

use crate::contact::{self, ContactEffect, ContactsToKeep};
use crate::course::TransitionCourses;
use crate::error::StepError;
use crate::ops::join::{self, MovementSeam};
use crate::ops::{OperatorDescription, amplify, component_notes, cut, retime};
use crate::outcome::NoteSubject;
use crate::work::{JointGroup, WorkingClip};
use std::fmt::{self, Display, Formatter};

use chereme_sign::SignerHandedness;
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::{AnswerSlot, CorpusAsker, NodeAnswers};
use crate::error::RecipeError;
use crate::ops::{FieldSetting, OperatorField, OperatorSyntax, StepOperator, StepOutcome};
use crate::recipe_settings::{PostureTransition, TransitionProfile};
use crate::sources::{LearnedProfile, MaterialSigner};
use crate::text::{ParsedText, RecipeParser, write_option};
use crate::units::{RecipeFactor, RecipeSeconds};
use crate::{check, stroke};

/// Settings of `repeat 3 scale 0.8 tempo 1.2 gap 0.1s`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RepeatSettings {
    /// The number of times that the movement is played, from 1 on.
    pub times: u32,
    /// The factor on the size of the hands' movement from each repetition to the next.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<RecipeFactor>,
    /// The factor on the speed from each repetition to the next.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tempo: Option<RecipeFactor>,
    /// The time between two repetitions, the transition included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap: Option<RecipeSeconds>,
    /// The transition between two repetitions; the default course is slerp, as in the founding paper.
    #[serde(default, skip_serializing_if = "PostureTransition::is_default")]
    pub via: PostureTransition,
}

/// The most repetitions.
pub const MOST_REPETITIONS: u32 = 1000;
/// The learned courses of the returns to the start.
const REPEAT_COURSE_SLOT: AnswerSlot<LearnedProfile> = AnswerSlot::new("repeat/via");

impl OperatorSyntax for RepeatSettings {
    const OPERATOR_NAME: &'static str = "repeat";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "repeat",
        "again-each-smaller": "repeat 3 scale 0.8 tempo 1.2 gap 0.1s"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        let mut repeat = Self {
            times: parser.parse_repetition_count("how often, such as 2")?,
            scale: None,
            tempo: None,
            gap: None,
            via: PostureTransition::default(),
        };
        loop {
            if parser.accept_word("scale") {
                repeat.scale = Some(parser.parse_quantity("a factor, such as 0.8")?);
            } else if parser.accept_word("tempo") {
                repeat.tempo = Some(parser.parse_quantity("a factor, such as 1.2")?);
            } else if parser.accept_word("gap") {
                repeat.gap = Some(parser.parse_quantity("a time, such as 0.1s")?);
            } else if let Some(via) = parser.parse_transition()? {
                repeat.via = via;
            } else {
                return Ok(repeat);
            }
        }
    }

    fn default_operator() -> Self {
        Self {
            times: 2,
            scale: None,
            tempo: None,
            gap: None,
            via: PostureTransition::default(),
        }
    }
}

impl Display for RepeatSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "repeat {}", self.times)?;
        write_option(f, "scale", self.scale)?;
        write_option(f, "tempo", self.tempo)?;
        write_option(f, "gap", self.gap)?;
        write!(f, "{}", self.via)
    }
}

impl StepOperator for RepeatSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        let (step, times) = (Self::OPERATOR_NAME, f64::from(self.times));
        let most = f64::from(MOST_REPETITIONS);
        check::check_step_range(step, "the number of times", times, 1.0, most)?;
        for (what, factor) in [("scale", self.scale), ("tempo", self.tempo)] {
            if let Some(factor) = factor {
                check::check_step_range(step, what, factor.0, 0.05, 20.0)?;
            }
        }
        check::check_step_time(step, "gap", self.gap, 60.0)?;
        check::check_step_transition(step, &self.via)
    }

    fn resolve_operator_inputs(&self, ask: &mut CorpusAsker<'_>, _setting: &MaterialSigner) -> Result<(), StepError> {
        ask.ask_learned_courses(&REPEAT_COURSE_SLOT, &self.via)
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        let course = given.transition_courses(&REPEAT_COURSE_SLOT, &self.via, TransitionProfile::Slerp)?;
        Ok(repeat_movement(work, self, &course, given.text)?.into())
    }

    fn contact_effect_for(&self, _handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        None
    }

    fn is_nothing(&self) -> bool {
        self.times == 1
    }

    fn operator_form_fields(&mut self) -> Vec<FieldSetting<'_>> {
        let setting = |id, field| FieldSetting::new(InterfaceText::from_id(id), field);
        let times = OperatorField::Count(&mut self.times, 1..=20);
        let scale = OperatorField::OptionalFactor(&mut self.scale, 0.8);
        let tempo = OperatorField::OptionalFactor(&mut self.tempo, 1.2);
        vec![
            setting("setting-times", times),
            setting("setting-scale", scale),
            setting("setting-tempo", tempo),
            setting("setting-gap", OperatorField::Time(&mut self.gap, 0.1)),
            FieldSetting::transition_field_setting(&mut self.via),
        ]
    }
}

/// The usual time of the return to the start, in seconds.
const REPEAT_GAP_S: f64 = 0.12;

/// Plays the movement `times` times.
pub(crate) fn repeat_movement(
    work: &mut WorkingClip,
    settings: &RepeatSettings,
    courses: &TransitionCourses,
    operator: &str,
) -> Result<join::JoinOutcome, StepError> {
    // The gap contains the transition, whose time serves if no gap is given.
    let seconds = settings.gap.or(settings.via.time).map_or(REPEAT_GAP_S, |time| time.0);
    let gap = (seconds / work.rate.frame_time()).round() as usize;
    let times = settings.times as usize;
    join::check_length(work, times.saturating_mul(work.frames + gap))?;
    let mut once = work.clone();
    let (scale, tempo) = (settings.scale.map_or(1.0, |s| s.0), settings.tempo.map_or(1.0, |t| t.0));
    let arms: Vec<BodySide> = BodySide::BOTH_SIDES
        .into_iter()
        .filter(|&s| work.anatomy.arm_chain(s).is_some())
        .collect();
    let mut residual: f64 = 0.0;
    let mut done = join::JoinOutcome::default();
    let (mut tail, mut rested) = (work.frames - stroke::signed_frame_range(work)?.end, false);
    for n in 1..times {
        let mut next = once.clone();
        if scale != 1.0 {
            let mut touched = contact::find_contacts(&next);
            residual = residual.max(amplify::scale_wrist_paths(&mut next, &arms, scale)?.residual);
            let keep = ContactsToKeep::All(&BodySide::BOTH_SIDES);
            let what = |text: &String| format!("repetition {}: {text}", n + 1);
            let kept = contact::restore_contacts(&mut next, &mut touched, keep, operator);
            done.did.extend(kept.iter().map(what));
            let lost = contact::describe_lost_contacts(&touched, &next, ContactEffect::Same);
            done.contacts.extend(lost.iter().map(what));
            let step = format!("{operator}, repetition {}", n + 1);
            done.warnings.extend(contact::long_repairs(&touched, &step));
        }
        if tempo != 1.0 {
            retime::stretch_movement(&mut next, 1.0 / tempo)?;
        }
        // Each repetition changes the one before, so that the factors multiply.
        if scale != 1.0 || tempo != 1.0 {
            once = next.clone();
        }
        // The return to rest and the next way from it are cut off between repetitions.
        let signed_frames = stroke::signed_frame_range(&next)?;
        rested |= tail > 0 || signed_frames.start > 0;
        let signed = work.frames - tail;
        cut::keep_quietly(work, 0..signed);
        tail = next.frames - signed_frames.end;
        let all = next.frames;
        cut::keep_quietly(&mut next, signed_frames.start..all);
        let seam = MovementSeam::plain_seam(work, gap);
        let what = format!("repetition {} to {}", n, n + 1);
        done.joins
            .extend(join::join_movements(work, next, &seam, courses, &what)?);
    }
    if times > 1 {
        work.note_changed_groups(JointGroup::ALL_JOINT_GROUPS, operator);
        note_repetition_count(work, times, operator);
    }
    let times = format!("{times} times, {gap} frames between");
    done.did.insert(0, times);
    if rested {
        done.did
            .push("the hands do not go back to rest between them".to_owned());
    }
    if residual > 1e-3 {
        done.did
            .push(format!("out of reach: a wrist stays {:.1} cm short", residual * 100.0));
    }
    Ok(done)
}

/// Notes the number of repetitions for each active hand, in place of its earlier value.
fn note_repetition_count(work: &mut WorkingClip, times: usize, operator: &str) {
    let is_said = |about: &NoteSubject| matches!(about, NoteSubject::Component(SignComponent::Movement, Some(it)) if it == "repetition");
    // A sign that repeats already does so more than twice when it is played twice.
    let more = work.notes.iter().any(|note| {
        let value = note.value.reading_value();
        is_said(&note.about) && value.is_some_and(|value| value != "once")
    });
    let value = if times == 2 && !more { "twice" } else { "several" };
    work.notes.retain(|note| !is_said(&note.about));
    let dominant = work.handedness.signer_dominant_side();
    let moves = |side: BodySide| {
        let manual = |about: &NoteSubject| matches!(about, NoteSubject::Component(..));
        let notes = work.notes.iter();
        notes
            .into_iter()
            .any(|note| note.hand == Some(side) && manual(&note.about))
    };
    let sides: Vec<BodySide> = BodySide::BOTH_SIDES
        .into_iter()
        .filter(|&side| side == dominant || moves(side))
        .collect();
    for side in sides {
        let what = NoteSubject::Component(SignComponent::Movement, Some("repetition".to_owned()));
        component_notes::record_component_value(work, side, what, value, 0..work.frames, operator);
    }
}
