//! `face`: gives parts of the face values of their own, or the face of another sign.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};
use std::sync::Arc;

use chereme_motion::{BodySide, RecordingInstant, TimeSpan};
use chereme_sign::hamnosys::{BodyLanguage, NonmanualAct, NonmanualPart, NotatedSign, TierKind};
use chereme_sign::words::InterfaceText;
use chereme_sign::{ComponentReading, SignComponent, SignerHandedness};
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::{AnswerSlot, CorpusAsker, NodeAnswers};
use crate::check;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::{RecipeError, StepError};
use crate::face_parts::FacePart;
use crate::notation::notation_nonmanual::{turn_body_joints, weights_over_span, written_body_bends};
use crate::notation::notation_plan::SignSpan;
use crate::notation::notation_stage::StandingBody;
use crate::ops::component_notes::cut_notes_in_span;
use crate::ops::cut::{self, CutEnds, SpanSettings};
use crate::ops::expression_operator::blend_curves;
use crate::ops::nonmanual_operator::fit_donor_movement;
use crate::ops::{
    FieldSetting, OperatorDescription, OperatorField, OperatorNeighbours, OperatorSyntax, Step, StepOperator,
    StepOutcome,
};
use crate::outcome::{GeneratedCurve, GeneratedNote, NoteSubject};
use crate::recipe_inputs::MaterialInput;
use crate::sources::MaterialSigner;
use crate::text::{ParsedText, QuotedName, RecipeParser, quote_recipe_text, write_option};
use crate::work::{JointGroup, WorkingClip, find_joint_groups};

/// Settings of `face brows=raised eyes=squint*0.5 over 0.2s..0.9s`, `face from BOL` and `mouth "bOl"`: values of parts of
/// the face, and another sign's face.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FaceSettings {
    /// The address of the sign whose face is taken; `None` to keep this one's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<String>,
    /// The values of its parts, each by its name or its code of SiGML, with its share: `raised`, `RB*0.5`; of a mouthing its
    /// sounds in SAMPA.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub show: BTreeMap<FacePart, String>,
    /// The part of this movement; without ends the whole of it.
    #[serde(default, skip_serializing_if = "is_whole")]
    pub over: SpanSettings,
}

fn is_whole(over: &SpanSettings) -> bool {
    *over == SpanSettings::default()
}

/// The sign whose face is taken.
const FACE_DONOR_SLOT: AnswerSlot<MaterialInput> = AnswerSlot::new("face/from");
/// The word that begins a mouthing alone.
const MOUTH_WORD: &str = "mouth";
const WANTED_PART: &str = "a part with its value, such as brows=raised (brows, eyes, cheeks, nose, mouth, mouthing, gaze, head), or \"from\" and a sign";
const WANTED_SOUNDS: &str = "the sounds of a word in SAMPA, such as \"bOl\"";

impl OperatorSyntax for FaceSettings {
    const OPERATOR_NAME: &'static str = "face";
    const OPERATOR_SYNONYMS: &'static [&'static str] = &[MOUTH_WORD];
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "face",
        "values-of-parts": "face brows=raised eyes=squint mouth=o over 0.2s..0.9s",
        "share-of-value": "face brows=furrowed*0.5 head=shaking",
        "mouthing": "mouth \"bOl\"",
        "face-alone-another": "face from BOL"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, word: &str) -> ParsedText<Self> {
        let mut face = Self::default();
        let mut assigned = None;
        if word == MOUTH_WORD {
            assigned = Some(("mouthing".to_owned(), parser.parse_recipe_name(WANTED_SOUNDS)?));
        } else if parser.accept_word("from") {
            face.from = Some(parser.parse_recipe_name("a sign")?);
        }
        while let Some((name, text)) = assigned.take().or_else(|| parser.accept_assignment()) {
            let named_part = FacePart::named_part(&name).and_then(|part| part.find_part_value(&text).map(|_| part));
            let part = named_part.map_err(|error| parser.fault_at_last_word(error.into()))?;
            face.show.insert(part, text);
        }
        if face.from.is_none() && face.show.is_empty() {
            return Err(parser.expected_text_error(WANTED_PART, &[]));
        }
        if parser.accept_word("over") {
            face.over = cut::parse_movement_part(parser)?;
        }
        Ok(face)
    }

    fn default_operator() -> Self {
        Self {
            show: BTreeMap::from([(FacePart::Brows, "raised".to_owned())]),
            ..Self::default()
        }
    }
}

impl Display for FaceSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(Self::OPERATOR_NAME)?;
        write_option(f, "from", self.from.as_deref().map(QuotedName))?;
        write_option(f, "", Some(self.shown_values_text()).filter(|text| !text.is_empty()))?;
        write_option(f, "over", Some(CutEnds(&self.over)).filter(|_| !is_whole(&self.over)))
    }
}

impl FaceSettings {
    /// Returns its values as a recipe has them: `brows=raised eyes=squint*0.5`.
    fn shown_values_text(&self) -> String {
        let is_special = |letter: char| letter.is_whitespace() || "|,()\"".contains(letter);
        let each = self.show.iter().map(|(part, text)| match text.contains(is_special) {
            true => format!("{}={}", part.face_part_name(), quote_recipe_text(text)),
            false => format!("{}={text}", part.face_part_name()),
        });
        each.collect::<Vec<_>>().join(" ")
    }

    /// Shows the values. Each replaces the former curves of its part by its weight; a head act adds to the head's own movement.
    fn show_values(
        &self,
        work: &mut WorkingClip,
        span: TimeSpan,
        weights: &[f64],
        step: &str,
    ) -> Result<(), StepError> {
        let is_shown = |name: &str| self.show.keys().any(|part| part.is_moved_by_curve(name));
        cut_notes_in_span(work, span, |note| is_note_of(note, is_shown));
        let mut shown_curves = Vec::new();
        for (part, text) in &self.show {
            let value = part.find_part_value(text).map_err(|_| StepError::Input)?;
            if let Some(name) = value.curve {
                if let Some(code) = name.strip_prefix("head.") {
                    move_head(work, code, value.amount, span)?;
                    work.note_changed_groups([JointGroup::Head], step);
                }
                let values = vec![value.amount; work.frames];
                shown_curves.push(GeneratedCurve { name, values });
            }
            work.notes.push(GeneratedNote {
                hand: None,
                about: NoteSubject::Component(SignComponent::NonManual, Some(part.face_part_feature().to_owned())),
                value: ComponentReading::Value(value.id),
                span,
                origin: step.to_owned(),
            });
        }
        blend_curves(work, shown_curves, weights, |curve| !is_shown(&curve.name));
        Ok(())
    }
}

impl StepOperator for FaceSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        let step = Self::OPERATOR_NAME;
        check::check_optional_text(self.from.as_deref(), step, "the name of the sign is empty")?;
        if self.from.is_none() && self.show.is_empty() {
            let what = "no part of the face is given; write one with its value, such as brows=raised";
            return Err(RecipeError::Empty { step, what });
        }
        for (part, text) in &self.show {
            part.find_part_value(text)?;
        }
        let part = Some(&self.over).filter(|over| !is_whole(over));
        part.map_or(Ok(()), |part| cut::check_movement_part(step, part))
    }

    fn resolve_operator_inputs(&self, ask: &mut CorpusAsker<'_>, _setting: &MaterialSigner) -> Result<(), StepError> {
        let Some(from) = &self.from else { return Ok(()) };
        let material = ask.sources.find_material(from)?;
        ask.keep_movement(&FACE_DONOR_SLOT, material).map(|_| ())
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        let frames = cut::movement_part_frames(work, &self.over)?;
        let rate = work.rate.per_second();
        let ends = [frames.start, frames.end].map(|frame| frame as f64 / rate);
        let weights = weights_over_span(ends, rate, work.frames);
        let span = work.rate.frame_range_span(frames);
        let mut did = Vec::new();
        if self.from.is_some() {
            let donor = given.answered_material(&FACE_DONOR_SLOT)?;
            let (other, address) = (fit_donor_movement(work, donor, span)?, donor.address.clone());
            let is_of_face = |name: &str| FacePart::of_curve_name(name).is_some_and(|part| part != FacePart::Head);
            if !other.curves.iter().any(|curve| is_of_face(&curve.name)) {
                return Err(StepError::NothingToTake { address, what: "face" });
            }
            cut_notes_in_span(work, span, |note| is_note_of(note, is_of_face));
            let notes = other.notes.into_iter().filter(|note| is_note_of(note, is_of_face));
            work.notes.extend(notes);
            blend_curves(work, other.curves, &weights, |curve| !is_of_face(&curve.name));
            let (own, target) = (donor.clip.clip_span().span_seconds(), span.span_seconds());
            did.push(format!(
                "the face from {address} ({own:.2} s stretched to {target:.2} s)"
            ));
        }
        if !self.show.is_empty() {
            self.show_values(work, span, &weights, given.text)?;
            let (from, to) = (span.span_start_instant(), span.span_end_instant());
            let values = self.shown_values_text();
            did.push(format!("the face shows {values} from {from} to {to}"));
        }
        Ok(did.into())
    }

    fn contact_effect_for(&self, _handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        let effect = (ContactEffect::Same, ContactsToKeep::All(&BodySide::BOTH_SIDES));
        self.show.contains_key(&FacePart::Head).then_some(effect)
    }

    fn relation_to_previous(&self, before: &mut Step) -> OperatorNeighbours {
        match before {
            Step::Face(other) if other == self => OperatorNeighbours::One,
            _ => OperatorNeighbours::Apart,
        }
    }

    fn operator_form_fields(&mut self) -> Vec<FieldSetting<'_>> {
        let setting = |id, field| FieldSetting::new(InterfaceText::from_id(id), field);
        let donor = self.from.as_mut().map(OperatorField::Sign);
        let donor = donor.map(|field| setting("setting-from-sign", field));
        let own = [
            setting("setting-face", OperatorField::Face(&mut self.show)),
            setting("setting-from-time", OperatorField::Time(&mut self.over.from, 0.2)),
            setting("setting-to-time", OperatorField::Time(&mut self.over.to, 1.0)),
        ];
        donor.into_iter().chain(own).collect()
    }
}

/// Returns whether a note is about one of the parts for which `is_meant` returns true of the curve with its name.
fn is_note_of(note: &GeneratedNote, is_meant: impl Fn(&str) -> bool) -> bool {
    let value = note.value.reading_value().unwrap_or_default();
    matches!(&note.about, NoteSubject::Component(SignComponent::NonManual, Some(feature)) if is_meant(&format!("{feature}.{value}")))
}

/// Moves the head by an act of notation over a span of time, in addition to its own movement.
fn move_head(work: &mut WorkingClip, code: &str, amount: f64, span: TimeSpan) -> Result<(), StepError> {
    let groups = find_joint_groups(&work.skeleton, &work.anatomy);
    let head: Vec<usize> = (0..groups.len()).filter(|&j| groups[j] == JointGroup::Head).collect();
    head.first().ok_or(StepError::NoHead)?;
    let (skeleton, anatomy) = (Arc::clone(&work.skeleton), Arc::clone(&work.anatomy));
    let body = StandingBody::body_in_posture(skeleton, anatomy, work.local_pose_at(0)).ok_or(StepError::NoHead)?;
    let mut act = NonmanualAct::new(NonmanualPart::Head, code);
    act.amount = Some(amount);
    let mut sign = NotatedSign::default();
    sign.nonmanual.push_act_group(TierKind::Head, vec![act]);
    let [from, to] = [span.span_start_instant(), span.span_end_instant()].map(RecordingInstant::instant_seconds);
    let (language, rate) = (BodyLanguage::default_body_language(), work.rate.per_second());
    let (gloss, mut channels) = (String::new(), work.channels.clone());
    let (bends, _) = written_body_bends(&[&sign], &[SignSpan { gloss, from, to }], language, rate, work.frames);
    let frames: Vec<(usize, f64)> = (0..work.frames).map(|frame| (frame, 0.0)).collect();
    turn_body_joints(&body, &bends, &frames, &mut channels);
    // The animator turns every joint, those of the trunk by nothing but a rounding.
    for joint in head {
        work.channels[joint] = channels[joint].clone();
    }
    Ok(())
}
