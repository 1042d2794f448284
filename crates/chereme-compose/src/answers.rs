//! The corpus's answers for the parts of a recipe: typed slots that are filled once and read repeatedly.
//!
//! Each operator and source declares a [`AnswerSlot`] for every answer that it needs. Resolving writes through [`CorpusAsker`],
//! evaluating reads through [`NodeAnswers`], both by the same slot, so that its name cannot be misspelt and it holds one
//! type.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};
use std::marker::PhantomData;
use std::sync::Arc;

use chereme_motion::BodySide;
use chereme_sign::SignComponent;
use chereme_sign::hamnosys::NotatedSign;

use crate::body::{self, SignerFrame};
use crate::course::{self, TransitionCourses};
use crate::cue_timing::CuePhases;
use crate::error::StepError;
use crate::language::BodyLanguageChanges;
use crate::poses::HandPose;
use crate::recipe_inputs::{ExpressionInput, LetterInput, MaterialInput, PlaceInput, RecipeInput, RecipeInputs};
use crate::recipe_settings::{PostureTransition, RecipeHandPoint, SigningSpot, TransitionProfile};
use crate::sources::{LearnedProfile, MaterialSigner, MovementMaterial, RecipeSources, SpellingTimes, ValueMeaning};
use crate::work::WorkingClip;

/// The place of a node or operator in a recipe's JSON, such as `/pipe/steps/0`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct RecipePath(String);

impl RecipePath {
    /// Returns the path of the operand of a pipe.
    pub(crate) fn operand_path(&self) -> Self {
        Self(format!("{self}/pipe/of"))
    }

    /// Returns the path of an operator.
    pub(crate) fn operator_step_path(&self, n: usize) -> Self {
        Self(format!("{self}/pipe/steps/{n}"))
    }

    /// Returns the path of the first piece of an utterance.
    pub(crate) fn first_piece_path(&self) -> Self {
        Self(format!("{self}/then/first"))
    }

    /// Returns the path of a later piece, together with its transition.
    pub(crate) fn later_piece_path(&self, n: usize) -> Self {
        Self(format!("{self}/then/next/{n}"))
    }

    /// Returns the path of the piece itself, below the path of a later piece.
    pub(crate) fn inner_piece_path(&self) -> Self {
        Self(format!("{self}/node"))
    }

    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }
}

impl Display for RecipePath {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A kind of answer.
pub(crate) trait AnswerKind: Sized {
    /// Converts the answer to the stored form.
    fn to_stored_input(self) -> RecipeInput;
    /// Returns the answer; `None` if the stored one is of another kind.
    fn from_stored_input(input: &RecipeInput) -> Option<&Self>;
}

macro_rules! answers {
    ($($kind:ident: $type:ty;)*) => {
        $(impl AnswerKind for $type {
            fn to_stored_input(self) -> RecipeInput {
                RecipeInput::$kind(self)
            }
            fn from_stored_input(input: &RecipeInput) -> Option<&Self> {
                match input {
                    RecipeInput::$kind(answer) => Some(answer),
                    _ => None,
                }
            }
        })*
    };
}

answers! {
    Material: MaterialInput;
    Poses: Vec<HandPose>;
    Place: PlaceInput;
    Letters: Vec<LetterInput>;
    Notation: Vec<NotatedSign>;
    Language: BodyLanguageChanges;
    Courses: LearnedProfile;
    Times: SpellingTimes;
    Phases: CuePhases;
    Expression: ExpressionInput;
}

/// The name of one answer below the node that needs it, such as `configure/via`.
#[derive(Debug, Clone)]
pub(crate) struct AnswerSlot<T> {
    end: Cow<'static, str>,
    kind: PhantomData<fn() -> T>,
}

impl<T> AnswerSlot<T> {
    /// Returns a slot with this name in the JSON of the node.
    pub(crate) const fn new(end: &'static str) -> Self {
        Self {
            end: Cow::Borrowed(end),
            kind: PhantomData,
        }
    }

    /// Returns the slot of one of several answers: that for the value with this number on a side.
    pub(crate) fn numbered_side_slot(&self, n: usize, side: BodySide) -> Self {
        Self {
            end: Cow::Owned(format!("{}/{n}/{}", self.end, side.body_side_name())),
            kind: PhantomData,
        }
    }

    /// Returns its path in the whole recipe, for a node at `path`.
    pub(crate) fn slot_path_at(&self, path: &RecipePath) -> String {
        format!("{path}/{}", self.end)
    }
}

/// The answers found so far.
#[derive(Default)]
pub(crate) struct RecipeAnswers {
    pub(crate) inputs: RecipeInputs,
    pub(crate) materials: BTreeMap<String, Arc<MovementMaterial>>,
}

/// Asks the corpus for the needs of one node or operator, and stores the answers.
pub(crate) struct CorpusAsker<'a> {
    pub(crate) sources: &'a dyn RecipeSources,
    pub(crate) path: &'a RecipePath,
    pub(crate) answers: &'a mut RecipeAnswers,
}

impl CorpusAsker<'_> {
    /// Stores an answer.
    pub(crate) fn put_answer<T: AnswerKind>(&mut self, slot: &AnswerSlot<T>, answer: T) {
        let slot_path = slot.slot_path_at(self.path);
        self.answers.inputs.0.insert(slot_path, answer.to_stored_input());
    }

    /// Stores movement; returns its signer.
    pub(crate) fn keep_movement(
        &mut self,
        slot: &AnswerSlot<MaterialInput>,
        material: MovementMaterial,
    ) -> Result<MaterialSigner, StepError> {
        if material.clip.clip_frame_count() == 0 {
            return Err(StepError::Empty(material.address));
        }
        let setting = MaterialSigner::signer_from_material(&material);
        let input = MaterialInput {
            address: material.address.clone(),
            hash: material.hash.clone(),
            gloss: material.gloss.clone(),
            handedness: material.handedness,
            held: material.held.clone(),
            body: self.sources.performer(&material.address)?,
        };
        self.put_answer(slot, input);
        let slot_path = slot.slot_path_at(self.path);
        self.answers.materials.insert(slot_path, Arc::new(material));
        Ok(setting)
    }

    /// Stores the body of a signer, or of one that the corpus chooses; returns the signer.
    pub(crate) fn ask_signer_body(
        &mut self,
        slot: &AnswerSlot<MaterialInput>,
        on: Option<&str>,
    ) -> Result<MaterialSigner, StepError> {
        let stage = self.sources.stage(on)?;
        self.keep_movement(slot, stage)
    }

    /// Stores the learned courses if a transition uses them.
    pub(crate) fn ask_learned_courses(
        &mut self,
        slot: &AnswerSlot<LearnedProfile>,
        via: &PostureTransition,
    ) -> Result<(), StepError> {
        if via.profile == Some(TransitionProfile::Learned) {
            let profile = self.sources.learned_profile()?.ok_or(StepError::NoProfile)?;
            // A transition takes the learned courses alone; reaches serve gestures.
            let reaches = None;
            self.put_answer(slot, LearnedProfile { reaches, ..profile });
        }
        Ok(())
    }

    /// Stores the learned reaches for a gesture that takes them by default.
    pub(crate) fn usual_reaches(
        &mut self,
        slot: &AnswerSlot<LearnedProfile>,
        via: &PostureTransition,
    ) -> Result<(), StepError> {
        if via.profile.is_some() {
            return self.ask_learned_courses(slot, via);
        }
        let learned = self.sources.learned_profile()?;
        if let Some(learned) = learned.filter(|learned| learned.reaches.is_some()) {
            self.put_answer(slot, learned);
        }
        Ok(())
    }

    /// Stores the place of a spot if the spot is a value of an inventory.
    pub(crate) fn ask_spot_place(
        &mut self,
        slot: &AnswerSlot<PlaceInput>,
        spot: &SigningSpot,
    ) -> Result<(), StepError> {
        if let SigningSpot::Value(value) = spot {
            let place = self.find_value_place(value)?;
            self.put_answer(slot, place);
        }
        Ok(())
    }

    /// Returns the place of a value: the inventory's own, or that of a sign with the value.
    pub(crate) fn find_value_place(&self, text: &str) -> Result<PlaceInput, StepError> {
        let value = self.sources.find_component_value(SignComponent::Placement, text)?;
        if let Some(ValueMeaning::Place(at)) = value.meaning {
            return Ok(PlaceInput {
                value: Some(value.id),
                from: value.inventory,
                at,
            });
        }
        let examples = self.sources.holding(SignComponent::Placement, &value.id)?;
        let Some(example) = examples.first() else {
            let what = "place on the body";
            return Err(StepError::NoMeaning { value: value.id, what });
        };
        let material = self.sources.find_material(&example.address)?;
        let side = example.hand.unwrap_or(material.handedness.signer_dominant_side());
        let shown_place = find_shown_place(&material, &[side], None)?;
        Ok(PlaceInput {
            value: Some(value.id),
            ..shown_place
        })
    }
}

/// The answers for one node or operator.
pub(crate) struct NodeAnswers<'a> {
    pub(crate) inputs: &'a BTreeMap<String, RecipeInput>,
    pub(crate) materials: &'a BTreeMap<String, Arc<MovementMaterial>>,
    pub(crate) path: &'a RecipePath,
    /// The node or operator as text.
    pub(crate) text: &'a str,
    /// Notes for the report on the sources of answers.
    pub(crate) aside: Vec<String>,
}

impl<'a> NodeAnswers<'a> {
    /// Returns an answer, if there is one.
    pub(crate) fn get_answer<T: AnswerKind + 'a>(&self, slot: &AnswerSlot<T>) -> Option<&'a T> {
        self.inputs
            .get(&slot.slot_path_at(self.path))
            .and_then(T::from_stored_input)
    }

    /// Returns an answer that is required. Fails if it is missing.
    pub(crate) fn required_answer<T: AnswerKind + 'a>(&self, slot: &AnswerSlot<T>) -> Result<&'a T, StepError> {
        self.get_answer(slot).ok_or(StepError::Input)
    }

    /// Returns the movement in a slot.
    pub(crate) fn answered_material(
        &self,
        slot: &AnswerSlot<MaterialInput>,
    ) -> Result<&'a MovementMaterial, StepError> {
        let stored_material = self.materials.get(&slot.slot_path_at(self.path));
        stored_material.map(AsRef::as_ref).ok_or(StepError::Input)
    }

    /// Returns the courses of a transition: those that it names, the learned ones if there are any, or the default ones.
    pub(crate) fn transition_courses(
        &mut self,
        slot: &AnswerSlot<LearnedProfile>,
        via: &PostureTransition,
        usual: TransitionProfile,
    ) -> Result<TransitionCourses, StepError> {
        let learned = self.get_answer(slot);
        self.aside.extend(learned.map(course::describe_learned_profile));
        let usual = learned.map_or(usual, |_| TransitionProfile::Learned);
        TransitionCourses::from_transition_profile(via.profile.unwrap_or(usual), learned).ok_or(StepError::NoProfile)
    }
}

/// Returns the placement of the hands throughout another sign, if it has exactly one.
fn held_hand_place(material: &MovementMaterial, sides: &[BodySide]) -> Option<String> {
    let dominant = material.handedness.signer_dominant_side();
    let annotated = material.held.iter().filter(|held| {
        // Annotations without a hand belong to the dominant one.
        let of = sides.contains(&held.hand.unwrap_or(dominant));
        of && held.component == SignComponent::Placement && held.feature.is_none()
    });
    let mut values = annotated.filter_map(|held| held.value.reading_value());
    let first = values.next()?;
    values.all(|value| value == first).then(|| first.to_owned())
}

/// Returns the position of the hands in the middle of another sign, relative to the signer's chest and arms.
pub(crate) fn find_shown_place(
    material: &MovementMaterial,
    sides: &[BodySide],
    with: Option<RecipeHandPoint>,
) -> Result<PlaceInput, StepError> {
    let work = WorkingClip::working_clip_from(material);
    let frame = SignerFrame::from_mean_posture(&work);
    let mean = body::mean_point(&work, sides, with.unwrap_or(RecipeHandPoint::Palm));
    let (Some(frame), Some(mean)) = (frame, mean) else {
        let address = material.address.clone();
        let what = "hand's place";
        return Err(StepError::NothingToTake { address, what });
    };
    Ok(PlaceInput {
        value: held_hand_place(material, sides),
        from: material.address.clone(),
        at: frame.relative_spatial_position(mean),
    })
}
