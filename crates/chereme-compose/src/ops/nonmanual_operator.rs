//! `nonmanual from`: takes head and face from another sign.

use std::sync::Arc;

use chereme_sign::SignComponent;
use chereme_sign::words::InterfaceText;

use crate::error::StepError;
use crate::ops::expression_operator::is_of_trunk;
use crate::ops::retarget::{self, TargetBody};
use crate::outcome::{GeneratedNote, NoteSubject};
use crate::sources::MovementMaterial;
use crate::work::{JointGroup, WorkingClip, find_joint_groups};
use std::fmt::{self, Display, Formatter};

use chereme_motion::{BodySide, RecordingInstant, TimeSpan};
use chereme_sign::SignerHandedness;
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::{AnswerSlot, CorpusAsker, NodeAnswers};
use crate::check;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::RecipeError;
use crate::ops::cut::{self, CutEnds, SpanSettings};
use crate::ops::{
    FieldSetting, OperatorDescription, OperatorField, OperatorSyntax, StepOperator, StepOutcome, expression_operator,
};
use crate::recipe_inputs::{ExpressionInput, MaterialInput};
use crate::sources::MaterialSigner;
use crate::text::{ParsedText, QuotedName, RecipeParser, RecipeTokenKind, write_separated_list};
use crate::units::RecipeSeconds;

/// Settings of `nonmanual from TOKEN`: head and face of another sign, fitted to this one's time, and of `nonmanual wh
/// from recording:3 over 0.4s..1.9s by phases`: an expression transferred phase by phase.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NonmanualSettings {
    /// The other sign's address.
    pub from: String,
    /// The function of the expression, such as `wh`; `None` for the only expression at the address.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub function: Option<String>,
    /// The part of this movement for the expression; `None` for all of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over: Option<ExpressionTimes>,
    /// Whether each phase of the expression is stretched to the same phase here; otherwise the whole is stretched
    /// evenly.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub by_phases: bool,
}

/// The times of an expression in a movement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum ExpressionTimes {
    /// Over the signs of this part, `0.4s..1.9s`: the milestones follow from them.
    Part(SpanSettings),
    /// With these milestones M1 to M5, `0s, 0.4s, 1.2s, 1.9s, 2.4s`; M3 is M2 if one sign is spanned.
    At([RecipeSeconds; 5]),
}

/// The other sign.
const NONMANUAL_DONOR_SLOT: AnswerSlot<MaterialInput> = AnswerSlot::new("nonmanual/from");
/// The transferred expression.
const EXPRESSION_SLOT: AnswerSlot<ExpressionInput> = AnswerSlot::new("nonmanual/expression");

impl NonmanualSettings {
    /// Returns whether it transfers an expression with milestones, instead of a whole sign.
    #[must_use]
    pub fn is_expression(&self) -> bool {
        self.by_phases || self.over.is_some() || self.function.is_some()
    }
}

impl OperatorSyntax for NonmanualSettings {
    const OPERATOR_NAME: &'static str = "nonmanual";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "nonmanual",
        "head-face-another": "nonmanual from BOL",
        "expression-fitted-part": "nonmanual wh from BOL over 0.4s..1.9s by phases"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        let function = match parser.current_word() {
            Some("from") => None,
            _ => Some(parser.parse_recipe_name("\"from\" and a sign")?),
        };
        parser.expect_word("from", "\"from\" and a sign")?;
        let from = parser.parse_recipe_name("a sign")?;
        let over = parser
            .accept_word("over")
            .then(|| parse_expression_times(parser))
            .transpose()?;
        let by_phases = parser.accept_word("by");
        if by_phases {
            parser.expect_word("phases", "\"phases\"")?;
        }
        Ok(Self {
            from,
            function,
            over,
            by_phases,
        })
    }

    fn default_operator() -> Self {
        Self::default()
    }
}

/// Reads a part of a movement, or the five milestones of an expression.
fn parse_expression_times(parser: &mut RecipeParser<'_>) -> ParsedText<ExpressionTimes> {
    let start = parser.parser_position();
    let mut times: Vec<RecipeSeconds> = Vec::new();
    while times.len() < 5 {
        let Ok(time) = parser.parse_quantity("a part such as 0.4s..1.9s, or five times with commas between") else {
            break;
        };
        times.push(time);
        if times.len() < 5 && !parser.accept_kind(RecipeTokenKind::Comma) {
            break;
        }
    }
    if let Ok(times) = times.try_into() {
        return Ok(ExpressionTimes::At(times));
    }
    // Fewer than five times are a part of the movement.
    parser.back_to(start);
    cut::parse_movement_part(parser).map(ExpressionTimes::Part)
}

impl Display for NonmanualSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("nonmanual ")?;
        if let Some(function) = &self.function {
            write!(f, "{} ", QuotedName(function))?;
        }
        write!(f, "from {}", QuotedName(&self.from))?;
        match &self.over {
            None => {}
            Some(ExpressionTimes::Part(cut)) => write!(f, " over {}", CutEnds(cut))?,
            Some(ExpressionTimes::At(times)) => {
                f.write_str(" over ")?;
                write_separated_list(f, times, ", ")?;
            }
        }
        f.write_str(if self.by_phases { " by phases" } else { "" })
    }
}

impl StepOperator for NonmanualSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        let (step, function) = (Self::OPERATOR_NAME, self.function.as_deref());
        check::check_named_text(step, &self.from, "the name of the sign is empty")?;
        check::check_optional_text(function, step, "the name of the function is empty")?;
        match &self.over {
            None => Ok(()),
            Some(ExpressionTimes::Part(span)) => cut::check_movement_part(step, span),
            Some(ExpressionTimes::At(times)) => {
                for at in times {
                    check::check_step_range(
                        step,
                        "a milestone",
                        at.0,
                        -check::MAX_RECIPE_SECONDS,
                        check::MAX_RECIPE_SECONDS,
                    )?;
                }
                if times.windows(2).any(|pair| pair[0].0 > pair[1].0) {
                    let what = "milestones decrease; write M1 to M5 in order of time";
                    return Err(RecipeError::Empty { step, what });
                }
                Ok(())
            }
        }
    }

    fn resolve_operator_inputs(&self, ask: &mut CorpusAsker<'_>, _setting: &MaterialSigner) -> Result<(), StepError> {
        let material = if self.is_expression() {
            let function = self.function.as_deref();
            let donor_expression = ask.sources.find_face_expression(&self.from, function)?;
            let input = ExpressionInput {
                function: donor_expression.function,
                milestones: donor_expression.milestones,
            };
            ask.put_answer(&EXPRESSION_SLOT, input);
            donor_expression.material
        } else {
            ask.sources.find_material(&self.from)?
        };
        ask.keep_movement(&NONMANUAL_DONOR_SLOT, material).map(|_| ())
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        let donor = given.answered_material(&NONMANUAL_DONOR_SLOT)?;
        let did = match given.get_answer(&EXPRESSION_SLOT) {
            Some(found) => expression_operator::transfer_expression(work, donor, self, found, given.text)?,
            None => transfer_nonmanuals(work, donor, given.text)?,
        };
        Ok(did.into())
    }

    fn contact_effect_for(&self, _handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        Some((ContactEffect::Same, ContactsToKeep::All(&BodySide::BOTH_SIDES)))
    }

    fn operator_form_fields(&mut self) -> Vec<FieldSetting<'_>> {
        let field = OperatorField::Sign(&mut self.from);
        vec![FieldSetting::new(InterfaceText::from_id("setting-from-sign"), field)]
    }
}

/// Gives head, neck, jaw and eyes their movement from another sign, stretched to this one's time.
pub(crate) fn transfer_nonmanuals(
    work: &mut WorkingClip,
    donor: &MovementMaterial,
    operator: &str,
) -> Result<Vec<String>, StepError> {
    let own = work.working_clip_span();
    let other = fit_donor_movement(work, donor, own)?;
    let groups = find_joint_groups(&work.skeleton, &work.anatomy);
    let head: Vec<usize> = (0..groups.len()).filter(|&j| groups[j] == JointGroup::Head).collect();
    if head.is_empty() {
        return Err(StepError::NoHead);
    }
    for &joint in &head {
        work.channels[joint] = other.channels[joint].clone();
    }
    let is_nonmanual = |note: &GeneratedNote| matches!(note.about, NoteSubject::Component(SignComponent::NonManual, _));
    work.notes.retain(|note| !is_nonmanual(note));
    work.notes.extend(other.notes.into_iter().filter(is_nonmanual));
    // Trunk and shoulders keep this sign's movement.
    work.curves.retain(is_of_trunk);
    work.curves
        .extend(other.curves.into_iter().filter(|curve| !is_of_trunk(curve)));
    work.note_changed_groups([JointGroup::Head], operator);
    let (seconds, own) = (donor.clip.clip_span().span_seconds(), own.span_seconds());
    Ok(vec![format!(
        "{} joints of the head from {} ({seconds:.2} s stretched to {own:.2} s)",
        head.len(),
        donor.address
    )])
}

/// Returns another sign's movement on this one's body.
pub(crate) fn donor_on_body(work: &WorkingClip, donor: &MovementMaterial) -> Result<WorkingClip, StepError> {
    let mut other = WorkingClip::working_clip_from(donor);
    if other.skeleton != work.skeleton {
        return retarget::retarget_movement(&other, &TargetBody::at_rest(&work.skeleton, &work.anatomy));
    }
    other.skeleton = Arc::clone(&work.skeleton);
    Ok(other)
}

/// Returns another sign's movement and notes on this one's body, stretched to a part of this one's time; before and after
/// that part it stands still.
pub(crate) fn fit_donor_movement(
    work: &WorkingClip,
    donor: &MovementMaterial,
    part: TimeSpan,
) -> Result<WorkingClip, StepError> {
    let mut other = donor_on_body(work, donor)?;
    let stretch = part.span_seconds() / donor.clip.clip_span().span_seconds().max(1e-9);
    let frames = work.rate.frames_in(part);
    let step = (other.frames - 1) as f64 / frames.len().saturating_sub(1).max(1) as f64;
    let sample_positions: Vec<f64> = (0..work.frames)
        .map(|frame| (frame as f64 - frames.start as f64) * step)
        .collect();
    other.resample_channels(&sample_positions);
    let start = part.span_start_instant();
    let stretched = |instant: RecordingInstant| {
        let seconds = start.instant_seconds() + instant.instant_seconds() * stretch;
        RecordingInstant::from_seconds(seconds).min(part.span_end_instant())
    };
    for note in &mut other.notes {
        let ends = [note.span.span_start_instant(), note.span.span_end_instant()].map(stretched);
        note.span = TimeSpan::span_between(ends[0], ends[1]);
    }
    Ok(other)
}
