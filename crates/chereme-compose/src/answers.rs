//! The corpus's answers for the parts of a recipe: typed slots that are filled once and read repeatedly.
//!
//! Each operator and source declares a [`Slot`] for every answer that it needs. Resolving writes through [`Ask`],
//! evaluating reads through [`Given`], both by the same slot, so that its name cannot be misspelt and it holds one
//! type.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};
use std::marker::PhantomData;
use std::sync::Arc;

use chereme_motion::Side;
use chereme_sign::hamnosys::Notated;
use chereme_sign::{Component, Handedness};

use crate::course::{self, Courses};
use crate::cue::CuePhases;
use crate::error::Cause;
use crate::language::Language;
use crate::ops::place;
use crate::poses::HandPose;
use crate::recipe::{Profile, Spot, Transition};
use crate::resolve::{ExpressionInput, Input, Inputs, LetterInput, MaterialInput, PlaceInput};
use crate::sources::{LearnedProfile, Material, Meaning, Sources, SpellingTimes};

/// The place of a node or operator in a recipe's JSON, such as `/pipe/steps/0`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Path(String);

impl Path {
    /// Returns the path of the operand of a pipe.
    pub(crate) fn operand(&self) -> Self {
        Self(format!("{self}/pipe/of"))
    }

    /// Returns the path of an operator.
    pub(crate) fn step(&self, n: usize) -> Self {
        Self(format!("{self}/pipe/steps/{n}"))
    }

    /// Returns the path of the first piece of an utterance.
    pub(crate) fn first(&self) -> Self {
        Self(format!("{self}/then/first"))
    }

    /// Returns the path of a later piece, together with its transition.
    pub(crate) fn joined(&self, n: usize) -> Self {
        Self(format!("{self}/then/next/{n}"))
    }

    /// Returns the path of the piece itself, below the path of a later piece.
    pub(crate) fn piece(&self) -> Self {
        Self(format!("{self}/node"))
    }

    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }
}

impl Display for Path {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A kind of answer.
pub(crate) trait Answer: Sized {
    /// Converts the answer to the stored form.
    fn stored(self) -> Input;
    /// Returns the answer; `None` if the stored one is of another kind.
    fn of(input: &Input) -> Option<&Self>;
}

macro_rules! answers {
    ($($kind:ident: $type:ty;)*) => {
        $(impl Answer for $type {
            fn stored(self) -> Input {
                Input::$kind(self)
            }
            fn of(input: &Input) -> Option<&Self> {
                match input {
                    Input::$kind(answer) => Some(answer),
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
    Notation: Vec<Notated>;
    Language: Language;
    Courses: LearnedProfile;
    Times: SpellingTimes;
    Phases: CuePhases;
    Expression: ExpressionInput;
}

/// The name of one answer below the node that needs it, such as `configure/via`.
#[derive(Debug, Clone)]
pub(crate) struct Slot<T> {
    end: Cow<'static, str>,
    kind: PhantomData<fn() -> T>,
}

impl<T> Slot<T> {
    /// Returns a slot with this name in the JSON of the node.
    pub(crate) const fn new(end: &'static str) -> Self {
        Self {
            end: Cow::Borrowed(end),
            kind: PhantomData,
        }
    }

    /// Returns the slot of one of several answers: that for the value with this number on a side.
    pub(crate) fn of(&self, n: usize, side: Side) -> Self {
        Self {
            end: Cow::Owned(format!("{}/{n}/{}", self.end, side.name())),
            kind: PhantomData,
        }
    }

    /// Returns its path in the whole recipe, for a node at `path`.
    pub(crate) fn at(&self, path: &Path) -> String {
        format!("{path}/{}", self.end)
    }
}

/// The signer whose movement an operator changes.
#[derive(Clone)]
pub(crate) struct Setting {
    pub(crate) signer: Option<String>,
    pub(crate) handedness: Handedness,
}

impl Setting {
    pub(crate) fn of(material: &Material) -> Self {
        Self {
            signer: material.signer.clone(),
            handedness: material.handedness,
        }
    }
}

/// The answers found so far.
#[derive(Default)]
pub(crate) struct Answers {
    pub(crate) inputs: Inputs,
    pub(crate) materials: BTreeMap<String, Arc<Material>>,
}

/// Asks the corpus for the needs of one node or operator, and stores the answers.
pub(crate) struct Ask<'a> {
    pub(crate) sources: &'a dyn Sources,
    pub(crate) path: &'a Path,
    pub(crate) answers: &'a mut Answers,
}

impl Ask<'_> {
    /// Stores an answer.
    pub(crate) fn put<T: Answer>(&mut self, slot: &Slot<T>, answer: T) {
        let at = slot.at(self.path);
        self.answers.inputs.0.insert(at, answer.stored());
    }

    /// Stores movement; returns its signer.
    pub(crate) fn keep(
        &mut self,
        slot: &Slot<MaterialInput>,
        material: Material,
    ) -> Result<Setting, Cause> {
        if material.clip.frames() == 0 {
            return Err(Cause::Empty(material.address));
        }
        let setting = Setting::of(&material);
        let input = MaterialInput {
            address: material.address.clone(),
            hash: material.hash.clone(),
            gloss: material.gloss.clone(),
            handedness: material.handedness,
            held: material.held.clone(),
            body: self.sources.performer(&material.address)?,
        };
        self.put(slot, input);
        let at = slot.at(self.path);
        self.answers.materials.insert(at, Arc::new(material));
        Ok(setting)
    }

    /// Stores the body of a signer, or of one that the corpus chooses; returns the signer.
    pub(crate) fn body(
        &mut self,
        slot: &Slot<MaterialInput>,
        on: Option<&str>,
    ) -> Result<Setting, Cause> {
        let stage = self.sources.stage(on)?;
        self.keep(slot, stage)
    }

    /// Stores the learned courses if a transition uses them.
    pub(crate) fn course(
        &mut self,
        slot: &Slot<LearnedProfile>,
        via: &Transition,
    ) -> Result<(), Cause> {
        if via.profile == Some(Profile::Learned) {
            let profile = self.sources.learned_profile()?.ok_or(Cause::NoProfile)?;
            let reaches = None;
            self.put(slot, LearnedProfile { reaches, ..profile });
        }
        Ok(())
    }

    /// Stores the learned reaches for a gesture that takes them by default.
    pub(crate) fn usual_reaches(
        &mut self,
        slot: &Slot<LearnedProfile>,
        via: &Transition,
    ) -> Result<(), Cause> {
        if via.profile.is_some() {
            return self.course(slot, via);
        }
        let learned = self.sources.learned_profile()?;
        if let Some(learned) = learned.filter(|learned| learned.reaches.is_some()) {
            self.put(slot, learned);
        }
        Ok(())
    }

    /// Stores the place of a spot if the spot is a value of an inventory.
    pub(crate) fn spot(&mut self, slot: &Slot<PlaceInput>, spot: &Spot) -> Result<(), Cause> {
        if let Spot::Value(value) = spot {
            let place = self.place(value)?;
            self.put(slot, place);
        }
        Ok(())
    }

    /// Returns the place of a value: the inventory's own, or that of a sign with the value.
    pub(crate) fn place(&self, text: &str) -> Result<PlaceInput, Cause> {
        let value = self.sources.value(Component::Placement, text)?;
        if let Some(Meaning::Place(at)) = value.meaning {
            return Ok(PlaceInput {
                value: Some(value.id),
                from: value.inventory,
                at,
            });
        }
        let examples = self.sources.holding(Component::Placement, &value.id)?;
        let Some(example) = examples.first() else {
            let what = "place on the body";
            return Err(Cause::NoMeaning {
                value: value.id,
                what,
            });
        };
        let material = self.sources.material(&example.address)?;
        let side = example.hand.unwrap_or(material.handedness.dominant());
        let found = place::shown_by(&material, &[side], None)?;
        Ok(PlaceInput {
            value: Some(value.id),
            ..found
        })
    }
}

/// The answers for one node or operator.
pub(crate) struct Given<'a> {
    pub(crate) inputs: &'a BTreeMap<String, Input>,
    pub(crate) materials: &'a BTreeMap<String, Arc<Material>>,
    pub(crate) path: &'a Path,
    /// The node or operator as text.
    pub(crate) text: &'a str,
    /// Notes for the report on the sources of answers.
    pub(crate) aside: Vec<String>,
}

impl<'a> Given<'a> {
    /// Returns an answer, if there is one.
    pub(crate) fn get<T: Answer + 'a>(&self, slot: &Slot<T>) -> Option<&'a T> {
        self.inputs.get(&slot.at(self.path)).and_then(T::of)
    }

    /// Returns an answer that is required. Fails if it is missing.
    pub(crate) fn need<T: Answer + 'a>(&self, slot: &Slot<T>) -> Result<&'a T, Cause> {
        self.get(slot).ok_or(Cause::Input)
    }

    /// Returns the movement in a slot.
    pub(crate) fn material(&self, slot: &Slot<MaterialInput>) -> Result<&'a Material, Cause> {
        let found = self.materials.get(&slot.at(self.path));
        found.map(AsRef::as_ref).ok_or(Cause::Input)
    }

    /// Returns the courses of a transition: those that it names, the learned ones if there are any, or the default ones.
    pub(crate) fn course(
        &mut self,
        slot: &Slot<LearnedProfile>,
        via: &Transition,
        usual: Profile,
    ) -> Result<Courses, Cause> {
        let learned = self.get(slot);
        self.aside.extend(learned.map(course::describe));
        let usual = learned.map_or(usual, |_| Profile::Learned);
        Courses::of(via.profile.unwrap_or(usual), learned).ok_or(Cause::NoProfile)
    }
}
